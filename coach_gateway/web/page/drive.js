// One robot driven by keyboard or gamepad in place of its brain, and given back.

import { byId, offer, say, show } from "./elements.js";
import { padHand } from "./gamepad.js";

const SAID_MS = 50;

/** Key → which way it moves: ahead, to the left, counter-clockwise. */
const MOVES = {
  KeyW: { ahead: 1 }, ArrowUp: { ahead: 1 },
  KeyS: { ahead: -1 }, ArrowDown: { ahead: -1 },
  KeyA: { left: 1 }, ArrowLeft: { left: 1 },
  KeyD: { left: -1 }, ArrowRight: { left: -1 },
  KeyQ: { turn: 1 }, KeyE: { turn: -1 },
};
const KICKS = { KeyK: "ground", KeyL: "lob" };
const DRIBBLE = "KeyZ";

export class Drive {
  /** The robot that is driven, or nothing. */
  robot = null;
  #keys = new Set();
  #dribble = false;
  #kick = null;

  constructor(match, stage, desk, seat) {
    Object.assign(this, { match, stage, desk, seat });
    setInterval(() => this.#say(), SAID_MS);
    addEventListener("blur", () => this.#keys.clear());
    addEventListener("pagehide", () => this.giveBack());
    document.addEventListener("visibilitychange", () => document.hidden && this.giveBack()); // its clock nearly stops
    byId("drive-take").addEventListener("click", () => (this.robot ? this.giveBack() : this.take(byId("drive-robot").value)));
    byId("drive-robot").addEventListener("change", () => seat.choose(byId("drive-robot").value || null));
    byId("dribble").addEventListener("click", () => this.#press(DRIBBLE));
    for (const [id, code] of [["kick-ground", "KeyK"], ["kick-lob", "KeyL"]]) byId(id).addEventListener("click", () => this.#press(code));
    this.#pads();
    seat.on(() => this.update());
    match.on("welcome host health", () => this.update());
  }

  /** Takes a robot in hand. */
  take(robot) {
    this.giveBack();
    this.robot = robot || null;
    this.#dribble = false;
    this.update();
    if (this.robot) byId("moving").focus({ preventScroll: true });
  }

  /** Gives the robot back to its brain at once. */
  giveBack() {
    if (this.robot) this.match.live && this.#tell({ release: true });
    this.robot = null;
    this.#keys.clear();
    this.update();
  }

  /** Whether a key is for the robot that is driven; then it is taken. */
  key(event, down) {
    if (!this.robot) return false;
    if (event.ctrlKey || event.metaKey || event.altKey) {
      this.#keys.clear(); // a key that is let go of beside one of these may not be heard of
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

  /** Who can be driven, and who is. */
  update() {
    const { match, seat } = this;
    const robots = match.robots.filter((name) => match.may("drive", match.sideOf(name)));
    offer(byId("drive-robot"), [["", "choose a robot"], ...robots.map((name) => [name, name])]);
    if (!this.robot && seat.robot && robots.includes(seat.robot)) byId("drive-robot").value = seat.robot;
    if (this.robot && (!robots.includes(this.robot) || !match.hostThere)) this.robot = null;
    const chosen = byId("drive-robot").value;
    byId("drive-robot").disabled = this.robot !== null || !match.live;
    byId("drive-take").disabled = !match.live || (this.robot === null && (!chosen || !match.hostThere));
    say(byId("drive-take"), this.robot ? `Give ${this.robot} back` : "Take in hand");
    byId("drive-take").setAttribute("aria-pressed", this.robot !== null);
    byId("dribble").setAttribute("aria-pressed", this.#dribble);
    for (const id of ["dribble", "kick-ground", "kick-lob"]) byId(id).disabled = this.robot === null;
    for (const button of byId("pad").children) button.disabled = this.robot === null;
    const words = this.robot ? `${this.robot} is driven by this page.` : "";
    say(byId("driven"), words);
    show(byId("driven"), words !== "");
  }

  /** Buttons for a finger, each like a key that is held down. */
  #pads() {
    for (const button of byId("pad").children) {
      const { code } = button.dataset;
      button.addEventListener("pointerdown", (event) => {
        event.preventDefault();
        if (event.button !== 0) return;
        this.#keys.add(code);
      });
      for (const end of ["pointerup", "pointerleave", "pointercancel"]) button.addEventListener(end, () => this.#keys.delete(code));
    }
  }

  #press(code) {
    if (code === DRIBBLE) this.#dribble = !this.#dribble;
    else this.#kick = KICKS[code];
    this.update();
  }

  /** Says twenty times a second what the hand does: half a second of silence gives the robot back. */
  #say() {
    if (!this.robot) return;
    const speed = byId("drive-speed").valueAsNumber || 0, turning = byId("drive-turn").valueAsNumber || 0;
    const hand = this.#moves();
    const pad = padHand();
    if (pad?.dribbles) this.#press(DRIBBLE);
    if (pad?.kicks) this.#kick = pad.kicks;
    let vx = speed * clamp(hand.ahead + (pad?.ahead ?? 0)), vy = speed * clamp(hand.left + (pad?.left ?? 0));
    if (byId("drive-field").checked) [vx, vy] = this.#inBody(vx, vy);
    const drive = { vx, vy, omega: turning * clamp(hand.turn + (pad?.turn ?? 0)) };
    const kick = this.#kick ? { mode: this.#kick, speed: Math.max(0.1, byId("drive-kick").valueAsNumber || 0) } : null;
    this.#kick = null;
    this.#tell({ drive, dribble: this.#dribble, kick });
  }

  #moves() {
    const hand = { ahead: 0, left: 0, turn: 0 };
    for (const code of this.#keys) for (const [way, sign] of Object.entries(MOVES[code])) hand[way] += sign;
    return hand;
  }

  /** Up and left as the picture shows them, in the frame of the robot's body. */
  #inBody(up, left) {
    const heading = this.stage.world?.robots[this.robot]?.heading ?? 0;
    const sign = this.stage.view.sign;
    const x = -sign * left, y = sign * up; // left on the picture is −x of the field, up is +y
    return [x * Math.cos(heading) + y * Math.sin(heading), -x * Math.sin(heading) + y * Math.cos(heading)];
  }

  #tell(hand) {
    const robot = this.robot;
    this.desk.line.tell("drive", { robot, hand }, (reply) => {
      if (this.robot !== robot || reply.accepted) return;
      this.robot = null;
      this.update();
      this.desk.show(byId("drive-take"), `Drive ${robot}`, reply);
    });
  }
}

const clamp = (value) => Math.min(Math.max(value, -1), 1);
