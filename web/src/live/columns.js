// From rows of state and rotor forces, e3 up, to the columns that a page shows, in the frame of the law.

const WIDTHS = { t: 1, x: 3, x_dot: 3, quat_xyzw: 4, y: 3, y_dot: 3, thrust: 1, rotor_forces: 0, x_ref: 3, clearance: 1, excess: 1, V: 1 };
const FINEST = 0.15; // rad that rod or vehicle may turn between two samples
const RATE = 100; // samples a second at least

/** The columns of the rows numbered by `kept`, of which the first was flown at tick `first`, by `simulation`. */
export function columns(simulation, rows, kept, first) {
  const { facts, row } = simulation, { rotors, period } = facts, sign = facts.e3 === "up" ? 1 : -1;
  const widths = { ...WIDTHS, rotor_forces: rotors };
  if (!facts.clear) delete widths.clearance;
  if (!facts.lyapunov) delete widths.V;
  const out = Object.fromEntries(Object.entries(widths).map(([name, width]) => [name, new Float64Array(width * kept.length)]));
  kept.forEach((place, i) => {
    const state = rows.subarray(place * row, (place + 1) * row), t = (first + place) * period;
    const [a, b, c, thrust, clearance, excess, V] = simulation.shown(t, state);
    const turn = (from) => [state[from], sign * state[from + 1], sign * state[from + 2]];
    const [x, y, z, w] = quaternion(state.subarray(6, 15));
    const values = {
      t: [t], x: turn(0), x_dot: turn(3), quat_xyzw: [x, sign * y, sign * z, w], y: turn(18), y_dot: turn(21), thrust: [thrust],
      rotor_forces: state.subarray(facts.state), x_ref: [a, b, c], clearance: [clearance], excess: [excess], V: [V],
    };
    for (const name of Object.keys(out)) out[name].set(values[name], widths[name] * i);
  });
  return out;
}

/**
 * Which of the rows, of which the first was flown at tick `first`, to keep: a hundred a second, more where rod or vehicle turn
 * fast, and the last.
 */
export function chosen(simulation, rows, first) {
  const { row, facts: { period } } = simulation, count = rows.length / row, every = Math.max(1, Math.round(1 / (RATE * period)));
  const size = (i, from) => Math.hypot(rows[i * row + from], rows[i * row + from + 1], rows[i * row + from + 2]), kept = [];
  let turned = 0;
  for (let i = 0; i < count; i++) {
    turned += period * Math.max(size(i, 15), size(i, 21));
    if ((first + i) % every && turned < FINEST && i < count - 1) continue;
    kept.push(i);
    turned = 0;
  }
  return kept;
}

/** The unit quaternion x, y, z, w of a rotation matrix, nine numbers row by row. */
function quaternion(R) {
  const [a, b, c, d, e, f, g, h, k] = R;
  const squares = [1 + a - e - k, 1 - a + e - k, 1 - a - e + k, 1 + a + e + k], i = squares.indexOf(Math.max(...squares));
  const rows = [[squares[0], b + d, c + g, h - f], [b + d, squares[1], f + h, c - g], [c + g, f + h, squares[2], d - b], [h - f, c - g, d - b, squares[3]]];
  const size = Math.hypot(...rows[i]);
  return rows[i].map((value) => value / size);
}
