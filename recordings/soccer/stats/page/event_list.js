// The list of events: each is a button that jumps there.

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
    const row = document.createElement("li"), button = document.createElement("button");
    row.className = `side-${event.side ?? "none"}${event.kind === "goal" ? " big" : ""}`;
    button.type = "button";
    const time = element("time", formatClock(event.clock)), symbol = element("span", SYMBOLS[event.kind] ?? "·");
    symbol.className = "symbol";
    symbol.setAttribute("aria-hidden", "true");
    const text = element("span", ""), kind = element("span", event.kind.replaceAll("_", " ")), what = element("span", withNames(event.text, this.match.teams));
    kind.className = "kind";
    what.className = "what";
    text.append(kind, what);
    button.append(time, symbol, text);
    button.addEventListener("click", () => this.seek(event.time - LEAD_S));
    row.append(button);
    return row;
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

/** An element with a text in it. */
function element(name, text) {
  const made = document.createElement(name);
  made.textContent = text;
  return made;
}
