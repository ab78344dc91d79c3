// A flight as a table: comma-separated values, SI units, in the frame of its law.

const PARTS = {
  x: ["x_1", "x_2", "x_3"], x_dot: ["x_dot_1", "x_dot_2", "x_dot_3"], quat_xyzw: ["quat_x", "quat_y", "quat_z", "quat_w"],
  y: ["y_1", "y_2", "y_3"], y_dot: ["y_dot_1", "y_dot_2", "y_dot_3"], x_ref: ["x_ref_1", "x_ref_2", "x_ref_3"],
};

/** The samples of a `flight` (flight.js) as a file. */
export function download(flight) {
  const names = Object.keys(flight.columns), count = flight.t.length, width = (name) => flight.columns[name].length / count;
  const heads = names.flatMap((name) => PARTS[name] ?? (name === "rotor_forces" ? Array.from({ length: width(name) }, (_, k) => `rotor_${k + 1}`) : [name]));
  const lines = Array.from({ length: count }, (_, i) => names.flatMap((name) => flight.sample(name, i, width(name))).join(","));
  return new Blob([`${[heads.join(","), ...lines].join("\n")}\n`], { type: "text/csv" });
}
