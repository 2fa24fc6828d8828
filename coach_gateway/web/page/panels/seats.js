// Seats: who looks at the page, and which parts of it that person has. A part names its seats in `data-for`.

import { byId, setText, show } from "../shared/elements.js";
import { keep, kept } from "../parts/storage.js";

const KEY = "touchline.seat";
const NAMES = { spectator: "watching", referee: "referee", operator: "operator", cyan: "coach of cyan", magenta: "coach of magenta" };

/** The seat of a role: a coach of either side, the referee, or the operator, who has the referee's token, too. */
export function seatOf(role, operates) {
  if (role === "cyan" || role === "magenta") return "coach";
  return role === "referee" && operates ? "operator" : role;
}

export class Seats {
  #operates = kept("sessionStorage", KEY) === "operator";

  /** `changed` is called when the seat has changed. */
  constructor(match, changed) {
    Object.assign(this, { match, changed });
    for (const button of document.querySelectorAll(".swap-seat")) button.addEventListener("click", () => this.#swap());
    match.on("welcome", () => this.update());
    this.update();
  }

  get seat() {
    return this.match.live ? seatOf(this.match.role, this.#operates) : "spectator";
  }

  /** Shows the parts of this seat alone. */
  update() {
    const { match, seat } = this;
    Object.assign(document.body.dataset, { role: match.role, live: match.live, seat, game: match.log ? "log" : (match.setup?.game ?? "soccer") });
    for (const part of document.querySelectorAll("[data-for]")) {
      show(part, match.live && part.dataset.for.split(" ").includes(seat));
    }
    setText(byId("role"), match.live ? NAMES[seat === "coach" ? match.role : seat] : "recording");
    for (const button of document.querySelectorAll(".swap-seat")) {
      show(button, match.live && match.role === "referee");
      setText(button, seat === "operator" ? "Referee’s page" : "Operator’s page");
    }
    this.changed(seat);
  }

  #swap() {
    this.#operates = !this.#operates;
    keep("sessionStorage", KEY, this.#operates ? "operator" : "referee");
    this.update();
  }
}
