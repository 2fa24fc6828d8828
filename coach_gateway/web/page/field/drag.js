// Pointing at the field: choosing a robot, dragging ball and robots to a place, picking points.

import { byId, setText, show } from "../shared/elements.js";
import { inPicture } from "../shared/bodies.js";
import { line } from "../shared/shapes.js";
import { metres } from "../parts/text.js";

const REACH_PX = 20; // a finger is thicker than a ball
const MOVED_PX = 6; // less is a click
const TURN_M = 0.35; // a drawn direction is longer

export class Drag {
  #held = null;
  #drawn = null;
  #pointer = null; // the finger or mouse that drags; others are ignored

  constructor(canvas, pitchCanvas, match, requests, selection) {
    Object.assign(this, { canvas, pitchCanvas, match, requests, selection });
    canvas.addEventListener("pointerdown", (event) => this.#down(event));
    canvas.addEventListener("pointermove", (event) => this.#move(event));
    canvas.addEventListener("pointerup", (event) => this.#up(event));
    canvas.addEventListener("pointercancel", (event) => this.#follows(event) && this.cancel());
    // A finger on a body drags it; beside all bodies it scrolls the page.
    canvas.addEventListener("touchstart", (event) => this.#takesFinger(event) && event.preventDefault(), { passive: false });
    selection.on(() => this.#hint());
    pitchCanvas.over.push((context, projection) => this.#draw(context, projection));
  }

  /** Drops nothing, and leaves everything where it is. */
  cancel() {
    this.#held = null;
    this.#drawn = null;
    this.selection.cancel();
  }

  /** Why a body cannot be placed; null when it can. */
  why(body) {
    const { match } = this;
    const action = body === "ball" && !byId("freely").checked;
    if (!match.live) return "this is a recording";
    if (!match.may(action ? "place_ball" : "scene")) return "only the referee places bodies";
    if (action && match.refbox.connected) return "the referee box commands the match";
    if (action || match.free || byId("freely").checked || !match.state?.running) return null;
    return "the game is running; stop it first, or place freely (Settings)";
  }

  /** Places a body, and shows the reply. */
  place(source, body, { x, y, heading }) {
    const words = `${body === "ball" ? "Ball" : body} to (${metres(x)}, ${metres(y)})`;
    if (body === "ball" && !byId("freely").checked) {
      return this.requests.ask(source, words, "action", { action: { action: "place_ball", place: { x, y } } });
    }
    const turned = heading ?? this.match.frames.newest?.robots[body]?.heading ?? 0;
    const where = body === "ball" ? { body, x, y } : { body, x, y, heading: turned };
    return this.requests.ask(source, words, "scene", { request: { operation: "place", place: [where] } });
  }

  #takesFinger(event) {
    return event.touches.length === 1 && (this.selection.picking !== null || this.#bodyAt(this.#at(event.touches[0])) !== null);
  }

  #at(event) {
    const box = this.canvas.getBoundingClientRect();
    return { left: event.clientX - box.left, top: event.clientY - box.top };
  }

  #down(event) {
    if (event.button !== 0 || this.pitchCanvas.world === null || this.#held || this.#drawn) return;
    const at = this.#at(event);
    const place = this.pitchCanvas.projection.onField(at.left, at.top);
    if (this.selection.picking) {
      this.#drawn = { from: place, to: place };
    } else {
      const body = this.#bodyAt(at);
      if (body === null) return;
      this.#held = { body, at, place, moved: false };
    }
    this.#pointer = event.pointerId;
    event.preventDefault();
    this.canvas.focus({ preventScroll: true });
    this.canvas.setPointerCapture(event.pointerId);
  }

  /** Whether an event is of the pointer that holds a body; while none is held, any pointer counts. */
  #follows({ pointerId }) {
    return (this.#held === null && this.#drawn === null) || pointerId === this.#pointer;
  }

  #move(event) {
    if (!this.#follows(event)) return;
    const at = this.#at(event);
    const place = this.pitchCanvas.projection.onField(at.left, at.top);
    if (this.#drawn) this.#drawn.to = place;
    if (this.#held === null) {
      this.canvas.style.cursor = this.selection.picking ? "crosshair" : this.#bodyAt(at) ? "grab" : "default";
      return;
    }
    const held = this.#held;
    held.place = place;
    if (held.moved || Math.hypot(at.left - held.at.left, at.top - held.at.top) < MOVED_PX) return;
    const why = this.why(held.body);
    if (why !== null) {
      this.#held = null;
      this.#refuse(held.body, why);
      return;
    }
    held.moved = true;
    this.selection.dragged = { ...place, radius: held.body === "ball" ? 0.2 : this.match.radiusOf(held.body) };
  }

  #refuse(body, why) {
    if (this.match.role !== "spectator") this.requests.show(byId("moving"), `Move ${body}`, { accepted: false, reason: why });
  }

  #up(event) {
    if (!this.#follows(event)) return;
    const held = this.#held, drawn = this.#drawn;
    this.#held = null;
    this.#drawn = null;
    this.selection.dragged = null;
    if (drawn) {
      const dx = drawn.to.x - drawn.from.x, dy = drawn.to.y - drawn.from.y;
      this.selection.picked(drawn.from, Math.hypot(dx, dy) > TURN_M ? Math.atan2(dy, dx) : null);
    } else if (held?.moved && this.why(held.body) !== null) {
      this.#refuse(held.body, this.why(held.body)); // the game may have changed since
    } else if (held?.moved) {
      this.place(byId("drop"), held.body, held.place);
    } else if (held && held.body !== "ball") {
      this.selection.choose(this.selection.robot === held.body ? null : held.body);
    }
  }

  /** The nearest body under a pointer: a robot's name, `ball`, or null. */
  #bodyAt({ left, top }) {
    const { projection, world } = this.pitchCanvas;
    if (world === null) return null;
    let nearest = null, least = REACH_PX;
    const robots = Object.entries(world.robots).map(([name, robot]) => [name, inPicture(projection, robot, this.match.radiusOf(name))]);
    for (const [body, { x, y }] of [...(world.ball ? [["ball", world.ball]] : []), ...robots]) {
      const off = Math.hypot(projection.x(x) - left, projection.y(y) - top) - (body === "ball" ? 3 : 0);
      if (off < least) [nearest, least] = [body, off];
    }
    return nearest;
  }

  #draw(context, projection) {
    const held = this.#held;
    const at = held?.moved ? held.place : null;
    if (at) {
      Object.assign(this.selection.dragged, at);
      const drop = byId("drop");
      drop.style.left = `${projection.x(at.x)}px`;
      drop.style.top = `${projection.y(at.y)}px`;
    }
    if (!this.#drawn) return;
    const { from, to } = this.#drawn;
    context.strokeStyle = "#ffffff";
    context.lineWidth = 2;
    line(context, projection, from, to);
  }

  #hint() {
    const { picking } = this.selection;
    show(byId("hint"), picking !== null);
    if (picking) setText(byId("hint"), `Point at the field: ${picking.words}. Keep drawing for a direction. Esc cancels.`);
  }
}
