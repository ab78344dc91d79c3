// A flight that goes on, at the pace of the wall: gains and plant change under way, a hand pokes and pulls.

import { kind } from "../lab/setting.js";
import { judge } from "../layout.js";
import { degrees } from "../numbers.js";
import { Growing } from "./growing.js";
import { blow, turned } from "./request.js";
import { judged } from "./verdict.js";

const SPAN = 8; // s that plots and paths show
const REDRAW = 250; // ms between two drawings of the plots
const LATE = 0.1; // s of flight that one picture asks for at most: a slow page flies slowly
const PULL = { stiffness: 60, damping: 6, most: 1.5 }; // per kg of the bob, 1/s² and 1/s; the most in weights of all

export class Running {
  /** Of the laboratory `lab`, whose engine may be able to. */
  constructor(lab) {
    Object.assign(this, { lab, on: false, pokes: [], pulling: null, due: 0, asked: false, drawn: 0 });
  }

  /** Whether the page has machine code for the present setting. */
  get able() {
    return Boolean(this.lab.link.facts);
  }

  /** Whether the flight can go on with `setting`. */
  follows(setting) {
    const { link } = this.lab;
    return kind(setting) === this.kind && !link.rebuilds(setting);
  }

  toggle() {
    this.go(!this.on);
  }

  /** Let the flight go on from where the clock stands, or stop and show the flight of the setting. */
  go(on) {
    if (on === this.on || (on && !this.able)) return;
    this.on = on;
    const { viewer, main } = this.lab;
    main.classList.toggle("running", on);
    this.lab.panel.live(on);
    if (on) this.lab.show("flight");
    if (on) this.#begin(Math.round(viewer.clock.time / this.lab.link.facts.period));
    else {
      viewer.clock.follow(null);
      this.lab.changed();
    }
  }

  /** Begin again at the start of the setting. */
  restart() {
    if (this.on) this.#begin(0);
  }

  #begin(tick) {
    const { lab } = this, { clock } = lab.viewer;
    lab.adopt(lab.link.whole(lab.setting.value).start);
    Object.assign(this, { kind: kind(lab.setting.value), pokes: [], poked: 0, pulling: null, due: 0, asked: true, flight: null, stood: false });
    lab.panel.fell("");
    this.change();
    clock.follow((elapsed, speed) => this.#drive(elapsed * speed));
    lab.link.begin(lab.setting.value, Math.max(tick, 1), (piece) => this.#flown(piece));
  }

  /** Gains and knobs of the setting, for the next piece. */
  change() {
    const { link, setting, panel } = this.lab;
    this.turned = turned(setting.value, link.facts, true);
    panel.sliders(link.sliders(setting.value));
  }

  /** Hit a body now, so that it would have another `velocity` if it were free. */
  poke(on, velocity) {
    if (this.on) this.pokes.push(blow(on, velocity, this.lab.link.facts));
  }

  /** Pull the bob towards a place (e3 up, m), or no more (null). */
  pull(place) {
    const { facts } = this.lab.link, { stiffness, damping, most } = PULL, mass = facts.masses.bob;
    this.pulling = this.on && place ? { place, stiffness: stiffness * mass, damping: damping * mass, most: most * this.lab.record.vehicle.weight } : null;
  }

  /** Ask for the next piece, unless one is under way. */
  #drive(elapsed) {
    this.due = Math.min(this.due + elapsed, LATE);
    const { period } = this.lab.link.facts, ticks = Math.floor(this.due / period + 1e-9);
    if (this.asked || ticks < 1 || this.over) return;
    this.due -= ticks * period;
    this.asked = true;
    this.lab.link.advance({ ticks, ...this.turned, pokes: this.pokes, pull: this.pulling });
    this.poked += this.pokes.length;
    this.pokes = [];
  }

  #flown({ columns, outcome, tick }) {
    if (!this.on) return;
    const { lab } = this, { viewer } = lab, verdict = judged(outcome, lab.link.facts);
    Object.assign(this, { asked: false, tick, over: outcome.status !== 0 });
    if (!columns.t.length) return;
    const told = { verdict: this.over ? verdict : { words: "live", state: "recovering", settling: null }, completed: !this.over };
    if (!this.flight) {
      this.flight = new Growing({ ...lab.record, columns, ...told });
      viewer.load([this.flight, ...lab.ghosts]);
    } else this.flight.take(columns, told);
    const now = performance.now(), redraw = now - this.drawn > REDRAW || this.over;
    if (redraw) {
      this.drawn = now;
      this.#say(verdict);
    }
    viewer.grown(SPAN, redraw);
    if (this.over) viewer.clock.pause();
  }

  #say(verdict) {
    const { y } = this.flight.at(this.flight.end), sign = this.flight.e3 === "up" ? 1 : -1;
    const lean = degrees(sign * y[2]), state = this.flight.state(this.flight.end);
    const words = this.over ? verdict.words : state === "done" ? "live: upright" : `live: recovering, rod ${lean.toFixed(0)}° from upright`;
    this.#fall(state, sign * y[2] < 0);
    this.lab.verdict = { words, good: state === "done", state };
    judge(this.lab.words, { words, state, reason: verdict.reason });
  }

  /** Once the rod has been upright (`state`), say at which sizes of the sensors' defects it is `down`. */
  #fall(state, down) {
    this.stood ||= state === "done";
    if (!this.stood || !(down || this.over)) return;
    this.stood = false;
    this.lab.panel.fell(`Fell after ${this.flight.end.toFixed(1)} s`);
  }

  /** For tests: how far the flight is, and its last state. */
  told() {
    return { on: this.on, tick: this.tick, over: Boolean(this.over), pulled: this.pulling !== null, poked: this.poked, samples: this.flight?.t.length ?? 0 };
  }
}
