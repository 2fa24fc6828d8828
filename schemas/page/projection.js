// From metres of the field to pixels of a canvas and back.

export class Projection {
  /** Pixels of the page for each metre. */
  scale = 20;
  width = 0;
  height = 0;
  /** Width of the pitch and its margins for each metre of their height. */
  ratio = 1.5;
  /** Pixels of the canvas for each pixel of the page. */
  density = 1;
  /** −1 where the field is turned by half a turn, otherwise 1. */
  sign = 1;

  /** Fits the pitch, with `margin` metres around it, into `width` pixels; returns whether anything has changed. */
  fit(pitch, width, margin = marginOf(pitch), sign = 1) {
    const wide = pitch.length + 2 * margin, high = pitch.width + 2 * margin;
    const fits = { width, height: Math.round((width * high) / wide), density: devicePixelRatio || 1, sign, pitch };
    const same = Object.entries(fits).every(([name, value]) => this[name] === value);
    Object.assign(this, fits, { scale: width / wide, ratio: wide / high });
    return !same;
  }

  /** Sizes a canvas for the picture; returns its context, in which one unit is a pixel of the page. */
  resize(canvas) {
    canvas.width = Math.round(this.width * this.density);
    canvas.height = Math.round(this.height * this.density);
    const context = canvas.getContext("2d");
    context.setTransform(this.density, 0, 0, this.density, 0, 0);
    return context;
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

  /** A point of the canvas, in pixels from its upper left corner, on the field. */
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

/** Metres around the pitch that show its goals, and at most one metre of its border. */
function marginOf(pitch) {
  return Math.max(pitch.goal_depth + 0.35, Math.min(pitch.border, 1));
}
