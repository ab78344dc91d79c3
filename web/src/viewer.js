// The viewer: puts scene, plots and player together for runs, and offers what becomes `window.flypend`.
//
// window.flypend: play(), pause(), seek(t), time(), duration(), playing(), speed(s), load(runs), camera(name),
// layout(name), theme(name), pose(i = 0) with t, x, R (rows), y, ... in the frame of run i, phases(i), floor() with its height, screen(i) with the pixels of pivot and bob,
// frames() with the number of frames drawn and the milliseconds that the last sixty took to draw.

import css from "./replay.css";
import { Captions } from "./captions.js";
import { Clock } from "./clock.js";
import { Choice, Player, keys } from "./controls.js";
import { Flight, rise } from "./flight.js";
import { help } from "./help.js";
import { frame, legend } from "./layout.js";
import { matrix } from "./numbers.js";
import { calm } from "./motion.js";
import { Opening } from "./opening.js";
import { Plot } from "./plots.js";
import { Portrait } from "./portrait.js";
import { canFilm, Film, save, SIZES } from "./record.js";
import { plots } from "./series.js";
import { steer } from "./scene/pointers.js";
import { PRESETS } from "./scene/rig.js";
import { LAYOUTS, Stage } from "./scene/stage.js";
import { Theme } from "./theme.js";

