// The engine of the laboratory: a worker with machine code shows a flight at once, the server confirms it and knows the rest.
//
// The server alone flies own laws, rotor limits (from which laws take gains), gains from which a law computes others in advance, a
// delay that an estimator has to be told, numbers of a plant that are compiled, and what a law may refuse.

import { keep, Local } from "../live/local.js";
import { beyond, isWhole, refused, untaken } from "../live/request.js";
import { Link } from "./link.js";
import { kind } from "./setting.js";

const REST = 150; // ms without a change, once the page has flown, until the server is asked to confirm

export class Hybrid {
  /** `told` is called with every reply, `say` with words about the connection. */
  constructor(told, say) {
    Object.assign(this, { told, engines: new Map(), known: null });
    this.link = new Link((reply) => this.#reply(reply), (open) => say(open ? "" : "no connection to the server"));
  }

  /** Ask for something of a `kind`; returns its number. */
  ask(kind, content = {}) {
    if (kind !== "fly") return this.link.ask(kind, content);
    const number = this.link.reserve();
    clearTimeout(this.resting);
    this.asked = structuredClone(content.setting); // which the page goes on to change
    this.confirm = () => this.link.ask("fly", content, number);
    if (this.#preview(number, content.setting)) this.flying = number;
    else this.confirm();
    return number;
  }

  /** Fly `setting` here, if that is possible; whether it is. */
  #preview(number, setting) {
    const { local } = this;
    if (!local || !isWhole(setting.start) || !this.#allowed(setting)) return false;
    const whole = this.#whole(setting);
    if (refused(whole, local.facts)) return false; // the server has words for it
    local.ask("fly", { setting: whole }, number);
    return true;
  }

  /** The machine code for the present setting, if it has come. */
  get local() {
    const found = this.known?.key === kind(this.asked) && this.engines.get(this.known.key);
    return found && !rebuilt(this.asked, found.facts) ? found : null;
  }

  /** Whether the law takes the gains beside each other, as far as the server has said. */
  #allowed({ law }) {
    return this.known.sliders.every(({ path, allowed }) => {
      const value = law.gains?.[path.slice("law.gains.".length)];
      return !allowed || value === undefined || (value >= allowed[0] && value <= allowed[1]);
    });
  }

  /** `setting` with the gains that the server has proposed for what it does not tell. */
  #whole(setting) {
    const gains = this.known.sliders.filter(({ path }) => path.startsWith("law.gains.")).map(({ path, value }) => [path.slice(10), value]);
    const proposed = Object.fromEntries(gains.filter(([name]) => !(name in this.known.gains)));
    return { ...setting, law: { ...setting.law, gains: { ...proposed, ...setting.law.gains } } };
  }

  #reply(reply) {
    if (reply.kind === "engine") {
      const { last } = this.link;
      if (reply.number === last.get("engine")?.number) last.delete("engine"); // not asked for again: it may be in use by then
      keep(this.engines, reply.key, reply.engine && this.#made(reply));
      this.#name();
      this.told({ kind: "able" });
      return;
    }
    if (reply.kind === "flight") this.#know(reply);
    this.told(reply);
  }

  #made({ engine, key, sliders }) {
    return new Local({ engine, offer: { sliders, seed: 0 }, runs: [{}] }, (reply) => {
      if (reply.kind === "flight") {
        if (reply.number === this.flying) this.resting = setTimeout(this.confirm, REST);
        this.told({ ...reply, kind: "preview" });
      } else { // the server flies it
        this.engines.set(key, null);
        this.confirm();
        this.told({ kind: "able" });
      }
    });
  }

  /** What the server said of a setting: its sliders, the record of its flight. */
  #know({ number, sliders, run }) {
    const { setting, number: last } = this.link.last.get("fly");
    if (number !== last) return; // the answer to an earlier question
    const key = kind(setting), { columns, ...record } = run;
    this.known = { key, sliders, gains: setting.law.gains, record };
    if (this.engines.has(key)) keep(this.engines, key, this.engines.get(key)); // it is in use
    else {
      this.engines.set(key, null);
      const { vehicle, law, plant } = setting;
      const plain = { vehicle: { base: vehicle.base, mount: vehicle.mount }, law: { name: law.name, gains: {} }, plant: { base: plant.base, sensors: plant.sensors } };
      this.link.ask("engine", { key, setting: { ...setting, ...plain, pokes: [] } });
    }
    this.#name();
  }

  /** Let the machine code know what it flies. */
  #name() {
    const { local, known } = this;
    if (!local) return;
    const usual = Object.fromEntries(local.offer.sliders.map(({ path, value }) => [path, value]));
    local.record = known.record;
    local.offer.sliders = known.sliders.map((facts) => ({ ...facts, value: usual[facts.path] }));
  }

  // A flight that goes on, which is this page's alone ---------------------------------------------------------------

  get facts() {
    return this.local?.facts;
  }

  /** Whether `setting` has numbers that its machine code does not take. */
  rebuilds(setting) {
    return rebuilt(setting, this.facts);
  }

  begin(setting, tick, flown) {
    this.local.begin(this.#whole(setting), tick, flown);
  }

  advance(content) {
    this.local.advance(content);
  }

  clear(setting, directions, done) {
    if (isWhole(setting.start)) this.local?.clear(setting, directions, done);
  }

  whole(setting) {
    return setting;
  }

  sliders(setting) {
    return this.local.sliders(setting);
  }
}

/** Whether numbers of a setting change what is compiled, or are beyond what machine code with `facts` takes. */
const rebuilt = (setting, facts) =>
  Boolean((setting.plant?.sensors && setting.plant.delay !== undefined) || untaken(setting, facts) || beyond(setting, facts));
