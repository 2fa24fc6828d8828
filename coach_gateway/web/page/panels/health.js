// The numbers of the match, the health of the host, its recorders and each robot's program, and how fast this page draws.

import { byId, element, setText } from "../shared/elements.js";

const EVERY_MS = 500;
const COLUMNS = [
  ["answers", ({ answers }) => answers],
  ["missed", ({ missed }) => missed],
  ["wrong", ({ duplicates, invalid }) => duplicates + invalid],
  ["refused", ({ refused }) => refused],
  ["ms", ({ latency_ms: latency }) => (latency === null ? "–" : latency.toFixed(1))],
];

/** Label, what of the match tells it, and its text. */
const LINES = [
  ["profile", "setup", ({ profile, profile_version: version }) => versionedName(profile, version)],
  ["rules", "setup", ({ rules, rules_version: version }) => versionedName(rules, version)],
  ["pace", "health", ({ pace, paused }) => (paused ? `${pace}, paused` : pace)],
  ["real-time factor", "health", ({ real_time_factor: factor }) => `${factor.toFixed(2)} ×`],
  ["late ticks", "health", ({ late_ticks: late }) => String(late)],
  ["worst tick of the last second", "health", ({ worst_tick_ms: worst }) => `${worst.toFixed(1)} ms`],
  ["recorders", "health", ({ recorders }) => recorderWords(recorders)],
  ["messages on unexpected keys", "health", ({ strangers }) => String(sum(Object.values(strangers)))],
  ["commands missed, of all robots", "health", ({ robots }) => String(sum(Object.values(robots).map(({ missed }) => missed)))],
];

export class HealthPanel {
  #values = LINES.map(([word, source, text]) => ({ source, text, ...this.#line(word) }));

  constructor(match, pitchCanvas) {
    Object.assign(this, { match, pitchCanvas });
    this.drawing = this.#line("this page draws");
    byId("health").append(...this.#values.map(({ row }) => row), this.drawing.row);
    match.on("health welcome", () => this.update());
    setInterval(() => setText(this.drawing.value, `${pitchCanvas.rate} frames per second`), EVERY_MS);
  }

  update() {
    const { health } = this.match;
    for (const { source, text, value } of this.#values) setText(value, this.match[source] ? text(this.match[source]) : "–");
    const table = byId("programs");
    const names = Object.keys(health?.robots ?? {});
    if (table.dataset.names !== names.join()) this.#layTable(table, names);
    names.forEach((name, place) => {
      const robot = health.robots[name];
      const cells = table.tBodies[0].rows[place].cells;
      setText(cells[0], robot.alive ? name : `${name} (no program)`);
      COLUMNS.forEach(([, text], column) => setText(cells[column + 1], String(text(robot))));
    });
  }

  #line(word) {
    const value = element("dd", {}, "–");
    return { value, row: element("div", {}, element("dt", {}, word), value) };
  }

  #layTable(table, names) {
    table.dataset.names = names.join();
    const head = element("tr", {}, ...["robot", ...COLUMNS.map(([word]) => word)].map((word) => element("th", { scope: "col" }, word)));
    const rows = names.map(() => element("tr", {}, element("th", { scope: "row" }), ...COLUMNS.map(() => element("td"))));
    table.replaceChildren(element("thead", {}, head), element("tbody", {}, ...rows));
  }
}

function recorderWords(recorders) {
  const all = Object.entries(recorders);
  if (all.length === 0) return "none, so nothing is recorded";
  return all.map(([name, behind]) => (behind > 5 ? `${name} is ${behind} ticks behind` : `${name} keeps up`)).join(", ");
}

/** Name and version of a profile or a rule book; a file of the user has no version unless it states one. */
const versionedName = (name, version) => (version ? `${name} (version ${version})` : name);

const sum = (values) => values.reduce((all, value) => all + value, 0);
