// The pitch from the numbers of the setup: ground, lines, areas, marks and goals.

import { INK, SIDES, circle, line, rectangle, write } from "./shapes.js";

const GRASS = ["#2c6a4a", "#306f4f"];
const GROUND = "#235640";
const STRIPES = 11;

/** Everything on the ground that does not move; `defends` gives the side that defends the goal at −x, then at +x. */
export function drawPitch(context, projection, pitch, teams, defends) {
  const { length, width } = pitch;
  context.fillStyle = GROUND;
  context.fillRect(0, 0, projection.width, projection.height);
  for (let number = 0; number < STRIPES; number += 1) {
    context.fillStyle = GRASS[number % 2];
    const from = -length / 2 + (number * length) / STRIPES;
    rectangle(context, projection, from, -width / 2, from + length / STRIPES, width / 2);
    context.fill();
  }
  [-1, 1].forEach((end, place) => drawEnd(context, projection, pitch, end, defends[place], teams[defends[place]].name));
  context.strokeStyle = INK;
  context.lineWidth = projection.length(0.6 * pitch.line_width, 1.2);
  rectangle(context, projection, -length / 2, -width / 2, length / 2, width / 2);
  context.stroke();
  line(context, projection, { x: 0, y: -width / 2 }, { x: 0, y: width / 2 });
  circle(context, projection, { x: 0, y: 0 }, pitch.centre_circle_radius);
  context.stroke();
  drawMarks(context, projection, pitch);
}

/** One half's areas, corner arcs and goal, the goal in the colour of who defends it. */
function drawEnd(context, projection, pitch, end, side, team) {
  const x = (end * pitch.length) / 2;
  context.strokeStyle = INK;
  context.lineWidth = projection.length(0.6 * pitch.line_width, 1.2);
  for (const depth of [pitch.penalty_area_depth, pitch.goal_area_depth]) {
    const half = pitch.goal_width / 2 + depth; // the league's formula: goal width + 2 × depth
    rectangle(context, projection, x, -half, x - end * depth, half);
    context.stroke();
  }
  for (const y of [-pitch.width / 2, pitch.width / 2]) {
    context.save();
    rectangle(context, projection, -pitch.length / 2, -pitch.width / 2, pitch.length / 2, pitch.width / 2);
    context.clip();
    circle(context, projection, { x, y }, pitch.corner_arc_radius);
    context.stroke();
    context.restore();
  }
  context.fillStyle = SIDES[side].fill;
  context.strokeStyle = "#ffffff";
  context.lineWidth = projection.length(pitch.post, 2);
  rectangle(context, projection, x, -pitch.goal_width / 2, x + end * pitch.goal_depth, pitch.goal_width / 2);
  context.globalAlpha = 0.55;
  context.fill();
  context.globalAlpha = 1;
  context.stroke();
  const size = Math.max(11, Math.min(15, 0.55 * projection.scale));
  const top = projection.y(projection.sign * (pitch.width / 2)) - 0.75 * size;
  write(context, team, projection.x(x * 0.5), top, size, { colour: SIDES[side].line });
}

/** The centre mark, the penalty marks, and the other spots where a dropped ball may lie. */
function drawMarks(context, projection, pitch) {
  context.fillStyle = INK;
  const mark = pitch.length / 2 - pitch.penalty_mark;
  for (const x of [-mark, 0, mark]) {
    for (const y of [-pitch.width / 4, 0, pitch.width / 4]) {
      circle(context, projection, { x, y }, y === 0 ? 0.1 : 0.06);
      context.fill();
    }
  }
}
