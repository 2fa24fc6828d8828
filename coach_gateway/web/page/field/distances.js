// How far robots have to stay from the ball, from the signal of a restart until the ball is in play.

import { SIDES } from "../shared/palette.js";
import { circle, plateOf, write } from "../shared/shapes.js";

const SIZE = 11, WEIGHT = 650;
const SIDED = new Set(["kick_off", "free_kick", "goal_kick", "throw_in", "corner", "penalty"]);

/** The circles of a state: [metres from the ball's spot, robots it is for, side of its colour]. */
export function circlesOf(state, setup) {
  const { opponent_distance, teammate_distance, drop_ball_distance } = setup.restarts;
  if (state.phase === "drop_ball") return [[drop_ball_distance, "all robots", null]];
  if (!SIDED.has(state.phase) || !state.side) return [];
  const other = state.side === "cyan" ? "magenta" : "cyan";
  return [
    [opponent_distance, setup.teams[other].name, other],
    [teammate_distance, `${setup.teams[state.side].name}, except the taker`, state.side],
  ];
}

export function drawDistances(context, projection, match, world) {
  const { state, setup } = match;
  if (state === null) return;
  const spot = state.spot ?? world.ball;
  circlesOf(state, setup).forEach(([radius, who, side], place) => {
    if (radius <= 0) return;
    context.strokeStyle = side ? SIDES[side].line : "#ffffff";
    context.lineWidth = 2;
    context.setLineDash(place ? [3, 5] : [10, 6]);
    circle(context, projection, spot, radius);
    context.stroke();
    context.setLineDash([]);
    const ends = [-1, 1].map((end) => projection.y(spot.y) + end * projection.length(radius));
    const [first, second] = place ? ends.toReversed() : ends; // labels of two circles stand at two ends
    const top = first > 12 && first < projection.height - 12 ? first : second;
    const text = `${radius} m: ${who}`, half = plateOf(context, text, 0, top, SIZE, WEIGHT).right;
    write(context, text, clamp(projection.x(spot.x), half, projection.width - half), top, SIZE, {
      colour: side ? SIDES[side].line : "#ffffff", weight: WEIGHT, ground: "#0b1c14cc",
    });
  });
}

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
