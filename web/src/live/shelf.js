// The engine of a laboratory without a server: machine code for each vehicle, law and plant that its page offers.

import { kind } from "../lab/setting.js";
import { keep, Local } from "./local.js";
import { untaken } from "./request.js";

export class Shelf {
  /** `told` is called with every reply to a question that is still asked. */
  constructor({ engines, offer }, told) {
    Object.assign(this, { engines, offer, told, number: 0, opened: new Map(), local: null });
  }

  /** Ask for something of a `kind`; returns the number of the question. */
  ask(kind, content = {}) {
    const number = ++this.number, lacking = kind === "stop" ? "" : this.#open(content.setting);
    if (lacking) queueMicrotask(() => this.told({ kind: "error", number, field: "", message: `this page cannot fly ${lacking}; flypend lab can` }));
    else this.local?.ask(kind, content, number);
    return number;
  }

  /** Take up the machine code for `setting`; returns what it lacks, or "". */
  #open(setting) {
    const name = kind(setting), stored = Object.hasOwn(this.engines, name) && this.engines[name];
    const lacking = stored ? untaken(setting, stored.engine) : name;
    const local = lacking ? null : this.opened.get(name) ?? this.#made(stored);
    if (this.local && this.local !== local) this.local.ask("stop");
    if (local) keep(this.opened, name, local);
    this.local = local;
    return lacking;
  }

  #made({ engine, sliders, record }) {
    return new Local({ engine, offer: { ...this.offer, sliders, seed: 0 }, runs: [record] }, this.told);
  }

  // A flight that goes on ------------------------------------------------------------------------------------------

  get facts() {
    return this.local?.facts;
  }

  /** Whether `setting` has numbers that its machine code does not take. */
  rebuilds(setting) {
    return Boolean(untaken(setting, this.facts));
  }

  begin(setting, tick, flown) {
    this.local.begin(setting, tick, flown);
  }

  advance(content) {
    this.local.advance(content);
  }

  clear(setting, directions, done) {
    this.local.clear(setting, directions, done);
  }

  whole(setting) {
    return this.local.whole(setting);
  }

  sliders(setting) {
    return this.local.sliders(setting);
  }
}
