// The match as the gateway sends it: what is known, and handlers for changes.

import { taskScore } from "../parts/text.js";
import { FrameBuffer } from "./frame_buffer.js";

const MOST_EVENTS = 5000;

/** A match before anything was received. */
const emptyMatch = () => ({
  role: "spectator",
  live: true,
  name: "",
  setup: null,
  deeds: new Set(),
  shown: [], // sides whose beliefs are sent
  drawn: [], // sides whose robots' drawings are sent
  scenes: {}, // name → description
  topics: [], // of a file without a match
  state: null,
  health: null,
  orders: {},
  beliefs: {},
  debug: {}, // robot → its drawing in the field frame
  events: [],
  eventCount: 0, // events so far, including dropped ones
  replay: null,
  result: null, // what is known once the match is over: figures and where they stand
  refbox: { connected: false, team: null },
  hostThere: true,
  episode: 1,
  frames: new FrameBuffer(),
});

/** Kind of message → what it says of the match. */
const READERS = {
  welcome({ role, match: name, setup, live, deeds, beliefs, debug, scenes, topics }) {
    return { ...emptyMatch(), role, name, setup, live, deeds: new Set(deeds), shown: beliefs, drawn: debug, scenes, topics };
  },
  frame({ world, beliefs, debug }, { episode, frames }) {
    if (world.episode !== episode) frames.clear();
    frames.add(world, performance.now());
    return { episode: world.episode, beliefs, debug };
  },
  state: ({ state }) => ({ state }),
  event({ event }, { events, eventCount }) {
    events.push(event);
    if (events.length > MOST_EVENTS) events.shift();
    return { eventCount: eventCount + 1 };
  },
  health: ({ health }) => ({ health }),
  orders: ({ cyan, magenta }) => ({ orders: { cyan, magenta } }),
  host: ({ there }) => ({ hostThere: there }),
  replay({ replay }, { frames }) {
    frames.still = replay.paused;
    return { replay };
  },
  result: ({ figures, statistics, replay }) => ({ result: { figures, statistics, replay } }),
  refbox: ({ connected, team }) => ({ refbox: { connected, team } }),
};

export class Match {
  #handlers = new Map();

  constructor() {
    Object.assign(this, emptyMatch());
  }

  /** Calls `does` after each message of these kinds. */
  on(kinds, does) {
    for (const kind of kinds.split(" ")) this.#handlers.set(kind, [...(this.#handlers.get(kind) ?? []), does]);
  }

  /** Takes in a message of the gateway; an unknown kind is ignored. */
  receive(message) {
    Object.assign(this, READERS[message.kind]?.(message, this));
    for (const does of this.#handlers.get(message.kind) ?? []) does(this);
  }

  /** Whether a match has been played to its end. */
  get over() {
    return this.live && this.state?.phase === "full_time";
  }

  /** Whether a file without a match is replayed. */
  get log() {
    return this.topics.length > 0;
  }

  /** All robots: the setup's in order, then others on the pitch. */
  get robots() {
    const listed = this.setup ? ["cyan", "magenta"].flatMap((side) => this.setup.teams[side].robots) : [];
    const there = this.frames.newest?.robots ?? {};
    return [...listed, ...Object.keys(there).filter((name) => !listed.includes(name))];
  }

  /** The task of the game `free`: its unit and zones; null in soccer. */
  get free() {
    return this.setup?.game === "free" ? this.setup.task : null;
  }

  /** The sides that play: in a free game one may have no robots. */
  get sides() {
    return ["cyan", "magenta"].filter((side) => this.free === null || this.setup.teams[side].robots.length > 0);
  }

  /** `2 : 1`, or the score of a free game with its unit. */
  get scoreText() {
    const { state, free } = this;
    if (state === null) return free ? "–" : "– : –";
    return free ? taskScore(state.value, free.unit) : `${state.score.cyan} : ${state.score.magenta}`;
  }

  /** Whether this role may do a deed; `side` is the side it is for, or null. */
  may(deed, side = null) {
    if (!this.deeds.has(deed)) return false;
    return this.role === "referee" || side === null || side === this.role;
  }

  sideOf(robot) {
    for (const side of ["cyan", "magenta"]) if (this.setup?.teams[side].robots.includes(robot)) return side;
    return robot.startsWith("magenta") ? "magenta" : "cyan";
  }

  /** 1 if a side attacks +x, −1 if it attacks −x: the sign that turns its team frame into the field's. */
  attack(side) {
    const cyan = this.state?.cyan_attacks ?? 1;
    return side === "cyan" ? cyan : -cyan;
  }

  /** Radius of a robot's hull in m. */
  radiusOf(robot) {
    return (this.setup?.models[this.#typeOf(robot)]?.body ?? this.setup?.robot)?.radius ?? 0.25;
  }

  /** A robot's sensors by name, with their numbers. */
  sensorsOf(robot) {
    return this.setup?.sensors?.[this.#typeOf(robot)] ?? {};
  }

  #typeOf(robot) {
    return this.setup?.teams[this.sideOf(robot)].types[robot] ?? "standard";
  }

  /** A robot's newest radio message; null when it is older than `age` s. */
  radioOf(robot, age = 1.5) {
    const belief = this.beliefs[robot];
    const now = this.frames.newest?.time ?? 0;
    return belief && Math.abs(now - belief.time) <= age ? belief.radio : null;
  }
}
