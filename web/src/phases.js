// What the rod is doing, in one word: the same for every law, own ones included. It stands where the verdict's criterion holds;
// the rest goes by height and rate alone.
//
// With c = y · up, its rate c', the rate |y'|, and w = √(g/l), the rate at which the rod would swing:
//
//   stands   within the tolerances of the verdict: rod, thrust axis and place
//   settles  within 15° of upright, |y'| < w/2, and not within them
//   hangs    within 15° of hanging, |y'| < w/2, the bob not carried up
//   flips    below level, and rising: c' > w/2
//   drops    falling: c' < −w/2
//   climbs   below level, and the bob is carried up, faster than √(g l)/10
//   catches  above level, and none of these
//   swings   below level, and none of these

const CONE = Math.cos(Math.PI / 12), QUICK = 0.5, CARRIED = 0.1;
const BRIEF = 0.4; // of 1/w: what is shorter is no phase

export const STANDS = "stands";

/** The rate at which the rod of `vehicle` would swing, 1/s; where nothing weighs anything, 1. */
const swing = ({ gravity, rod_length }) => Math.sqrt(gravity / rod_length) || 1;

/** The phase of a pose of `flight` (flight.js). */
export function phase(flight, { y, y_dot, x_dot, excess }) {
  const { vehicle, e3 } = flight, up = e3 === "up" ? 1 : -1, w = swing(vehicle);
  const height = up * y[2], rise = up * y_dot[2] / w, calm = Math.hypot(...y_dot) < QUICK * w;
  const carried = up * (x_dot[2] + vehicle.rod_length * y_dot[2]) > CARRIED * w * vehicle.rod_length;
  if (up > 0 && excess <= 0) return STANDS;
  if (height > CONE && calm) return "settles";
  if (rise < -QUICK) return "drops";
  if (height > 0) return "catches";
  if (rise > QUICK) return "flips";
  if (carried) return "climbs";
  return height < -CONE && calm ? "hangs" : "swings";
}

/** The phases of a whole flight, one after the other: { from, to, name } in seconds, none of them brief. */
export function phases(flight) {
  const { t } = flight, found = [];
  t.forEach((from, i) => {
    const name = phase(flight, { y: flight.sample("y", i), y_dot: flight.sample("y_dot", i), x_dot: flight.sample("x_dot", i), excess: flight.columns.excess[i] });
    if (name !== found[found.length - 1]?.name) found.push({ from, name });
  });
  found.forEach((piece, i) => (piece.to = found[i + 1]?.from ?? flight.end));
  const least = BRIEF / swing(flight.vehicle), after = (i) => found[i - 1]?.name === STANDS; // which is said of no other time
  const long = found.filter(({ from, to }, i) => to - from >= least || after(i));
  return joined(long.length ? long : found.slice(-1), flight);
}

/** Pieces that follow each other without a gap, equal neighbours as one: what was brief goes to what came before. */
function joined(pieces, flight) {
  const out = pieces.filter(({ name }, i) => name !== pieces[i - 1]?.name).map(({ name, from }) => ({ name, from }));
  out[0].from = flight.start;
  return out.map((piece, i) => ({ ...piece, to: out[i + 1]?.from ?? flight.end }));
}
