// The pitch from the numbers of its setup: grass, lines, areas, marks and goals.

import { GRASS, GROUND, INK, PLAIN } from "./palette.js";
import { circle, line, rectangle } from "./shapes.js";

const STRIPES = 11;

/** Grass, darker around the lines, in mown stripes unless `plain`. */
export function drawGrass(context, projection, pitch, plain = false) {
  const { length, width } = pitch;
  context.fillStyle = plain ? PLAIN : GROUND;
  context.fillRect(0, 0, projection.width, projection.height);
  if (plain) return;
  for (let number = 0; number < STRIPES; number += 1) {
    context.fillStyle = GRASS[number % 2];
    const from = -length / 2 + (number * length) / STRIPES;
    rectangle(context, projection, from, -width / 2, from + length / STRIPES, width / 2);
    context.fill();
  }
}

/** All lines and marks, and the frames of the goals; `thickness` of the lines in m. */
export function drawLines(context, projection, pitch, colour = INK, thickness = 0.6 * pitch.line_width) {
  const { length, width } = pitch, lineWidth = projection.length(thickness, 1.2);
  context.strokeStyle = colour;
  context.lineWidth = lineWidth;
  rectangle(context, projection, -length / 2, -width / 2, length / 2, width / 2);
  context.stroke();
  line(context, projection, { x: 0, y: -width / 2 }, { x: 0, y: width / 2 });
  circle(context, projection, { x: 0, y: 0 }, pitch.centre_circle_radius);
  context.stroke();
  for (const end of [-1, 1]) drawAreas(context, projection, pitch, end);
  drawMarks(context, projection, pitch, colour);
  context.strokeStyle = "#ffffff";
  context.lineWidth = Math.max(projection.length(pitch.post), 1.5 * lineWidth);
  for (const end of [-1, 1]) {
    goalPath(context, projection, pitch, end);
    context.stroke();
  }
}

/** The path of the goal at −x or +x, as `end` is −1 or 1. */
export function goalPath(context, projection, pitch, end) {
  const x = (end * pitch.length) / 2;
  rectangle(context, projection, x, -pitch.goal_width / 2, x + end * pitch.goal_depth, pitch.goal_width / 2);
}

/** The areas and corner arcs of one half. */
function drawAreas(context, projection, pitch, end) {
  const x = (end * pitch.length) / 2;
  for (const depth of [pitch.penalty_area_depth, pitch.goal_area_depth]) {
    const half = pitch.goal_width / 2 + depth; // the league's formula: goal width + 2 × depth
    rectangle(context, projection, x, -half, x - end * depth, half);
    context.stroke();
  }
  context.save();
  rectangle(context, projection, -pitch.length / 2, -pitch.width / 2, pitch.length / 2, pitch.width / 2);
  context.clip();
  for (const y of [-pitch.width / 2, pitch.width / 2]) {
    circle(context, projection, { x, y }, pitch.corner_arc_radius);
    context.stroke();
  }
  context.restore();
}

/** The centre mark, the penalty marks, and the other spots where a dropped ball may lie. */
function drawMarks(context, projection, pitch, colour) {
  context.fillStyle = colour;
  const mark = pitch.length / 2 - pitch.penalty_mark;
  for (const x of [-mark, 0, mark]) {
    for (const y of [-pitch.width / 4, 0, pitch.width / 4]) {
      circle(context, projection, { x, y }, y === 0 ? 0.1 : 0.06);
      context.fill();
    }
  }
}
