// Robots, ball and obstacles. Sides differ in shape and brightness, not in hue alone: cyan is round, magenta square.

import { SIDES, circle, write } from "./shapes.js";
import { numberOf } from "./text.js";

const LARGER = 1.35; // than they are, or nobody could read their numbers
const LEAST_PX = 8.5;
const AHEAD_S = 0.5; // how far a line of velocity leads
const BALL = { fill: "#ffb000", edge: "#4a3000", line: "#ffd978" };

/** Radius of a robot as it is drawn, in pixels. */
export const drawnRadius = (projection, radius) => projection.length(LARGER * radius, LEAST_PX);

/** The path of a robot's body, about the origin. */
export function bodyPath(context, side, radius) {
  context.beginPath();
  if (side === "magenta") context.roundRect(-0.9 * radius, -0.9 * radius, 1.8 * radius, 1.8 * radius, 0.25 * radius);
  else context.arc(0, 0, radius, 0, 2 * Math.PI);
}

/** One robot; `look` says whether it is selected, holds the ball, and what stands below it. */
export function drawRobot(context, projection, match, name, robot, look) {
  const side = match.sideOf(name);
  const colours = SIDES[side];
  const radius = drawnRadius(projection, match.radiusOf(name));
  context.save();
  context.translate(projection.x(robot.x), projection.y(robot.y));
  if (robot.off_field) context.globalAlpha = 0.45;
  if (look.selected || look.holding) ring(context, radius, look);
  context.rotate(projection.angle(robot.heading));
  context.fillStyle = colours.edge;
  context.beginPath();
  context.moveTo(1.5 * radius, 0);
  context.lineTo(0.75 * radius, 0.62 * radius);
  context.lineTo(0.75 * radius, -0.62 * radius);
  context.fill();
  context.fillStyle = colours.fill;
  context.strokeStyle = colours.edge;
  context.lineWidth = Math.max(1.2, 0.18 * radius);
  bodyPath(context, side, radius);
  context.fill();
  context.stroke();
  context.rotate(-projection.angle(robot.heading));
  const number = numberOf(name, match.setup.teams[side].robots);
  write(context, number, 0, 0, 1.3 * radius, { colour: colours.ink, weight: 700 });
  if (robot.off_field) cross(context, radius);
  if (robot.stuck) write(context, "!", 0.9 * radius, -0.95 * radius, radius, { colour: "#2a1c00", ground: "#ffd23f" });
  if (look.label) label(context, look.label, radius);
  context.restore();
}

/** Where a robot will be in half a second if it goes on. */
export function drawVelocity(context, projection, body, colour) {
  if (Math.hypot(body.vx, body.vy) < 0.15) return;
  context.strokeStyle = colour;
  context.lineWidth = 1.6;
  context.lineCap = "round";
  context.beginPath();
  context.moveTo(projection.x(body.x), projection.y(body.y));
  context.lineTo(projection.x(body.x + AHEAD_S * body.vx), projection.y(body.y + AHEAD_S * body.vy));
  context.stroke();
}

/** The ball with its shadow, the higher the farther apart. */
export function drawBall(context, projection, ball, radius, withVelocity) {
  const left = projection.x(ball.x), top = projection.y(ball.y);
  const size = projection.length(1.35 * radius, 4);
  const lift = Math.max(0, ball.z - radius);
  if (withVelocity) drawVelocity(context, projection, ball, BALL.line);
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

/** Something that stands on the pitch and is no robot. */
export function drawObstacle(context, projection, obstacle) {
  context.save();
  context.translate(projection.x(obstacle.x), projection.y(obstacle.y));
  context.rotate(projection.angle(obstacle.heading));
  context.fillStyle = "#c9c2b4";
  context.strokeStyle = "#3a352a";
  context.lineWidth = 1.5;
  const wide = projection.length(obstacle.size_x, 4), high = projection.length(obstacle.size_y, 4);
  context.beginPath();
  if (obstacle.shape === "box") context.rect(-wide / 2, -high / 2, wide, high);
  else context.arc(0, 0, wide / 2, 0, 2 * Math.PI);
  context.fill();
  context.stroke();
  context.restore();
}

/** Where a body that is being dragged would be set down. */
export function drawGhost(context, projection, body) {
  context.strokeStyle = "#ffffff";
  context.lineWidth = 2;
  context.setLineDash([5, 4]);
  circle(context, projection, body, body.radius + 4 / projection.scale);
  context.stroke();
  context.setLineDash([]);
}

function ring(context, radius, look) {
  context.strokeStyle = look.holding ? "#ffd23f" : "#ffffff";
  context.lineWidth = look.selected ? 3 : 2;
  context.beginPath();
  context.arc(0, 0, 1.5 * radius, 0, 2 * Math.PI);
  context.stroke();
}

function cross(context, radius) {
  context.strokeStyle = "#ffffff";
  context.lineWidth = 2;
  context.beginPath();
  for (const slope of [-1, 1]) {
    context.moveTo(-radius, -slope * radius);
    context.lineTo(radius, slope * radius);
  }
  context.stroke();
}

function label(context, text, radius) {
  write(context, text, 0, 1.5 * radius + 9, 11, { weight: 550, ground: "#0b1c14a6" });
}
