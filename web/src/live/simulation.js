// A flight in pieces: the package's own machine code in WebAssembly, one control tick after the other. Frames have e3 up.

import { Engine } from "../engine.js";

const MOST = 512; // ticks of one call; longer pieces are several

export class Simulation {
  /** Of a `module` of WebAssembly, and `facts` about it, both as flypend.flight.live writes them. */
  static async from(module, facts) {
    return new Simulation(await Engine.from(module), facts);
  }

  constructor(engine, facts) {
    Object.assign(this, { engine, facts, tick: 0, ended: true });
    const doubles = (length) => engine.reserve(Float64Array, length), integers = (length) => engine.reserve(BigInt64Array, length);
    const { state, rotors, gains, plant, reductions, knobs, judge } = facts, row = state + rotors;
    const room = integers(1);
    engine.call("context_size", room);
    this.at = {
      starts: doubles(row), parameters: doubles(Math.max(gains.length, 1)), plant: doubles(plant), seeds: integers(1),
      sample_ticks: integers(MOST + 1), judged: integers(MOST + 1), rows: integers(MOST + 2), samples: doubles((MOST + 1) * row),
      reductions: doubles(reductions), final: doubles(state), end: doubles(1), status: integers(1), clearance: doubles(1), part: integers(1),
      stop: integers(1), context: doubles(Number(room.view()[0]) / 8), impulses: doubles(6),
    };
    this.knobs = doubles(Object.values(knobs).reduce((sum, value) => sum + value.length, 0));
    this.asked = { t: doubles(1), state: doubles(row), origin: doubles(3), shown: doubles(6) };
    this.row = row;
    this.judge = judge;
    this.turn({});
    this.tune({});
  }

  /** Begin from the packed `start` with the rotor forces `rotors` (default the least), and the random numbers of `seed`. */
  begin(start, seed = 0, rotors = null) {
    const { facts } = this;
    this.at.starts.view().set([...start, ...(rotors ?? new Array(facts.rotors).fill(facts.knobs.rotor_limits[0]))]);
    this.at.seeds.view()[0] = BigInt(seed);
    Object.assign(this, { tick: 0, ended: false });
  }

  /** Take the gains of a law by name; those that are not told are as in the page. */
  tune(gains) {
    this.at.parameters.view().set(this.facts.gains.map((name, i) => gains[name] ?? this.facts.parameters[i]));
  }

  /** Turn knobs of the plant, by name; those that are not told are as in the page. */
  turn(knobs) {
    this.turned = { ...this.facts.knobs, ...knobs };
    this.#turn(this.turned);
  }

  #turn(knobs) {
    this.knobs.view().set(Object.keys(this.facts.knobs).flatMap((name) => knobs[name]));
    this.engine.call("turned", this.knobs, this.at.plant);
  }

  /**
   * Fly on for `ticks`; first, `impulses` strike vehicle and bob (six numbers, N s). Returns the rows of state and rotor forces
   * that have been flown, one after the other; the first piece of a flight begins with its start.
   */
  advance(ticks, impulses = null) {
    const kept = [];
    this.at.impulses.view().set(impulses ?? [0, 0, 0, 0, 0, 0]);
    for (let left = ticks; left > 0 && !this.ended; left -= MOST) {
      kept.push(this.#piece(Math.min(left, MOST)));
      this.at.impulses.view().fill(0);
    }
    const all = new Float64Array(kept.reduce((sum, rows) => sum + rows.length, 0));
    kept.reduce((place, rows) => (all.set(rows, place), place + rows.length), 0);
    return all;
  }

  #piece(ticks) {
    const { at, engine, facts, row } = this, begun = this.tick, first = begun === 0 ? 0 : begun + 1, last = begun + ticks;
    const count = last - first + 1, tick = at.sample_ticks.view(), judged = at.judged.view(), rows = at.rows.view();
    for (let i = 0; i < count; i++) {
      tick[i] = BigInt(first + i);
      judged[i] = (first + i) % this.judge === 0 ? 1n : 0n;
      rows[i] = BigInt(i);
    }
    rows[count] = BigInt(count);
    const numbers = { runs: 1n, ticks: BigInt(last), sample_count: BigInt(count), row_count: BigInt(count), begun: BigInt(begun) };
    engine.call("kernel", ...facts.arguments.map((name) => numbers[name] ?? at[name] ?? null));
    this.tick = last;
    this.ended = at.status.view()[0] !== 0n;
    const whole = this.ended ? Math.floor(at.end.view()[0] / facts.period + 1e-6) - first + 1 : count;
    return at.samples.view().slice(0, Math.max(whole, 0) * row);
  }

  /**
   * As `advance`, while a spring pulls the bob to `pull.place`: the force is told anew at every tick. `pull` has also
   * `stiffness` (N/m), `damping` (N s/m) and `most` (N).
   */
  pulled(ticks, pull, impulses = null) {
    const kept = [];
    for (let i = 0; i < ticks && !this.ended; i++) {
      const force = this.#spring(pull), held = this.turned.on_bob;
      this.#turn({ ...this.turned, on_bob: held.map((value, k) => value + force[k]) });
      kept.push(...this.advance(1, i === 0 ? impulses : null));
    }
    this.#turn(this.turned);
    return Float64Array.from(kept);
  }

  #spring({ place, stiffness, damping, most }) {
    const [x, v, y, w] = [0, 3, 18, 21].map((begin) => Array.from(this.last.subarray(begin, begin + 3)));
    const rod = this.facts.rod;
    const force = place.map((value, k) => stiffness * (value - x[k] - rod * y[k]) - damping * (v[k] + rod * w[k]));
    const size = Math.hypot(...force);
    return size > most ? force.map((value) => (value * most) / size) : force;
  }

  /** The state at the last tick; that of the start before the first. */
  get last() {
    return this.tick === 0 ? this.at.starts.view() : this.at.final.view();
  }

  /** How the flight has ended so far, and what the criterion says of it. */
  outcome() {
    const { at } = this;
    return {
      status: Number(at.status.view()[0]), end: at.end.view()[0], part: Number(at.part.view()[0]), reductions: Array.from(at.reductions.view()),
    };
  }

  /** Reference, thrust, clearance and V of a row at the time `t`: six numbers, see `shown` in flypend.flight.kernels.web. */
  shown(t, row) {
    const { asked } = this;
    asked.t.view()[0] = t;
    asked.state.view().set(row);
    asked.origin.view().set(this.turned.origin);
    this.engine.call("shown", asked.t, asked.state, asked.origin, this.at.parameters, asked.shown);
    return asked.shown.view();
  }
}
