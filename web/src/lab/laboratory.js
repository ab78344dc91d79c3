// The laboratory: a viewer beside controls; what they say goes to an engine, what comes back is shown at once.
//
// window.flypend is that of the viewer (docs/pages/replay.md) and: setting(), verdict(), number() of the last question, shown() of
// the last flight that is shown, timings() in ms of the last ones, map() with the points so far and the way of the rod; and
// live(), poke(), pull(), see docs/pages/live.md.

import css from "../replay.css";
import own from "../lab.css";
import { Choice, keys } from "../controls.js";
import { judge } from "../layout.js";
import { isWhole } from "../live/request.js";
import { asked, Kiosk } from "../live/kiosk.js";
import { Running } from "../live/running.js";
import { Saving } from "../live/saving.js";
import { calm } from "../motion.js";
import { dot, unit } from "../numbers.js";
import { Viewer } from "../viewer.js";
import { Handle } from "./handle.js";
import { Map as Disc } from "./map.js";
import { Panel } from "./panel.js";
import { kind, Setting } from "./setting.js";
import { Story } from "./story.js";

const MAP_DELAY = 250; // ms without a change before a map is asked for
const AT_ONCE = 0.02; // s: a flight so short has ended where it began
const ROOM = 0.005; // m of clearance at a start that is free
const SLOW = 0.25, BEFORE = 0.15; // of the speed, and s before it: of a phase that a chapter shows
const HOLD = 400; // ms without a slider's move before the camera goes where the new flight needs it

export class Laboratory {
  /** With the engine that `connect` makes of a listener to replies and one to the connection: see link.js, live/local.js. */
  constructor(data, connect) {
    this.offer = data.offer;
    this.link = connect((reply) => this.#told(reply), (words) => this.#say(words)); // first: its worker starts beside the page
    this.viewer = new Viewer({ ...data, runs: [] }, css + own); // until the engine has flown
    this.pinned = data.runs;
    this.main = document.querySelector("main");
    this.main.classList.add("lab");
    this.setting = new Setting(data.offer.first, () => this.changed(), (setting) => this.#linked(setting));
    Object.assign(this, { asked: 0, shown: 0, clock: new Map(), times: [], tab: "flight" });
    this.#header();
    this.running = new Running(this);
    this.panel = new Panel(this.main, this);
    const figure = this.#figure();
    if (this.offer.story?.length) this.story = new Story(this.panel.bar, figure ? [{ ...figure, phase: null }] : this.offer.story, this);
    this.handle = new Handle(this.viewer, (y) => this.rod(y), (place) => (this.kiosk ?? this.running).pull(place));
    this.disc = new Disc(this.main, (y) => {
      this.rod(y);
      this.show("flight");
    });
    this.viewer.drew = () => {
      this.handle.show(this.running.on, this.running.pulling);
      this.kiosk?.frame();
    };
    this.saving = new Saving(this);
    keys({ p: () => this.panel.poke("bob"), l: () => this.running.toggle(), r: () => this.restart(), k: () => this.exhibit(), Escape: () => this.kiosk && this.exhibit() });
    this.#undoKeys();
    if (asked() !== null) this.kiosk = new Kiosk(this, { quiet: asked() });
    if (this.setting.unreadable) this.#notice("The address holds no setting that can be read. This is the usual start.");
    if (figure) this.#watched();
    else if (this.offer.chapters && !location.hash) this.story.go(0);
    else this.changed();
  }

  /** The step that the address asks for, as ?figure=throw: the page is then a figure of a text, with one slider and one plot. */
  #figure() {
    const name = new URLSearchParams(location.search).get("figure");
    const figure = name && [...(this.offer.story ?? []), ...(this.offer.figures ?? [])].find((step) => step.name === name);
    if (!figure) return null;
    this.main.classList.add("figure");
    this.viewer.only = figure.plot;
    return figure;
  }

  /** Fly a figure when half of it is in sight, and play it by itself only while it is. */
  #watched() {
    const { clock } = this.viewer;
    new IntersectionObserver(([{ isIntersecting }]) => {
      if (isIntersecting && !this.story.told) this.story.go(0);
      else if (this.viewer.opening) isIntersecting ? clock.play() : clock.pause();
    }, { threshold: 0.5 }).observe(this.main);
  }

