// Where everything has been: a tail behind each body, or its whole path.

import { BALL, SIDES, TRAIL_ALPHA } from "../shared/palette.js";

export const TRAILS = [
  ["off", "off"],
  ["short", "3 s"],
  ["all", "all"],
];
const SHORT_S = 3;
const STEP_M = 0.06; // shorter moves are not added
const JUMP_M = 1.5; // after longer moves the body was placed
const MOST = 2500; // points of one body

export class Trails {
  #ways = new Map();
  #episode = 0;
  #time = 0;

  /** Adds the place of every body. */
  note(world) {
    if (world.episode !== this.#episode || world.time < this.#time) this.#ways.clear();
    this.#episode = world.episode;
    this.#time = world.time;
    if (world.ball) this.#step("ball", world.ball, world.time);
    for (const [name, robot] of Object.entries(world.robots)) this.#step(name, robot, world.time);
  }

  draw(context, projection, match, kept) {
    if (kept === "off") return;
    context.lineJoin = "round";
    for (const [name, way] of this.#ways) {
      const from = kept === "short" ? this.#time - SHORT_S : -Infinity;
      context.strokeStyle = name === "ball" ? BALL.trail : SIDES[match.sideOf(name)].line;
      context.globalAlpha = TRAIL_ALPHA[kept];
      context.lineWidth = name === "ball" ? 2.2 : 1.6;
      trace(context, projection, way, from);
    }
    context.globalAlpha = 1;
  }

  #step(name, { x, y }, time) {
    const way = this.#ways.get(name) ?? [];
    const last = way.at(-1);
    const gone = last ? Math.hypot(x - last.x, y - last.y) : Infinity;
    if (gone < STEP_M) return;
    way.push({ x, y, time, jump: gone > JUMP_M });
    if (way.length > MOST) way.splice(0, MOST / 5);
    this.#ways.set(name, way);
  }
}

function trace(context, projection, way, from) {
  let place = way.length - 1;
  while (place > 0 && way[place - 1].time >= from) place -= 1;
  context.beginPath();
  for (; place < way.length; place += 1) {
    const { x, y, time, jump } = way[place];
    if (time < from) continue;
    if (jump) context.moveTo(projection.x(x), projection.y(y));
    else context.lineTo(projection.x(x), projection.y(y));
  }
  context.stroke();
}
