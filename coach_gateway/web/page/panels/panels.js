// A panel for each robot: role, intention, pose, ball, health of its program, order and cards.

import { byId, element, mark, setText, show } from "../shared/elements.js";
import { disciplineText } from "./scoreboard.js";
import { degreeText, metres, numberOf, placeText, readable } from "../parts/text.js";

const EVERY_MS = 200;
const HIGH_M = 0.25; // the centre of a ball that is off the ground
/** Key, label, and the text from what is known of the robot. Each line has its place, so that no other one ever moves. */
const LINES = [
  ["intention", "intends", ({ word }) => word?.intention ?? ""],
  ["pose", "at", ({ body }) => (body ? `${placeText(body)} ${degreeText(body.heading)}` : "")],
  ["speed", "speed", ({ body }) => (body ? `${metres(Math.hypot(body.vx, body.vy))} m/s` : "")],
  ["ball", "ball", ({ body, ball, holds }) => (holds ? "held" : body && ball ? `${metres(Math.hypot(ball.x - body.x, ball.y - body.y))} m away` : "")],
  ["battery", "battery", ({ word }) => batteryWords(word?.extra?.battery)],
  ["latency", "replies in", ({ health }) => (health?.latency_ms ? `${health.latency_ms.toFixed(1)} ms` : "")],
  ["missed", "missed", ({ health }) => (health?.missed ? `${health.missed} of ${health.answers + health.missed}` : "")],
  ["refused", "refused", ({ health }) => (health?.refused ? String(health.refused) : "")],
  ["order", "order", ({ order, acknowledged }) => (order ? `${order.mode}, ${acknowledged ? "acknowledged" : "sent"}` : "")],
  ["cards", "referee", ({ discipline }) => (discipline ? disciplineText(discipline) : "")],
];

export class Panels {
  #panels = new Map();
  #robots = "";

  constructor(match, pitchCanvas, selection) {
    Object.assign(this, { match, pitchCanvas, selection });
    setInterval(() => this.update(), EVERY_MS);
    selection.on(() => this.update());
  }

  update() {
    const { match } = this;
    if (match.setup === null) return;
    if (match.robots.join() !== this.#robots) this.#lay();
    for (const [name, panel] of this.#panels) this.#fill(name, panel);
    if (this.pitchCanvas.world?.ball) setText(byId("ball-says"), ballWords(this.pitchCanvas.world));
  }

  #lay() {
    this.#robots = this.match.robots.join();
    this.#panels = new Map(this.match.robots.map((name) => [name, this.#panel(name)]));
    for (const side of ["cyan", "magenta"]) {
      const mine = [...this.#panels].filter(([name]) => this.match.sideOf(name) === side);
      byId(`${side}-robots`).replaceChildren(...mine.map(([, { card }]) => card));
    }
  }

  #panel(name) {
    const side = this.match.sideOf(name);
    const role = element("span", { class: "does" });
    const badge = element("span", { class: "badge" });
    const number = numberOf(name, this.match.setup.teams[side].robots);
    const head = element(
      "button",
      { type: "button", class: "who", on: { click: () => this.selection.choose(this.selection.robot === name ? null : name) } },
      element("span", { class: `mark ${side}` }, number), element("b", {}, name), role, badge,
    );
    const lines = LINES.map(([key, word, text]) => {
      const value = element("dd", { data: { is: key }, on: { mouseenter: () => { value.title = value.textContent; } } });
      return { value, row: element("div", {}, element("dt", {}, word), value), text };
    });
    const card = element("li", { class: `panel ${side}`, data: { robot: name } }, head, element("dl", {}, ...lines.map(({ row }) => row)));
    return { card, head, role, badge, lines };
  }

  #fill(name, { card, head, role, badge, lines }) {
    const { match } = this;
    const world = this.pitchCanvas.world;
    const body = world?.robots[name];
    const known = {
      body,
      ball: world?.ball,
      holds: world?.possession === name,
      word: match.radioOf(name, 5),
      health: match.health?.robots[name],
      order: match.orders[match.sideOf(name)]?.order,
      acknowledged: match.orders[match.sideOf(name)]?.acknowledged[name],
      discipline: match.state?.robots[name],
    };
    setText(role, known.word?.role ? readable(known.word.role) : "");
    const [word, looks] = stateOf(known);
    setText(badge, word);
    badge.dataset.looks = looks;
    show(badge, word !== "");
    mark(card, "holds", known.holds);
    mark(card, "away", !body || body.off_field !== null);
    head.setAttribute("aria-pressed", this.selection.robot === name);
    for (const { value, text } of lines) {
      setText(value, text(known) || "–");
    }
  }
}

/** The most important fact about a robot, as a badge: its text and its class. */
function stateOf({ body, holds, health }) {
  if (!body) return ["not there", "grey"];
  if (body.off_field) return [readable(body.off_field), "grey"];
  if (health?.removed || health?.still) return ["stands still", "grey"];
  if (health && !health.alive) return ["no program", "bad"];
  if (body.stuck) return ["stuck", "bad"];
  if (holds) return ["ball", "ball"];
  if (health && !health.answering && health.latency_ms === null) return ["silent", "bad"]; // for a second
  return ["", ""];
}

/** The ball's place, speed and height, and the robot that has it. */
function ballWords({ ball, possession }) {
  const words = [`at ${placeText(ball)}`, `${metres(Math.hypot(ball.vx, ball.vy))} m/s`];
  if (ball.z > HIGH_M) words.push(`${metres(ball.z)} m high`);
  return [...words, possession ? `${possession} has it` : "no robot has it"].join(", ");
}

/** A share up to 1 in percent; a larger number is a voltage. */
function batteryWords(battery) {
  if (typeof battery !== "number") return battery === undefined ? "" : String(battery);
  return battery <= 1 ? `${Math.round(100 * battery)} %` : `${battery.toFixed(1)} V`;
}
