// The referee's buttons: a table of groups of rows, each button with the action that it requests.

import { byId, element, offer, setText, show } from "../shared/elements.js";
import { onHold, onPress, onSecondPress } from "./presses.js";

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

/**
 * Title → rows of buttons: `text`, the referee's `action`, an `order` or what to do with the referee's `seat`, its `side`,
 * `robot` if it is about one, and `press` if one press is not enough.
 */
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
        { text: "Take over", seat: "take" },
        { text: "Leave", seat: "leave" },
      ],
      [
        { text: "End half", action: "end_half", press: onSecondPress },
        { text: "End match", action: "end_game", press: onHold },
      ],
    ],
  ],
];

/** What people may do while a referee box commands the match. */
const BESIDE_A_BOX = ["stop", "name_robot"];

const deedOf = ({ action, seat }) => (seat ? "referee_seat" : (action ?? "order"));

export class Buttons {
  #buttons = [];
  #groups = [];

  constructor(match, requests, selection) {
    Object.assign(this, { match, requests, selection });
    const place = byId("buttons");
    for (const [title, rows] of GROUPS) place.append(this.#group(title, rows));
    byId("stop").addEventListener("click", () => this.stop());
    match.on("welcome host state refbox health orders", () => this.update());
  }

  /** Stops the match, or as a coach the own side. */
  stop() {
    const { match } = this, source = byId("stop");
    if (match.may("stop")) return this.#ask(source, { text: "Stop", action: "stop" });
    if (match.role !== "referee" && match.may("order", match.role)) return this.#ask(source, { text: `Hold ${match.role}`, order: "hold", side: match.role });
    return null;
  }

  /** Why a button cannot be pressed; null when it can. */
  why(row) {
    const { action, seat, side, robot } = row;
    const { match, selection } = this;
    if (!match.live) return "this is a recording";
    const deed = deedOf(row);
    const of = side ?? (robot && selection.robot ? match.sideOf(selection.robot) : null);
    if (!match.may(deed, of)) {
      return match.role === "spectator" ? "spectators watch; a token lets you command" : `not for the coach of ${match.role}`;
    }
    if (!match.hostThere) return "the host is away";
    if ((seat || (action && !BESIDE_A_BOX.includes(action))) && match.refbox.connected) return "the referee box commands the match";
    return robot && !selection.robot ? "choose a robot first" : null;
  }

  /** Shows the buttons of this role, enables those that may be pressed now, and gives the others their reason. */
  update() {
    const { match, selection } = this;
    for (const { button, row } of this.#buttons) {
      const why = this.why(row);
      button.disabled = why !== null;
      button.title = why ?? (row.press === onHold ? "hold it down for a second" : "");
      if (row.order) button.setAttribute("aria-pressed", match.orders[row.side]?.order?.mode === row.order);
      show(button, match.may(deedOf(row), row.side ?? null) && (!row.side || match.sides.includes(row.side)));
    }
    for (const group of this.#groups) show(group, [...group.querySelectorAll("[data-action]")].some((button) => !button.hidden));
    if (match.setup !== null) {
      for (const side of ["cyan", "magenta"]) {
        for (const name of document.querySelectorAll(`[data-team=${side}]`)) setText(name, match.setup.teams[side].name);
        for (const head of document.querySelectorAll(`.heads .${side}`)) show(head, match.may("order", side) && match.sides.includes(side));
      }
    }
    const robots = match.robots.filter((name) => match.may("repair", match.sideOf(name)));
    offer(byId("robot"), [["", "none chosen"], ...robots.map((name) => [name, name])]);
    const chosen = robots.includes(selection.robot) ? selection.robot : "";
    if (byId("robot").value !== chosen) byId("robot").value = chosen;
    show(byId("stop"), match.live && (match.may("stop") || (match.role !== "referee" && match.may("order", match.role))));
    byId("stop").disabled = !match.hostThere; // enabled while a referee box commands the match, too: a stop is always accepted
  }

  #group(title, rows) {
    const group = element("fieldset", { class: "group" }, element("legend", {}, title));
    if (["For a side", "Teams"].includes(title)) {
      group.append(
        element("div", { class: "row heads", aria: { hidden: "true" } }, ...["cyan", "magenta"].map((side) =>
          element("span", { class: `team ${side}` }, element("span", { class: "mark" }), element("span", { data: { team: side } })))),
      );
    }
    this.#groups.push(group);
    if (title === "For the robot") group.append(this.#robotChoice());
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
        data: { action: row.action ?? (row.seat ? `${row.seat}_seat` : `${row.order}_order`), side: row.side ?? "" },
        aria: row.side ? { label: `${row.text}, ${row.side}` } : {},
      },
      row.text,
    );
    (row.press ?? onPress)(button, () => this.#ask(button, row));
    this.#buttons.push({ button, row });
    return button;
  }

  #ask(source, { text, action, order, seat, side = null, robot }) {
    if (seat) return this.requests.ask(source, text, "referee_seat", { operation: seat });
    if (order) return this.requests.ask(source, `${text}, ${side}`, "order", { side, order: { mode: order } });
    const asked = { action };
    if (side) asked.side = side;
    if (robot) asked.robot = this.selection.robot;
    const whom = side ?? asked.robot;
    return this.requests.ask(source, whom ? `${text}, ${whom}` : text, "action", { action: asked });
  }
}
