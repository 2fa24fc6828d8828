// Playback: the current time in the match, and whether it advances.

export class Player {
  /** `onChange` is called with the player whenever its state changes; `clock` returns the time in ms. */
  constructor(start, end, onChange, clock = () => performance.now()) {
    Object.assign(this, { start, end, onChange, clock, time: start, rate: 1, playing: false });
  }

  seek(time) {
    this.time = Math.min(Math.max(time, this.start), this.end);
    this.onChange(this);
  }

  play() {
    if (this.playing) return;
    if (this.time >= this.end) this.time = this.start;
    this.playing = true;
    this.last = this.clock();
    const frame = () => {
      if (!this.playing) return;
      const now = this.clock();
      this.time = Math.min(this.end, this.time + ((now - this.last) / 1000) * this.rate);
      this.last = now;
      if (this.time >= this.end) this.playing = false;
      this.onChange(this);
      requestAnimationFrame(frame);
    };
    this.onChange(this);
    requestAnimationFrame(frame);
  }

  pause() {
    this.playing = false;
    this.onChange(this);
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }
}
