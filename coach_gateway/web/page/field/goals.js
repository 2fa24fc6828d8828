// Which side defends which goal: the goals in the colours of their sides, and the teams' names above their halves.

import { goalPath } from "../shared/pitch.js";
import { SIDES } from "../shared/palette.js";
import { write } from "../shared/shapes.js";

const ENDS = [-1, 1];

/** Fills the goals; `defends` are the sides that defend the goal at −x and at +x. */
export function fillGoals(context, projection, pitch, defends) {
  context.globalAlpha = 0.55;
  ENDS.forEach((end, place) => {
    context.fillStyle = SIDES[defends[place]].fill;
    goalPath(context, projection, pitch, end);
    context.fill();
  });
  context.globalAlpha = 1;
}

/** Writes the name of each team above the half that it defends. */
export function writeTeams(context, projection, pitch, teams, defends) {
  const size = Math.max(11, Math.min(15, 0.55 * projection.scale));
  const top = projection.y(projection.sign * (pitch.width / 2)) - 0.75 * size;
  ENDS.forEach((end, place) => {
    const side = defends[place], left = projection.x((end * pitch.length) / 4);
    write(context, teams[side].name, left, top, size, { colour: SIDES[side].line });
  });
}
