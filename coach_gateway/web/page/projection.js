// From metres of the field to pixels of the canvas and back.

export const SEEN_FROM = [
  ["fixed", "as it lies"],
  ["turned", "turned round"],
  ["cyan", "cyan to the right"],
  ["magenta", "magenta to the right"],
];
const MARGIN_M = 1.0;

/** Whether the picture is turned by half a turn. */
function turned(seenFrom, match) {
  if (seenFrom === "turned") return true;
  return (seenFrom === "cyan" || seenFrom === "magenta") && match.attack(seenFrom) < 0;
}

export class Projection {
  /** Pixels of the page for each metre. */
  scale = 20;
  width = 0;
  height = 0;
  density = 1;
  sign = 1;

  /** Fits the pitch into `width` pixels; says whether anything has changed. */
  fit(pitch, width, seenFrom, match) {
    const margin = Math.max(pitch.goal_depth + 0.35, Math.min(pitch.border, MARGIN_M));
    const wide = pitch.length + 2 * margin, high = pitch.width + 2 * margin;
    const sign = turned(seenFrom, match) ? -1 : 1;
    const fits = { width, height: Math.round((width * high) / wide), density: devicePixelRatio || 1, sign };
    const same = Object.entries(fits).every(([name, value]) => this[name] === value) && this.pitch === pitch;
    Object.assign(this, fits, { scale: width / wide, pitch });
    return !same;
  }

  x(x) {
    return this.width / 2 + this.sign * x * this.scale;
  }

  y(y) {
    return this.height / 2 - this.sign * y * this.scale;
  }

  /** A direction of the field as an angle of the canvas, clockwise from the right. */
  angle(heading) {
    return -heading + (this.sign < 0 ? Math.PI : 0);
  }

  /** A point of the canvas, in pixels from its left upper corner, on the field. */
  onField(left, top) {
    return {
      x: (this.sign * (left - this.width / 2)) / this.scale,
      y: (-this.sign * (top - this.height / 2)) / this.scale,
    };
  }

  /** Metres in pixels, but never fewer than `least`. */
  length(metres, least = 0) {
    return Math.max(metres * this.scale, least);
  }
}
