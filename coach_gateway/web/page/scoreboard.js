// The head of the page: names, score, clock, phase, who sits here, and whether everybody is there.

import { byId, mark, say, show } from "./elements.js";
import { clockWords, halfWords, phaseWords, spoken } from "./words.js";

const ROLES = { spectator: "watching", referee: "referee", cyan: "coach of cyan", magenta: "coach of magenta" };

export class Scoreboard {
  constructor(match, line) {
    Object.assign(this, { match, line });
    match.on("welcome state host refbox replay", () => this.update());
  }

  /** Score, phase and people; the clock follows each drawn picture. */
  update() {
    const { match } = this;
    document.body.dataset.role = match.role;
    document.body.dataset.live = match.live;
    say(byId("role"), match.live ? ROLES[match.role] : "recording");
    this.#notice();
    if (match.setup === null) return;
    const { teams } = match.setup;
    document.title = `${teams.cyan.name} – ${teams.magenta.name}`;
    say(byId("cyan-name"), teams.cyan.name);
    say(byId("magenta-name"), teams.magenta.name);
    const { state } = match;
    say(byId("score"), state ? `${state.score.cyan} : ${state.score.magenta}` : "– : –");
    say(byId("phase"), state ? phaseWords(state, teams) : "Not begun");
    byId("phase").dataset.side = state?.side ?? "";
    mark(byId("phase"), "running", state?.running === true);
    say(byId("half"), state ? halfWords(state) : "");
    say(byId("left"), state?.left !== null && state?.left !== undefined ? `${Math.ceil(state.left)} s left` : "");
    say(byId("people"), state ? peopleWords(state) : "");
  }

  /** The clock of the picture that is shown. */
  tick(world) {
    if (world !== null) say(byId("clock"), clockWords(world.clock));
  }

  #notice() {
    const { match, line } = this;
    const words = [];
    if (line.sentAway) words.push(`The gateway let this page go: ${line.sentAway}. It tries again by itself.`);
    else if (!line.up) words.push("The connection is broken; the page tries again by itself.");
    else if (match.setup === null) words.push("No host plays this match yet; the page waits for it.");
    else if (!match.hostThere) words.push(match.live ? "The host is gone; the page waits for it." : "The replay has ended.");
    if (match.refbox.connected) {
      const whom = match.refbox.team ? ` of ${match.refbox.team}` : "";
      words.push(`A referee box commands the match${whom}; the referee's buttons are locked.`);
    }
    show(byId("notice"), words.length > 0);
    say(byId("notice"), words.join(" "));
    mark(document.body, "away", !line.up || !match.hostThere);
  }
}

/** Cards, and who is off the field and why: `cyan3 1 yellow, off: repair, 12 s`. */
function peopleWords(state) {
  return Object.entries(state.robots)
    .map(([name, standing]) => [name, standingWords(standing)])
    .filter(([, words]) => words)
    .map(([name, words]) => `${name} ${words}`)
    .join(" · ");
}

/** A robot's cards, and why it is off the field. */
export function standingWords({ yellow, red, off_field: away, left }) {
  const words = [];
  if (yellow) words.push(`${yellow} yellow`);
  if (red) words.push(`${red} red`);
  if (away) words.push(`off: ${spoken(away)}${left === null || left === undefined ? "" : `, ${Math.ceil(left)} s`}`);
  return words.join(", ");
}
