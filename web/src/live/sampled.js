// A flight through a sampled plant, in pieces: one control tick after the other.

import { joined, rooms, Simulation } from "./simulation.js";

const MOST = 512; // ticks of one call; longer pieces are several
const NONE = [0, 0, 0, 0, 0, 0];

export class Sampled extends Simulation {
  constructor(engine, facts) {
    super(engine, facts, facts.lanes);
    const { plant, knobs, lanes } = facts, { doubles, integers } = rooms(engine), { row } = this, room = integers(1);
    engine.call("context_size", room);
    Object.assign(this.at, {
      starts: doubles(lanes * row), plant: doubles(plant), seeds: integers(lanes), sample_ticks: integers(MOST + 1), judged: integers(MOST + 1),
      rows: integers(MOST + 2), samples: doubles((MOST + 1) * row), context: doubles(Number(room.view()[0]) / 8), impulses: doubles(6 * lanes),
    });
    this.knobs = doubles(Object.values(knobs).reduce((sum, value) => sum + value.length, 0));
    this.turn({});
  }

  /** Begin from the packed `start` with the rotor forces `rotors` (default the least), and the random numbers of `seed`. */
  begin(start, seed = 0, rotors = null) {
    this.#place([start], seed, rotors ?? undefined);
  }

  #place(starts, seed, rotors = new Array(this.facts.rotors).fill(this.facts.knobs.rotor_limits[0])) {
    this.at.starts.view().set(starts.flatMap((start) => [...start, ...rotors]));
    this.at.seeds.view().set(starts.map((_, i) => BigInt(seed + i)));
    this.at.impulses.view().fill(0);
    Object.assign(this, { tick: 0, ended: false });
  }

  turn(knobs) {
    super.turn(knobs);
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
    this.at.impulses.view().set(impulses ?? NONE);
    for (let left = ticks; left > 0 && !this.ended; left -= MOST) {
      kept.push(this.#piece(Math.min(left, MOST)));
      this.at.impulses.view().fill(0);
    }
    return joined(kept);
  }

  /** Fly from packed `starts` for so many ticks, and return how each flight has ended. Their seeds are `seed` and what follows. */
  several(starts, ticks, seed = 0) {
    const { runs } = this, endings = [];
    for (let i = 0; i < starts.length; i += runs) {
      const group = starts.slice(i, i + runs);
      this.#place(group, seed + i);
      for (let left = ticks; left > 0 && !this.ended; left -= MOST) this.#piece(Math.min(left, MOST), group.length, 0);
      endings.push(...group.map((_, k) => this.outcome(k)));
    }
    return endings;
  }

  /** Fly some ticks of so many `runs`, keeping all rows, or none (`kept` 1 or 0). */
  #piece(ticks, runs = 1, kept = 1) {
    const { at, row } = this, begun = this.tick, first = begun === 0 ? 0 : begun + 1, last = begun + ticks;
    const count = last - first + 1, tick = at.sample_ticks.view(), judged = at.judged.view(), rows = at.rows.view();
    for (let i = 0; i < count; i++) {
      tick[i] = BigInt(first + i);
      judged[i] = (first + i) % this.facts.judge === 0 ? 1n : 0n;
      rows[i] = BigInt(kept * i);
    }
    rows[count] = BigInt(kept * count);
    this.fly(runs, { ticks: BigInt(last), sample_count: BigInt(count), row_count: rows[count], begun: BigInt(begun) });
    this.tick = last;
    return at.samples.view().slice(0, kept * this.lived(first, count) * row);
  }

  /** Fly one tick, while a `force` (N) acts on the bob. */
  pushed(force, impulses) {
    const { turned } = this;
    this.#turn({ ...turned, on_bob: turned.on_bob.map((value, k) => value + force[k]) });
    const rows = this.advance(1, impulses);
    this.#turn(turned);
    return rows;
  }

  /** The state at the last tick; that of the start before the first. */
  get last() {
    return this.tick === 0 ? this.at.starts.view() : this.at.final.view();
  }
}
