// One robot driven by keyboard, gamepad or buttons in place of its brain.

import { byId, mark, offer, setText } from "../shared/elements.js";
import { readGamepad } from "./gamepad.js";

const SEND_EVERY_MS = 50;

/** Key → motion ahead, to the left, counter-clockwise. */
const MOVES = {
  KeyW: { ahead: 1 }, ArrowUp: { ahead: 1 },
  KeyS: { ahead: -1 }, ArrowDown: { ahead: -1 },
  KeyA: { left: 1 }, ArrowLeft: { left: 1 },
  KeyD: { left: -1 }, ArrowRight: { left: -1 },
  KeyQ: { turn: 1 }, KeyE: { turn: -1 },
};
const KICKS = { KeyK: "ground", KeyL: "lob" };
const DRIBBLE = "KeyZ";

export class ManualControl {
  /** The robot that is driven, or null. */
  robot = null;
  #keys = new Set();
  #dribble = false;
  #kick = null;

  constructor(match, pitchCanvas, requests, selection) {
    Object.assign(this, { match, pitchCanvas, requests, selection });
    setInterval(() => this.#sendState(), SEND_EVERY_MS);
    addEventListener("blur", () => this.#keys.clear());
    addEventListener("pagehide", () => this.giveBack());
    document.addEventListener("visibilitychange", () => document.hidden && this.giveBack()); // its clock nearly stops
    byId("drive-take").addEventListener("click", () => (this.robot ? this.giveBack() : this.takeOver(byId("drive-robot").value)));
    byId("drive-robot").addEventListener("change", () => selection.choose(byId("drive-robot").value || null));
    byId("dribble").addEventListener("click", () => this.#press(DRIBBLE));
    for (const [id, code] of [["kick-ground", "KeyK"], ["kick-lob", "KeyL"]]) byId(id).addEventListener("click", () => this.#press(code));
    this.#pads();
    selection.on(() => this.update());
    match.on("welcome host health", () => this.update());
  }

  /** Takes over a robot from its brain. */
  takeOver(robot) {
    this.giveBack();
    this.robot = robot || null;
    this.#dribble = false;
    this.update();
    if (this.robot) byId("moving").focus({ preventScroll: true });
  }

  /** Gives the robot back to its brain at once. */
  giveBack() {
    if (this.robot) this.match.live && this.#send({ release: true });
    this.robot = null;
    this.#keys.clear();
    this.update();
  }

  /** Handles a key of the robot that is driven; returns whether it was one. */
  key(event, down) {
    if (!this.robot) return false;
    if (event.ctrlKey || event.metaKey || event.altKey) {
      this.#keys.clear(); // the release of another key beside one of these may not be reported
      return false;
    }
    const { code } = event;
    if (MOVES[code]) {
      if (down) this.#keys.add(code);
      else this.#keys.delete(code);
      return true;
    }
    if (!KICKS[code] && code !== DRIBBLE) return false;
    if (down && !event.repeat) this.#press(code);
    return true;
  }

  /** Shows which robots can be driven, and which one is. */
  update() {
    const { match, selection } = this;
    const robots = match.robots.filter((name) => match.may("drive", match.sideOf(name)));
    offer(byId("drive-robot"), [["", "choose a robot"], ...robots.map((name) => [name, name])]);
    if (!this.robot && selection.robot && robots.includes(selection.robot)) byId("drive-robot").value = selection.robot;
    if (this.robot && (!robots.includes(this.robot) || !match.hostThere)) this.robot = null;
    const chosen = byId("drive-robot").value;
    byId("drive-robot").disabled = this.robot !== null || !match.live;
    byId("drive-take").disabled = !match.live || (this.robot === null && (!chosen || !match.hostThere));
    setText(byId("drive-take"), this.robot ? `Give ${this.robot} back` : "Take over");
    byId("drive-take").setAttribute("aria-pressed", this.robot !== null);
    byId("dribble").setAttribute("aria-pressed", this.#dribble);
    for (const id of ["dribble", "kick-ground", "kick-lob"]) byId(id).disabled = this.robot === null;
    for (const button of byId("pad").children) button.disabled = this.robot === null;
    setText(byId("driven"), this.robot ? `This page drives ${this.robot}.` : "This page drives no robot.");
    mark(byId("driven"), "now", this.robot !== null);
  }

  /** Buttons for a finger; each acts like a key that is held down. */
  #pads() {
    for (const button of byId("pad").children) {
      const { code } = button.dataset;
      button.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        if (event.button === 0) this.#keys.add(code);
      });
      for (const end of ["pointerup", "pointerleave", "pointercancel"]) button.addEventListener(end, () => this.#keys.delete(code));
    }
  }

  #press(code) {
    if (code === DRIBBLE) this.#dribble = !this.#dribble;
    else this.#kick = KICKS[code];
    this.update();
  }

  /** Sends the drive 20 times a second: after half a second of silence the host gives the robot back. */
  #sendState() {
    if (!this.robot) return;
    const speed = byId("drive-speed").valueAsNumber || 0, turning = byId("drive-turn").valueAsNumber || 0;
    const moves = this.#moves();
    const pad = readGamepad();
    if (pad?.dribbles) this.#press(DRIBBLE);
    if (pad?.kicks) this.#kick = pad.kicks;
    let vx = speed * clamp(moves.ahead + (pad?.ahead ?? 0)), vy = speed * clamp(moves.left + (pad?.left ?? 0));
    if (byId("drive-field").checked) [vx, vy] = this.#inBody(vx, vy);
    const drive = { vx, vy, omega: turning * clamp(moves.turn + (pad?.turn ?? 0)) };
    const kick = this.#kick ? { mode: this.#kick, speed: Math.max(0.1, byId("drive-kick").valueAsNumber || 0) } : null;
    this.#kick = null;
    this.#send({ drive, dribble: this.#dribble, kick });
  }

  #moves() {
    const moves = { ahead: 0, left: 0, turn: 0 };
    for (const code of this.#keys) for (const [way, sign] of Object.entries(MOVES[code])) moves[way] += sign;
    return moves;
  }

  /** Up and left of the picture as a velocity in the frame of the robot's body. */
  #inBody(up, left) {
    const heading = this.pitchCanvas.world?.robots[this.robot]?.heading ?? 0;
    const sign = this.pitchCanvas.projection.sign;
    const x = -sign * left, y = sign * up; // left on the picture is −x of the field, up is +y
    return [x * Math.cos(heading) + y * Math.sin(heading), -x * Math.sin(heading) + y * Math.cos(heading)];
  }

  #send(manual) {
    const robot = this.robot;
    this.requests.connection.send("drive", { robot, manual }, (reply) => {
      if (this.robot !== robot || reply.accepted) return;
      this.robot = null;
      this.update();
      this.requests.show(byId("drive-take"), `Drive ${robot}`, reply);
    });
  }
}

const clamp = (value) => Math.min(Math.max(value, -1), 1);
