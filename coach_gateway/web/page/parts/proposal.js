// What the referee proposes, as a question to people and the sentence that explains it.

import { withNames } from "../shared/events.js";
import { playerText, readable } from "./text.js";

const SCORED = /^(own )?goal, counts for \w+: /;
const PREFIX = /^proposed, decided in [\d.e+]+ s: /;

/** {question, reason} of the proposal that waits; null without one. */
export function proposalOf(match) {
  const { live, state, events, setup } = match;
  const proposal = live ? (state?.proposal ?? null) : null;
  if (proposal === null || setup === null) return null;
  const event = events.findLast(({ kind, text }) => kind === "proposal" && proposal.endsWith(text.replace(PREFIX, "")));
  const reason = (event ? event.text.replace(PREFIX, "") : proposal).replace(SCORED, "");
  const names = { cyan: setup.teams.cyan.name, magenta: setup.teams.magenta.name };
  return { question: event ? questionOf(event, match) : "The referee proposes:", reason: initial(withNames(reason, names)) };
}

/** `Goal for Lions (cyan 3)?` for the event of a proposal; its text says more. */
export function questionOf({ rule, side, robot, text }, match) {
  const { teams } = match.setup, what = text.replace(PREFIX, ""), of = robot ? match.sideOf(robot) : null;
  const who = robot ? playerText(teams[of].name, robot) : "";
  const scored = SCORED.test(what);
  if (scored && side === of) return `Goal for ${who}?`;
  if (scored) return `Goal for ${teams[side].name}${who ? `, an own goal of ${who}` : ""}?`;
  if (what.startsWith("no goal")) return `No goal for ${teams[side].name}?`;
  if (what.startsWith("ball out")) return `Ball out${who ? `, last touched by ${who}` : ""}?`;
  if (robot && side) return `Foul by ${who}: ${readable(rule)}?`;
  return `${initial(readable(rule))}?`;
}

const initial = (text) => text.charAt(0).toUpperCase() + text.slice(1);
