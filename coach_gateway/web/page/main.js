// Puts the page together.

import { Buttons } from "./buttons.js";
import { Coach } from "./coach.js";
import { Desk } from "./desk.js";
import { Drag } from "./drag.js";
import { Drive } from "./drive.js";
import { byId, element, say, show } from "./elements.js";
import { Events } from "./events.js";
import { HealthPanel } from "./health.js";
import { KEYS, listenForKeys } from "./keys.js";
import { Layers } from "./layers.js";
import { Match } from "./match.js";
import { Panels } from "./panels.js";
import { Parameters } from "./parameters.js";
import { Replay } from "./replay.js";
import { Scenes } from "./scenes.js";
import { Scoreboard } from "./scoreboard.js";
import { Seat } from "./seat.js";
import { Line } from "./socket.js";
import { Stage } from "./stage.js";
import { Tabs } from "./tabs.js";
import { keepToken, tokenHere } from "./token.js";

const match = new Match();
const seat = new Seat();
const line = new Line(tokenHere(), (message) => match.take(message), (up) => changed(up));
const desk = new Desk(line);
const layers = new Layers(match);
const stage = new Stage(byId("ground"), byId("moving"), match, layers, seat);
const board = new Scoreboard(match, line);
const replay = new Replay(match, desk);
const events = new Events(match, (time) => replay.seek(time));
const buttons = new Buttons(match, desk, seat);
const drag = new Drag(byId("moving"), stage, match, desk, seat);
const drive = new Drive(match, stage, desk, seat);
const parameters = new Parameters(match, desk);
new Panels(match, stage, seat);
new HealthPanel(match, stage);
new Coach(match, stage, desk, seat);
new Scenes(match, desk, drag);
const tabs = new Tabs((name) => name === "settings" && parameters.stale && parameters.load());
listenForKeys({ match, buttons, drive, drag, replay, layers, seat });

seat.on(() => buttons.update());
stage.over.push(() => {
  board.tick(stage.world);
  replay.tick(stage.world);
  events.follow(stage.world?.time ?? 0);
});

const SEATS = {
  spectator: "You watch. Who is to command opens the address that was given out with a token, or types it in here.",
  referee: "You are the referee, who runs the match and may do everything.",
  cyan: "You coach cyan: orders, driving, repair and substitution are for your own robots.",
  magenta: "You coach magenta: orders, driving, repair and substitution are for your own robots.",
};

/** The line to the gateway came up, or broke. */
async function changed(up) {
  board?.update();
  if (up && line.token) await claim(line.token);
}

/** Sits down with a token; one that is nobody's is forgotten, one that nobody answered is tried again. */
async function claim(token) {
  const reply = await line.speakAs(token);
  if (reply.unanswered) {
    if (line.up && line.token === token) claim(token);
    return;
  }
  keepToken(reply.accepted ? token : "");
  if (!reply.accepted) line.token = "";
  say(byId("token-says"), reply.accepted ? "" : `refused: ${reply.reason}`);
  if (reply.accepted) byId("seat").close();
}

for (const id of ["role", "sit"]) byId(id).addEventListener("click", () => byId("seat").showModal());
byId("seat-open").addEventListener("click", () => {
  byId("help").close();
  byId("seat").showModal();
});
byId("seat-close").addEventListener("click", () => byId("seat").close());
byId("leave").addEventListener("click", () => claim(""));
byId("token-form").addEventListener("submit", (event) => {
  event.preventDefault();
  claim(byId("token").value.trim());
  byId("token").value = "";
});
match.on("welcome", () => {
  say(byId("seat-says"), SEATS[match.role]);
  show(byId("leave"), match.role !== "spectator");
  for (const id of ["token-form", "watching"]) show(byId(id), match.role === "spectator");
  if (!match.live && ["match", "coach", "drive", "settings", "log"].includes(tabs.opened)) tabs.open("host");
});
byId("help-open").addEventListener("click", () => byId("help").showModal());
byId("keys").append(...KEYS.map(([keys, does]) => element("div", {}, element("dt", {}, keys), element("dd", {}, does))));

/** For those who look at the page from outside: tests, and people at its console. */
window.touchline = { match, stage, line, seat, layers, drive };
