// Movies and pictures of the scene in any size, with title, time and verdict. A movie is drawn frame by frame at times of the
// flight, however long a drawing takes: it plays at the chosen speed.

import { room } from "./captions.js";
import { webm } from "./webm.js";

const RATE = 30; // frames per second
const HOLD = 1.5; // s for which the end stays, with the verdict
const KEY = 60; // frames from one that stands by itself to the next
const BITS = 0.2; // of a movie, for each pixel of a frame
const AHEAD = 4; // frames that wait to be encoded
const HEIGHT = 720; // CSS pixels for which lines and letters are made; in larger pictures they grow
const CODECS = { V_VP9: "vp09.00.51.08", V_VP8: "vp8" };

/** Sizes that are offered by name, pixels; null: that of the scene. */
export const SIZES = { "as seen": null, "720p": [1280, 720], "1080p": [1920, 1080], "4K": [3840, 2160] };

/** Whether this browser can write movies. */
export const canFilm = () => typeof VideoEncoder !== "undefined";

export class Film {
  /** Of `viewer`, in a `size` in pixels, or null; `told` is told which share is done. */
  constructor(viewer, size, told) {
    Object.assign(this, { viewer, told, ...exposed(viewer, size), given: false });
    this.canvas = Object.assign(document.createElement("canvas"), { width: this.width, height: this.height });
  }

  /** The movie from time `from` to `to` as a Blob, or null if it is given up. Throws if it cannot be encoded. */
  async shoot(from, to) {
    const { viewer, width, height, canvas } = this, { speed } = viewer.clock, chunks = [], codec = await this.#codec();
    const encoder = new VideoEncoder({ output: (chunk) => chunks.push(chunk), error: (error) => (this.given = error) });
    encoder.configure(codec.settings);
    const moving = Math.max(Math.ceil(((to - from) / speed) * RATE - 1e-9), 1), frames = moving + Math.round(HOLD * RATE);
    for (let i = 0; i <= frames && !this.given; i++) {
      if (i <= moving) this.#draw(Math.min(from + (i * speed) / RATE, to), i === moving);
      const frame = new VideoFrame(canvas, { timestamp: (1e6 * i) / RATE, duration: 1e6 / RATE });
      encoder.encode(frame, { keyFrame: i % KEY === 0 });
      frame.close();
      this.told(i / frames);
      do await new Promise((resolve) => setTimeout(resolve)); // also lets the page answer
      while (encoder.encodeQueueSize > AHEAD && !this.given);
    }
    if (!this.given) await encoder.flush();
    if (encoder.state !== "closed") encoder.close();
    if (this.given instanceof Error) throw this.given;
    return this.given ? null : webm(chunks, { codec: codec.name, width, height, duration: (1000 * (frames + 1)) / RATE });
  }

  /** Leave off. */
  stop() {
    this.given = true;
  }

  async #codec() {
    const { width, height } = this, rest = { width, height, framerate: RATE, bitrate: BITS * RATE * width * height };
    const all = Object.entries(CODECS).map(([name, codec]) => ({ name, settings: { ...rest, codec } }));
    for (const one of all) if ((await VideoEncoder.isConfigSupported(one.settings)).supported) return one;
    throw new Error("this browser encodes no WebM");
  }

  #draw(time, last) {
    const { viewer, canvas } = this, { theme: { colours } } = viewer;
    viewer.clock.time = time;
    viewer.expose(this, 1 / RATE);
    const { context, size } = paint(viewer, canvas);
    if (!last || viewer.clock.drive) return;
    viewer.flights.forEach(({ title, verdict }, i) => {
      context.fillStyle = colours[verdict.state];
      context.fillText(viewer.flights.length > 1 ? `${title}: ${verdict.words}` : verdict.words, size, (4 + 1.4 * i) * size);
    });
  }
}

/** Pixels of a picture of `viewer` in a `size`, both even as codecs want them, and how many of them are a CSS pixel. */
function exposed({ stage }, size) {
  const [width, height] = size ?? [stage.width * stage.ratio, stage.height * stage.ratio], even = (pixels) => 2 * Math.round(pixels / 2);
  return { width: even(width), height: even(height), scale: size ? height / HEIGHT : stage.ratio };
}

/** Paint on `film` what `viewer` has just drawn, with title and time; returns the context and the size of a letter. */
function paint(viewer, film) {
  const { clock, stage, parts: { canvas }, theme: { colours } } = viewer, context = film.getContext("2d");
  const size = (14 * film.height) / stage.height;
  context.fillStyle = colours.sky;
  context.fillRect(0, 0, film.width, film.height);
  context.drawImage(canvas, 0, 0, film.width, film.height);
  Object.assign(context, { fillStyle: colours.ink, textBaseline: "top", font: `600 ${size}px system-ui, sans-serif` });
  context.fillText(viewer.title, size, size);
  context.font = `${size}px system-ui, sans-serif`;
  const [flight] = viewer.flights;
  if (stage.near) frame(context, stage.near, film.height / stage.height, colours);
  context.fillText(`${clock.time.toFixed(2)} s, ${clock.speed}× real time, ${flight.phase(clock.time)}`, size, 2.4 * size);
  return { context, size };
}

/** Frame what is seen from near by, at `near` in CSS pixels, `scale` times as large, and write how much room the rod has. */
function frame(context, { left, top, side, clearance }, scale, colours) {
  Object.assign(context, { strokeStyle: colours.line, lineWidth: 1.5 * scale });
  context.strokeRect(scale * left, scale * top, scale * side, scale * side);
  context.fillText(room(clearance), scale * (left + 10), scale * (top + side - 24));
}

/** Have a picture of `viewer` in a `size` (pixels, or null), with title and time, as a PNG told to `done`. */
export function picture(viewer, size, done) {
  const view = exposed(viewer, size), film = Object.assign(document.createElement("canvas"), { width: view.width, height: view.height });
  viewer.expose(view, 0);
  paint(viewer, film);
  film.toBlob(done, "image/png");
  viewer.resume();
}

/** Offer a file called `name`. */
export function save(blob, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
