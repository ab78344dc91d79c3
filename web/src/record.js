// A movie of the scene as the page draws it: played once at the chosen speed, with title, time and verdict, as .webm.

const RATE = 30; // frames per second
const HOLD = 1500; // ms for which the end stays, with the verdict
const KINDS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm", "video/mp4"];

/** The kind of movie that this browser can write, or undefined. */
export const movieKind = () => KINDS.find((kind) => window.MediaRecorder?.isTypeSupported(kind));

export class Recorder {
  /** Of `viewer`; `done` is told the movie, a Blob, or null if it was given up. */
  constructor(viewer, done) {
    const { width, height } = viewer.parts.canvas;
    Object.assign(this, { viewer, done, kept: [], film: Object.assign(document.createElement("canvas"), { width, height }) });
    this.media = new MediaRecorder(this.film.captureStream(RATE), { mimeType: movieKind(), videoBitsPerSecond: 8e6 });
    this.media.addEventListener("dataavailable", ({ data }) => this.kept.push(data));
    this.media.addEventListener("stop", () => done(this.given ? null : new Blob(this.kept, { type: this.media.mimeType })));
  }

  start() {
    const { clock } = this.viewer;
    if (!clock.drive) clock.seek(clock.start);
    this.media.start();
    clock.play();
    this.frame();
  }

  /** End it: given up, unless the flight has no end of its own. */
  stop() {
    this.given = !this.viewer.clock.drive;
    this.#end();
  }

  /** Take the picture that has just been drawn. */
  frame() {
    const { viewer, film } = this, { clock } = viewer, colours = viewer.theme.colours;
    const { context, size } = paint(viewer, film);
    if (clock.drive || clock.playing || clock.time < clock.end) return;
    viewer.flights.forEach(({ title, verdict }, i) => {
      context.fillStyle = verdict.good ? colours.good : colours.alarm;
      context.fillText(viewer.flights.length > 1 ? `${title}: ${verdict.words}` : verdict.words, size, (4 + 1.4 * i) * size);
    });
    this.waiting ??= setTimeout(() => this.#end(), HOLD);
  }

  #end() {
    clearTimeout(this.waiting);
    if (this.media.state !== "inactive") this.media.stop();
  }
}

/** Paint on `film` what `viewer` has just drawn, with title and time; returns the context and the size of a letter. */
function paint(viewer, film) {
  const { clock, parts: { canvas }, theme: { colours } } = viewer, context = film.getContext("2d");
  const scale = film.height / canvas.clientHeight, size = 14 * scale;
  context.fillStyle = colours.sky;
  context.fillRect(0, 0, film.width, film.height);
  context.drawImage(canvas, 0, 0, film.width, film.height);
  Object.assign(context, { fillStyle: colours.ink, textBaseline: "top", font: `600 ${size}px system-ui, sans-serif` });
  context.fillText(viewer.title, size, size);
  context.font = `${size}px system-ui, sans-serif`;
  const [flight] = viewer.flights;
  context.fillText(`${clock.time.toFixed(2)} s, ${clock.speed}× real time, ${flight.phase(clock.time)}`, size, 2.4 * size);
  return { context, size };
}

/** Have the next picture of `viewer`, with title and time, as a PNG told to `done`. */
export function picture(viewer, done) {
  const { width, height } = viewer.parts.canvas, film = Object.assign(document.createElement("canvas"), { width, height });
  viewer.shoot = () => {
    viewer.shoot = null;
    paint(viewer, film);
    film.toBlob(done, "image/png");
  };
  viewer.wake();
}

/** Offer a file called `name`; the `ending` of a movie is that of its kind. */
export function save(blob, name, ending = blob.type.includes("mp4") ? "mp4" : "webm") {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = `${name}.${ending}`;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
