// How a flight ended, in the words of the package, by the reductions of its criterion; see flypend.flight.verdict.

const SAME = 1e-9;

export function judged({ status, end, part, reductions }, { words }) {
  const [since, ...rest] = reductions, last = rest.slice(0, words.parts.length), excursion = rest[words.parts.length];
  const distance = `excursion ${+(Math.round(100 * excursion) / 100).toPrecision(3)} m`;
  const named = words.status[status];
  if (named !== "completed") {
    const [name, touched] = (named === "collided" && words.touched[part]) || [null, ""];
    const said = `${named} after ${+end.toPrecision(3)} s${touched && `, ${touched}`}`;
    return { words: said, good: false, settling: null, excursion: null, reason: touched || words.reasons[status], part: name, cause: named };
  }
  const late = last.map((time) => time >= end - words.hold - SAME), cause = words.parts[late.indexOf(true)];
  const said = cause ? `${words.missed[cause]} during the last second, ${distance}` : `${words.pose} after ${since.toFixed(1)} s, ${distance}`;
  return { words: said, good: !cause, settling: cause ? null : since, excursion, reason: "", part: null, cause: cause ?? "" };
}
