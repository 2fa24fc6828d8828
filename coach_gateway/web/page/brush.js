// Shapes on the canvas, in metres of the field, through a view.

export const INK = "#eef4ef";
export const SIDES = {
  cyan: { fill: "#28b9dc", edge: "#05303a", ink: "#04222a", line: "#7fe3fa" },
  magenta: { fill: "#c9237b", edge: "#3d0527", ink: "#ffffff", line: "#ff9fd2" },
};
const FONT = 'system-ui, -apple-system, "Segoe UI", Roboto, "DejaVu Sans", sans-serif';

export function line(context, view, from, to) {
  context.beginPath();
  context.moveTo(view.x(from.x), view.y(from.y));
  context.lineTo(view.x(to.x), view.y(to.y));
  context.stroke();
}

export function circle(context, view, centre, radius) {
  context.beginPath();
  context.arc(view.x(centre.x), view.y(centre.y), radius * view.scale, 0, 2 * Math.PI);
}

export function rectangle(context, view, x1, y1, x2, y2) {
  context.beginPath();
  context.rect(
    Math.min(view.x(x1), view.x(x2)), Math.min(view.y(y1), view.y(y2)),
    Math.abs(x2 - x1) * view.scale, Math.abs(y2 - y1) * view.scale,
  );
}

/** An arrow's head at `to`, in the colour of the lines. */
export function head(context, view, from, to, size) {
  const angle = Math.atan2(view.y(to.y) - view.y(from.y), view.x(to.x) - view.x(from.x));
  context.save();
  context.translate(view.x(to.x), view.y(to.y));
  context.rotate(angle);
  context.fillStyle = context.strokeStyle;
  context.beginPath();
  context.moveTo(0, 0);
  context.lineTo(-size, 0.5 * size);
  context.lineTo(-size, -0.5 * size);
  context.fill();
  context.restore();
}

/** A text of `size` pixels about a point of the canvas; with a `ground` it stands on a plate of that colour. */
export function write(context, text, left, top, size, { colour = INK, weight = 650, ground = null } = {}) {
  context.font = `${weight} ${size}px ${FONT}`;
  context.textAlign = "center";
  context.textBaseline = "middle";
  if (ground !== null) {
    const wide = context.measureText(text).width + 0.7 * size;
    context.fillStyle = ground;
    context.beginPath();
    context.roundRect(left - wide / 2, top - 0.65 * size, wide, 1.3 * size, 0.35 * size);
    context.fill();
  }
  context.fillStyle = colour;
  context.fillText(text, left, top + 0.05 * size);
}