  #header() {
    const header = this.main.querySelector("header");
    this.tabs = new Choice(header, "View", [["flight", "Flight", "The flight and its plots"], ["map", "Region of attraction", "From which directions of the rod it settles"]], (name) => this.show(name));
    this.words = document.createElement("p");
    Object.assign(this.words, { className: "verdict", ariaLive: "polite" });
    header.append(this.words);
    this.busy = document.createElement("p");
    Object.assign(this.busy, { className: "busy", role: "status", textContent: "starting…" }); // until the engine says more
    this.viewer.parts.scene.append(this.busy);
    this.note = document.createElement("p");
    Object.assign(this.note, { className: "notice", hidden: true });
    this.note.setAttribute("role", "alert");
    this.viewer.parts.scene.append(this.note);
    this.tabs.show("flight");
  }

  #say(words) {
    this.busy.textContent = words;
    this.busy.hidden = !words;
  }

  /** Say `words` over the picture until the next flight, with a button that does `action`, if there is one. */
  #notice(words, [name, action] = []) {
    this.note.textContent = words;
    this.note.hidden = !words;
    if (!name) return;
    const button = document.createElement("button");
    Object.assign(button, { type: "button", textContent: name });
    button.addEventListener("click", action);
    this.note.append(" ", button);
  }

  #undoKeys() {
    document.addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.key.toLowerCase() !== "z" || event.target.closest("textarea")) return;
      event.preventDefault();
      if (event.shiftKey) this.setting.redo();
      else this.setting.undo();
    });
  }

  // What the controls do -----------------------------------------------------------------------------------------

  slide(facts, value) {
    this.touched = facts.path;
    if (!this.running.on) this.#hold();
    this.setting.slide(facts, value);
  }

  /** Hold the camera while a slider moves: flights are compared better from one place, and nothing is drawn on the way. */
  #hold() {
    const { stage } = this.viewer;
    stage?.hold("slider", true);
    clearTimeout(this.held);
    this.held = setTimeout(() => {
      stage?.hold("slider", false);
      this.viewer.wake();
    }, HOLD);
  }

  choose(path, name) {
    this.touched = path;
    this.running.go(false);
    const value = structuredClone(this.setting.value), { mount } = value.vehicle;
    if (path === "law.name") value.law = { name, gains: {} };
    else if (path === "vehicle.mount") value.vehicle.mount = name;
    else if (path === "vehicle.base") Object.assign(value, { vehicle: { base: name, mount }, law: { name: value.law.name, gains: {} } });
    else if (path === "plant.sensors") value.plant = sensed(value.plant, name);
    else value.plant = sensed({ base: name }, value.plant.sensors);
    this.setting.replace(value);
  }

  reset(group) {
    const value = structuredClone(this.setting.value);
    if (group === "gains") value.law.gains = {};
    else if (group === "place") delete value.origin;
    else if (group === "defects") delete value.plant.defects;
    else Object.assign(value, { plant: { ...sensed({ base: value.plant.base }, value.plant.sensors), ...kept(value.plant) }, vehicle: { base: value.vehicle.base, mount: value.vehicle.mount } });
    this.setting.replace(value);
  }

  /** Begin elsewhere; pokes belong to the flight that was. */
  start(start) {
    this.touched = "start.y.tilt";
    if (!this.running.on) {
      this.viewer.clock.pause();
      this.viewer.clock.seek(this.viewer.clock.start);
    }
    this.setting.replace({ ...this.setting.value, start, pokes: [] });
    this.running.restart();
  }

  /** Begin again: a live flight at its start, another with all as it was at first. */
  restart() {
    if (this.running.on) this.running.restart();
    else this.preset(this.offer.first);
  }

  /** Keep the flight that is shown as a ghost, or let it go. */
  pin() {
    if (!this.record) return;
    this.pinned = this.pinned.length ? [] : [{ ...this.record, title: "pinned" }];
    this.panel.pins(this.pinned.length > 0);
    if (!this.running.on) this.#load();
  }

  rod(y) {
    this.start({ ...this.setting.value.start, y: unit(y) });
  }

  preset(setting) {
    this.running.go(false);
    this.viewer.clock.pause();
    this.viewer.clock.seek(this.viewer.clock.start);
    this.steady = null;
    this.setting.replace(setting);
  }

  /** Show the flight of the setting as on opening: it plays by itself, and hands over once the rod stands. */
  repeat() {
    this.again = true;
    this.preset(this.setting.value);
  }

  /** Take the `setting` of another address; where a flight goes on, it is shown as on opening, with its start and pokes. */
  #linked(setting) {
    this.again = this.running.on;
    if (this.again) this.preset(setting);
    else this.setting.replace(setting);
  }

  /** Become a kiosk, over the whole screen where that is possible, or a laboratory again. */
  exhibit() {
    if (this.kiosk) {
      this.kiosk.end();
      this.kiosk = null;
      if (document.fullscreenElement) document.exitFullscreen();
      return;
    }
    if (!this.running.able) return;
    this.show("flight");
    this.panel.tune(false);
    this.main.requestFullscreen?.().catch(() => {}); // a frame may not
    this.kiosk = new Kiosk(this, { leave: () => this.exhibit() });
  }

  /** Show the flight of a chapter and play it, from its beginning or slowly from its phase. */
  tell({ setting, phase }) {
    this.show("flight");
    this.follow = true;
    this.preset(setting);
    this.phase = phase;
    this.viewer.clock.setSpeed(phase ? SLOW : 1);
  }

  /** Go to the phase that is told. */
  #seek() {
    const { clock, flights: [flight] } = this.viewer, begun = flight.phases.find(({ name }) => name === this.phase)?.from;
    if (begun !== undefined) clock.seek(begun - BEFORE);
    this.phase = null;
  }

  /** Hit a body at the time shown; what was before stays, what came after is flown anew. */
  poke(on, way, speed) {
    const { clock, stage } = this.viewer;
    const { right = [1, 0, 0], back = [0, -1, 0] } = stage?.views[0] ?? {};
    const level = unit([back[0], back[1], 0]);
    const [sign, along] = { right: [1, right], left: [-1, right], away: [-1, level], towards: [1, level], up: [1, [0, 0, 1]], down: [-1, [0, 0, 1]] }[way];
    if (this.running.on) {
      this.running.poke(on, along.map((value) => sign * speed * value));
      return;
    }
    const time = Math.max(clock.time, 0);
    const earlier = (this.setting.value.pokes ?? []).filter((poke) => poke.time < time - 1e-9);
    this.touched = "pokes.velocity";
    this.follow = true;
    this.setting.replace({ ...this.setting.value, pokes: [...earlier, { time, on, velocity: along.map((value) => sign * speed * value) }] });
  }

  unpoke() {
    this.setting.replace({ ...this.setting.value, pokes: [] });
  }

  /** Show a tab: "flight" or "map", which is of flights that begin and end. */
  show(tab) {
    if (tab === "map") this.running?.go(false);
    this.tab = tab;
    this.main.dataset.tab = tab;
    this.disc.root.hidden = tab !== "map";
    this.tabs.show(tab);
    if (tab === "map") this.#map();
    else {
      clearTimeout(this.mapping);
      this.link.ask("stop");
    }
  }

  // Questions and answers ----------------------------------------------------------------------------------------

  /** The setting has changed: ask for its flight, or tell the one that goes on. */
  changed() {
    this.panel.setting(this.setting.value);
    this.story?.changed(this.setting.value);
    if (this.running.on) {
      if (this.running.follows(this.setting.value)) this.running.change();
      else this.running.go(false); // and ask
      return;
    }
    this.asked = this.link.ask("fly", { setting: this.setting.value });
    this.clock.set(this.asked, performance.now());
    if (this.tab === "map") this.#map();
  }

  #map() {
    const { duration, start } = this.setting.value;
    this.disc.clear(duration, start.y);
    this.mapped = -1;
    clearTimeout(this.mapping);
    this.mapping = setTimeout(() => (this.mapped = this.link.ask("map", { setting: this.setting.value })), MAP_DELAY);
  }

  #told(reply) {
    if (reply.kind === "flight") this.#flight(reply);
    else if (reply.kind === "preview") this.#preview(reply);
    else if (reply.kind === "able") this.#able();
    else if (reply.number === this.panel.asked) this.panel.texts(reply); // or an error, which has none
    else if (reply.kind === "map" && reply.number === this.mapped) this.disc.add(reply);
    else if (reply.kind === "compiling" && reply.number >= this.shown) this.#say("compiling…");
    else if (reply.kind === "error" && reply.number === this.asked) this.#error(reply);
    else if (reply.kind === "error" && reply.number === this.mapped) this.disc.refuse(reply.message);
  }

  #flight(reply) {
    if (reply.number < this.shown) return;
    this.shown = reply.number;
    if (reply.number > (this.previewed ?? 0)) this.#picture(reply);
    this.verdict = reply.verdict;
    judge(this.words, reply.verdict);
    if (reply.number === this.asked) {
      this.#say("");
      this.adopt(reply.start);
      // A live flight's sliders may have moved on since it was asked for.
      this.panel.flight(this.running.on ? { ...reply, sliders: this.link.sliders(this.setting.value) } : reply);
      if (!this.running.on) this.panel.fell(reply.verdict.good ? "" : "Fails");
      this.#barred();
      if (this.viewer.stage && reply.verdict.part && this.viewer.flights[0].end < AT_ONCE) this.#notice(`${capital(reply.verdict.reason)} at the start. Shaded directions are taken.`, ["Move to a free start", () => this.free()]);
      this.story?.flown(this.setting.value, reply.sliders);
      if (this.phase) this.#seek();
      if (this.follow && !calm()) this.viewer.clock.play();
      this.follow = false;
      if (this.again) this.#open();
    }
  }

  /** Play by itself from the start. */
  #open() {
    this.again = false;
    this.viewer.clock.seek(this.viewer.clock.start);
    this.viewer.open(() => this.#handOver());
  }

  /** Show a flight that the page has flown by itself, before the server confirms it. */
  #preview(reply) {
    if (reply.number <= this.shown || reply.number < (this.previewed ?? 0) || this.running.on) return;
    this.previewed = reply.number;
    this.#picture(reply);
    judge(this.words, reply.verdict);
  }

  #picture(reply) {
    const first = !this.flew;
    if (first) performance.mark("flypend flown"); // and "flypend drawn": marks that browsers keep of a page
    if (!first || this.main.classList.contains("stale")) this.#notice(""); // what is said of the address stays at first
    this.main.classList.remove("stale");
    this.flew = true;
    // The picture is not turned round by a gain: the camera keeps the direction of the first flight of a preset.
    this.steady ??= reply.run.direction;
    this.record = { ...reply.run, direction: this.steady };
    if (!this.running.on) this.#load();
    if (first) this.#open();
    this.disc.follow(this.viewer.flights[0]);
    const begun = this.clock.get(reply.number);
    for (const number of this.clock.keys()) if (number <= reply.number) this.clock.delete(number);
    if (begun === undefined) return;
    const ready = performance.now() - begun; // all but the picture, for which the browser may let one wait
    requestAnimationFrame(() => {
      if (first) performance.mark("flypend drawn");
      this.times = [...this.times.slice(-199), { here: reply.kind === "preview", flown: reply.milliseconds, ready, picture: performance.now() - begun }];
    });
  }

  /** Once the rod stands, let the flight go on, if the page can and tells no chapter: it is there to be grabbed. */
  #handOver() {
    if (!this.story?.told && this.running.able && this.record.e3 === "up") this.running.go(true);
    return this.running.on;
  }

  /** Whether the setting is that of the opening. */
  get usual() {
    return JSON.stringify(this.setting.value) === JSON.stringify(this.offer.first);
  }

  /** The flights beside that of the setting: those that are pinned unless it is they. */
  get ghosts() {
    return this.offer.vehicles || !this.usual || this.pinned[0]?.title === "pinned" ? this.pinned : [];
  }

  #load() {
    this.viewer.load([this.record, ...this.ghosts]);
  }

  #able() {
    this.panel.able(this.running.able);
    this.#barred();
  }

  /** Shade where the rod would touch at the start. */
  #barred() {
    const { value } = this.setting, { stage } = this.viewer, asked = JSON.stringify([kind(value), value.start.R]);
    if (!stage || !this.record || !this.running.able || asked === this.barred) return;
    this.barred = asked;
    if (this.record.vehicle.mount === "gimbal") stage.barred.take([]);
    else this.link.clear(value, stage.barred.directions, (clearances) => {
      stage.barred.take(clearances);
      this.viewer.wake();
    });
  }

  /** Begin with the rod in the nearest direction in which it touches nothing. */
  free() {
    const { value } = this.setting, { directions } = this.viewer.stage.barred;
    this.link.clear(value, directions, (clearances) => {
      const near = directions.filter((_, i) => clearances[i] > ROOM).sort((a, b) => dot(b, value.start.y) - dot(a, value.start.y));
      if (near.length) this.rod(near[0]);
    });
  }

  /** A start that is random, or not told in full, comes back in numbers, which the setting then keeps. */
  adopt(start) {
    if (isWhole(this.setting.value.start)) return;
    this.setting.adopt(start);
    this.panel.setting(this.setting.value);
  }

  #error({ number, field, message }) {
    this.shown = number;
    this.follow = false;
    this.#say("");
    this.panel.complain(message, field, this.touched);
    this.verdict = { words: message, good: false, state: "failed" };
    judge(this.words, { words: "not flown", state: "failed" });
    this.viewer.clock.pause();
    if (!this.flew && !this.usual) this.#begin(message);
    else {
      this.main.classList.add("stale");
      const undo = this.setting.past.length ? ["Undo", () => this.setting.undo()] : [];
      this.#notice(`Not flown. ${message}.${this.flew ? " The picture is of the last flight." : ""}`, undo);
    }
  }

  /** Nothing has been flown yet: an address that leads to no flight is no dead end. */
  #begin(message) {
    this.#notice(`The setting of the address cannot be flown (${message}). This is the usual start.`);
    this.setting.replace(this.offer.first);
  }

  provide() {
    const taking = (act) => (...given) => {
      this.viewer.take();
      return act(...given);
    };
    return Object.freeze({
      ...this.viewer.offer(),
      setting: () => structuredClone(this.setting.value), verdict: () => this.verdict, number: () => this.asked,
      shown: () => this.shown, timings: () => structuredClone(this.times), tab: taking((name) => this.show(name)),
      live: () => this.running.told(), go: taking((on) => this.running.go(on)), poke: taking((on, velocity) => this.running.poke(on, velocity)),
      pull: taking((place) => this.running.pull(place)), pin: () => this.pin(),
      map: () => ({ total: this.disc.total, done: this.disc.points.length, good: this.disc.good, points: structuredClone(this.disc.points), path: this.disc.path }),
    });
  }
}

const capital = (words) => words[0].toUpperCase() + words.slice(1);

/** What a plant tells of its sensors' defects. */
const kept = ({ defects }) => (defects ? { defects } : {});

/** A plant with the `sensors` of that name, which have noise and defects of their own; undefined for perfect ones. */
function sensed({ noise, sensors: old, defects, ...plant }, sensors) {
  return sensors && sensors !== "perfect" ? { ...plant, sensors } : { ...plant, ...(noise && { noise }) };
}
