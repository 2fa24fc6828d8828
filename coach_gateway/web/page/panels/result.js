// The result: score, scorers and figures, so far or of the whole match. It needs no server and stays until the page is closed.

import { byId, element, mark, setText, show, together } from "../shared/elements.js";
import { clockText, playerText } from "../parts/text.js";

const SIDES = ["cyan", "magenta"];
/** Label → how many events of a side it counts. */
const COUNTS = [
  ["fouls", (event) => event.kind === "foul"],
  ["yellow cards", (event) => event.card === "yellow"],
  ["red cards", (event) => event.card === "red"],
  ["ball out", (event) => event.kind === "ball_out"],
];

/** The goals of a list of events that count in the end: {side, robot, clock}; without those taken back or before a reset. */
export function goalsOf(events, score) {
  const goals = [];
  const takeBack = (after) => {
    for (const one of SIDES) while (count(goals, one) > after[one]) goals.splice(goals.findLastIndex(({ side }) => side === one), 1);
  };
  for (const { kind, rule, side, robot, clock, text, score: after } of events) {
    if (kind === "scene" && ["load", "reset"].includes(rule)) goals.length = 0; // another episode
    if (kind === "goal" && side) goals.push({ side, robot: robot ?? null, clock });
    const isOfPenalties = kind === "shot" || text.includes("in the shoot-out");
    if (after && !isOfPenalties) takeBack(after);
  }
  takeBack(score);
  return goals;
}

const count = (goals, side) => goals.filter((goal) => goal.side === side).length;

export class Result {
  constructor(match) {
    this.match = match;
    match.on("welcome state result host event", together(() => this.update(), setTimeout));
  }

  update() {
    const { match } = this, { setup, state, result } = match, over = state?.phase === "full_time";
    setText(byId("result-title"), over ? "Final result" : "So far");
    mark(byId("result"), "over", over);
    if (setup === null || state === null) return;
    const events = match.live ? match.events : match.events.filter(({ time }) => time <= state.time); // a recording knows all
    const goals = goalsOf(events, state.score);
    for (const side of SIDES) {
      setText(byId(`result-${side}`), match.sides.includes(side) ? setup.teams[side].name : "");
      byId(`${side}-scorers`).replaceChildren(...goals.filter((goal) => goal.side === side).map(({ robot, clock }) =>
        element("li", {}, `${robot ? playerText(setup.teams[match.sideOf(robot)].name, robot) : setup.teams[side].name} ${clockText(clock)}`)));
    }
    const shootOut = state.shoot_out?.goals ?? state.shoot_out;
    const penalties = shootOut ? ` (${shootOut.cyan} : ${shootOut.magenta} on penalties)` : "";
    setText(byId("result-score"), match.scoreText + penalties);
    const counted = COUNTS.map(([name, counts]) => [name, ...SIDES.map((side) =>
      String(events.filter((event) => event.side === side && counts(event)).length))]);
    byId("result-figures").tBodies[0].replaceChildren(...(result?.figures.length ? result.figures : counted).map(([name, cyan, magenta]) =>
      element("tr", {}, element("td", {}, cyan), element("th", { scope: "row" }, name), element("td", {}, magenta))));
    this.#link(result);
  }

  /** Links to the replay and the statistics, where the match has left a recording. */
  #link(result) {
    show(byId("result-later"), result === null && this.match.live);
    show(byId("result-statistics"), (result?.statistics ?? null) !== null);
    if (result?.statistics) byId("result-statistics").href = result.statistics;
    show(byId("result-replay-row"), (result?.replay ?? null) !== null);
    setText(byId("result-replay"), result?.replay ?? "");
  }
}
