// The figures: both sides next to each other, and a table of robots.

import { element } from "./event_list.js";

/** Shows a row for each figure of the two sides, with a bar of their shares. */
export function showSides(place, rows) {
  place.replaceChildren(...rows.map(([name, cyan, magenta]) => {
    const pair = element("div", "");
    pair.className = "pair";
    const [left, middle, right] = [element("span", cyan), element("span", name), element("span", magenta)];
    left.className = "cyan-value";
    middle.className = "name";
    right.className = "magenta-value";
    pair.append(left, middle, right);
    const [ours, theirs] = [Number.parseFloat(cyan), Number.parseFloat(magenta)];
    if (ours + theirs > 0) pair.append(shares(ours, theirs));
    return pair;
  }));
}

function shares(cyan, magenta) {
  const bar = element("div", "");
  bar.className = "share";
  bar.append(...[cyan, magenta].map((value) => {
    const part = element("i", "");
    part.style.width = `${(100 * value) / (cyan + magenta)}%`;
    return part;
  }));
  return bar;
}

/** Shows one row for each robot, in the order of `robots`. */
export function showRobots(table, { headings, rows }, robots) {
  const head = table.createTHead().insertRow();
  head.append(...headings.map((heading) => {
    const cell = element("th", heading);
    cell.scope = "col";
    return cell;
  }));
  const body = table.createTBody();
  rows.forEach((row, number) => {
    const line = body.insertRow();
    line.className = robots[number]?.side ?? "";
    line.append(...row.map((text) => element("td", text)));
    const mark = element("span", "");
    mark.className = "mark";
    line.cells[0].prepend(mark);
  });
}
