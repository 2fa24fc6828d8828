// What the picture shows: switches that are kept for the next visit.

import { byId, choice, element, offer, show } from "../shared/elements.js";
import { keep, kept } from "../parts/storage.js";
import { capitalized } from "../parts/text.js";
import { TRAILS } from "./trails.js";
import { SEEN_FROM } from "./seen_from.js";

const KEY = "touchline.layers";
const SWITCHES = ["roles", "velocities", "passes", "distances", "obstacles"];

export class Layers {
  trails = "short";
  beliefs = "none";
  drawings = "none";
  #drawingsChosen = false;
  seenFrom = "fixed";

  constructor(match) {
    for (const name of SWITCHES) this[name] = true;
    Object.assign(this, JSON.parse(kept("localStorage", KEY) ?? "{}"));
    this.#lay(match);
  }

  /** Shows the field from the next side. */
  turn() {
    const steps = SEEN_FROM.map(([value]) => value);
    this.#set("seenFrom", steps[(steps.indexOf(this.seenFrom) + 1) % steps.length]);
  }

  #lay(match) {
    const boxes = SWITCHES.map((name) => {
      const box = element("input", { type: "checkbox", id: `layer-${name}`, on: { change: () => this.#set(name, box.checked) } });
      box.checked = this[name];
      return element("label", { class: "switch" }, box, capitalized(name));
    });
    byId("layers").append(
      this.#chosen("seenFrom", "Field", SEEN_FROM), this.#chosen("beliefs", "Believed", [["none", "nothing"]]),
      this.#chosen("drawings", "Drawn by brains", [["none", "nothing"]]), this.#chosen("trails", "Trails", TRAILS), ...boxes,
    );
    match.on("welcome health", () => this.#offerRobots(match));
  }

  #chosen(name, text, options) {
    const select = choice(options, { id: `layer-${name}`, on: { change: () => this.#set(name, select.value) } });
    select.value = this[name];
    return element("label", { class: "chosen" }, text, select);
  }

  /** Offers the robots whose beliefs and drawings this role is shown. */
  #offerRobots(match) {
    const drawn = match.drawn.filter((side) => match.sides.includes(side));
    if (!this.#drawingsChosen) this.drawings = drawn.length === 1 ? "all" : "none"; // those of both teams hide the match
    this.#offer(match, "beliefs", match.shown);
    this.#offer(match, "drawings", match.drawn);
    show(byId("layer-drawings").closest("label"), match.drawn.length > 0);
  }

  /** Offers nothing, all, each side and each robot; a choice that is not offered now is kept for later. */
  #offer(match, name, shown) {
    const sides = match.setup === null ? [] : shown.filter((side) => match.sides.includes(side));
    const robots = match.robots.filter((robot) => sides.includes(match.sideOf(robot)));
    const options = [
      ["none", "nothing"],
      ...(sides.length ? [["all", "by all"]] : []),
      ...sides.map((side) => [side, `by ${match.setup.teams[side].name}`]),
      ...robots.map((robot) => [robot, `by ${robot}`]),
    ];
    offer(byId(`layer-${name}`), options);
    byId(`layer-${name}`).value = options.some(([value]) => value === this[name]) ? this[name] : "none";
  }

  #set(name, value) {
    this[name] = value;
    this.#drawingsChosen ||= name === "drawings";
    const input = byId(`layer-${name}`);
    if (input.type === "checkbox") input.checked = value;
    else input.value = value;
    const all = Object.fromEntries([...SWITCHES, "trails", "seenFrom"].map((word) => [word, this[word]]));
    keep("localStorage", KEY, JSON.stringify(all));
  }
}
