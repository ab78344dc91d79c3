// The engine of a page that flies by itself: machine code in a worker, which answers like the server of the laboratory.

import source from "worker:./worker.js";
import { floats } from "../flight.js";
import { kind as kindOf } from "../lab/setting.js";
import { clamp } from "../numbers.js";
import { packed, refused, request, unknown } from "./request.js";
import { judged } from "./verdict.js";

const CHUNK = { least: 2, first: 8, most: 64, time: 50 }; // directions of a map that are flown at a time, ms that they may take
const MOST = 6; // workers that stay
let address; // of the worker's text

/** Put `local` last into the map `opened` under `name`, and end those that were used longest ago. */
export function keep(opened, name, local) {
  opened.delete(name);
  opened.set(name, local);
  for (const [old, other] of opened) {
    if (opened.size <= MOST) break;
    other?.end();
    opened.delete(old);
  }
}

export class Local {
  /** `told` is called with every reply to a question that is still asked. */
  constructor({ engine, offer, runs }, told) {
    const { code, ...facts } = engine;
    const { columns, ...record } = runs[0];
    Object.assign(this, { facts, offer, told, record, number: 0, waiting: null, busy: false });
    address ??= URL.createObjectURL(new Blob([source], { type: "text/javascript" }));
    this.worker = new Worker(address);
    this.worker.addEventListener("message", ({ data }) => this.#answer(data));
    this.worker.postMessage({ kind: "load", code: Uint8Array.from(atob(code), (character) => character.charCodeAt(0)), facts });
  }

  /** Ask for a flight ("fly") or a map, or for no more of a map ("stop"); returns the number of the question. */
  ask(kind, content = {}, number = ++this.number) {
    this.mapping = null; // a map is of the setting that was
    if (kind === "stop") return number;
    const setting = this.whole(content.setting), message = this.#foreign(setting) || refused(setting, this.facts);
    if (message) queueMicrotask(() => this.told({ kind: "error", number, field: "", message }));
    else if (kind === "fly") {
      this.waiting = { number, setting };
      this.#next();
    } else this.#chunk({ number, setting: { ...setting, pokes: [] }, done: 0, size: CHUNK.first });
    return number;
  }

  /** What `setting` has of another page, where this one has a single flight to offer; "" if nothing. */
  #foreign(setting) {
    const { first, vehicles } = this.offer;
    if (!first || vehicles) return ""; // whoever has several has chosen this one
    const found = kindOf(setting) === kindOf(first) ? unknown(setting, this.facts) : kindOf(setting);
    return found && `setting: expected law, vehicle, plant and gains of this page, got ${found}`;
  }

