// The picture of the match: the ground when it changes, all that moves thirty times a second or more.

import { drawBall, drawGhost, drawObstacle, drawRobot, drawVelocity } from "./bodies.js";
import { drawBeliefs, drawPasses } from "./beliefs.js";
import { SIDES } from "./brush.js";
import { drawDistances } from "./distances.js";
import { drawPitch } from "./pitch.js";
import { Trails } from "./trails.js";
import { View } from "./view.js";

const ROOM_PX = 520; // a narrower field has room for the chosen robot's role alone

export class Stage {
  view = new View();
  /** What is drawn now, or nothing. */
  world = null;
  /** Pictures drawn since the page was opened. */
  drawn = 0;
  /** Pictures in the last whole second. */
  rate = 0;
  /** What others draw over it all: functions of (context, view). */
  over = [];
  #trails = new Trails();
  #second = 0;
  #inSecond = 0;
  #ground;
  #moving;
  #ends = "";

  constructor(ground, moving, match, layers, seat) {
    this.#ground = ground;
    this.#moving = moving;
    Object.assign(this, { match, layers, seat });
    const draw = (now) => {
      this.#draw(now);
      requestAnimationFrame(draw);
    };
    requestAnimationFrame(draw);
  }

  #draw(now) {
    const { match } = this;
    if (match.setup === null) return;
    this.#fit();
    this.world = match.film.at(performance.now());
    const context = this.#moving.getContext("2d");
    context.setTransform(this.view.density, 0, 0, this.view.density, 0, 0);
    context.clearRect(0, 0, this.view.width, this.view.height);
    if (this.world !== null) this.#drawWorld(context, this.world);
    for (const draws of this.over) draws(context, this.view);
    this.#count(now);
  }

  #fit() {
    const { match, view } = this;
    const changed = view.fit(match.setup.pitch, this.#moving.parentElement.clientWidth, this.layers.seenFrom, match);
    const defends = match.attack("cyan") > 0 ? ["cyan", "magenta"] : ["magenta", "cyan"];
    const ends = `${defends} ${match.setup.teams.cyan.name} ${match.setup.teams.magenta.name}`;
    if (!changed && ends === this.#ends) return;
    this.#ends = ends;
    for (const canvas of [this.#ground, this.#moving]) {
      canvas.width = Math.round(view.width * view.density);
      canvas.height = Math.round(view.height * view.density);
    }
    this.#moving.parentElement.style.height = `${view.height}px`;
    const context = this.#ground.getContext("2d");
    context.setTransform(view.density, 0, 0, view.density, 0, 0);
    drawPitch(context, view, match.setup.pitch, match.setup.teams, defends);
  }

  #drawWorld(context, world) {
    const { match, view, layers, seat } = this;
    this.#trails.note(world);
    if (layers.obstacles) for (const obstacle of Object.values(world.obstacles ?? {})) drawObstacle(context, view, obstacle);
    this.#trails.draw(context, view, match, layers.trails);
    if (layers.distances) drawDistances(context, view, match, world);
    if (layers.passes) drawPasses(context, view, match, world);
    if (layers.beliefs !== "none") drawBeliefs(context, view, match, world, layers.beliefs);
    for (const [name, robot] of Object.entries(world.robots)) {
      if (layers.velocities) drawVelocity(context, view, robot, SIDES[match.sideOf(name)].line);
      drawRobot(context, view, match, name, robot, {
        selected: name === seat.robot,
        holding: world.possession === name,
        label: layers.roles && (view.width >= ROOM_PX || name === seat.robot) ? match.wordOf(name)?.role : null,
      });
    }
    drawBall(context, view, world.ball, match.setup.ball.radius, layers.velocities);
    if (seat.dragged) drawGhost(context, view, seat.dragged);
  }

  #count(now) {
    this.drawn += 1;
    this.#inSecond += 1;
    if (now - this.#second < 1000) return;
    this.rate = Math.round((1000 * this.#inSecond) / (now - this.#second));
    this.#second = now;
    this.#inSecond = 0;
  }
}
