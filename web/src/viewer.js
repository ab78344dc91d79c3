// The viewer: puts scene, plots and player together for runs, and offers what becomes `window.flypend`.
//
// window.flypend: play(), pause(), seek(t), time(), duration(), playing(), speed(s), load(runs), camera(name),
// layout(name), theme(name), pose(i = 0) with t, x, R (rows), y, ... in the frame of run i, phases(i), screen(i) with the pixels of pivot and bob,
// frames() with the number of frames drawn and the milliseconds that the last sixty took to draw.

import css from "./replay.css";
import { Captions } from "./captions.js";
import { Clock } from "./clock.js";
import { Choice, Player, keys } from "./controls.js";
import { Flight } from "./flight.js";
import { frame, legend } from "./layout.js";
import { matrix } from "./numbers.js";
import { Plot } from "./plots.js";
import { Portrait } from "./portrait.js";
import { Recorder, movieKind, save } from "./record.js";
import { plots } from "./series.js";
import { steer } from "./scene/pointers.js";
import { PRESETS } from "./scene/rig.js";
import { LAYOUTS, Stage } from "./scene/stage.js";
import { Theme } from "./theme.js";

const STEP = 1 / 30; // s, of the arrow keys
const LOW = 380; // CSS pixels, the height of a picture below which the phase portrait is put away at first
const WORDS = 80; // ms between two changes of the numbers while time runs: faster, nobody reads them

export class Viewer {
  constructor({ runs, palette, title, layout, speed }, style = css) {
    this.parts = frame(style, title);
    this.title = title;
    this.drawn = { count: 0, cost: [] };
    this.clock = new Clock(0, 0, () => this.wake());
    this.clock.speed = speed;
    this.player = new Player(this.parts.player, this.clock);
    this.plots = [];
    this.portrait = new Portrait(this.parts.low, (t) => this.clock.seek(t));
    this.theme = new Theme(palette, (colours) => this.#paint(colours));
    this.#choices();
    this.flights = [];
    if (runs.length) this.load(runs);
    this.theme.set(this.theme.name);
    this.layouts.root.hidden = this.flights.length < 2;
    this.layout(layout);
    this.#keys();
    new ResizeObserver(() => this.#resize()).observe(this.parts.scene);
    this.last = null;
  }

  /** Show other runs, packed as in the page or flights; the clock stays where it is as far as they last, the camera as it looks. */
  load(runs) {
    const first = !this.stage;
    this.flights = runs.map((record) => (record instanceof Flight ? record : new Flight(record)));
    const ends = this.flights.map((flight) => flight.end), starts = this.flights.map((flight) => flight.start);
    this.clock.span(Math.min(...starts), Math.max(...ends));
    this.player.mark(this.flights);
    legend(this.parts.legend, this.flights);
    this.parts.canvas.setAttribute("aria-label", `The flight in three dimensions: ${this.flights.map(({ title, verdict }) => `${title}, ${verdict.words}`).join("; ")}`);
    this.#plot(plots(this.flights));
    this.portrait.load(this.flights);
    this.layouts.root.hidden = this.flights.length < 2; // this and the player change the size of the scene, which is read next
    this.player.show();
    this.#stage();
    if (first) this.#begin();
    if (first) this.stage?.compile();
    if (this.flights.length < 2) this.layout("overlay");
    this.#redraw();
    this.wake();
  }

  #plot(wanted) {
    for (const plot of this.plots.splice(wanted.length)) plot.root.remove();
    wanted.forEach((options, i) => {
      if (this.plots[i]) this.plots[i].load(options);
      else this.plots.push(new Plot(this.parts.plots, options, (t) => this.clock.seek(t)));
    });
  }

  /** The first flight has grown: go to its end, show its last `span` seconds, and in the plots too if it is `time` for that. */
  grown(span, time) {
    const [flight] = this.flights;
    Object.assign(this.clock, { start: flight.start, end: flight.end, time: flight.end });
    this.stage?.grow(span, time);
    if (time) {
      this.#plot(plots(this.flights, flight.end - span));
      this.portrait.load(this.flights, flight.end - span);
      this.#redraw();
    } else this.portrait.grow();
    this.wake();
  }

  #stage() {
    try {
      if (this.stage) this.stage.load(this.flights);
      else {
        this.stage = new Stage(this.parts.canvas, this.flights);
        this.captions = new Captions(this.parts.scene, this.parts.low);
        steer(this.parts.canvas, this.stage.rig, () => this.wake());
      }
      this.captions.load(this.flights);
    } catch (error) {
      this.parts.scene.classList.add("none");
      this.parts.note.textContent = "This browser shows no 3-D graphics (WebGL is off); the plots work without.";
    }
  }

