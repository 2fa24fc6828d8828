// The referee's buttons: a table of groups of rows, each button with the action that it requests.

import { byId, element, mark, offer, setText, show } from "./elements.js";

const SURE_MS = 3000;
const RESTARTS = [
  ["kick_off", "Kick-off"],
  ["free_kick", "Free kick"],
  ["goal_kick", "Goal kick"],
  ["throw_in", "Throw-in"],
  ["corner", "Corner"],
  ["penalty", "Penalty"],
];
const FOR_SIDES = [...RESTARTS, ["goal", "Goal +"], ["cancel_goal", "Goal −"]];
const sided = ([action, text]) => ["cyan", "magenta"].map((side) => ({ text, action, side }));

/** Title → rows of buttons: `text`, the referee's `action` or an `order`, its `side`, `robot` if it is about one. */
const GROUPS = [
  [
    "Play",
    [
      [
        { text: "Start", action: "start", looks: "go" },
        { text: "Stop", action: "stop", looks: "halt" },
      ],
      [
        { text: "Drop ball", action: "drop_ball" },
        { text: "Undo", action: "undo" },
      ],
    ],
  ],
  ["For a side", FOR_SIDES.map(sided)],
  [
    "Teams",
    ["play", "hold", "park"].map((mode) =>
      ["cyan", "magenta"].map((side) => ({ text: { play: "Go on", hold: "Hold", park: "Park" }[mode], order: mode, side })),
    ),
  ],
  [
    "For the robot",
    [
      [
        { text: "Yellow card", action: "yellow_card", robot: true, looks: "yellow" },
        { text: "Red card", action: "red_card", robot: true, looks: "red" },
      ],
      [
        { text: "Repair", action: "repair", robot: true },
        { text: "Substitute", action: "substitute", robot: true },
      ],
      [
        { text: "Take off", action: "park", robot: true },
        { text: "Come back", action: "enter", robot: true },
      ],
    ],
  ],
  [
    "Match",
    [
      [
        { text: "End half", action: "end_half", sure: true },
        { text: "End match", action: "end_game", sure: true },
      ],
    ],
  ],
];

export class Buttons {
  #buttons = [];

  constructor(match, requests, selection) {
    Object.assign(this, { match, requests, selection });
    const place = byId("buttons");
    for (const [title, rows] of GROUPS) place.append(this.#group(title, rows));
    byId("stop").addEventListener("click", () => this.stop(byId("stop")));
    for (const [id, action] of [["confirm", "confirm"], ["overrule", "overrule"]]) {
      byId(id).addEventListener("click", () => this.#ask(byId(id), { text: byId(id).textContent, action }));
    }
    match.on("welcome host state refbox health", () => this.update());
  }

  /** Stops the match, or as a coach the own side. */
  stop(source = byId("stop")) {
    const { match } = this;
    if (match.may("stop")) return this.#ask(source, { text: "Stop", action: "stop" });
    if (match.may("order", match.role)) return this.#ask(source, { text: `Hold ${match.role}`, order: "hold", side: match.role });
    return null;
  }

  /** Why a button cannot be pressed; null when it can. */
  why({ action, order, side, robot }) {
    const { match, selection } = this;
    if (!match.live) return "this is a recording";
    const deed = action ?? "order";
    const of = side ?? (robot && selection.robot ? match.sideOf(selection.robot) : null);
    if (!match.may(deed, of)) {
      return match.role === "spectator" ? "spectators watch; a token lets you command" : `not for the coach of ${match.role}`;
    }
    if (!match.hostThere) return "the host is away";
    if (action && action !== "stop" && match.refbox.connected) return "the referee box commands the match";
    return robot && !selection.robot ? "choose a robot first" : null;
  }

  /** Enables the buttons that may be pressed, and gives the others their reason as a title. */
  update() {
    const { match, selection } = this;
    for (const { button, row } of this.#buttons) {
      const why = this.why(row);
      button.disabled = why !== null;
      button.title = why ?? "";
    }
    if (match.setup !== null) {
      for (const side of ["cyan", "magenta"]) {
        for (const name of document.querySelectorAll(`[data-team=${side}]`)) setText(name, match.setup.teams[side].name);
      }
    }
    offer(byId("robot"), [["", "none chosen"], ...match.robots.map((name) => [name, name])]);
    if (byId("robot").value !== (selection.robot ?? "")) byId("robot").value = selection.robot ?? "";
    const proposal = match.state?.proposal ?? null;
    show(byId("proposal"), proposal !== null && match.live);
    setText(byId("proposed"), proposal ?? "");
    for (const id of ["confirm", "overrule"]) byId(id).disabled = this.why({ action: id }) !== null;
    show(byId("stop"), match.live && (match.may("stop") || match.may("order", match.role)));
    byId("stop").disabled = !match.hostThere; // enabled while a referee box commands the match, too: a stop is always accepted
  }

  #group(title, rows) {
    const group = element("fieldset", { class: "group" }, element("legend", {}, title));
    const names = { side: ["For a side", "Teams"].includes(title), robot: title === "For the robot" };
    if (names.side) {
      group.append(
        element("div", { class: "row heads", aria: { hidden: "true" } }, ...["cyan", "magenta"].map((side) =>
          element("span", { class: `team ${side}` }, element("span", { class: "mark" }), element("span", { data: { team: side } })))),
      );
    }
    if (names.robot) group.append(this.#robotChoice());
    for (const row of rows) group.append(element("div", { class: "row" }, ...row.map((one) => this.#button(one))));
    return group;
  }

  #robotChoice() {
    const select = element("select", { id: "robot", on: { change: () => this.selection.choose(select.value || null) } });
    return element("label", { class: "field" }, "Robot", select);
  }

  #button(row) {
    const button = element(
      "button",
      {
        type: "button",
        class: [row.side, row.looks].filter(Boolean).join(" "),
        data: { action: row.action ?? `${row.order}_order`, side: row.side ?? "" },
        aria: row.side ? { label: `${row.text}, ${row.side}` } : {},
        on: { click: () => this.#press(button, row) },
      },
      row.text,
    );
    this.#buttons.push({ button, row });
    return button;
  }

  /** Has a button that cannot be undone pressed twice. */
  #press(button, row) {
    if (row.sure && !button.classList.contains("sure")) {
      mark(button, "sure", true);
      setText(button, "Press again");
      setTimeout(() => {
        mark(button, "sure", false);
        setText(button, row.text);
      }, SURE_MS);
      return;
    }
    mark(button, "sure", false);
    setText(button, row.text);
    this.#ask(button, row);
  }

  #ask(source, { text, action, order, side = null, robot }) {
    if (order) return this.requests.ask(source, `${text}, ${side}`, "order", { side, order: { mode: order } });
    const asked = { action };
    if (side) asked.side = side;
    if (robot) asked.robot = this.selection.robot;
    const whom = side ?? asked.robot;
    return this.requests.ask(source, whom ? `${text}, ${whom}` : text, "action", { action: asked });
  }
}
