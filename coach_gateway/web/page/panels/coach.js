// Orders to a side: modes, and tests with points and angles picked on the field.

import { circle, write } from "../shared/shapes.js";
import { onField } from "../field/beliefs.js";
import { byId, choice, element, mark, offer, setText, show } from "../shared/elements.js";
import { FIELDS, TESTS } from "./coach_tests.js";
import { degrees, capitalized, radians, readable } from "../parts/text.js";

const MODES = ["play", "hold", "park", "test"];
const LIMITS = ["max_speed", "max_turn_rate"];
const OF_TESTS = ["radius", "kick_mode", "with_ball", "avoid"]; // fields of tests alone

export class Coach {
  #inputs = {};

  constructor(match, pitchCanvas, requests, selection) {
    Object.assign(this, { match, pitchCanvas, requests, selection });
    this.#lay();
    match.on("welcome orders host", () => this.update());
    byId("order-side").addEventListener("change", () => this.update());
    byId("order-mode").addEventListener("change", () => this.#fit());
    byId("order-test").addEventListener("change", () => this.#fit());
    byId("order-give").addEventListener("click", () => this.#give());
    pitchCanvas.over.push((context, projection) => this.#draw(context, projection));
  }

  get side() {
    return byId("order-side").value;
  }

  /** Shows the sides that may be given orders, and the active orders with their acknowledgements. */
  update() {
    const { match } = this;
    if (match.setup === null) return;
    const sides = match.sides.filter((side) => match.may("order", side));
    const shown = sides.length ? sides : match.sides;
    offer(byId("order-side"), shown.map((side) => [side, match.setup.teams[side].name]));
    const robots = [["", "none"], ...match.setup.teams[this.side].robots.map((name) => [name, name])];
    for (const key of ["robot_a", "robot_b"]) offer(this.#inputs[key].select, robots);
    const why = !match.live ? "this is a recording" : sides.length ? "" : "orders need the token of the side's coach or the referee's";
    byId("order-give").disabled = why !== "" || !match.hostThere;
    byId("order-give").title = why;
    byId("active-orders").replaceChildren(...["cyan", "magenta"].flatMap((side) => this.#orderLine(side)));
    this.#fit();
  }

  #lay() {
    offer(byId("order-mode"), MODES.map((mode) => [mode, capitalized(mode)]));
    offer(byId("order-test"), Object.entries(TESTS).map(([word, [name]]) => [word, name]));
    for (const [key, [words, kind, knows]] of Object.entries(FIELDS)) {
      this.#inputs[key] = KINDS[kind](this, key, words, knows);
      byId("order-fields").append(this.#inputs[key].row);
    }
  }

  /** Shows the fields of the order. */
  #fit() {
    const mode = byId("order-mode").value;
    const [, sentence, needed, taken] = TESTS[byId("order-test").value];
    show(byId("order-test-row"), mode === "test");
    setText(byId("order-says"), mode === "test" ? sentence : MODE_WORDS[mode]);
    for (const [key, { row }] of Object.entries(this.#inputs)) {
      const fits = { test: [...needed, ...taken].includes(key), play: !OF_TESTS.includes(key) };
      show(row, fits[mode] ?? LIMITS.includes(key));
      mark(row, "needed", mode === "test" && needed.includes(key));
    }
    show(byId("order-tactic-row"), mode === "play");
  }

  #give() {
    const order = { mode: byId("order-mode").value };
    if (order.mode === "test") order.test = byId("order-test").value;
    if (order.mode === "play" && byId("order-tactic").value) order.tactic = byId("order-tactic").value;
    for (const [key, { row, read }] of Object.entries(this.#inputs)) {
      const value = row.hidden ? null : read();
      if (value !== null) order[key] = value;
    }
    const missing = order.mode === "test" ? TESTS[order.test][2].filter((key) => !(key in order)).map((key) => FIELDS[key][0]) : [];
    if (missing.length) {
      const reason = `${TESTS[order.test][0]} needs ${new Intl.ListFormat("en").format(missing)}`;
      return this.requests.show(byId("order-give"), `Test ${readable(order.test)}, ${this.side}`, { accepted: false, reason });
    }
    const words = order.mode === "test" ? `Test ${readable(order.test)}` : capitalized(order.mode);
    return this.requests.ask(byId("order-give"), `${words}, ${this.side}`, "order", { side: this.side, order });
  }

  #orderLine(side) {
    const active = this.match.orders[side];
    if (!active?.order) return [];
    const { order, acknowledged, refused } = active;
    const what = order.mode === "test" ? `test ${readable(order.test ?? "")}` : order.mode;
    const robots = Object.entries(acknowledged);
    const taken = robots.filter(([, has]) => has).length;
    return [
      element(
        "p", {},
        element("b", {}, `${this.match.setup.teams[side].name}: ${what}`), ` — acknowledged by ${taken} of ${robots.length} `,
        ...robots.map(([name, has]) => element("span", { class: `ack ${has ? "accepted" : "waits"}` }, `${has ? "✓" : "…"} ${name}`)),
        ...Object.entries(refused).map(([name, why]) => element("span", { class: "ack waits" }, ` ✕ ${name}: ${why}`)),
      ),
    ];
  }

  /** Draws the points of the form while it is visible, and the points of active tests. */
  #draw(context, projection) {
    if (byId("order-fields").offsetParent !== null) {
      for (const key of ["point_a", "point_b"]) {
        const { row, onPitch } = this.#inputs[key];
        const place = row.hidden ? null : onPitch();
        if (place) cross(context, projection, place, key === "point_a" ? "A" : "B");
      }
    }
    for (const [side, active] of Object.entries(this.match.orders)) {
      const order = active?.order;
      if (order?.mode !== "test") continue;
      for (const [letter, point] of [["A", order.point_a], ["B", order.point_b]]) {
        if (point) cross(context, projection, onField(this.match, side, point), letter);
      }
    }
  }
}

const MODE_WORDS = {
  play: "The team plays; its own code decides what tactic, points and robots mean.",
  hold: "All robots of the side stand still.",
  park: "All robots of the side drive to their parking places.",
};

/** Kind of field → its row and its `read`: a value of the order, or null where it is left empty. */
const KINDS = {
  robot(coach, key, words) {
    const select = choice([], { id: `order-${key}` });
    return { select, row: labelled(key, words, select), read: () => select.value || null };
  },
  number(coach, key, words, most) {
    const input = numeric(`order-${key}`, { min: 0, max: most });
    return { row: labelled(key, words, input), read: () => numberIn(input) };
  },
  word(coach, key, words, all) {
    const select = choice(all.map((word) => [word, readable(word)]), { id: `order-${key}` });
    return { row: labelled(key, words, select), read: () => select.value };
  },
  switch(coach, key, words) {
    const input = element("input", { id: `order-${key}`, type: "checkbox" });
    const row = element("label", { class: "switch", data: { field: key } }, input, words);
    return { row, read: () => (input.checked ? true : null) };
  },
  angle(coach, key, words) {
    const input = numeric(`order-${key}`, { step: 5 });
    const read = () => {
      const given = numberIn(input);
      return given === null ? null : turnedBy(coach, radians(given));
    };
    return { input, row: labelled(key, `${words} (°, on the field)`, input), read };
  },
  point(coach, key, words) {
    const x = numeric(`order-${key}-x`, { step: 0.1 }), y = numeric(`order-${key}-y`, { step: 0.1 });
    const pick = element("button", { type: "button", id: `order-${key}-pick`, aria: { label: `Pick ${words} on the field` } }, "Pick");
    pick.addEventListener("click", () =>
      coach.selection.pick(words, (place, angle) => {
        x.value = place.x.toFixed(2);
        y.value = place.y.toFixed(2);
        const beside = byId(`order-${key.replace("point", "angle")}`);
        if (angle !== null) beside.value = Math.round(degrees(angle));
      }),
    );
    for (const [input, axis] of [[x, "x"], [y, "y"]]) input.setAttribute("aria-label", `${words}, ${axis} in m`);
    const onPitch = () => (numberIn(x) === null || numberIn(y) === null ? null : { x: numberIn(x), y: numberIn(y) });
    const read = () => {
      const place = onPitch();
      const sign = coach.match.attack(coach.side);
      return place === null ? null : { x: sign * place.x, y: sign * place.y };
    };
    const row = element("div", { class: "field", data: { field: key } }, element("span", {}, `${words} (m)`), element("span", { class: "pair" }, x, y, pick));
    return { row, read, onPitch };
  },
};

/** A direction of the field in the frame of the order's side, in (−π, π]. */
function turnedBy(coach, angle) {
  const turned = coach.match.attack(coach.side) > 0 ? angle : angle + Math.PI;
  return Math.atan2(Math.sin(turned), Math.cos(turned));
}

const labelled = (key, words, input) => element("label", { class: "field", data: { field: key } }, words, input);
const numeric = (id, limits) => element("input", { id, type: "number", step: "any", autocomplete: "off", ...limits });
const numberIn = (input) => (input.value.trim() === "" || !Number.isFinite(input.valueAsNumber) ? null : input.valueAsNumber);

function cross(context, projection, place, letter) {
  context.strokeStyle = "#ffffff";
  context.lineWidth = 2;
  circle(context, projection, place, 7 / projection.scale);
  context.stroke();
  write(context, letter, projection.x(place.x) + 14, projection.y(place.y) - 10, 12, { ground: "#0b1c14cc" });
}
