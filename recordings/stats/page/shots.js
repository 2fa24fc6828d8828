// Positions and outcomes of shots; cyan attacks to the right.

import { drawGrass, drawLines, fitted } from "./pitch.js";

const SHOT_COLOURS = { cyan: "#4fd3f2", magenta: "#ff7fc0" };
const OUTCOME_SYMBOLS = { goal: "★", saved: "◆", blocked: "■", missed: "✕" };

export function drawShots(canvas, match) {
  const context = fitted(canvas, match.pitch, 0.9);
  drawGrass(context, match.pitch, true);
  drawLines(context, match.pitch, "#ffffff66", 0.09);
  context.textAlign = "center";
  context.textBaseline = "middle";
  for (const shot of match.shots) {
    const goal = shot.outcome === "goal";
    const x = (shot.side === "cyan" ? 1 : -1) * (match.pitch.length / 2);
    context.strokeStyle = `${SHOT_COLOURS[shot.side]}66`;
    context.lineWidth = 0.05;
    context.beginPath();
    context.moveTo(shot.x, shot.y);
    context.lineTo(x, 0);
    if (goal) context.stroke();
    context.save();
    context.translate(shot.x, shot.y);
    context.scale(1, -1);
    context.font = `${goal ? 1.2 : 0.85}px "DejaVu Sans", system-ui, sans-serif`;
    context.fillStyle = SHOT_COLOURS[shot.side];
    context.fillText(OUTCOME_SYMBOLS[shot.outcome], 0, 0);
    context.restore();
  }
}
