// Everything that moves, at one time: robots, and the ball with its trail.

import { HOLDS } from "./shared/palette.js";
import { drawBall, drawRobot, inPicture } from "./shared/bodies.js";
import { line } from "./shared/shapes.js";

const TRAIL_S = 1.6;
const TRAIL_STEPS = 24;
const JUMP_M = 1.5; // a ball that moved more between two steps was set down elsewhere

export function drawMovingBodies(context, projection, match, time) {
  const { robots, ball, holder } = match.bodies(time);
  drawTrail(context, projection, match, time);
  robots.forEach((robot, number) => {
    if (robot) drawRobot(context, projection, inPicture(projection, robot, match.robots[number].radius), match.robots[number], number === holder ? HOLDS : null);
  });
  drawBall(context, projection, ball, match.ball.radius);
}

function drawTrail(context, projection, match, time) {
  let last = null;
  context.lineCap = "round";
  for (let step = 0; step <= TRAIL_STEPS; step += 1) {
    const share = step / TRAIL_STEPS, at = time - TRAIL_S * (1 - share);
    if (at < match.start) continue;
    const { ball } = match.bodies(at);
    if (last && Math.hypot(ball.x - last.x, ball.y - last.y) < JUMP_M) {
      context.strokeStyle = `rgba(255, 190, 40, ${0.75 * share ** 1.4})`;
      context.lineWidth = projection.length(0.04 + 0.14 * share);
      line(context, projection, last, ball);
    }
    last = ball;
  }
}
