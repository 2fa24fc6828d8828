// The values that the chosen robot's program shows its authors, below the panels.

import { byId, element, setText, show } from "../shared/elements.js";

const EVERY_MS = 200;

export class DebugValues {
  #names = "";

  constructor(match, selection) {
    Object.assign(this, { match, selection });
    setInterval(() => this.update(), EVERY_MS);
    selection.on(() => this.update());
  }

  update() {
    const { robot } = this.selection;
    const values = Object.entries(this.match.debug[robot]?.debug.values ?? {});
    const list = byId("debug-values"), names = JSON.stringify(values.map(([name]) => name));
    show(byId("debug"), values.length > 0);
    setText(byId("debug-robot"), robot ?? "");
    if (names !== this.#names) {
      this.#names = names;
      list.replaceChildren(...values.map(([name]) => element("div", {}, element("dt", {}, name), element("dd"))));
    }
    values.forEach(([, value], place) => setText(list.children[place].lastChild, String(value)));
  }
}
