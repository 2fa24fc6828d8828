// What who sits here has in hand: the robot that is chosen, what is being dragged, what is picked on the field.

export class Selection {
  /** The robot that buttons, panels and driving are about, or nothing. */
  robot = null;
  /** Where a body is being dragged: {x, y, radius}, or nothing. */
  dragged = null;
  /** Who waits for a point of the field: {words, take}, or nothing. */
  picking = null;
  #handlers = [];

  /** Has `does` called when something here changes. */
  on(does) {
    this.#handlers.push(does);
  }

  choose(robot) {
    this.robot = robot;
    this.#tell();
  }

  /** The next point of the field goes to `take`: a place, and a direction if one was drawn. */
  pick(words, take) {
    this.picking = { words, take };
    this.#tell();
  }

  picked(place, angle) {
    const { take } = this.picking;
    this.picking = null;
    take(place, angle);
    this.#tell();
  }

  /** Lets go of everything. */
  cancel() {
    this.picking = null;
    this.dragged = null;
    this.#tell();
  }

  #tell() {
    for (const does of this.#handlers) does(this);
  }
}
