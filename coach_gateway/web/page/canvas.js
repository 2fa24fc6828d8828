// The picture of the match: the ground when it changes, all that moves thirty times a second or more.

import { drawBall, drawGhost, drawObstacle, drawRobot, drawVelocity } from "./bodies.js";
import { drawBeliefs, drawPasses } from "./beliefs.js";
import { SIDES } from "./shapes.js";
import { drawDistances } from "./distances.js";
import { drawPitch } from "./pitch.js";
import { Trails } from "./trails.js";
import { Projection } from "./projection.js";

const ROOM_PX = 520; // a narrower field has room for the chosen robot's role alone

export class PitchCanvas {
  projection = new Projection();
  /** What is drawn now, or nothing. */
  world = null;
  /** Pictures drawn since the page was opened. */
  drawn = 0;
  /** Pictures in the last whole second. */
  rate = 0;
  /** What others draw over it all: functions of (context, projection). */
  over = [];
  #trails = new Trails();
  #second = 0;
  #inSecond = 0;
  #ground;
  #moving;
  #ends = "";

  constructor(ground, moving, match, layers, selection) {
    this.#ground = ground;
    this.#moving = moving;
    Object.assign(this, { match, layers, selection });
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
    this.world = match.frames.at(performance.now());
    const context = this.#moving.getContext("2d");
    context.setTransform(this.projection.density, 0, 0, this.projection.density, 0, 0);
    context.clearRect(0, 0, this.projection.width, this.projection.height);
    if (this.world !== null) this.#drawWorld(context, this.world);
    for (const draws of this.over) draws(context, this.projection);
    this.#count(now);
  }

  #fit() {
    const { match, projection } = this;
    const changed = projection.fit(match.setup.pitch, this.#moving.parentElement.clientWidth, this.layers.seenFrom, match);
    const defends = match.attack("cyan") > 0 ? ["cyan", "magenta"] : ["magenta", "cyan"];
    const ends = `${defends} ${match.setup.teams.cyan.name} ${match.setup.teams.magenta.name}`;
    if (!changed && ends === this.#ends) return;
    this.#ends = ends;
    for (const canvas of [this.#ground, this.#moving]) {
      canvas.width = Math.round(projection.width * projection.density);
      canvas.height = Math.round(projection.height * projection.density);
    }
    this.#moving.parentElement.style.height = `${projection.height}px`;
    const context = this.#ground.getContext("2d");
    context.setTransform(projection.density, 0, 0, projection.density, 0, 0);
    drawPitch(context, projection, match.setup.pitch, match.setup.teams, defends);
  }

  #drawWorld(context, world) {
    const { match, projection, layers, selection } = this;
    this.#trails.note(world);
    if (layers.obstacles) for (const obstacle of Object.values(world.obstacles ?? {})) drawObstacle(context, projection, obstacle);
    this.#trails.draw(context, projection, match, layers.trails);
    if (layers.distances) drawDistances(context, projection, match, world);
    if (layers.passes) drawPasses(context, projection, match, world);
    if (layers.beliefs !== "none") drawBeliefs(context, projection, match, world, layers.beliefs);
    for (const [name, robot] of Object.entries(world.robots)) {
      if (layers.velocities) drawVelocity(context, projection, robot, SIDES[match.sideOf(name)].line);
      drawRobot(context, projection, match, name, robot, {
        selected: name === selection.robot,
        holding: world.possession === name,
        label: layers.roles && (projection.width >= ROOM_PX || name === selection.robot) ? match.radioOf(name)?.role : null,
      });
    }
    drawBall(context, projection, world.ball, match.setup.ball.radius, layers.velocities);
    if (selection.dragged) drawGhost(context, projection, selection.dragged);
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
