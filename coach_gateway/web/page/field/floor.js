// The floor of a free game, and the zones of any task with their names.

import { drawObstacle } from "./marked_bodies.js";
import { INK } from "../shared/palette.js";
import { rectangle, write } from "../shared/shapes.js";

const ZONE = { fill: "#7fe3fa26", edge: "#c7d8cf" };

export function drawFloor(context, projection, { length, width }) {
  context.strokeStyle = INK;
  context.lineWidth = 1.5;
  rectangle(context, projection, -length / 2, -width / 2, length / 2, width / 2);
  context.stroke();
}

export function drawZones(context, projection, zones) {
  for (const { name, place: [x, y], radius, size, heading } of zones) {
    const [size_x, size_y] = size ?? [2 * radius, 2 * radius];
    drawObstacle(context, projection, { x, y, heading, size_x, size_y, shape: size ? "box" : "cylinder" }, ZONE);
    write(context, name, projection.x(x), projection.y(y), 12);
  }
}
