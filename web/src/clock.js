// Time of the flight: plays at a speed, stops at the end, can be put anywhere. Knows nothing of pictures.

import { clamp } from "./numbers.js";

export const SPEEDS = [0.1, 0.25, 0.5, 1, 2];
const REST = 2; // s of the wall at the end before it begins again, where it does

export class Clock {
  /** From `start` to `end`, in seconds of flight; `changed` is called whenever anything here changes. */
  constructor(start, end, changed) {
    Object.assign(this, { start, end, changed, time: start, speed: 1, playing: false, drive: null, loop: false, rested: 0 });
  }

  /** Another start and end; the time stays if it lies between. */
  span(start, end) {
    Object.assign(this, { start, end });
    this.seek(this.time);
  }

  /** Let `drive` (elapsed seconds of the wall, speed) say where the time goes, which has then no end; null: play as usual. */
  follow(drive) {
    this.drive = drive;
    this.playing = Boolean(drive);
    this.changed();
  }

  play() {
    if (this.drive) this.time = this.end;
    else if (this.time >= this.end) this.time = this.start;
    this.playing = Boolean(this.drive) || this.end > this.start;
    this.changed();
  }

  pause() {
    this.playing = false;
    this.changed();
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  seek(time) {
    if (!Number.isFinite(time)) return;
    this.time = clamp(time, this.start, this.end);
    this.changed();
  }

  setSpeed(speed) {
    if (!(speed > 0)) return;
    this.speed = speed;
    this.changed();
  }

  /** The next speed of the list, faster (+1) or slower (-1). */
  shift(way) {
    const faster = SPEEDS.filter((speed) => (speed - this.speed) * way > 1e-9);
    if (faster.length) this.setSpeed(way > 0 ? faster[0] : faster[faster.length - 1]);
  }

  /** Let `elapsed` seconds of the wall pass. */
  tick(elapsed) {
    if (!this.playing) return;
    if (this.drive) {
      this.drive(elapsed, this.speed);
      return;
    }
    this.time = Math.min(this.time + elapsed * this.speed, this.end);
    if (this.time < this.end) this.rested = 0;
    else if (!this.loop) this.pause();
    else if ((this.rested += elapsed) > REST) this.time = this.start;
  }
}
