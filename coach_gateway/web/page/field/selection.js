// The user's selection: the chosen robot, the body that is being dragged, the point that is picked on the field.

export class Selection {
  /** The robot that buttons, panels and driving are about, or null. */
  robot = null;
  /** The body that is being dragged: {x, y, radius}, or null. */
  dragged = null;
  /** The request for a point of the field: {words, take}, or null. */
  picking = null;
  #handlers = [];

  /** Calls `does` when the selection changes. */
  on(does) {
    this.#handlers.push(does);
  }

  choose(robot) {
    this.robot = robot;
    this.#notify();
  }

  /** Calls `take` with the next point of the field, and with a direction if one was drawn. */
  pick(words, take) {
    this.picking = { words, take };
    this.#notify();
  }

  picked(place, angle) {
    const { take } = this.picking;
    this.picking = null;
    take(place, angle);
    this.#notify();
  }

  /** Ends picking and dragging. */
  cancel() {
    this.picking = null;
    this.dragged = null;
    this.#notify();
  }

  #notify() {
    for (const does of this.#handlers) does(this);
  }
}