const STEP = 1 / 30; // s, of the arrow keys
const LOW = 380, NARROW = 480; // CSS pixels, height and width of a picture below which the phase portrait is put away until it is asked for
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
    addEventListener("message", ({ source, data }) => source === parent && source !== window && this.#suit(data)); // of the page around a frame
    this.theme.set(this.theme.name); // before the scene is measured: borders have their width by their colours
    if (runs.length) this.load(runs);
    this.layouts.root.hidden = this.flights.length < 2;
    this.layout(layout);
    this.since = null;
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

  /** Take theme and size of letters of the page around. */
  #suit(data) {
    if (data?.letters > 0) document.documentElement.style.fontSize = `${14 * data.letters}px`;
    this.theme.set(data?.theme);
  }

  /** Play by itself, see opening.js; to those who want little motion, say how. */
  open(settled) {
    if (!calm()) {
      this.opening = new Opening(this, settled);
      return;
    }
    const { invite } = this.parts;
    Object.assign(invite, { hidden: false, textContent: "Press play, or the space bar" });
    const [flight] = this.flights, { y } = flight.at(flight.start);
    invite.classList.toggle("under", rise(y, flight.e3)[2] > 0); // not where the bob is
    for (const name of ["pointerdown", "keydown"]) document.addEventListener(name, () => (invite.hidden = true), { capture: true, once: true });
  }

  /** Somebody takes over: what played by itself goes on as usual. */
  take() {
    this.opening?.end();
    this.opening = null;
  }

  #plot(every) {
    const wanted = this.only ? every.filter(({ plain }) => plain === this.only) : every;
    for (const plot of this.plots.splice(wanted.length)) plot.root.remove();
    wanted.forEach((options, i) => {
      if (this.plots[i]) this.plots[i].load(options);
      else this.plots.push(new Plot(this.parts.plots, options, (t) => this.clock.seek(t)));
    });
  }

  /**
   * The first flight has grown: go to its end, unless it is paused, show its last `span` seconds, and in the plots too if
   * it is `time` for that.
   */
  grown(span, time) {
    const [flight] = this.flights, { clock } = this;
    Object.assign(clock, { start: flight.start, end: flight.end, time: clock.playing ? flight.end : clock.time });
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
  }

  #choices() {
    const cameras = [
      ["overview", "Overview", "The whole flight (1)"], ["side", "Side", "Level, beside the vehicle (2)"],
      ["follow", "Follow", "Behind the vehicle (3)"], ["axis", "Above", "From above, along gravity: the paper's camera on its −e₃ axis (4)"],
    ];
    this.cameras = new Choice(this.parts.choices, "Camera", cameras, (name) => this.camera(name));
    const layouts = [["overlay", "Overlay", "One picture, the others as ghosts (g)"], ["beside", "Side by side", "A picture for each (g)"]];
    this.layouts = new Choice(this.parts.choices, "Layout", layouts, (name) => this.layout(name));
    this.movies = new Choice(this.parts.choices, "Movie", [["movie", "Movie", "Save the flight as a movie, at the chosen speed (m)"]], () => this.film());
    this.sizes = Object.assign(document.createElement("select"), { className: "sizes", ariaLabel: "Size of movies and pictures" });
    this.sizes.append(...Object.keys(SIZES).map((name) => new Option(name, name)));
    this.movies.root.append(this.sizes);
    this.movies.root.hidden = !canFilm();
    this.movies.show("");
    const themes = [["toggle", "◐", "Light or dark (t)"]];
    this.themes = new Choice(this.parts.choices, "Theme", themes, () => this.theme.toggle());
    this.helps = new Choice(this.parts.choices, "Help", [["help", "?", "What everything does (?)"]], () => help(document.querySelector("main")));
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
      "?": () => help(document.querySelector("main")),
      ...Object.fromEntries(PRESETS.map((name, i) => [String(i + 1), () => this.camera(name)])),
    });
  }

  /** Pixels of movies and pictures, or null: those of the scene. */
  get size() {
    return SIZES[this.sizes.value];
  }

  /** Save a movie of the flight, or of what a flight that goes on flies until this is called again; or leave off. */
  film() {
    const { clock } = this;
    if (!this.stage || !canFilm()) return;
    this.take();
    if (this.filming) this.filming.stop();
    else if (clock.drive && this.since === null) {
      this.since = clock.time;
      this.movies.show("movie");
    } else this.#film(clock.drive ? Math.max(this.since, clock.start) : clock.start);
  }

  async #film(from) {
    const { clock, movies: { buttons: [button] } } = this, name = this.title.replaceAll(/[^\p{L}\p{N}]+/gu, "-"), { playing } = clock;
    clock.pause();
    this.filming = new Film(this, this.size, (share) => (button.textContent = `${Math.round(100 * share)} %`));
    this.parts.scene.classList.add("filming");
    this.movies.show("movie");
    this.parts.note.textContent = "";
    try {
      const movie = await this.filming.shoot(from, clock.end);
      if (movie) save(movie, `${name}.webm`);
    } catch ({ message }) {
      this.parts.note.textContent = `There is no movie: ${message}`;
    } finally {
      Object.assign(this, { filming: null, since: null });
      button.textContent = "Movie";
      this.movies.show("");
      this.parts.scene.classList.remove("filming");
      this.resume();
      if (clock.drive && playing) clock.play();
    }
  }

  /** Draw the scene of the time shown in `width` by `height` pixels, `scale` of them to a CSS pixel, `elapsed` seconds after the last. */
  expose({ width, height, scale }, elapsed) {
    this.stage.resize(width / scale, height / scale, scale);
    this.stage.show(this.#poses());
    this.stage.render(elapsed);
  }

  /** Go on in the size of the scene. */
  resume() {
    this.#size();
    this.wake();
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
    const small = clientHeight < LOW || clientWidth < NARROW;
    if (small && !this.small) this.portrait.fold(true); // it would lie on the words
    this.small = small;
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
    if (stage?.width && !this.filming) {
      stage.show(poses);
      moving = stage.render(elapsed || 1 / 60);
      this.captions.show(stage, clock.time, this.theme.colours, words);
    }
    this.opening?.frame();
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
    const { clock } = this, taking = (act) => (value) => {
      this.take();
      return act(value);
    };
    return Object.freeze({
      play: taking(() => clock.play()), pause: taking(() => clock.pause()), speed: taking((value) => clock.setSpeed(value)),
      seek: (t) => {
        if (this.opening) clock.pause(); // it is shown to be looked at
        this.take();
        clock.seek(t);
      },
      time: () => clock.time, duration: () => clock.end - clock.start, playing: () => clock.playing,
      load: taking((runs) => this.load(runs)),
      camera: (name) => this.camera(name), layout: (name) => this.layout(name), theme: (name) => this.theme.set(name),
      pose: (i = 0) => {
        const pose = this.flights[i].at(clock.time);
        return { ...pose, R: matrix(pose.quat_xyzw) };
      },
      floor: () => this.stage?.world.ground ?? null,
      phases: (i = 0) => structuredClone(this.flights[i].phases),
      recoveries: (i = 0) => this.flights[i].recoveries(clock.time).all.map(({ begin, end, distance, lost }) => ({ begin, time: end === null ? null : end - begin, distance, height_lost: lost })),
      screen: (i = 0) => {
        if (!this.stage) return null;
        this.#frame(0);
        return this.stage.screen(i);
      },
      frames: () => ({ count: this.drawn.count, milliseconds: [...this.drawn.cost] }),
    });
  }
}
