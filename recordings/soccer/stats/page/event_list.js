// The list of events: each is a button that jumps there.

import { element } from "./shared/elements.js";
import { LEAD_S, SYMBOLS, indexAt, isKey, jumpTarget, withNames } from "./shared/events.js";
import { formatClock } from "./match.js";

export class EventList {
  constructor(list, buttons, match, seek) {
    Object.assign(this, { list, buttons, match, seek, keyOnly: true });
    buttons.key.addEventListener("click", () => this.show(true));
    buttons.all.addEventListener("click", () => this.show(false));
    this.show(true);
  }

  show(keyOnly) {
    this.keyOnly = keyOnly;
    this.buttons.key.setAttribute("aria-pressed", String(keyOnly));
    this.buttons.all.setAttribute("aria-pressed", String(!keyOnly));
    this.shown = this.match.events.filter((event) => !keyOnly || isKey(event));
    this.list.replaceChildren(...this.shown.map((event) => this.row(event)));
    this.current = undefined;
    this.mark(this.time ?? this.match.start);
  }

  row(event) {
    const kind = element("span", { class: "kind" }, event.kind.replaceAll("_", " "));
    const button = element(
      "button", { type: "button", on: { click: () => this.seek(event.time - LEAD_S) } },
      element("time", {}, formatClock(event.clock)),
      element("span", { class: "symbol", aria: { hidden: "true" } }, SYMBOLS[event.kind] ?? "·"),
      element("span", {}, kind, element("span", { class: "what" }, withNames(event.text, this.match.teams))),
    );
    return element("li", { class: `side-${event.side ?? "none"}${event.kind === "goal" ? " big" : ""}` }, button);
  }

  /** Marks the newest event at a time. */
  mark(time) {
    this.time = time;
    const current = indexAt(this.shown, time);
    if (current === this.current) return;
    this.list.children[this.current]?.classList.remove("now-is");
    this.current = current;
    const row = this.list.children[current];
    if (!row) return;
    row.classList.add("now-is");
    const above = row.offsetTop - this.list.offsetTop;
    if (above < this.list.scrollTop || above + row.offsetHeight > this.list.scrollTop + this.list.clientHeight) {
      this.list.scrollTop = above - this.list.clientHeight / 2;
    }
  }

  /** To the next event that is shown, or with −1 to the one before. */
  jump(step, from) {
    const found = jumpTarget(this.shown, step, from, this.match.start);
    if (found !== undefined) this.seek(found);
  }
}
