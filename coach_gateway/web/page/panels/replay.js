// Controls of a replay: a bar with the marks of its events, play, pause, step, rate, loop, and jumps.

import { byId, element, mark, setText, show, together } from "../shared/elements.js";
import { SYMBOLS, jumpTarget } from "../shared/events.js";
import { SIDES } from "../shared/palette.js";
import { clockText } from "../parts/text.js";

const MARKED = new Set(["goal", "card", "foul", "half_time", "full_time"]);

export class Replay {
  #wanted = null;
  #asking = false;
  #holding = false;
  #drawLater = together(() => this.match.live || this.#draw());

  constructor(match, requests) {
    Object.assign(this, { match, requests });
    const scrub = byId("scrub");
    scrub.addEventListener("input", () => this.seek(Number(scrub.value)));
    scrub.addEventListener("pointerdown", () => { this.#holding = true; });
    for (const end of ["pointerup", "pointercancel", "change"]) scrub.addEventListener(end, () => { this.#holding = false; });
    byId("play").addEventListener("click", () => this.toggle());
    byId("step").addEventListener("click", () => this.step());
    byId("loop").addEventListener("click", () => this.#ask("loop", "Loop", { operation: "loop" }));
    byId("previous").addEventListener("click", () => this.jump(-1));
    byId("next").addEventListener("click", () => this.jump(1));
    byId("rate").addEventListener("change", () => this.setRate(byId("rate").value));
    byId("go").addEventListener("submit", (event) => {
      event.preventDefault();
      this.seek(byId("go-to").valueAsNumber);
    });
    byId("marks").addEventListener("click", (event) => this.#pointed(event));
    match.on("welcome replay", () => this.update());
    match.on("event welcome", () => this.#drawLater());
    addEventListener("resize", () => this.#drawLater());
  }

  /** Simulated time in s that is shown; of a file without a match, that of its status. */
  get time() {
    return this.#wanted ?? this.match.frames.newest?.time ?? this.match.replay?.time ?? 0;
  }

  update() {
    const { replay, live } = this.match;
    show(byId("replay"), !live);
    if (live) return;
    this.#lock(this.#why());
    if (replay === null) return;
    const scrub = byId("scrub");
    if (Number(scrub.min) !== replay.start || Number(scrub.max) !== replay.end) {
      scrub.min = replay.start;
      scrub.max = replay.end;
      this.#drawLater();
    }
    mark(byId("play"), "playing", !replay.paused);
    byId("play").setAttribute("aria-label", replay.paused ? "Play (space)" : "Pause (space)");
    byId("loop").setAttribute("aria-pressed", replay.loop);
    const rates = byId("rate"), rate = replay.rate === null ? "fast" : String(replay.rate);
    if (![...rates.options].some(({ value }) => value === rate)) rates.append(element("option", { value: rate }, `${rate}×`));
    if (document.activeElement !== rates) rates.value = rate;
    if (this.match.log) this.tick(replay);
  }

  /** Why the replay cannot be controlled; empty when it can. */
  #why() {
    if (this.match.replay === null) return "the status of the replay is not known yet";
    return this.match.may("replay") ? "" : "only the referee of this replay may control it";
  }

  /** Disables the controls with a reason, or enables them. */
  #lock(why) {
    for (const control of byId("replay").querySelectorAll("button, select, input")) {
      control.disabled = why !== "";
      control.title = why || (control.dataset.title ?? "");
    }
  }

  /** Moves the bar to the drawn time, unless it is being dragged. */
  tick(world) {
    if (this.match.live || world === null) return;
    setText(byId("moment"), `${clockText(this.#wanted ?? world.time)} of ${clockText(this.match.replay?.end ?? 0)}`);
    if (!this.#holding && this.#wanted === null) byId("scrub").value = world.time;
  }

  toggle() {
    if (this.#why()) return null;
    const { paused } = this.match.replay;
    return this.#ask("play", paused ? "Play" : "Pause", { operation: paused ? "play" : "pause" });
  }

  step(ticks = 1) {
    return this.#ask("step", "Step", { operation: "step", ticks });
  }

  setRate(rate) {
    return this.#ask("rate", `Rate ${rate}`, rate === "fast" ? { operation: "rate" } : { operation: "rate", rate: Number(rate) });
  }

  /** Seeks to a time in s; while a seek is pending, only the newest one counts. */
  async seek(time) {
    if (this.#why()) return;
    const { start, end } = this.match.replay;
    this.#wanted = Math.min(Math.max(time, start), end);
    if (this.#asking) return;
    this.#asking = true;
    let went = null;
    while (this.#wanted !== went) {
      went = this.#wanted;
      const reply = await this.requests.connection.ask("replay", { request: { operation: "seek", to: String(went) } });
      if (reply.accepted) continue;
      this.requests.show(byId("scrub"), `Go to ${clockText(went)}`, reply);
      break;
    }
    this.#wanted = null;
    this.#asking = false;
  }

  /** Seeks to the event before or after the shown time. */
  jump(step) {
    const marked = this.match.events.filter(({ kind }) => MARKED.has(kind));
    const to = jumpTarget(marked, step, this.time, this.match.replay?.start ?? 0);
    if (to !== undefined) this.seek(to);
  }

  async #ask(id, words, request) {
    const reply = await this.requests.connection.ask("replay", { request });
    if (!reply.accepted) this.requests.show(byId(id), words, reply);
  }

  #pointed(event) {
    if (this.#why()) return;
    const box = byId("marks").getBoundingClientRect();
    const { start, end } = this.match.replay;
    this.seek(start + ((event.clientX - box.left) / box.width) * (end - start));
  }

  /** Draws the marks of goals, cards, fouls and halves along the bar. */
  #draw() {
    const canvas = byId("marks"), { replay, events } = this.match;
    const density = devicePixelRatio || 1, width = canvas.clientWidth, height = canvas.clientHeight;
    if (replay === null || width === 0) return;
    canvas.width = width * density;
    canvas.height = height * density;
    const context = canvas.getContext("2d");
    context.scale(density, density);
    context.textAlign = "center";
    context.textBaseline = "middle";
    const ink = getComputedStyle(canvas).color;
    for (const event of events) {
      if (!MARKED.has(event.kind) || event.time < replay.start || event.time > replay.end) continue;
      const left = ((event.time - replay.start) / Math.max(replay.end - replay.start, 0.01)) * width;
      context.fillStyle = event.kind === "goal" && event.side ? SIDES[event.side].fill : ink;
      context.font = `${event.kind === "goal" ? 17 : 12}px system-ui, "DejaVu Sans", sans-serif`;
      context.fillText(SYMBOLS[event.kind], Math.min(Math.max(left, 7), width - 7), height / 2);
    }
  }
}
