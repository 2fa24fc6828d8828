// The tabs beside the field. On a phone they are below it, and include robots and events.

import { byId, show } from "../shared/elements.js";

/** Seat → the tab that is open until another one is chosen. */
const FIRST = { spectator: "result", coach: "match", referee: "match", operator: "settings" };

export class Tabs {
  #tabs = [...document.querySelectorAll("[role=tab]")];
  #narrow = matchMedia("(max-width: 1000px)");

  /** `seen` is called with the name of each tab that is opened. */
  constructor(seen) {
    this.seen = seen;
    for (const tab of this.#tabs) {
      tab.addEventListener("click", () => this.#choose(tab.dataset.tab));
      tab.addEventListener("keydown", (event) => this.#key(event));
    }
    this.#narrow.addEventListener("change", () => this.open(this.opened));
    this.open(this.#narrow.matches ? "robots" : "result");
  }

  /** The name of the tab that is open. */
  opened = "result";
  #chosen = false;

  /** Opens the first tab of a seat, unless one was chosen that the seat has, too. */
  fit(seat) {
    const kept = this.#chosen && this.#seen().some((tab) => tab.dataset.tab === this.opened);
    const first = seat === "spectator" && this.#narrow.matches ? "robots" : FIRST[seat];
    this.open(kept ? this.opened : first);
  }

  open(name) {
    const tab = this.#seen().find((one) => one.dataset.tab === name) ?? this.#seen()[0];
    this.opened = tab.dataset.tab;
    for (const one of this.#tabs) {
      const chosen = one === tab;
      one.setAttribute("aria-selected", chosen);
      one.tabIndex = chosen ? 0 : -1;
      const beside = one.classList.contains("beside") && !this.#narrow.matches;
      show(byId(one.getAttribute("aria-controls")), chosen || beside);
    }
    this.seen(this.opened);
  }

  #choose(name) {
    this.#chosen = true;
    this.open(name);
  }

  #seen() {
    return this.#tabs.filter((tab) => getComputedStyle(tab).display !== "none");
  }

  #key(event) {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (step === undefined) return;
    const seen = this.#seen();
    const next = seen[(seen.indexOf(event.currentTarget) + step + seen.length) % seen.length];
    this.#choose(next.dataset.tab);
    next.focus();
    event.preventDefault();
    event.stopPropagation();
  }
}
