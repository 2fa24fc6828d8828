// The list of events; in a recording, a click on one seeks to it.

import { byId, element, mark } from "./elements.js";
import { LEAD_S, indexAt, isKey } from "./shared/events.js";
import { clockText, capitalized } from "./text.js";

const GREAT = new Set(["goal", "half_time", "full_time", "forfeit"]);
const MOST = 400; // lines shown

export class EventList {
  #shown = 0;
  #all = false;
  #rows = [];
  #now;

  constructor(match, jump) {
    Object.assign(this, { match, jump });
    match.on("welcome", () => this.#restart());
    match.on("event", () => this.#later());
    for (const [id, all] of [["key-events", false], ["all-events", true]]) {
      byId(id).addEventListener("click", () => {
        this.#all = all;
        byId("key-events").setAttribute("aria-pressed", !all);
        byId("all-events").setAttribute("aria-pressed", all);
        this.#restart();
      });
    }
  }

  /** Marks the newest event at the shown time. */
  follow(time) {
    if (this.match.live) return;
    const now = this.#rows[indexAt(this.#rows, time)]?.row;
    if (now === this.#now) return;
    this.#now = now;
    for (const { row } of this.#rows) mark(row, "now-is", row === now);
    const list = byId("events-panel");
    if (now) list.scrollTop += now.getBoundingClientRect().top - list.getBoundingClientRect().top - list.clientHeight / 2;
  }

  #restart() {
    this.#shown = 0;
    this.#rows = [];
    this.#now = undefined;
    byId("events").replaceChildren();
    this.#later();
  }

  /** Many events come at once at the beginning: they are shown together. */
  #later() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.#show();
    });
  }

  #show() {
    const list = byId("events");
    const { events, eventCount } = this.match;
    for (const event of events.slice(Math.max(0, events.length - (eventCount - this.#shown)))) {
      if (!this.#all && !isKey(event)) continue;
      const row = this.#row(event);
      this.#rows.push({ row, time: event.time });
      if (this.match.live) list.prepend(row);
      else list.append(row);
    }
    this.#shown = eventCount;
    while (this.match.live && list.childElementCount > MOST) {
      list.lastElementChild.remove();
      this.#rows.shift();
    }
  }

  #row(event) {
    const side = event.side ? element("span", { class: `mark ${event.side}`, aria: { label: event.side }, role: "img" }) : element("span");
    const words = element("span", {}, element("b", {}, capitalized(event.kind)), " ", element("span", { class: "what" }, event.text));
    const parts = [element("time", {}, clockText(event.clock)), side, words];
    const looks = GREAT.has(event.kind) ? "great" : "";
    if (this.match.live) return element("li", { class: looks }, ...parts);
    const button = element("button", { type: "button", on: { click: () => this.jump(event.time - LEAD_S) } }, ...parts);
    return element("li", { class: looks }, button);
  }
}
