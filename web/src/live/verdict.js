// How a flight ended, in the words of the package, by the reductions of its criterion; see flypend.flight.verdict.

const SAME = 1e-9;

/** Of an ending, by `facts` of its machine code; `fall` is how far the vehicle went along gravity, m. */
export function judged({ status, end, part, reductions }, { words, e3 }, fall = 0) {
  const [since, ...rest] = reductions, last = rest.slice(0, words.parts.length), excursion = rest[words.parts.length];
  const rounded = (metres) => `${+(Math.round(100 * metres) / 100).toPrecision(3)} m`, up = e3 === "up";
  const distance = up ? `excursion ${rounded(excursion)}` : `vehicle ${fall >= 0 ? "fell" : "rose"} ${rounded(Math.abs(fall))}`;
  const named = words.status[status];
  if (named !== "completed") {
    const [name, touched] = (named === "collided" && words.touched[part]) || [null, ""];
    const said = `${named} ${end > 0 ? `after ${+end.toPrecision(3)} s` : "at the start"}${touched && `, ${touched}`}`;
    return { words: said, good: false, state: "failed", settling: null, excursion: null, reason: touched || words.reasons[status], part: name, cause: named };
  }
  const late = last.map((time) => time >= end - words.hold - SAME), cause = words.parts[late.indexOf(true)];
  const said = `${cause ? `${words.missed[cause]} during the last second` : `${up ? words.pose : words.hangs} after ${since.toFixed(1)} s`}, ${distance}`;
  return { words: said, good: !cause, state: cause ? "failed" : up ? "done" : "recovering", settling: cause ? null : since, excursion, reason: "", part: null, cause: cause ?? "" };
}
