// Bodies with what the page marks on them: selection, roles, trouble, velocities; obstacles, and the ghost of a drag.

import { HOLDS } from "../shared/palette.js";
import { drawRobot, drawnRadius, inPicture } from "../shared/bodies.js";
import { circle, line, write } from "../shared/shapes.js";
import { numberOf } from "../parts/text.js";

const FIXED = { fill: "#9d978b", edge: "#3a352a" };
const MOVABLE = { fill: "#f4ead2", edge: "#3a352a" };
const AHEAD_S = 0.5; // how far a line of velocity leads

/** One robot; `look` has whether it is selected, and whether it holds the ball. */
export function drawMarkedRobot(context, projection, match, name, truth, look) {
  const side = match.sideOf(name), radius = match.radiusOf(name), robot = inPicture(projection, truth, radius);
  const number = numberOf(name, match.setup.teams[side].robots);
  const ring = look.holding ? HOLDS : look.selected ? "#ffffff" : null;
  context.save();
  if (robot.off_field) context.globalAlpha = 0.7;
  drawRobot(context, projection, robot, { side, radius, number }, ring, look.selected ? 3 : 2);
  context.translate(projection.x(robot.x), projection.y(robot.y));
  const size = drawnRadius(projection, radius);
  if (robot.off_field) cross(context, size);
  if (robot.stuck) write(context, "!", 0.9 * size, -0.95 * size, size, { colour: "#2a1c00", ground: HOLDS });
  context.restore();
}

/** Where a body will be in half a second if it goes on. */
export function drawVelocity(context, projection, body, colour) {
  if (Math.hypot(body.vx, body.vy) < 0.15) return;
  context.strokeStyle = colour;
  context.lineWidth = 1.6;
  context.lineCap = "round";
  line(context, projection, body, { x: body.x + AHEAD_S * body.vx, y: body.y + AHEAD_S * body.vy });
}

/** A body that stands on the pitch and is not a robot; one that can be pushed is lighter. */
export function drawObstacle(context, projection, obstacle, look = obstacle.pushed ? MOVABLE : FIXED) {
  context.save();
  context.translate(projection.x(obstacle.x), projection.y(obstacle.y));
  context.rotate(projection.angle(obstacle.heading));
  context.fillStyle = look.fill;
  context.strokeStyle = look.edge;
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

function cross(context, size) {
  context.strokeStyle = "#ffffff";
  context.lineWidth = 2;
  context.beginPath();
  for (const slope of [-1, 1]) {
    context.moveTo(-size, -slope * size);
    context.lineTo(size, slope * size);
  }
  context.stroke();
}
