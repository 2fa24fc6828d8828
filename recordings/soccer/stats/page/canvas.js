// Canvases that show the pitch.

import { Projection } from "./shared/projection.js";

/** Sizes a canvas for the width it has, with `margin` metres around the pitch; returns its projection and context. */
export function fitted(canvas, pitch, margin) {
  const projection = new Projection();
  projection.fit(pitch, canvas.clientWidth || canvas.parentElement.clientWidth || 320, margin);
  canvas.style.height = `${projection.height}px`;
  canvas.dataset.scale = String(projection.scale);
  return { projection, context: projection.resize(canvas) };
}
