// Positions, ends and outcomes of shots; cyan attacks to the right.

import { fitted } from "./canvas.js";
import { drawGrass, drawLines } from "./shared/pitch.js";
import { line } from "./shared/shapes.js";

const SHOT_COLOURS = { cyan: "#4fd3f2", magenta: "#ff7fc0" };
const OUTCOME_SYMBOLS = { goal: "★", saved: "◆", blocked: "■", missed: "✕" };

export function drawShots(canvas, match) {
  const { projection, context } = fitted(canvas, match.pitch, match.pitch.goal_depth + 0.4);
  drawGrass(context, projection, match.pitch, true);
  drawLines(context, projection, match.pitch, "#ffffff66", 0.09);
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const shot of match.shots) {
    const goal = shot.outcome === "goal";
    context.strokeStyle = `${SHOT_COLOURS[shot.side]}${goal ? "b3" : "59"}`;
    context.lineWidth = projection.length(goal ? 0.07 : 0.04);
    line(context, projection, shot, shot.end);
    context.font = `${projection.length(goal ? 1.2 : 0.85)}px "DejaVu Sans", system-ui, sans-serif`;
    context.fillStyle = SHOT_COLOURS[shot.side];
    context.fillText(OUTCOME_SYMBOLS[shot.outcome], projection.x(shot.x), projection.y(shot.y));
  }
}
