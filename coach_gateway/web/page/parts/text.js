// Times, phases, places and names as text.

/** Game time as `m:ss.s`. */
export function clockText(seconds) {
  const tenths = Math.round(seconds * 10);
  return `${Math.floor(tenths / 600)}:${((tenths % 600) / 10).toFixed(1).padStart(4, "0")}`;
}

/** A word of the protocol as people write it: `kick_off` is `kick off`. */
export const readable = (word) => word.replaceAll("_", " ");

/** The same with a capital letter. */
export const capitalized = (word) => word.charAt(0).toUpperCase() + readable(word).slice(1);

/** Metres with two digits, with a minus that is as wide as a plus. */
export const metres = (value) => value.toFixed(2).replace("-", "−");

/** `(1.50, −0.30)`. */
export const placeText = ({ x, y }) => `(${metres(x)}, ${metres(y)})`;

export const degrees = (radians) => (radians * 180) / Math.PI;
export const radians = (degree) => (degree * Math.PI) / 180;

/** Whole degrees in (−180, 180]. */
export function degreeText(angle) {
  const turned = Math.round(degrees(Math.atan2(Math.sin(angle), Math.cos(angle))));
  return `${String(turned === -180 ? 180 : turned).replace("-", "−")}°`;
}

/** A robot of a team: `Lions (cyan 3)`. */
export const playerText = (team, robot) => `${team} (${robot.replace(/(\D)(\d+)$/, "$1 $2")})`;

/** The phase, and its team. */
export function phaseText(state, teams) {
  const words = [capitalized(state.phase)];
  if (state.side) words.push(teams[state.side].name);
  if (state.side && state.running) words.push("started");
  return words.join(", ");
}

/** An order in a few words; empty where the side plays as it wants. */
export function orderText(order) {
  if (order?.mode === "test") return `test ${readable(order.test ?? "")}`;
  return order?.mode === "play" ? (order.tactic ?? "") : (order?.mode ?? "");
}

/** The score of a task with six digits and its unit; a dash before the first tick. */
export const taskScore = (value, unit) => (typeof value === "number" ? `${Number(value.toPrecision(6))} ${unit}`.trim() : "–");

/** `Half 1`, `Extra time, half 3`, or `Penalties 4 : 3`. */
export function halfText(state) {
  if (state.stage === "shoot_out" && state.shoot_out) {
    return `Penalties ${state.shoot_out.cyan} : ${state.shoot_out.magenta}`;
  }
  return state.stage === "extra_time" ? `Extra time, half ${state.half}` : `Half ${state.half}`;
}

/** The digits at the end of a robot's name, or its place in its team. */
export function numberOf(name, team) {
  return /\d+$/.exec(name)?.[0] ?? String((team?.indexOf(name) ?? 0) + 1);
}
