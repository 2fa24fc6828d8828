// Momentum over time, with goals and shots; a click jumps to that time.

import { SYMBOLS } from "./shared/events.js";
import { SIDES } from "./shared/palette.js";

export class Timeline {
  constructor(canvas, match, seek) {
    Object.assign(this, { canvas, match });
    let dragging = false;
    const go = (event) => {
      const box = canvas.getBoundingClientRect();
      seek(match.start + ((event.clientX - box.left) / box.width) * (match.end - match.start));
    };
    canvas.addEventListener("pointerdown", (event) => {
      dragging = true;
      canvas.setPointerCapture(event.pointerId);
      go(event);
    });
    canvas.addEventListener("pointermove", (event) => dragging && go(event));
    for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, () => { dragging = false; });
  }

  /** Draws the background for the current size; `draw` adds the current time. */
  fit() {
    const density = window.devicePixelRatio || 1;
    this.canvas.width = Math.max(1, Math.round(this.canvas.clientWidth * density)); // on paper it has no size
    this.canvas.height = Math.max(1, Math.round(this.canvas.clientHeight * density));
    this.density = density;
    this.background = document.createElement("canvas");
    this.background.width = this.canvas.width;
    this.background.height = this.canvas.height;
    this.drawBackground(this.background.getContext("2d"), getComputedStyle(this.canvas));
  }

  x(time) {
    const { start, end } = this.match;
    return ((time - start) / Math.max(end - start, 1e-9)) * this.canvas.width;
  }

  drawBackground(context, style) {
    const { width, height } = this.canvas, middle = height / 2, reach = middle - 16 * this.density;
    const quiet = style.color;
    context.globalAlpha = 0.08;
    context.fillStyle = quiet;
    for (const [from, until] of this.match.inPlay()) context.fillRect(this.x(from), 0, this.x(until) - this.x(from), height);
    context.globalAlpha = 1;
    const { width: step, values } = this.match.momentum;
    for (const [side, sign] of [["cyan", 1], ["magenta", -1]]) {
      context.beginPath();
      context.moveTo(this.x(this.match.start), middle);
      values.forEach((value, number) => {
        context.lineTo(this.x(this.match.start + (number + 0.5) * step), middle - sign * Math.max(0, sign * value) * reach);
      });
      context.lineTo(this.x(Math.min(this.match.end, this.match.start + values.length * step)), middle);
      context.fillStyle = SIDES[side].fill;
      context.fill();
    }
    context.strokeStyle = quiet;
    context.lineWidth = this.density;
    context.beginPath();
    context.moveTo(0, middle);
    context.lineTo(width, middle);
    context.stroke();
    context.textAlign = "center";
    context.textBaseline = "middle";
    for (const event of this.match.events) {
      const goal = event.kind === "goal";
      if (!goal && !["shot", "save"].includes(event.kind)) continue;
      const y = event.side === "magenta" ? height - 9 * this.density : 9 * this.density;
      context.font = `${(goal ? 17 : 10) * this.density}px "DejaVu Sans", system-ui, sans-serif`;
      context.fillStyle = quiet;
      context.fillText(goal ? SYMBOLS.goal : SYMBOLS.shot, Math.min(Math.max(this.x(event.time), 9), width - 9), y);
    }
  }

  draw(time) {
    const context = this.canvas.getContext("2d");
    context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    context.drawImage(this.background, 0, 0);
    context.fillStyle = getComputedStyle(this.canvas).color;
    context.fillRect(this.x(time) - this.density, 0, 2 * this.density, this.canvas.height);
  }
}
