// Connects the parts of the page.

import { fitted } from "./canvas.js";
import { EventList } from "./event_list.js";
import { drawHeatMaps } from "./heat_maps.js";
import { listenForKeys } from "./keys.js";
import { formatClock, readMatch } from "./match.js";
import { drawMovingBodies } from "./moving_bodies.js";
import { Player } from "./player.js";
import { byId } from "./shared/elements.js";
import { drawGrass, drawLines } from "./shared/pitch.js";
import { drawShots } from "./shots.js";
import { Timeline } from "./timeline.js";

const match = readMatch(byId("match").textContent);
const player = new Player(match.start, match.end, draw);
const seek = (time) => player.seek(time);
const timeline = new Timeline(byId("momentum"), match, seek);
const events = new EventList(byId("events"), { key: byId("key-events"), all: byId("all-events") }, match, seek);
const view = {};
const pitchLayer = document.createElement("canvas");

function fit() {
  Object.assign(view, fitted(byId("pitch"), match.pitch));
  const { context, projection } = view;
  drawGrass(context, projection, match.pitch);
  drawLines(context, projection, match.pitch);
  pitchLayer.width = context.canvas.width;
  pitchLayer.height = context.canvas.height;
  pitchLayer.getContext("2d").drawImage(context.canvas, 0, 0);
  timeline.fit();
  drawHeatMaps(byId("heat"), match);
  drawShots(byId("shots"), match);
  draw(player);
}

function draw({ time, playing }) {
  const { context, projection } = view;
  if (context === undefined) return; // nothing is laid out yet
  context.save();
  context.setTransform(1, 0, 0, 1, 0, 0);
  context.drawImage(pitchLayer, 0, 0);
  context.restore();
  drawMovingBodies(context, projection, match, time);
  timeline.draw(time);
  events.mark(time);
  const interval = match.interval(time), scrub = byId("scrub");
  scrub.value = String(time);
  scrub.setAttribute("aria-valuetext", formatClock(time - match.start, true));
  byId("clock").textContent = formatClock(match.clockAt(time), true);
  byId("phase").textContent = interval ? phaseText(interval) : "";
  byId("score-now").textContent = interval?.score ? interval.score.join(" : ") : "";
  byId("play").classList.toggle("playing", playing);
  byId("play").setAttribute("aria-label", playing ? "Pause (space)" : "Play (space)");
}

function phaseText(interval) {
  const phase = interval.phase.replaceAll("_", " ");
  return interval.side ? `${phase}, ${match.teams[interval.side]}` : phase;
}

byId("in-play").textContent = match.in_play.seconds === null
  ? ""
  : `${formatClock(match.end - match.start)} recorded, ball in play ${formatClock(match.in_play.seconds)} (${Math.round(100 * match.in_play.share)} %)`;

const scrub = byId("scrub");
scrub.min = String(match.start);
scrub.max = String(match.end);
scrub.addEventListener("input", () => seek(Number(scrub.value)));
const speed = byId("speed");
speed.addEventListener("change", () => { player.rate = Number(speed.value); });
const jump = (step) => events.jump(step, player.time);
byId("play").addEventListener("click", () => player.toggle());
byId("pitch").addEventListener("click", () => player.toggle());
byId("previous").addEventListener("click", () => jump(-1));
byId("next").addEventListener("click", () => jump(1));
listenForKeys(player, match, speed, jump);

const asked = Number.parseFloat(new URLSearchParams(location.hash.slice(1)).get("t"));
player.time = Number.isFinite(asked) ? Math.min(Math.max(asked, match.start), match.end) : match.start;
let width = 0;
new ResizeObserver(() => {
  if (width === document.body.clientWidth) return; // drawing changes the height
  width = document.body.clientWidth;
  fit();
}).observe(document.body);
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", fit); // marks are drawn in the colour of texts
window.touchline = { match, player, view };
