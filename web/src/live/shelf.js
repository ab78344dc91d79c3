// The engine of a laboratory without a server: machine code for each vehicle, law and plant that its page offers.

import { Local } from "./local.js";

const MOST = 6; // workers that stay

export class Shelf {
  /** `told` is called with every reply to a question that is still asked. */
  constructor({ engines, offer }, told) {
    Object.assign(this, { engines, offer, told, number: 0, opened: new Map(), local: null });
  }

  /** Ask for something of a `kind`; returns the number of the question. */
  ask(kind, content = {}) {
    const number = ++this.number;
    if (kind === "stop") this.local?.ask(kind, content, number);
    else if (this.#open(content.setting)) this.local.ask(kind, content, number);
    else queueMicrotask(() => this.told({ kind: "error", number, field: "", message: `no machine code in this page for ${key(content.setting)}` }));
    return number;
  }

  /** Take up the machine code for `setting`; whether there is any. */
  #open(setting) {
    const name = key(setting), stored = Object.hasOwn(this.engines, name) && this.engines[name];
    if (!stored) return false;
    const local = this.opened.get(name) ?? new Local({ engine: stored.engine, offer: { ...this.offer, sliders: stored.sliders, seed: 0 }, runs: [stored.record] }, this.told);
    if (this.local && this.local !== local) this.local.ask("stop");
    this.opened.delete(name); // the last that was used comes last
    this.opened.set(name, local);
    for (const [old, other] of this.opened) {
      if (this.opened.size <= MOST) break;
      other.end();
      this.opened.delete(old);
    }
    this.local = local;
    return true;
  }

  // A flight that goes on ------------------------------------------------------------------------------------------

  get facts() {
    return this.local?.facts;
  }

  begin(setting, tick, flown) {
    this.local.begin(setting, tick, flown);
  }

  advance(content) {
    this.local.advance(content);
  }

  whole(setting) {
    return this.local.whole(setting);
  }

  sliders(setting) {
    return this.local.sliders(setting);
  }
}

/** What machine code is for, as flypend.lab.alone names it. */
const key = ({ vehicle, law, plant }) => [vehicle?.base, vehicle?.mount ?? "gimbal", law.name, plant?.base].join("/");
