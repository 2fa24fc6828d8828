// What robots' programs draw for their authors: shapes in the field frame.

import { circle, line, write } from "../shared/shapes.js";

const MARK_PX = 5; // half the size of a point's mark
const TEXT = { size: 11, ground: "#0b1c14a6", weight: 550 };

/** Kind of shape → how one is drawn; the colour is set. */
const SHAPES = {
  polygons(context, projection, { corners }) {
    context.beginPath();
    for (const { x, y } of corners) context.lineTo(projection.x(x), projection.y(y));
    context.closePath();
    context.stroke();
  },
  circles(context, projection, shape) {
    circle(context, projection, shape, shape.radius);
    context.stroke();
  },
  lines(context, projection, { x1, y1, x2, y2 }) {
    line(context, projection, { x: x1, y: y1 }, { x: x2, y: y2 });
  },
  points(context, projection, point) {
    const x = projection.x(point.x), y = projection.y(point.y);
    context.beginPath();
    for (const sign of [1, -1]) {
      context.moveTo(x - MARK_PX, y - sign * MARK_PX);
      context.lineTo(x + MARK_PX, y + sign * MARK_PX);
    }
    context.stroke();
  },
  texts(context, projection, { x, y, text, colour }) {
    write(context, text, projection.x(x), projection.y(y), TEXT.size, { ...TEXT, colour });
  },
};

/** Draws the shapes of robots; `whose` is a robot's name, a side, or `all`. */
export function drawDrawings(context, projection, match, whose) {
  for (const [name, { debug }] of Object.entries(match.debug)) {
    if (whose !== "all" && whose !== name && whose !== match.sideOf(name)) continue;
    context.lineWidth = 2;
    for (const [kind, draw] of Object.entries(SHAPES)) {
      for (const shape of debug[kind] ?? []) {
        context.strokeStyle = shape.colour;
        draw(context, projection, shape);
      }
    }
  }
}
