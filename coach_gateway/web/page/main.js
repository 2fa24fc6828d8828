// Puts the page together.

import { Buttons } from "./deeds/buttons.js";
import { Coach } from "./panels/coach.js";
import { Requests } from "./deeds/requests.js";
import { Drag } from "./field/drag.js";
import { ManualControl } from "./deeds/manual_control.js";
import { byId, element, setText, show } from "./shared/elements.js";
import { EventList } from "./panels/event_list.js";
import { HealthPanel } from "./panels/health.js";
import { KEYS, listenForKeys } from "./deeds/keys.js";
import { DebugValues } from "./panels/debug_values.js";
import { Layers } from "./field/layers.js";
import { Match } from "./link/match.js";
import { Panels } from "./panels/panels.js";
import { Parameters } from "./panels/parameters.js";
import { Pending } from "./deeds/pending.js";
import { Replay } from "./panels/replay.js";
import { Result } from "./panels/result.js";
import { Scenes } from "./panels/scenes.js";
import { Scoreboard } from "./panels/scoreboard.js";
import { Seats } from "./panels/seats.js";
import { Selection } from "./field/selection.js";
import { Connection } from "./link/connection.js";
import { PitchCanvas } from "./field/canvas.js";
import { Tabs } from "./panels/tabs.js";
import { Topics } from "./panels/topics.js";
import { keepToken, tokenHere } from "./link/token.js";

const match = new Match();
const selection = new Selection();
const connection = new Connection(tokenHere(), (message) => match.receive(message), (up) => changed(up), () => board.update());
const requests = new Requests(connection, match);
const layers = new Layers(match);
const pitchCanvas = new PitchCanvas(byId("ground"), byId("moving"), match, layers, selection);
const board = new Scoreboard(match, connection);
const replay = new Replay(match, requests);
new Topics(match, (time) => replay.seek(time));
const events = new EventList(match, (time) => replay.seek(time));
const buttons = new Buttons(match, requests, selection);
new Pending(match, requests, buttons);
const drag = new Drag(byId("moving"), pitchCanvas, match, requests, selection);
const manualControl = new ManualControl(match, pitchCanvas, requests, selection);
const parameters = new Parameters(match, requests);
new Panels(match, pitchCanvas, selection);
new DebugValues(match, selection);
new HealthPanel(match, pitchCanvas);
new Coach(match, pitchCanvas, requests, selection);
new Scenes(match, requests, drag);
new Result(match);
const tabs = new Tabs((name) => name === "settings" && parameters.stale && parameters.load());
const seats = new Seats(match, (seat) => tabs.fit(seat));
listenForKeys({ match, buttons, manualControl, drag, replay, layers, selection });

selection.on(() => buttons.update());
pitchCanvas.over.push(() => {
  board.tick(pitchCanvas.world);
  replay.tick(pitchCanvas.world);
  events.follow(pitchCanvas.world?.time ?? 0);
});

const ROLE_TEXT = {
  spectator: "You are watching. To command, open the address that you were given with a token, or enter the token here.",
  referee: "You are the referee, who runs the match and may do everything.",
  cyan: "You coach cyan: orders, driving, repair and substitution are for your own robots.",
  magenta: "You coach magenta: orders, driving, repair and substitution are for your own robots.",
};

/** Handles that the connection came up or broke. */
async function changed(up) {
  if (!up && match.over) tabs?.open("result");
  board?.update();
  if (up && connection.token) await claim(connection.token);
}

/** Takes the role of a token; an unknown token is forgotten, an unanswered check is repeated. */
async function claim(token) {
  connection.token = token;
  const reply = await connection.ask("token");
  if (reply.unanswered) {
    if (connection.up && connection.token === token) claim(token);
    return;
  }
  keepToken(reply.accepted ? token : "");
  if (!reply.accepted) connection.token = "";
  setText(byId("token-says"), reply.accepted ? "" : `refused: ${reply.reason}`);
  if (reply.accepted) byId("role-dialog").close();
}

byId("role").addEventListener("click", () => byId("role-dialog").showModal());
byId("role-dialog-open").addEventListener("click", () => {
  byId("help").close();
  byId("role-dialog").showModal();
});
byId("role-dialog-close").addEventListener("click", () => byId("role-dialog").close());
byId("leave").addEventListener("click", () => claim(""));
byId("token-form").addEventListener("submit", (event) => {
  event.preventDefault();
  claim(byId("token").value.trim());
  byId("token").value = "";
});
let ended = false;
match.on("welcome state", () => {
  if (match.over && !ended && seats.seat === "spectator") tabs.open("result");
  ended = match.over;
});
match.on("welcome", () => {
  setText(byId("role-dialog-says"), ROLE_TEXT[match.role]);
  show(byId("leave"), match.role !== "spectator");
  show(byId("token-form"), match.role === "spectator");
});
byId("help-open").addEventListener("click", () => byId("help").showModal());
byId("keys").append(...KEYS.map(([keys, does, of]) => element("div", { class: of }, element("dt", {}, keys), element("dd", {}, does))));

/** For tests, and for the console of the browser. */
window.touchline = { match, pitchCanvas, connection, selection, layers, manualControl };
