// A flight that a page flies: the package's own machine code in WebAssembly. Rows of state and rotor forces have e3 up.

import { Engine } from "../engine.js";
import { spring } from "./spring.js";

/** What flights through both kinds of plant share; sampled.js and ideal.js have the rest. */
export class Simulation {
  /** Of a `module` of WebAssembly, and `facts` about it, both as flypend.flight.live writes them. */
  static async from(module, facts) {
    return new this(await Engine.from(module), facts);
  }

  /** With room for so many `runs` at a time. */
  constructor(engine, facts, runs) {
    const { state, rotors, gains, reductions } = facts, { doubles, integers } = rooms(engine);
    Object.assign(this, { engine, facts, runs, row: state + rotors, tick: 0, ended: true });
    // Arguments of the kernel, by their names.
    this.at = {
      parameters: doubles(Math.max(runs * gains.length, 1)), reductions: doubles(runs * reductions), final: doubles(runs * state),
      end: doubles(runs), status: integers(runs), clearance: doubles(runs), part: integers(runs), stop: integers(1),
    };
    this.asked = { t: doubles(1), state: doubles(this.row), origin: doubles(3), shown: doubles(7) };
    this.tune({});
  }

  /** Take the gains of a law by name; those that are not told are as in the page. */
  tune(gains) {
    const values = this.facts.gains.map((name, i) => gains[name] ?? this.facts.parameters[i]);
    this.at.parameters.view().set(Array(this.runs).fill(values).flat());
  }

  /** Turn knobs of the plant, by name; those that are not told are as in the page. */
  turn(knobs) {
    this.turned = { ...this.facts.knobs, ...knobs };
    this.asked.origin.view().set(this.turned.origin);
  }

  /** Call the kernel for so many `runs`, with `numbers` beside the arrays that it always takes. */
  fly(runs, numbers) {
    const given = { runs: BigInt(runs), ...numbers };
    this.engine.call("kernel", ...this.facts.arguments.map((name) => given[name] ?? this.at[name] ?? null));
    this.ended = this.at.status.view().subarray(0, runs).every((status) => status !== 0n);
  }

  /** How many of `count` ticks from the tick `first` on the flight has lived to see. */
  lived(first, count) {
    return this.ended ? Math.max(Math.floor(this.at.end.view()[0] / this.facts.period + 1e-6) - first + 1, 0) : count;
  }

  /**
   * As `advance`, while a spring pulls the bob as spring.js says: the force is told anew at every tick.
   */
  pulled(ticks, pull, impulses = null) {
    const kept = [];
    for (let i = 0; i < ticks && !this.ended; i++) kept.push(this.pushed(this.#spring(pull), i === 0 ? impulses : null));
    return joined(kept);
  }

  #spring(pull) {
    const [x, v, y, w] = [0, 3, 18, 21].map((begin) => Array.from(this.last.subarray(begin, begin + 3))), { rod } = this.facts;
    return spring(pull, x.map((value, k) => value + rod * y[k]), v.map((value, k) => value + rod * w[k]));
  }

  /** How the flight has ended so far, and what the criterion says of it. */
  outcome(run = 0) {
    const { at } = this, { reductions } = this.facts, [status, end, part] = ["status", "end", "part"].map((name) => Number(at[name].view()[run]));
    return { status, end, part, reductions: Array.from(at.reductions.view().subarray(run * reductions, (run + 1) * reductions)) };
  }

  /** Reference, thrust, clearance, excess and V of a row at the time `t`: seven numbers, see `shown` in flypend.flight.kernels.web. */
  shown(t, row) {
    const { asked } = this;
    asked.t.view()[0] = t;
    asked.state.view().set(row);
    this.engine.call("shown", asked.t, asked.state, asked.origin, this.at.parameters, asked.shown);
    return asked.shown.view();
  }
}

/** What reserves arrays in the memory of `engine`. */
export function rooms(engine) {
  return { doubles: (length) => engine.reserve(Float64Array, length), integers: (length) => engine.reserve(BigInt64Array, length) };
}

/** Arrays of numbers, one after the other. */
export function joined(parts) {
  const all = new Float64Array(parts.reduce((sum, part) => sum + part.length, 0));
  parts.reduce((place, part) => (all.set(part, place), place + part.length), 0);
  return all;
}
