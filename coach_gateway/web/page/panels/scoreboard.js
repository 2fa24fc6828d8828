// The head of the page: names, score, clock, phase, role, cards, and notices.

import { byId, mark, setText, show } from "../shared/elements.js";
import { proposalOf } from "../parts/proposal.js";
import { capitalized, clockText, halfText, orderText, phaseText, readable, taskScore } from "../parts/text.js";

export class Scoreboard {
  #score = null;

  constructor(match, connection) {
    Object.assign(this, { match, connection });
    match.on("welcome state event orders host refbox replay", () => this.update());
  }

  /** Updates score, phase and cards; the clock follows the drawn frames. */
  update() {
    const { match } = this;
    this.#notice();
    if (match.log) return this.#log();
    if (match.setup === null) return;
    const { teams } = match.setup;
    document.title = match.sides.map((side) => teams[side].name).join(" – ");
    setText(byId("title"), document.title);
    for (const side of ["cyan", "magenta"]) {
      setText(byId(`${side}-name`), teams[side].name);
      show(byId(`${side}-name`).parentElement, match.sides.includes(side));
    }
    const { state } = match;
    this.#announce(state, teams);
    setText(byId("score"), match.scoreText);
    setText(byId("phase"), state ? phaseText(state, teams) : "Not begun");
    byId("phase").dataset.side = state?.side ?? "";
    mark(byId("phase"), "running", this.#heard && state?.running === true);
    const { task } = match.setup;
    setText(byId("half"), state ? (task ? `Score ${taskScore(state.value, task.unit)}` : halfText(state)) : "");
    setText(byId("left"), typeof state?.left === "number" && state.phase !== "full_time" ? `${Math.ceil(state.left)} s left` : "");
    setText(byId("people"), state ? disciplineLine(state) : "");
    setText(byId("in-force"), inForce(match));
    for (const id of ["phase", "people", "in-force"]) byId(id).title = byId(id).textContent;
  }

  /** What is heard of the host is new. */
  get #heard() {
    return this.connection.up && !this.connection.silent && this.match.hostThere;
  }

  /** Shows how the replay of a file without a match stands, below its name. */
  #log() {
    const { name, replay } = this.match;
    document.title = name;
    for (const id of ["title", "score"]) setText(byId(id), name);
    if (replay === null) return;
    setText(byId("clock"), clockText(replay.time));
    setText(byId("phase"), replay.paused ? "Paused" : "Playing");
    mark(byId("phase"), "running", this.#heard && !replay.paused);
    setText(byId("half"), `${replay.messages} messages`);
  }

  /** Announces a changed score to those who hear the page, not the score that it begins with. */
  #announce(state, teams) {
    const before = this.#score;
    this.#score = state?.score ?? null;
    if (before === null || this.#score === null) return;
    if (["cyan", "magenta"].every((side) => this.#score[side] === before[side])) return;
    const scored = ["cyan", "magenta"].filter((side) => this.#score[side] > before[side]);
    const what = scored.length ? `Goal for ${scored.map((side) => teams[side].name).join(" and ")}.` : "The score is corrected.";
    setText(byId("announcer"), `${what} ${teams.cyan.name} ${this.#score.cyan}, ${teams.magenta.name} ${this.#score.magenta}.`);
  }

  /** Shows the clock of the drawn frame. */
  tick(world) {
    if (world !== null) setText(byId("clock"), clockText(world.clock));
  }

  #notice() {
    const { match, connection } = this;
    const words = [];
    const over = match.over && (!connection.up || !match.hostThere);
    if (over) words.push("The match is over. This page keeps its result until it is closed.");
    else if (connection.closeReason) words.push(`The gateway closed the connection: ${connection.closeReason}. The page reconnects by itself.`);
    else if (!connection.up) words.push("The connection is broken; the page reconnects by itself.");
    else if (connection.silent) words.push("Nothing arrives any more; the connection may be broken.");
    else if (match.setup === null && !match.log) words.push("No host plays this match yet; the page waits for it.");
    else if (!match.hostThere) words.push(match.live ? "The host has left; the page waits for it." : "The replay has ended.");
    if (match.refbox.connected) {
      const whom = match.refbox.team ? ` of ${match.refbox.team}` : "";
      words.push(`A referee box commands the match${whom}; all buttons but Stop and its questions are locked.`);
    }
    show(byId("notice"), words.length > 0);
    setText(byId("notice"), words.join(" "));
    byId("notice").title = words.join(" ");
    mark(document.body, "away", !over && (!connection.up || connection.silent || !match.hostThere));
  }
}

/** What is not play as usual: orders in force, and to those who only watch the decisions that wait for others. */
function inForce(match) {
  const { setup, state, orders } = match;
  const ordered = match.sides.map((side) => [setup.teams[side].name, orderText(orders[side]?.order)]).filter(([, what]) => what);
  const both = ordered.length > 1 && ordered[0][1] === ordered[1][1] ? [["both", ordered[0][1]]] : ordered;
  const words = both.length ? [`Ordered: ${both.map((one) => one.join(" ")).join(", ")}`] : [];
  if (match.live && match.role === "spectator") {
    const proposal = proposalOf(match);
    if (proposal) words.push(`Proposed: ${proposal.question}`);
    for (const { action, side } of state?.questions ?? []) words.push(`${capitalized(action)} for ${setup.teams[side].name}: which robot?`);
  }
  return words.join(" · ");
}

/** Robots with cards, and robots off the field with the reason: `cyan3 1 yellow, off: repair, 12 s`. */
function disciplineLine(state) {
  return Object.entries(state.robots)
    .map(([name, discipline]) => [name, disciplineText(discipline)])
    .filter(([, words]) => words)
    .map(([name, words]) => `${name} ${words}`)
    .join(" · ");
}

/** A robot's cards, and why it is off the field. */
export function disciplineText({ yellow, red, off_field: away, left }) {
  const words = [];
  if (yellow) words.push(`${yellow} yellow`);
  if (red) words.push(`${red} red`);
  if (away) words.push(`off: ${readable(away)}${left === null || left === undefined ? "" : `, ${Math.ceil(left)} s`}`);
  return words.join(", ");
}
