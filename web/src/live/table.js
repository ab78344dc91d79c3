// A flight as a table: comma-separated values, SI units, in the frame of its law. Heads are those of `run.to_dataframe(units=True)`,
// with the attitude as a quaternion.

const UNITS = {
  t: "s", x: "m", x_dot: "m/s", quat_xyzw: "1", y: "1", y_dot: "1/s", thrust: "N", rotor_forces: "N", x_ref: "m", clearance: "m",
};
const STEMS = { quat_xyzw: "quat", rotor_forces: "rotor_force" };

/** The heads of the column `name`, with `width` numbers to a sample: x_1 [m], x_2 [m], x_3 [m]. */
function heads(name, width) {
  const ends = width === 1 ? [""] : name === "quat_xyzw" ? ["_x", "_y", "_z", "_w"] : Array.from({ length: width }, (_, k) => `_${k + 1}`);
  const unit = UNITS[name] ? ` [${UNITS[name]}]` : "";
  return ends.map((end) => `${STEMS[name] ?? name}${end}${unit}`);
}

/** The samples of a `flight` (flight.js) as a file. */
export function download(flight) {
  const names = Object.keys(flight.columns).filter((name) => name !== "excess"), count = flight.t.length, width = (name) => flight.columns[name].length / count;
  const head = names.flatMap((name) => heads(name, width(name))).join(",");
  const lines = Array.from({ length: count }, (_, i) => names.flatMap((name) => flight.sample(name, i, width(name))).join(","));
  return new Blob([`${[head, ...lines].join("\n")}\n`], { type: "text/csv" });
}
