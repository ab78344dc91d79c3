// Recoveries of a flight, counted as flypend.flight.metrics.recoveries counts them: each stretch outside the tolerances of the verdict,
// until they hold again for as long as they have to.

const SAME = 1e-9; // s
const LEAST = 0.05; // s, which is written as 0.1

export class Recoveries {
  /** Where tolerances have to hold for `hold` seconds. */
  constructor(hold) {
    Object.assign(this, { hold, all: [], next: 0, until: -Infinity });
  }

  /** The last recovery, if it goes on. */
  get open() {
    const last = this.all[this.all.length - 1];
    return last?.end === null ? last : null;
  }

  /** Take the samples of `flight` up to the time `t` that are new. */
  read(flight, t) {
    const { columns: { x, x_ref, excess } } = flight, sign = flight.e3 === "up" ? 1 : -1;
    for (; this.next < flight.t.length && flight.t[this.next] <= t; this.next++) {
      const i = 3 * this.next, place = [0, 1, 2].map((k) => x[i + k] - x_ref[i + k]);
      this.#add(flight.t[this.next], excess[this.next] <= 0, Math.hypot(...place), sign * x[i + 2]);
    }
    this.until = t;
    return this;
  }

  /** A sample at `t`: whether it is within the tolerances, its distance from the reference and its height, m. */
  #add(t, within, distance, height) {
    let { open } = this;
    if (within) {
      if (!open) return;
      open.back ??= t;
      if (t - open.last > this.hold + SAME) open.end = open.back;
      return;
    }
    if (!open) this.all.push((open = { begin: t, height, end: null, distance: 0, lost: 0 }));
    Object.assign(open, { last: t, back: null, distance: Math.max(open.distance, distance), lost: Math.max(open.lost, open.height - height) });
  }
}

const metres = (value) => (value < 0.995 ? `${(100 * value).toFixed(0)} cm` : `${value.toFixed(1)} m`);

/** The last of `recoveries` in words, at the time `t`; "" before the first has taken a tenth of a second. */
export function recovered({ all }, t) {
  const last = all[all.length - 1];
  if (!last || (last.back ?? t) - last.begin < LEAST) return "";
  const { begin, back, distance, lost } = last, time = `${((back ?? t) - begin).toFixed(1)} s`;
  return `${all.length > 1 ? `recovery ${all.length}` : "recovery"}: ${time}${back === null ? " so far" : ""}, ${metres(distance)} away, ${metres(lost)} lower`;
}