  /** What a stage that is new has to be told. */
  #begin() {
    this.cameras.show(this.stage?.rig.preset);
    this.stage?.colour(this.theme.colours);
    this.#size();
    if (this.parts.scene.clientHeight < LOW) this.portrait.fold(true);
  }

  #choices() {
    const cameras = [
      ["overview", "Overview", "The whole flight (1)"], ["side", "Side", "Level, beside the vehicle (2)"],
      ["follow", "Follow", "Behind the vehicle (3)"], ["axis", "Above", "From above, along gravity: the paper's camera on its −e₃ axis (4)"],
    ];
    this.cameras = new Choice(this.parts.choices, "Camera", cameras, (name) => this.camera(name));
    const layouts = [["overlay", "Overlay", "One picture, the others as ghosts (g)"], ["beside", "Side by side", "A picture for each (g)"]];
    this.layouts = new Choice(this.parts.choices, "Layout", layouts, (name) => this.layout(name));
    this.movies = new Choice(this.parts.choices, "Movie", [["movie", "Movie", "Play once and save what is seen as a movie (m)"]], () => this.film());
    this.movies.root.hidden = !movieKind();
    this.movies.show("");
    const themes = [["toggle", "◐", "Light or dark (t)"]];
    this.themes = new Choice(this.parts.choices, "Theme", themes, () => this.theme.toggle());
  }

  #keys() {
    const { clock } = this;
    keys({
      " ": () => clock.toggle(),
      ArrowLeft: (far) => clock.seek(clock.time - (far ? 1 : STEP)),
      ArrowRight: (far) => clock.seek(clock.time + (far ? 1 : STEP)),
      ArrowUp: () => clock.shift(1),
      ArrowDown: () => clock.shift(-1),
      Home: () => clock.seek(clock.start),
      End: () => clock.seek(clock.end),
      g: () => this.layout(this.stage?.layout === "overlay" ? "beside" : "overlay"),
      t: () => this.theme.toggle(),
      m: () => this.film(),
      s: () => this.portrait.fold(),
      ...Object.fromEntries(PRESETS.map((name, i) => [String(i + 1), () => this.camera(name)])),
    });
  }

  /** Play once and save a movie of it, or stop doing so. */
  film() {
    if (this.recorder) this.recorder.stop();
    else if (this.stage && movieKind()) {
      this.recorder = new Recorder(this, (movie) => {
        this.recorder = null;
        this.movies.show("");
        if (movie) save(movie, this.title.replaceAll(/[^\p{L}\p{N}]+/gu, "-"));
      });
      this.movies.show("movie");
      this.recorder.start();
    }
  }

  camera(name) {
    if (!this.stage?.rig.choose(name)) return false;
    this.cameras.show(name);
    this.wake();
    return true;
  }

  layout(name) {
    if (!this.stage || !LAYOUTS.includes(name) || (name === "beside" && this.flights.length < 2)) return false;
    this.stage.layout = name;
    this.layouts.show(name);
    this.parts.scene.dataset.layout = name;
    this.wake();
    return true;
  }

  #paint(colours) {
    this.stage?.colour(colours);
    this.#redraw();
    this.wake();
  }

  /** Draw in the size that the scene has now, at once: what is drawn is lost with the old size. */
  #resize() {
    if (this.#size()) this.#frame(0);
  }

  /** Give the stage the size of the scene; true if it had another. */
  #size() {
    const { stage, parts: { scene: { clientWidth, clientHeight } } } = this, ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (!stage || !clientWidth || !clientHeight) return false;
    if (stage.width === clientWidth && stage.height === clientHeight && stage.ratio === ratio) return false;
    stage.resize(clientWidth, clientHeight, ratio);
    return true;
  }

  #redraw() {
    for (const plot of this.plots) {
      plot.draw(this.theme.colours);
      plot.show(this.clock.time);
    }
    if (!this.flights.length) return;
    this.portrait.draw(this.theme.colours);
    this.portrait.show(this.#poses());
  }

  #poses() {
    return this.flights.map((flight) => flight.at(this.clock.time));
  }

  /** Draw a frame soon: nothing is drawn while nothing changes. */
  wake() {
    this.dirty = true;
    this.waiting ??= requestAnimationFrame((now) => this.#tick(now));
  }

  #tick(now) {
    this.waiting = undefined;
    const elapsed = this.last === null ? 0 : Math.min((now - this.last) / 1000, 0.25);
    this.dirty = false;
    this.clock.tick(elapsed);
    const moving = this.#frame(elapsed);
    const going = this.clock.playing || moving || this.dirty;
    this.last = going ? now : null;
    if (going) this.wake();
  }

  #frame(elapsed) {
    const started = performance.now(), { stage, clock } = this, words = !clock.playing || !(started - this.told < WORDS);
    if (words) this.told = started;
    const poses = this.#poses();
    let moving = false;
    if (stage?.width) {
      stage.show(poses);
      moving = stage.render(elapsed || 1 / 60);
      this.captions.show(stage, clock.time, this.theme.colours, words);
      this.recorder?.frame();
      this.shoot?.();
    }
    this.player.show(words);
    for (const plot of this.plots) plot.show(clock.time, words);
    if (poses.length) this.portrait.show(poses, words);
    this.drew?.();
    this.drawn.count += 1;
    this.drawn.cost = [...this.drawn.cost.slice(-59), performance.now() - started];
    return moving;
  }

  /** What tests and other pages may use. */
  offer() {
    const { clock } = this;
    return Object.freeze({
      play: () => clock.play(), pause: () => clock.pause(), seek: (t) => clock.seek(t), speed: (value) => clock.setSpeed(value),
      time: () => clock.time, duration: () => clock.end - clock.start, playing: () => clock.playing,
      load: (runs) => this.load(runs),
      camera: (name) => this.camera(name), layout: (name) => this.layout(name), theme: (name) => this.theme.set(name),
      pose: (i = 0) => {
        const pose = this.flights[i].at(clock.time);
        return { ...pose, R: matrix(pose.quat_xyzw) };
      },
      phases: (i = 0) => structuredClone(this.flights[i].phases),
      screen: (i = 0) => {
        if (!this.stage) return null;
        this.#frame(0);
        return this.stage.screen(i);
      },
      frames: () => ({ count: this.drawn.count, milliseconds: [...this.drawn.cost] }),
    });
  }
}
