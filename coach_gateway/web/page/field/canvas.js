// The picture of the match: the ground is drawn when it changes, everything that moves with each frame of the browser.

import { drawBeliefs, drawPasses } from "./beliefs.js";
import { drawDrawings } from "./drawings.js";
import { drawDistances } from "./distances.js";
import { drawFloor, drawZones } from "./floor.js";
import { fillGoals, writeTeams } from "./goals.js";
import { drawGhost, drawMarkedRobot, drawObstacle, drawVelocity } from "./marked_bodies.js";
import { Readings } from "./readings.js";
import { drawRoleLabels } from "./role_labels.js";
import { signOf } from "./seen_from.js";
import { drawBall } from "../shared/bodies.js";
import { drawGrass, drawLines } from "../shared/pitch.js";
import { Projection } from "../shared/projection.js";
import { SIDES } from "../shared/palette.js";
import { Trails } from "./trails.js";

const BALL_VELOCITY = "#ffd978";
const ROOM_PX = 520; // a narrower field shows the role of the chosen robot alone

export class PitchCanvas {
  projection = new Projection();
  /** The world that is drawn, or null. */
  world = null;
  /** Frames drawn since the page was opened. */
  drawn = 0;
  /** Frames in the last whole second. */
  rate = 0;
  /** Robots whose role is written below them. */
  labelled = [];
  /** Functions of (context, projection) that draw over everything. */
  over = [];
  #trails = new Trails();
  #readings = new Readings();
  #second = 0;
  #inSecond = 0;
  #ends = "";

  constructor(ground, moving, match, layers, selection) {
    Object.assign(this, { ground, moving, match, layers, selection });
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
    const context = this.moving.getContext("2d");
    context.setTransform(this.projection.density, 0, 0, this.projection.density, 0, 0);
    context.clearRect(0, 0, this.projection.width, this.projection.height);
    if (this.world !== null) this.#drawWorld(context, this.world);
    for (const draws of this.over) draws(context, this.projection);
    this.#count(now);
  }

  #fit() {
    const { match, projection } = this;
    const { pitch, teams } = match.setup, sign = signOf(this.layers.seenFrom, match);
    const changed = projection.fit(pitch, this.moving.parentElement.clientWidth, undefined, sign);
    const defends = match.attack("cyan") > 0 ? ["cyan", "magenta"] : ["magenta", "cyan"];
    const ends = `${defends} ${teams.cyan.name} ${teams.magenta.name}`;
    if (!changed && ends === this.#ends) return;
    this.#ends = ends;
    projection.resize(this.moving);
    document.documentElement.style.setProperty("--ratio", String(projection.ratio));
    const context = projection.resize(this.ground);
    drawGrass(context, projection, pitch, match.free !== null);
    if (match.free) drawFloor(context, projection, pitch);
    else {
      fillGoals(context, projection, pitch, defends);
      drawLines(context, projection, pitch);
      writeTeams(context, projection, pitch, teams, defends);
    }
    drawZones(context, projection, match.setup.task?.zones ?? []);
  }

  #drawWorld(context, world) {
    const { match, projection, layers, selection } = this;
    this.#trails.note(world);
    this.#readings.note(world);
    if (layers.obstacles) for (const obstacle of Object.values(world.obstacles ?? {})) drawObstacle(context, projection, obstacle);
    this.#trails.draw(context, projection, match, layers.trails);
    if (layers.distances) drawDistances(context, projection, match, world);
    if (layers.passes) drawPasses(context, projection, match, world);
    if (layers.beliefs !== "none") drawBeliefs(context, projection, match, world, layers.beliefs);
    const chosen = world.robots[selection.robot];
    if (chosen !== undefined) this.#readings.draw(context, projection, match, selection.robot, chosen);
    for (const [name, robot] of Object.entries(world.robots)) {
      if (layers.velocities) drawVelocity(context, projection, robot, SIDES[match.sideOf(name)].line);
      drawMarkedRobot(context, projection, match, name, robot, {
        selected: name === selection.robot,
        holding: world.possession === name,
      });
    }
    if (layers.roles) this.#labelRobots(context, world);
    if (world.ball) {
      if (layers.velocities) drawVelocity(context, projection, world.ball, BALL_VELOCITY);
      drawBall(context, projection, world.ball, match.setup.ball.radius);
    }
    if (layers.drawings !== "none") drawDrawings(context, projection, match, layers.drawings);
    if (selection.dragged) drawGhost(context, projection, selection.dragged);
  }

  #labelRobots(context, world) {
    const { match, projection, selection } = this;
    const bodies = Object.entries(world.robots).map(([name, truth]) => ({ name, truth, radius: match.radiusOf(name) }));
    const labels = bodies
      .filter(({ name }) => projection.width >= ROOM_PX || name === selection.robot)
      .map((body) => ({ ...body, text: match.radioOf(body.name)?.role }))
      .filter(({ text }) => text);
    this.labelled = drawRoleLabels(context, projection, labels, bodies, new Set([selection.robot, world.possession]));
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
