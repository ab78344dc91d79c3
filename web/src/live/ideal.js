// A flight through the ideal plant: continuous time, in which a tick is no more than the time between two rows.

import { rooms, Simulation } from "./simulation.js";

const TOGETHER = 16; // flights of which the lanes take one after the other
// Steps that a flight may take, unless the run has said how many, and a piece of a live one, which must not keep the page
// waiting. A step takes some 50 µs; usual flights of 10 s take less than 1,000, one by a network on a large machine 8,000.
const STEPS = { whole: 20_000, tick: 2, piece: 2000 };
const PIECE = 200; // ticks that are fewer are a piece

export class Ideal extends Simulation {
  constructor(engine, facts) {
    super(engine, facts, TOGETHER);
    const { doubles, integers } = rooms(engine);
    Object.assign(this.at, { starts: doubles(TOGETHER * facts.state), queue: integers(1), steps: integers(TOGETHER) });
    Object.assign(this, { state: doubles(facts.state), impulses: doubles(6), first: doubles(1), most: 0, mostRows: 0 });
    this.turn({});
  }

  /** Begin from the packed `start`; nothing is random here. */
  begin(start) {
    this.state.view().set(start);
    Object.assign(this, { tick: 0, ended: false, judged: null });
  }

  /**
   * Fly on for `ticks`; first, `impulses` strike vehicle and bob (six numbers, N s). Returns the rows of state and rotor forces
   * that have been flown, one after the other; the first piece of a flight begins with its start. All are one integration.
   */
  advance(ticks, impulses = null) {
    if (this.ended) return new Float64Array(0);
    const { at, facts, row } = this, { period } = facts, begun = this.tick;
    this.#fit(ticks);
    this.#fitRows(ticks);
    const own = () => this.engine.call("own", this.state, this.asked.origin, at.starts);
    own();
    if (begun === 0) this.#row(this.first, at.starts, 0); // as it is before a blow
    if (impulses) {
      this.#strike(impulses);
      own();
    }
    const times = at.times.view();
    for (let i = 0; i < ticks; i++) times[i] = (begun + 1 + i) * period;
    times[ticks] = Infinity;
    this.#integrate(1, begun, ticks, ticks);
    this.tick = begun + ticks;
    this.#reduce(begun * period);
    const count = this.lived(begun + 1, ticks), before = begun === 0 ? 1 : 0;
    for (let i = 0; i < count; i++) this.#row(entry(at.times, i), entry(at.samples, facts.state * i), before + i);
    if (!this.ended) this.state.view().set(this.rows.view().subarray((before + count - 1) * row, (before + count - 1) * row + facts.state));
    return this.rows.view().slice(0, (before + count) * row);
  }

  /** Fly from packed `starts` for so many ticks, and return how each flight has ended. */
  several(starts, ticks) {
    const endings = [];
    this.#fit(ticks);
    this.at.times.view()[0] = Infinity;
    for (let i = 0; i < starts.length; i += TOGETHER) {
      const group = starts.slice(i, i + TOGETHER);
      group.forEach((start, k) => {
        this.state.view().set(start);
        this.engine.call("own", this.state, this.asked.origin, entry(this.at.starts, k * this.facts.state));
      });
      this.#integrate(group.length, 0, ticks, 0);
      endings.push(...group.map((_, k) => super.outcome(k)));
    }
    return endings;
  }

  /** Fly so many `runs` from tick `begun` on, keeping the states at the first `kept` of the times. */
  #integrate(runs, begun, ticks, kept) {
    const { period, exact: { rtol, atol, max_steps } } = this.facts, usual = STEPS.whole + STEPS.tick * ticks;
    const most = ticks < PIECE ? Math.min(STEPS.piece, max_steps ?? usual) : max_steps ?? usual;
    this.at.queue.view()[0] = 0n;
    this.fly(runs, {
      begin: begun * period, until: (begun + ticks) * period, rtol, atol, max_steps: BigInt(most), time_count: BigInt(kept),
      ...this.#judge(begun, ticks),
    });
  }

  /** Write the row `place` of the state `own` at the time at `t`. */
  #row(t, own, place) {
    this.engine.call("row", t, own, this.at.parameters, this.asked.origin, entry(this.rows, this.row * place));
  }

  /** Have room for the times of so many ticks. */
  #fit(ticks) {
    if (ticks <= this.most) return;
    this.most = Math.max(ticks, 2 * this.most);
    const { doubles } = rooms(this.engine), { most } = this;
    Object.assign(this.at, { times: doubles(most + 1), judge_times: doubles(most + 2), bins: doubles(2 * (most + 1)) });
  }

  /** Have room for so many rows, and for the states that they are made of. */
  #fitRows(ticks) {
    if (ticks <= this.mostRows) return;
    this.mostRows = Math.max(ticks, 2 * this.mostRows);
    const { doubles } = rooms(this.engine);
    this.at.samples = doubles(this.mostRows * this.facts.state);
    this.rows = doubles((this.mostRows + 1) * this.row);
  }

  #strike(impulses) {
    this.impulses.view().set(impulses);
    this.engine.call("strike", this.state, this.impulses, this.state);
  }

  /** Write the times after tick `begun`, and that of a start, at which the criterion is judged; see compile/loops/grid.hpp. */
  #judge(begun, ticks) {
    const { judge, period } = this.facts, { at } = this, times = at.judge_times.view(), bins = at.bins.view();
    const first = begun === 0 ? 0 : Math.floor(begun / judge) + 1, last = Math.floor((begun + ticks) / judge);
    for (let i = first; i <= last; i++) times[i - first] = i * judge * period;
    times[Math.max(last - first + 1, 0)] = Infinity;
    const count = ticks < PIECE || last >= bins.length ? 1 : last + 1; // the few of a piece are found without a table
    for (let i = 0; i < count; i++) bins[i] = Math.max(i - first, 0);
    return { bin_count: count, bin_rate: count > 1 ? 1 / (judge * period) : 0 };
  }

  /** Add what the last piece, begun at a time, says of the criterion to what those before have said. */
  #reduce(begun) {
    const { reductions: now, end } = super.outcome(), { judged } = this, parts = this.facts.words.parts.length;
    if (!judged) {
      this.judged = now;
      return;
    }
    const [since, ...rest] = now, within = rest.slice(0, parts).every((time) => time < 0), [before, ...older] = judged;
    const last = rest.slice(0, parts).map((time, k) => Math.max(time, older[k]));
    const [most, mean, peak] = rest.slice(parts), [mostBefore, meanBefore, peakBefore] = older.slice(parts);
    const share = end > 0 ? begun / end : 0;
    this.judged = [
      within && Number.isFinite(before) ? before : since, ...last, most > mostBefore ? most : mostBefore,
      share * meanBefore + (1 - share) * mean, Math.max(peak, peakBefore),
    ];
  }

  outcome() {
    return { ...super.outcome(), reductions: this.judged };
  }

  /** Fly one tick, begun by the impulse of a `force` (N) on the bob during the tick. */
  pushed(force, impulses) {
    const blow = [0, 0, 0, ...force.map((value) => value * this.facts.period)];
    return this.advance(1, impulses ? blow.map((value, k) => value + impulses[k]) : blow);
  }

  /** The state at the last tick; that of the start before the first. */
  get last() {
    return this.state.view();
  }
}

/** The numbers of an array of the engine from the place `index` on. */
const entry = ({ place, kind }, index) => ({ place: place + index * kind.BYTES_PER_ELEMENT });
