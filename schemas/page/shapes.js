// Shapes on the canvas, in metres of the field, through a projection.

import { INK } from "./palette.js";

const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

export function line(context, projection, from, to) {
  context.beginPath();
  context.moveTo(projection.x(from.x), projection.y(from.y));
  context.lineTo(projection.x(to.x), projection.y(to.y));
  context.stroke();
}

export function circle(context, projection, centre, radius) {
  context.beginPath();
  context.arc(projection.x(centre.x), projection.y(centre.y), radius * projection.scale, 0, 2 * Math.PI);
}

export function rectangle(context, projection, x1, y1, x2, y2) {
  context.beginPath();
  context.rect(
    Math.min(projection.x(x1), projection.x(x2)), Math.min(projection.y(y1), projection.y(y2)),
    Math.abs(x2 - x1) * projection.scale, Math.abs(y2 - y1) * projection.scale,
  );
}

/** The plate of a text as it is written, in pixels. */
export function plateOf(context, text, left, top, size, weight) {
  context.font = `${weight} ${size}px ${FONT}`;
  const wide = context.measureText(text).width + 0.7 * size;
  return { left: left - wide / 2, right: left + wide / 2, top: top - 0.65 * size, bottom: top + 0.65 * size };
}

/** Writes a text of `size` pixels about a point of the canvas, on a plate of the colour `ground` if one is given. */
export function write(context, text, left, top, size, { colour = INK, weight = 650, ground = null } = {}) {
  context.font = `${weight} ${size}px ${FONT}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  if (ground !== null) {
    const plate = plateOf(context, text, left, top, size, weight);
    context.fillStyle = ground;
    context.beginPath();
    context.roundRect(plate.left, plate.top, plate.right - plate.left, plate.bottom - plate.top, 0.35 * size);
    context.fill();
  }
  context.fillStyle = colour;
  context.fillText(text, left, top + 0.05 * size);
}
