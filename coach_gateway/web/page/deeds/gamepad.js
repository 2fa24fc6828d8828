// The first gamepad: left stick drives, right stick turns, buttons kick and dribble.

const DEAD = 0.12;
const GROUND = 0, LOB = 1, DRIBBLES = [4, 5]; // buttons of the standard layout: A, B, both shoulders
let before = [];

/** Ahead, left and counter-clockwise from −1 to 1, and buttons that were just pressed; null without a gamepad. */
export function readGamepad() {
  const pad = navigator.getGamepads?.().find((one) => one?.connected);
  if (!pad) return null;
  const now = pad.buttons.map(({ pressed }) => pressed);
  const fresh = (number) => now[number] && !before[number];
  const state = {
    ahead: -stick(pad.axes[1]),
    left: -stick(pad.axes[0]),
    turn: -stick(pad.axes[2]),
    kicks: fresh(GROUND) ? "ground" : fresh(LOB) ? "lob" : null,
    dribbles: DRIBBLES.some(fresh),
  };
  before = now;
  return state;
}

const stick = (value = 0) => (Math.abs(value) < DEAD ? 0 : value);
