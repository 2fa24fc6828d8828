// What robots believe beside the truth: their own pose, the ball and obstacles, as sent on the radio, and passes.

import { bodyPath, drawnRadius } from "../shared/bodies.js";
import { SIDES } from "../shared/palette.js";
import { circle, line, write } from "../shared/shapes.js";
import { numberOf } from "../parts/text.js";

/** Turns a body from the frame of a side into the field's. */
export function onField(match, side, { x, y, heading = 0, ...rest }) {
  const sign = match.attack(side);
  return { ...rest, x: sign * x, y: sign * y, heading: sign > 0 ? heading : heading + Math.PI };
}

/** Draws beliefs; `whose` is a robot's name, a side, or `all`. */
export function drawBeliefs(context, projection, match, world, whose) {
  for (const name of Object.keys(world.robots)) {
    const side = match.sideOf(name);
    if (whose !== "all" && whose !== side && whose !== name) continue;
    const word = match.radioOf(name);
    if (word !== null) drawBelief(context, projection, match, name, side, word, world);
  }
}

/** Draws an arrow from each robot that means to pass to its receiver. */
export function drawPasses(context, projection, match, world) {
  for (const [name, robot] of Object.entries(world.robots)) {
    const mate = world.robots[match.radioOf(name)?.pass_to];
    if (mate === undefined) continue;
    context.strokeStyle = "#ffffff";
    context.lineWidth = 2;
    context.setLineDash([9, 6]);
    line(context, projection, robot, mate);
    context.setLineDash([]);
    arrowHead(context, projection, robot, mate, 13);
  }
}

function drawBelief(context, projection, match, name, side, word, world) {
  const colours = SIDES[side];
  const radius = drawnRadius(projection, match.radiusOf(name));
  context.strokeStyle = colours.line;
  context.lineWidth = 1.6;
  context.setLineDash([4, 3]);
  const own = word.self ? onField(match, side, word.self) : world.robots[name];
  if (word.self) {
    context.save();
    context.translate(projection.x(own.x), projection.y(own.y));
    context.rotate(projection.angle(own.heading));
    bodyPath(context, side, 1.18 * radius);
    context.stroke();
    context.restore();
    line(context, projection, own, world.robots[name]);
  }
  for (const place of word.obstacles ?? []) {
    circle(context, projection, onField(match, side, place), match.radiusOf(name));
    context.stroke();
  }
  if (word.ball) drawBall(context, projection, onField(match, side, word.ball), own, colours, name, match, side);
  context.setLineDash([]);
}

/** A believed ball: hollow, with the number of its robot; the older, the fainter. */
function drawBall(context, projection, ball, own, colours, name, match, side) {
  context.globalAlpha = Math.max(0.3, 1 - 0.25 * ball.age);
  context.setLineDash([2, 4]);
  line(context, projection, own, ball);
  context.setLineDash([]);
  circle(context, projection, ball, 7 / projection.scale);
  context.stroke();
  const number = numberOf(name, match.setup.teams[side].robots);
  write(context, number, projection.x(ball.x) + 12, projection.y(ball.y) - 9, 10, { colour: colours.line });
  context.globalAlpha = 1;
}

/** An arrow's head at `to`, in the colour of the lines. */
function arrowHead(context, projection, from, to, size) {
  const angle = Math.atan2(projection.y(to.y) - projection.y(from.y), projection.x(to.x) - projection.x(from.x));
  context.save();
  context.translate(projection.x(to.x), projection.y(to.y));
  context.rotate(angle);
  context.fillStyle = context.strokeStyle;
  context.beginPath();
  context.moveTo(0, 0);
  context.lineTo(-size, 0.5 * size);
  context.lineTo(-size, -0.5 * size);
  context.fill();
  context.restore();
}
