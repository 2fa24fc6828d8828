// The list of events in their order, the newest at the end; in a recording, a click on one seeks to it.

import { byId, element, mark, together } from "../shared/elements.js";
import { LEAD_S, indexAt, isKey, withNames } from "../shared/events.js";
import { questionOf } from "../parts/proposal.js";
import { capitalized, clockText, readable } from "../parts/text.js";

const GREAT = new Set(["goal", "half_time", "full_time", "forfeit"]);
const MOST = 400; // lines shown
const NEAR_PX = 40; // of the end: a list that is read there follows what happens

export class EventList {
  #shown = 0;
  #all = false;
  #rows = [];
  #now;
  #follows = true;
  #later = together(() => this.#show());

  constructor(match, jump) {
    Object.assign(this, { match, jump });
    const panel = byId("events-panel");
    panel.addEventListener("scroll", () => {
      this.#follows = panel.scrollHeight - panel.scrollTop - panel.clientHeight < NEAR_PX;
    });
    new ResizeObserver(() => this.#toEnd()).observe(panel);
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
    this.#follows = true;
    byId("events").replaceChildren();
    this.#later();
  }

  #show() {
    const list = byId("events");
    const { events, eventCount } = this.match;
    for (const event of events.slice(Math.max(0, events.length - (eventCount - this.#shown)))) {
      if (!this.#all && !isKey(event)) continue;
      const row = this.#row(event);
      this.#rows.push({ row, time: event.time });
      list.append(row);
    }
    this.#shown = eventCount;
    while (this.match.live && list.childElementCount > MOST) {
      list.firstElementChild.remove();
      this.#rows.shift();
    }
    this.#toEnd();
  }

  /** Scrolls to the newest event of a match, unless earlier ones are being read. */
  #toEnd() {
    if (this.match.live && this.#follows) byId("events-panel").scrollTop = byId("events-panel").scrollHeight;
  }

  #row(event) {
    const side = event.side ? element("span", { class: `mark ${event.side}`, aria: { label: event.side }, role: "img" }) : element("span");
    const words = element("span", {}, element("b", {}, capitalized(event.kind)), " ", element("span", { class: "what" }, this.#textOf(event)));
    const parts = [element("time", {}, clockText(event.clock)), side, words];
    const looks = GREAT.has(event.kind) ? "great" : "";
    if (!this.match.may("replay") || this.match.live) return element("li", { class: looks }, ...parts);
    const button = element("button", { type: "button", on: { click: () => this.jump(event.time - LEAD_S) } }, ...parts);
    return element("li", { class: looks }, button);
  }

  /** The sentence of an event without its kind where it begins with that: `Goal` stands before it already. */
  #textOf(event) {
    const { kind, text } = event;
    if (kind === "proposal" && this.match.setup) return questionOf(event, this.match);
    const name = readable(kind), sentence = text.toLowerCase();
    const repeats = sentence.startsWith(`${name},`) || sentence.startsWith(`${name}:`);
    const short = repeats ? text.slice(name.length + 1).trim() : text;
    const teams = this.match.setup?.teams;
    return teams ? withNames(short, { cyan: teams.cyan.name, magenta: teams.magenta.name }) : short;
  }
}
