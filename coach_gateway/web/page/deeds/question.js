// The question to a side which of its robots an action concerns: a referee box gives cards and repairs without one.

import { byId, element, setText, show } from "../shared/elements.js";
import { APART_MS, onPress } from "./presses.js";
import { capitalized } from "../parts/text.js";

const TITLES = { enter: "Come back" }; // as the referee's buttons call it; other actions have their own name

export class RobotQuestion {
  #asked = null;
  #kind = "";
  #ready = 0;
  #waits = false;
  #buttons = [];

  constructor(side, match, requests, buttons) {
    Object.assign(this, { side, match, requests, buttons });
    this.place = byId(`${side}-question`);
    [this.says, this.rest, this.row] = ["says", "rest", "robots"].map((part) => this.place.querySelector(`[data-is=${part}]`));
  }

  /** Shows the first question of the side, which is answered first; returns whether there is one. */
  update() {
    const { match, side } = this;
    const all = match.live ? (match.state?.questions ?? []).filter((question) => question.side === side) : [];
    const asked = all[0] ?? null;
    const kind = asked ? JSON.stringify([asked.action, asked.robots, asked.default]) : "";
    if (kind !== this.#kind || (asked && this.#asked && asked.left > this.#asked.left)) this.#replace(asked, kind);
    this.#asked = asked;
    show(this.place, asked !== null);
    if (asked === null) return false;
    const team = match.setup?.teams[side].name ?? side;
    setText(this.says, `${TITLES[asked.action] ?? capitalized(asked.action)} for ${team}: which robot?`);
    setText(this.rest, ` ${asked.default} in ${Math.ceil(asked.left)} s.${all.length > 1 ? ` Questions after this one: ${all.length - 1}.` : ""}`);
    show(this.row, match.may("name_robot", side));
    this.#lock();
    return true;
  }

  /** A press that was meant for the question before does not answer the new one. */
  #replace(asked, kind) {
    this.#kind = kind;
    this.#waits = false;
    this.#ready = performance.now() + APART_MS;
    this.#buttons = (asked?.robots ?? []).map((robot) => this.#button(robot));
    this.row.replaceChildren(...this.#buttons);
    setTimeout(() => this.#lock(), APART_MS + 20);
  }

  #button(robot) {
    const button = element("button", { type: "button", data: { names: robot } }, robot);
    onPress(button, () => this.#name(button, robot));
    return button;
  }

  /** Names the robot; until the reply, no second press answers the next question. */
  async #name(button, robot) {
    this.#waits = true;
    this.#lock();
    const { accepted } = await this.requests.ask(button, `Name ${robot}`, "action", { action: { action: "name_robot", robot } });
    if (accepted || !button.isConnected) return;
    this.#waits = false;
    this.#lock();
  }

  #lock() {
    const why = this.buttons.why({ action: "name_robot", side: this.side });
    const locked = why !== null || this.#waits || performance.now() < this.#ready;
    for (const button of this.#buttons) {
      button.disabled = locked;
      button.title = why ?? "";
    }
  }
}
