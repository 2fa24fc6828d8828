// Live parameters, such as speeds and noise: listed with unit and range, set, and reset.

import { byId, element, setText, show } from "../shared/elements.js";
import { capitalized } from "../parts/text.js";

const FIRST = ["drive", "noise", "sensing", "radio", "ball"];

export class Parameters {
  #rows = new Map();

  constructor(match, requests) {
    Object.assign(this, { match, requests });
    byId("parameter-filter").addEventListener("input", () => this.#filter());
    byId("parameters-reset").addEventListener("click", () => this.#change(byId("parameters-reset"), "Reset all", { operation: "reset" }));
    match.on("welcome host", () => this.#changed());
    match.on("event", ({ events }) => events.at(-1).kind === "parameters" && this.#changed());
  }

  /** Queries all parameters, when the panel is visible. */
  async load() {
    const { match } = this;
    if (!match.live || match.setup === null || !match.deeds.has("read_parameters")) return;
    this.again = this.loading;
    if (this.loading) return;
    this.loading = true;
    const reply = await this.requests.connection.ask("parameters", { request: { operation: "list" } });
    this.loading = false;
    if (this.again) {
      this.load(); // they have changed since the query
      return;
    }
    this.stale = !reply.accepted;
    if (reply.accepted) this.#lay(reply.answer.parameters);
    else setText(byId("parameters-state"), reply.reason);
  }

  #changed() {
    this.stale = true;
    const { match } = this;
    if (byId("parameters").offsetParent !== null) this.load();
  }

  #lay(parameters) {
    const sections = new Map();
    for (const one of parameters) {
      const section = one.name.slice(0, one.name.lastIndexOf(".")) || "other";
      sections.set(section, [...(sections.get(section) ?? []), one]);
    }
    const names = parameters.map(({ name }) => name).join();
    if (byId("parameters").dataset.names !== names) {
      byId("parameters").dataset.names = names;
      this.#rows.clear();
      const order = [...sections.keys()].sort((a, b) => rank(a) - rank(b));
      byId("parameters").replaceChildren(...order.map((section) => this.#section(section, sections.get(section))));
    }
    for (const one of parameters) this.#fill(one);
    setText(byId("parameters-state"), `${parameters.filter(({ live }) => live).length} can be set while the match runs`);
    this.#filter();
  }

  #section(name, parameters) {
    return element(
      "details",
      { data: { section: name }, ...(name === "drive" ? { open: true } : {}) },
      element("summary", {}, capitalized(name)), ...parameters.map((one) => this.#row(one)),
    );
  }

  #row(one) {
    const id = `parameter-${one.name}`;
    const input = one.options.length
      ? element("select", { id }, ...one.options.map((word) => element("option", { value: word }, word)))
      : element("input", { id, type: "text", inputmode: "decimal", autocomplete: "off" });
    const set = element("button", { type: "button", aria: { label: `Set ${one.name}` } }, "Set");
    const reset = element("button", { type: "button", aria: { label: `Reset ${one.name}` } }, "Reset");
    set.addEventListener("click", () => this.#set(set, one, input.value));
    input.addEventListener("input", () => { input.dataset.edited = "yes"; });
    input.addEventListener("keydown", (event) => event.key === "Enter" && this.#set(set, one, input.value));
    reset.addEventListener("click", () => this.#change(reset, `Reset ${one.name}`, { operation: "reset", names: [one.name] }));
    const range = element("span", { class: "quiet" }, rangeWords(one));
    const row = element(
      "div", { class: "parameter", data: { parameter: one.name } },
      element("label", { for: id }, element("b", {}, one.name.split(".").at(-1)), ` ${one.description}`), range,
      element("div", { class: "setting" }, input, set, reset),
    );
    this.#rows.set(one.name, { row, input, set, reset, words: `${one.name} ${one.description}`.toLowerCase() });
    return row;
  }

  #fill(one) {
    const { row, input, set, reset } = this.#rows.get(one.name);
    const may = one.live && this.match.may("parameters");
    if (!input.dataset.edited) input.value = valueWords(one.value);
    for (const control of [input, set, reset]) {
      control.disabled = !may;
      control.title = one.live ? "" : one.fixed_reason;
      if (control !== input) show(control, this.match.may("parameters"));
    }
    row.classList.toggle("changed", valueWords(one.value) !== valueWords(one.initial));
    reset.disabled = !may || valueWords(one.value) === valueWords(one.initial);
  }

  #set(source, one, text) {
    const value = valueOf(text, one);
    if (value === null) {
      this.requests.show(source, `Set ${one.name}`, { accepted: false, reason: `${text} is not a number` });
      return;
    }
    this.#change(source, `${one.name} = ${text}`, { operation: "set", values: { [one.name]: value } });
  }

  async #change(source, words, request) {
    const reply = await this.requests.ask(source, words, "parameters", { request });
    if (!reply.accepted) return;
    for (const name of Object.keys(request.values ?? {}).concat(request.names ?? (request.values ? [] : [...this.#rows.keys()]))) {
      delete this.#rows.get(name)?.input.dataset.edited;
    }
    this.load();
  }

  #filter() {
    const words = byId("parameter-filter").value.toLowerCase().trim();
    for (const { row, words: said } of this.#rows.values()) show(row, said.includes(words));
    for (const section of byId("parameters").children) {
      const some = [...section.querySelectorAll(".parameter")].some((row) => !row.hidden);
      show(section, some);
      if (words && some) section.open = true;
    }
  }
}

/** Order of sections: those in demand first, types of robots last. */
function rank(section) {
  const place = FIRST.findIndex((name) => section.includes(name));
  return (section.startsWith("types") ? 100 : 0) + (place < 0 ? FIRST.length : place);
}

function rangeWords({ unit, low, high, options }) {
  if (options.length) return "a word";
  const named = unit && unit !== "1" ? ` ${unit}` : "";
  if (low !== null && high !== null) return `${low} to ${high}${named}`;
  if (low !== null) return `from ${low}${named}`;
  return high !== null ? `up to ${high}${named}` : named.trim();
}

const valueWords = (value) => (Array.isArray(value) ? value.join(", ") : String(value));

/** The typed text as a value of the protocol; null if it is not a number. */
function valueOf(text, { value, options }) {
  if (options.length || typeof value === "string") return text;
  const numbers = text.split(",").map((part) => Number(part.trim() === "" ? NaN : part));
  if (numbers.some((number) => !Number.isFinite(number))) return null;
  return Array.isArray(value) ? numbers : numbers.length === 1 ? numbers[0] : null;
}
