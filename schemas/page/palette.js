// The colours of the picture. Each mark stands out from the grass by at least 3 : 1, as graphics have to (WCAG 2.2, 1.4.11).

export const INK = "#eef4ef";
/** Mown stripes, and the ground around the lines. */
export const GRASS = ["#174330", "#194733"];
export const GROUND = "#12372a";
export const PLAIN = "#12241b";
export const SIDES = {
  cyan: { fill: "#28b9dc", edge: "#05303a", ink: "#04222a", line: "#7fe3fa" },
  magenta: { fill: "#ef4fa0", edge: "#3d0527", ink: "#30031c", line: "#ff9fd2" },
};
/** Colours of a robot that belongs to neither side. */
export const NEUTRAL = { fill: "#b9c0bc", edge: "#333a36", ink: "#222222", line: "#e3e8e5" };
/** The ring around a hull, and the nose that shows where it kicks to. */
export const RING = "#ffffff";
export const NOSE = "#ffffff";
/** The ring of the robot that holds the ball. */
export const HOLDS = "#ffd23f";
export const BALL = { fill: "#ffb000", edge: "#4a3000", trail: "#ffcf5c" };
/** Opacity of trails of the last seconds, and of trails of the whole match. */
export const TRAIL_ALPHA = { short: 0.85, all: 0.7 };
