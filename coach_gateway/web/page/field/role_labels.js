// The roles below the robots: none covers another one or a robot, so that a crowd stays readable.

import { drawnRadius, inPicture } from "../shared/bodies.js";
import { plateOf, write } from "../shared/shapes.js";

const SIZE = 11;
const LOOK = { weight: 550, ground: "#0b1c14a6" };

/**
 * Draws the labels that have room; those of the chosen robot and of the one with the ball come first.
 * `labels` have `name`, `text`, `truth` and `radius`; `bodies` are all robots. Returns the names of the labelled robots.
 */
export function drawRoleLabels(context, projection, labels, bodies, first) {
  const discs = bodies.map(({ name, truth, radius }) => ({ name, ...placeOf(projection, truth, radius) }));
  const taken = [], drawn = [];
  for (const { name, text, truth, radius } of [...labels].sort((a, b) => first.has(b.name) - first.has(a.name))) {
    const { left, top, size } = placeOf(projection, truth, radius);
    const plate = plateOf(context, text, left, top + 1.5 * size + 9, SIZE, LOOK.weight);
    const covers = taken.some((other) => overlap(plate, other)) || discs.some((disc) => disc.name !== name && touches(plate, disc));
    if (covers && !first.has(name)) continue;
    write(context, text, left, top + 1.5 * size + 9, SIZE, LOOK);
    taken.push(plate);
    drawn.push(name);
  }
  return drawn;
}

/** Where a robot is drawn, and how large, in pixels. */
function placeOf(projection, truth, radius) {
  const { x, y } = inPicture(projection, truth, radius);
  return { left: projection.x(x), top: projection.y(y), size: drawnRadius(projection, radius) };
}

const overlap = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;

function touches(plate, { left, top, size }) {
  const x = Math.min(Math.max(left, plate.left), plate.right), y = Math.min(Math.max(top, plate.top), plate.bottom);
  return Math.hypot(x - left, y - top) < size;
}
