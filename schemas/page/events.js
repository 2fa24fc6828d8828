// Events on a time axis: which of them matter most, their symbols, and jumps from one to the next.

/** Seconds before an event that a jump leads to: what led to it is seen, too. */
export const LEAD_S = 2;

/** Kind of event → its symbol. */
export const SYMBOLS = {
  goal: "★", shot: "◆", save: "◇", foul: "✕", advantage: "▷", card: "▮", ball_out: "↗", restart: "↻",
  half_time: "◐", full_time: "■",
};

const ROUTINE = new Set(["stop", "start", "in_play", "restart", "ball_out", "agent", "parameters", "action"]);

/** Whether an event is listed among the key events. */
export const isKey = ({ kind }) => !ROUTINE.has(kind);

/**
 * The text of an event with the teams' names in place of the sides'; names of robots stay. Names that do not tell the teams
 * apart get their sides.
 */
export function withNames(text, { cyan, magenta }) {
  const names = { cyan: cyan.trim() || "cyan", magenta: magenta.trim() || "magenta" };
  const [one, other] = [names.cyan.toLowerCase(), names.magenta.toLowerCase()];
  if (one === other || one === "magenta") names.cyan = `${names.cyan} (cyan)`;
  if (one === other || other === "cyan") names.magenta = `${names.magenta} (magenta)`;
  return text.replace(/\b(cyan|magenta)\b/g, (side) => names[side]);
}

/** Index of the newest of `events`, which are in order of time, at a time; −1 before the first. */
export const indexAt = (events, time) => events.findLastIndex((event) => event.time <= time + 1e-6);

/** Where a jump leads from a time: with `step` 1 to the next event, with −1 to the one before; undefined where none is. */
export function jumpTarget(events, step, from, start) {
  const times = events.map(({ time }) => Math.max(start, time - LEAD_S));
  return step > 0 ? times.find((time) => time > from + 0.05) : times.findLast((time) => time < from - 0.5);
}
