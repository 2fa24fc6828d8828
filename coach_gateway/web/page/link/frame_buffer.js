// Where everything is at the time of drawing: interpolated between received worlds, a little behind the newest.

const KEPT = 40; // worlds
const DELAY_MS = 75; // behind the newest: worlds come every 40 ms, and some are late
const SETTLE_MS = 180; // time constant with which the shown time approaches its target
const STALE_MS = 260; // without a new world for this long, the newest is shown as it is
const JUMP_M = 0.5; // a body that moves farther between two worlds than this and its speed allow was placed there
const FASTEST = 25; // m/s

export class FrameBuffer {
  #pictures = [];
  #shown = 0;
  #drawnAt = 0;

  /** Whether the newest world is shown exactly, without interpolation. */
  still = false;

  /** The newest world received, or null. */
  get newest() {
    return this.#pictures.at(-1)?.world ?? null;
  }

  /** Forgets all worlds: a new episode begins. */
  clear() {
    this.#pictures = [];
  }

  /** Adds a world received at `now`, in ms. */
  add(world, now) {
    const last = this.#pictures.at(-1);
    if (last && (world.time < last.world.time || world.time > last.world.time + 30)) this.clear();
    else if (last && world.tick === last.world.tick) this.#pictures.pop();
    this.#pictures.push({ world, at: now });
    if (this.#pictures.length > KEPT) this.#pictures.shift();
  }

  /** The world to draw at `now`, in ms; null before the first. */
  at(now) {
    const last = this.#pictures.at(-1);
    if (last === undefined) return null;
    const passed = Math.min(now - this.#drawnAt, 100);
    this.#drawnAt = now;
    if (this.still || now - last.at > STALE_MS || this.#pictures.length < 3) {
      this.#shown = last.world.time;
      return last.world;
    }
    const first = this.#pictures[0];
    const rate = (last.world.time - first.world.time) / Math.max(last.at - first.at, 1);
    const wanted = last.world.time + rate * (now - last.at - DELAY_MS);
    this.#shown += rate * passed;
    const off = wanted - this.#shown;
    this.#shown += Math.abs(off) > 400 * rate ? off : off * (1 - Math.exp(-passed / SETTLE_MS));
    this.#shown = Math.min(Math.max(this.#shown, first.world.time), last.world.time);
    return this.#between(this.#shown);
  }

  #between(time) {
    let place = this.#pictures.length - 1;
    while (place > 0 && this.#pictures[place - 1].world.time > time) place -= 1;
    const after = this.#pictures[place].world;
    const before = this.#pictures[place - 1]?.world;
    if (before === undefined || after.time <= before.time) return after;
    const share = (time - before.time) / (after.time - before.time);
    const reach = JUMP_M + FASTEST * (after.time - before.time);
    const between = (earlier, later) =>
      Object.fromEntries(Object.entries(later ?? {}).map(([name, body]) => [name, mixed(earlier?.[name], body, share, reach)]));
    const obstacles = between(before.obstacles, after.obstacles), robots = between(before.robots, after.robots);
    return { ...after, time, robots, obstacles, ball: after.ball && mixed(before.ball, after.ball, share, reach) };
  }
}

/** A body between two worlds; a placed body jumps at once. */
function mixed(before, after, share, reach) {
  if (before === undefined || Math.hypot(after.x - before.x, after.y - before.y) > reach) return after;
  const body = {
    ...after,
    x: before.x + share * (after.x - before.x),
    y: before.y + share * (after.y - before.y),
    z: before.z + share * (after.z - before.z),
  };
  if (after.heading !== undefined) {
    const turn = after.heading - before.heading;
    body.heading = before.heading + share * Math.atan2(Math.sin(turn), Math.cos(turn));
  }
  return body;
}
