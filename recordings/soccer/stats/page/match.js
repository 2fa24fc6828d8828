// The data of the match: positions of all bodies, game state and clock at any time.

import { indexAt } from "./shared/events.js";

const ABSENT = -32768;
const NO_HOLDER = 255;
const MAX_STEP_CM = 120; // between two samples; a body that moves farther was placed by hand

function bytes(text) {
  return Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
}

function int16s(text) {
  return new Int16Array(bytes(text).buffer);
}

/** Reads the data in the page; times in s of simulated time, lengths in m. */
export function readMatch(text) {
  const content = JSON.parse(text);
  const robots = content.robots.map((robot) => ({
    ...robot, x: int16s(robot.x), y: int16s(robot.y), heading: bytes(robot.heading),
  }));
  const ball = { ...content.ball, x: int16s(content.ball.x), y: int16s(content.ball.y), z: int16s(content.ball.z) };
  return new Match({ ...content, robots, ball, holder: bytes(content.holder) });
}

class Match {
  constructor(content) {
    Object.assign(this, content);
    const last = [...this.intervals, ...this.events].map(({ time }) => time);
    // The last sample may lie before full time, by less than the time between two samples.
    this.end = Math.max(this.start + Math.max(0, this.samples - 1) / this.rate, ...last);
  }

  /** Samples before and after a time, and the fraction of the interval between them. */
  place(time) {
    const exact = Math.min(Math.max((time - this.start) * this.rate, 0), this.samples - 1);
    const sample = Math.floor(exact + 1e-6);
    return [sample, Math.min(sample + 1, this.samples - 1), Math.max(0, exact - sample)];
  }

  /** All bodies at a time: robots with x, y and heading, null for absent ones; the ball; the holder's index or null. */
  bodies(time) {
    const [before, after, way] = this.place(time);
    const robots = this.robots.map((robot) => {
      if (robot.x[before] === ABSENT) return null;
      const point = between(robot, before, after, way);
      const turn = ((robot.heading[after] - robot.heading[before] + 384) % 256) - 128;
      return { ...point, heading: ((robot.heading[before] + turn * way) * Math.PI) / 128 };
    });
    const z = this.ball.z[before] + (this.ball.z[after] - this.ball.z[before]) * way;
    const ball = { ...between(this.ball, before, after, way), z: z / 100 };
    return { robots, ball, holder: this.holder[before] === NO_HOLDER ? null : this.holder[before] };
  }

  /** Phase, side and score at a time; null before the first game state. */
  interval(time) {
    return this.intervals[indexAt(this.intervals, time)] ?? null;
  }

  /** The game clock at a time. */
  clockAt(time) {
    const over = this.events.findLast((event) => event.kind === "full_time" && event.time <= time + 1e-6);
    if (over) return over.clock;
    const at = Math.min(Math.max(time - this.start, 0), this.clock.length - 1);
    const second = Math.floor(at);
    const next = Math.min(second + 1, this.clock.length - 1);
    return this.clock[second] + (this.clock[next] - this.clock[second]) * (at - second);
  }

  /** Intervals in which the ball was in play: begin, end, and game state. */
  inPlay() {
    return this.intervals
      .map((interval, number) => [interval, this.intervals[number + 1]?.time ?? this.end])
      .filter(([interval]) => interval.phase === "play" && interval.running)
      .map(([interval, until]) => [interval.time, until, interval]);
  }
}

function between(track, before, after, way) {
  const x = track.x[before], y = track.y[before];
  let dx = track.x[after] - x, dy = track.y[after] - y;
  if (track.x[after] === ABSENT || Math.hypot(dx, dy) > MAX_STEP_CM) dx = dy = 0;
  return { x: (x + dx * way) / 100, y: (y + dy * way) / 100 };
}

/** Seconds as minutes and seconds. */
export function formatClock(seconds, tenths = false) {
  const whole = tenths ? Math.floor(seconds * 10) / 10 : Math.floor(seconds);
  const minutes = Math.floor(whole / 60);
  const rest = whole - 60 * minutes;
  return `${minutes}:${tenths ? rest.toFixed(1).padStart(4, "0") : String(Math.floor(rest)).padStart(2, "0")}`;
}
