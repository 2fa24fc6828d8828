// Heat maps: where each body was while the ball was in play.

import { fitted } from "./canvas.js";
import { drawGrass, drawLines } from "./shared/pitch.js";

const CELL = 0.5; // m
const SPREAD = 2; // cells; smooths the short tracks of a match
const STOPS = [[0, 18, 36, 27], [0.18, 40, 56, 110], [0.42, 122, 44, 120], [0.68, 224, 83, 71], [0.86, 251, 170, 50], [1, 252, 250, 190]];

/** Draws the map of each robot and of the ball in its current width. */
export function drawHeatMaps(place, match) {
  for (const figure of place.children) {
    const body = match.robots.find(({ name }) => name === figure.dataset.body) ?? match.ball;
    drawMap(figure.querySelector("canvas"), match, body);
  }
}

function drawMap(canvas, match, body) {
  const { pitch } = match, { projection, context } = fitted(canvas, pitch, pitch.goal_depth + 0.4);
  drawGrass(context, projection, pitch, true);
  const columns = Math.ceil(pitch.length / CELL), rows = Math.ceil(pitch.width / CELL);
  const cells = blurred(counted(match, body, columns, rows), columns, rows);
  const most = cells.reduce((high, value) => Math.max(high, value), 0);
  if (most > 0) {
    const image = new ImageData(columns, rows);
    cells.forEach((value, number) => image.data.set([...colour(Math.sqrt(value / most)), 255], 4 * number));
    const small = document.createElement("canvas");
    small.width = columns;
    small.height = rows;
    small.getContext("2d").putImageData(image, 0, 0);
    context.imageSmoothingQuality = "high";
    const [left, top] = [projection.x(-pitch.length / 2), projection.y(pitch.width / 2)];
    context.drawImage(small, left, top, projection.length(pitch.length), projection.length(pitch.width));
  }
  drawLines(context, projection, pitch, "#ffffff8c", 0.12);
}

function counted(match, body, columns, rows) {
  const cells = new Float32Array(columns * rows);
  for (const [from, until, interval] of match.inPlay()) {
    const turned = interval.cyan_attacks * (body.side === "magenta" ? -1 : 1);
    const [first] = match.place(from), [last] = match.place(until);
    for (let sample = first; sample < last; sample += 1) {
      const column = Math.floor(((turned * body.x[sample]) / 100 + match.pitch.length / 2) / CELL);
      const row = Math.floor((match.pitch.width / 2 - (turned * body.y[sample]) / 100) / CELL);
      if (column >= 0 && column < columns && row >= 0 && row < rows) cells[row * columns + column] += 1;
    }
  }
  return cells;
}

function blurred(cells, columns, rows) {
  const once = new Float32Array(cells.length), twice = new Float32Array(cells.length);
  spread(cells, once, columns, rows, 1, columns);
  spread(once, twice, rows, columns, columns, 1);
  return twice;
}

function spread(from, to, along, across, step, stride) {
  for (let other = 0; other < across; other += 1) {
    for (let place = 0; place < along; place += 1) {
      let sum = 0;
      for (let offset = -2 * SPREAD; offset <= 2 * SPREAD; offset += 1) {
        const near = place + offset;
        if (near < 0 || near >= along) continue;
        sum += from[other * stride + near * step] * Math.exp(-0.5 * (offset / SPREAD) ** 2);
      }
      to[other * stride + place * step] = sum;
    }
  }
}

function colour(share) {
  const after = Math.max(1, STOPS.findIndex(([at]) => at >= share));
  const [from, ...low] = STOPS[after - 1], [to, ...high] = STOPS[after];
  const way = (share - from) / (to - from);
  return low.map((value, number) => value + (high[number] - value) * way);
}
