// Robots and ball. Sides differ in shape and brightness, not in hue alone: cyan is round, magenta square.

import { BALL, NEUTRAL, NOSE, RING, SIDES } from "./palette.js";
import { write } from "./shapes.js";

const LARGER = 1.35; // than they are, or their numbers could not be read
const LEAST_PX = 8.5;

/** Radius of a robot as it is drawn, in pixels. */
export const drawnRadius = (projection, radius) => projection.length(LARGER * radius, LEAST_PX);

/** Size of a number on a robot that is drawn with this radius, in pixels: two digits have to fit, too. */
export const numberSize = (number, radius) => (number.length > 1 ? 1.05 : 1.3) * radius;

/** The path of a robot's body, about the origin. */
export function bodyPath(context, side, radius) {
  context.beginPath();
  if (side === "magenta") context.roundRect(-0.9 * radius, -0.9 * radius, 1.8 * radius, 1.8 * radius, 0.25 * radius);
  else context.arc(0, 0, radius, 0, 2 * Math.PI);
}

/** Where a body is drawn: one beyond the picture, as a robot on the bench, at its edge. */
export function inPicture(projection, body, radius) {
  const margin = drawnRadius(projection, radius) / projection.scale;
  const most = { x: projection.width / 2 / projection.scale - margin, y: projection.height / 2 / projection.scale - margin };
  return { ...body, x: Math.min(Math.max(body.x, -most.x), most.x), y: Math.min(Math.max(body.y, -most.y), most.y) };
}

/** One robot: hull, nose and number; `ring` is the colour of a circle about it, or null. */
export function drawRobot(context, projection, { x, y, heading }, { side, radius, number }, ring = null, ringWidth = 2) {
  const colours = SIDES[side] ?? NEUTRAL, size = drawnRadius(projection, radius);
  context.save();
  context.translate(projection.x(x), projection.y(y));
  if (ring !== null) {
    context.strokeStyle = ring;
    context.lineWidth = ringWidth;
    context.beginPath();
    context.arc(0, 0, 1.5 * size, 0, 2 * Math.PI);
    context.stroke();
  }
  context.rotate(projection.angle(heading));
  context.fillStyle = NOSE;
  context.beginPath();
  context.moveTo(1.5 * size, 0);
  context.lineTo(0.75 * size, 0.62 * size);
  context.lineTo(0.75 * size, -0.62 * size);
  context.fill();
  context.fillStyle = colours.fill;
  context.strokeStyle = RING;
  context.lineWidth = Math.max(1.2, 0.15 * size);
  bodyPath(context, side, size);
  context.fill();
  context.stroke();
  context.rotate(-projection.angle(heading));
  write(context, number, 0, 0, numberSize(number, size), { colour: colours.ink, weight: 700 });
  context.restore();
}

/** The ball with its shadow; the higher the ball, the farther apart. */
export function drawBall(context, projection, ball, radius) {
  const left = projection.x(ball.x), top = projection.y(ball.y);
  const size = projection.length(LARGER * radius, 4);
  const lift = Math.max(0, ball.z - radius);
  context.fillStyle = "#00000066";
  context.beginPath();
  context.arc(left + 1, top + 1.5, size, 0, 2 * Math.PI);
  context.fill();
  context.fillStyle = BALL.fill;
  context.strokeStyle = BALL.edge;
  context.lineWidth = 1.3;
  context.beginPath();
  context.arc(left, top - projection.length(0.5 * lift), size * (1 + 0.2 * Math.min(lift, 3)), 0, 2 * Math.PI);
  context.fill();
  context.stroke();
  if (lift > 0.25) {
    const above = top - projection.length(0.5 * lift) - 2.2 * size - 4;
    write(context, `${ball.z.toFixed(1)} m high`, left, above, 11, { ground: "#0b1c14cc" });
  }
}
