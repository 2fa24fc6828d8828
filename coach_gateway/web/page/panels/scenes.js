// Scenes: loading one, resetting, and placing a body by numbers.

import { byId, offer, setText } from "../shared/elements.js";
import { onSecondPress } from "../deeds/presses.js";
import { radians } from "../parts/text.js";

export class Scenes {
  constructor(match, requests, drag) {
    Object.assign(this, { match, requests, drag });
    byId("scene-load").addEventListener("click", () => this.#ask("scene-load", `Scene ${byId("scene").value}`, { operation: "load", load: byId("scene").value }));
    byId("scene-reset").addEventListener("click", () => this.#ask("scene-reset", "Reset scene", { operation: "reset" }));
    onSecondPress(byId("match-reset"), () => this.#ask("match-reset", "Reset match", { operation: "reset", to_match: true }));
    byId("place").addEventListener("click", () => this.#place());
    byId("scene").addEventListener("change", () => this.update());
    match.on("welcome host", () => this.update());
  }

  update() {
    const { match } = this;
    const may = match.live && match.may("scene") && match.hostThere;
    offer(byId("scene"), Object.keys(match.scenes).map((name) => [name, name.replaceAll("_", " ")]));
    setText(byId("scene-says"), match.scenes[byId("scene").value] ?? "");
    offer(byId("place-body"), [...(match.free ? [] : [["ball", "ball"]]), ...match.robots.map((name) => [name, name])]);
    for (const id of ["scene", "scene-load", "scene-reset", "match-reset", "freely"]) byId(id).disabled = !may;
    for (const id of ["place-body", "place-x", "place-y", "place-heading", "place"]) byId(id).disabled = !may && !match.may("place_ball");
  }

  #ask(id, words, request) {
    return this.requests.ask(byId(id), words, "scene", { request });
  }

  #place() {
    const body = byId("place-body").value;
    const [x, y, turned] = ["place-x", "place-y", "place-heading"].map((id) => byId(id).valueAsNumber);
    const why = Number.isFinite(x) && Number.isFinite(y) ? this.drag.why(body) : "x and y are missing";
    if (why !== null) return this.requests.show(byId("place"), `Place ${body}`, { accepted: false, reason: why });
    return this.drag.place(byId("place"), body, { x, y, heading: Number.isFinite(turned) ? radians(turned) : undefined });
  }
}