  /** Fly the next directions of a map: the rod at rest there, the rest of the start as it is. */
  #chunk(mapping) {
    const { number, setting, done, size } = mapping, rods = this.directions.slice(done, done + size);
    this.mapping = { ...mapping, rods, done: done + rods.length };
    const starts = rods.map((y) => packed({ ...setting.start, y, y_dot: [0, 0, 0] }));
    this.worker.postMessage({ kind: "several", number, asked: request(setting, this.facts, this.offer.seed), starts, first: done });
  }

  #mapped({ number, endings, milliseconds }) {
    const { mapping } = this, total = this.directions.length;
    if (number !== mapping?.number) return; // another has been asked for
    const verdicts = endings.map((ending) => judged(ending, this.facts)), told = (name) => verdicts.map((verdict) => verdict[name]);
    this.told({ kind: "map", number, total, done: mapping.done, y: mapping.rods, settling: told("settling"), cause: told("cause") });
    const wanted = Math.round((endings.length * CHUNK.time) / Math.max(milliseconds, 1)), size = clamp(wanted, CHUNK.least, CHUNK.most);
    if (this.mapping === mapping && mapping.done < total) this.#chunk({ ...mapping, size });
  }

  /** Tell `done` the clearance (m) of the rod in each of `directions`, the rest of the start as in `setting`. */
  clear(setting, directions, done) {
    const { start } = this.whole(setting), number = ++this.number;
    this.clearing = { number, done };
    this.worker.postMessage({ kind: "clear", number, starts: directions.map((y) => packed({ ...start, y, y_dot: [0, 0, 0] })) });
  }

  /** The directions of a map's points, e3 up. */
  get directions() {
    return (this.spread ??= triples(Array.from(floats(this.offer.directions))));
  }

  /** Begin a flight that goes on: that of `setting`, up to `tick`; `flown` is told every piece, until the next begins. */
  begin(setting, tick, flown) {
    this.flown = flown;
    this.begun = ++this.number;
    this.worker.postMessage({ kind: "begin", number: this.begun, asked: request(this.whole(setting), this.facts, this.offer.seed), until: tick });
  }

  /** Whether `setting` has numbers that its machine code does not take: none that the page offers. */
  rebuilds() {
    return false;
  }

  /** Fly it on: `ticks`, gains, knobs, pokes and pull as the worker takes them. */
  advance(content) {
    this.worker.postMessage({ kind: "advance", number: this.begun, ...content });
  }

  /** Fly no more. */
  end() {
    this.worker.terminate();
  }

  /** A start that is a number becomes one of those that the package has drawn. */
  whole(setting) {
    const { random, ...given } = setting.start, { randoms } = this.offer;
    return random === undefined ? setting : { ...setting, start: { ...randoms[random % randoms.length], ...given } };
  }

  #next() {
    if (this.busy || !this.waiting) return;
    const { number, setting } = this.waiting;
    Object.assign(this, { busy: true, asked: setting, waiting: null });
    this.worker.postMessage({ kind: "fly", number, asked: request(setting, this.facts, this.offer.seed) });
  }

  #answer(reply) {
    if (reply.kind === "error") {
      this.busy = false;
      this.told({ ...reply, field: "" });
      this.#next();
      return;
    }
    if (reply.kind === "several") {
      this.#mapped(reply);
      return;
    }
    if (reply.kind === "clear") {
      if (reply.number === this.clearing.number) this.clearing.done(reply.clearances);
      return;
    }
    if (reply.kind === "piece") {
      if (reply.number === this.begun) this.flown?.(reply);
      return;
    }
    const { asked } = this, { number, columns, outcome, milliseconds } = reply, { x } = columns;
    const verdict = judged(outcome, this.facts, x[x.length - 1] - x[2]); // e3 is along gravity where it counts
    this.busy = false;
    this.told({
      kind: "flight", number, milliseconds, verdict, start: asked.start, sliders: this.sliders(asked),
      run: { ...this.record, columns, verdict, completed: outcome.status === 0, gains: gains(asked, this.record) },
    });
    this.#next();
  }

  /** The sliders with the values of a setting; what it does not tell is as usual. */
  sliders(setting) {
    return this.offer.sliders.map((facts) => {
      const stored = facts.path.split(".").reduce((table, key) => table?.[key], setting);
      return stored === undefined ? facts : { ...facts, value: read(facts.put, stored) };
    });
  }
}

const triples = (flat) => Array.from({ length: flat.length / 3 }, (_, i) => flat.slice(3 * i, 3 * i + 3));

/** What a slider's `put` was filled with to become `stored`; see setting.js. */
function read(put, stored) {
  if (put === null || put === undefined) return stored;
  if ("#" in Object(put)) return stored / put["#"];
  for (const key of Object.keys(Object(put))) {
    const value = read(put[key], stored[key]);
    if (typeof put[key] === "object" && Number.isFinite(value)) return value;
  }
  return NaN;
}

/** The gains of a legend, in which those of the setting stand for those of the flight that was recorded. */
function gains({ law }, { gains: shown }) {
  return shown.map(([name, value]) => [name, name in law.gains ? String(+law.gains[name].toPrecision(4)) : value]);
}
