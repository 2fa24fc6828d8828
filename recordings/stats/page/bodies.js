// Robots and ball on the pitch. Sides differ in shape and in brightness, not in hue alone.

import { disc, line } from "./pitch.js";

const STYLES = {
  cyan: { fill: "#28b9dc", edge: "#05303a", ink: "#04222a" },
  magenta: { fill: "#c9237b", edge: "#3d0527", ink: "#ffffff" },
  null: { fill: "#b9c0bc", edge: "#333a36", ink: "#222222" },
};
const ROBOT_SCALE = 1.45; // than they are, or nobody could read their numbers
const TRAIL_S = 1.6;
const TRAIL_STEPS = 24;

/** Everything that moves, at one time. */
export function drawBodies(context, match, time) {
  const { robots, ball, holder } = match.bodies(time);
  drawTrail(context, match, time);
  robots.forEach((robot, number) => {
    if (robot) drawRobot(context, match.robots[number], robot, number === holder);
  });
  drawBall(context, ball, match.ball.radius);
}

function drawTrail(context, match, time) {
  let last = null;
  context.lineCap = "round";
  for (let step = 0; step <= TRAIL_STEPS; step += 1) {
    const at = time - TRAIL_S * (1 - step / TRAIL_STEPS);
    if (at < match.start) continue;
    const { ball } = match.bodies(at);
    if (last && Math.hypot(ball.x - last.x, ball.y - last.y) < 1.5) {
      context.strokeStyle = `rgba(255, 190, 40, ${0.75 * (step / TRAIL_STEPS) ** 1.4})`;
      context.lineWidth = 0.04 + 0.14 * (step / TRAIL_STEPS);
      line(context, last.x, last.y, ball.x, ball.y);
    }
    last = ball;
  }
}

function drawRobot(context, robot, { x, y, heading }, holds) {
  const style = STYLES[robot.side] ?? STYLES.null;
  const radius = robot.radius * ROBOT_SCALE;
  context.save();
  context.translate(x, y);
  if (holds) {
    context.strokeStyle = "#ffd23f";
    context.lineWidth = 0.1;
    context.beginPath();
    context.arc(0, 0, radius + 0.17, 0, 2 * Math.PI);
    context.stroke();
  }
  context.rotate(heading);
  context.fillStyle = style.edge;
  context.beginPath();
  context.moveTo(radius * 1.5, 0);
  context.lineTo(radius * 0.75, radius * 0.62);
  context.lineTo(radius * 0.75, -radius * 0.62);
  context.fill();
  context.fillStyle = style.fill;
  context.strokeStyle = style.edge;
  context.lineWidth = 0.07;
  context.beginPath();
  if (robot.side === "magenta") context.roundRect(-radius * 0.9, -radius * 0.9, radius * 1.8, radius * 1.8, radius * 0.25);
  else context.arc(0, 0, radius, 0, 2 * Math.PI);
  context.fill();
  context.stroke();
  context.rotate(-heading);
  context.scale(1, -1);
  context.fillStyle = style.ink;
  context.font = `700 ${radius * 1.25}px system-ui, "DejaVu Sans", sans-serif`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.fillText(robot.number, 0, radius * 0.06);
  context.restore();
}

function drawBall(context, ball, radius) {
  const lift = Math.max(0, ball.z - radius);
  context.fillStyle = "#00000066";
  disc(context, ball.x + 0.05, ball.y - 0.07, radius * 1.5);
  context.fillStyle = "#ffb000";
  context.strokeStyle = "#4a3000";
  context.lineWidth = 0.05;
  context.beginPath();
  context.arc(ball.x, ball.y + 0.5 * lift, radius * 1.6 * (1 + 0.25 * lift), 0, 2 * Math.PI);
  context.fill();
  context.stroke();
}
