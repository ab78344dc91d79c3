// A flight through a sampled plant, in pieces: one control tick after the other.

import { joined, rooms, Simulation } from "./simulation.js";

const MOST = 512; // ticks of one call; longer pieces are several
const NONE = [0, 0, 0, 0, 0, 0];

export class Sampled extends Simulation {
  constructor(engine, facts) {
    super(engine, facts);
    const { plant, knobs } = facts, { doubles, integers } = rooms(engine), { row } = this, room = integers(1);
    engine.call("context_size", room);
    Object.assign(this.at, {
      starts: doubles(row), plant: doubles(plant), seeds: integers(1), sample_ticks: integers(MOST + 1), judged: integers(MOST + 1),
      rows: integers(MOST + 2), samples: doubles((MOST + 1) * row), context: doubles(Number(room.view()[0]) / 8), impulses: doubles(6),
    });
    this.knobs = doubles(Object.values(knobs).reduce((sum, value) => sum + value.length, 0));
    this.turn({});
  }

  /** Begin from the packed `start` with the rotor forces `rotors` (default the least), and the random numbers of `seed`. */
  begin(start, seed = 0, rotors = null) {
    const { facts } = this;
    this.at.starts.view().set([...start, ...(rotors ?? new Array(facts.rotors).fill(facts.knobs.rotor_limits[0]))]);
    this.at.seeds.view()[0] = BigInt(seed);
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

  #piece(ticks) {
    const { at, row } = this, begun = this.tick, first = begun === 0 ? 0 : begun + 1, last = begun + ticks;
    const count = last - first + 1, tick = at.sample_ticks.view(), judged = at.judged.view(), rows = at.rows.view();
    for (let i = 0; i < count; i++) {
      tick[i] = BigInt(first + i);
      judged[i] = (first + i) % this.facts.judge === 0 ? 1n : 0n;
      rows[i] = BigInt(i);
    }
    rows[count] = BigInt(count);
    this.fly({ runs: 1n, ticks: BigInt(last), sample_count: BigInt(count), row_count: BigInt(count), begun: BigInt(begun) });
    this.tick = last;
    return at.samples.view().slice(0, this.lived(first, count) * row);
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
