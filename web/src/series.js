// Which quantities of which flights are plotted, and how: colour tells the quantity, dashes tell the flight.

export const DASHES = [[], [6, 3], [2, 3], [8, 3, 2, 3]];
export const ROTORS = ["rotor1", "rotor2", "rotor3", "rotor4"];

/** Options of the plots of `flights`, for `Plot`. */
export function plots(flights) {
  const [first] = flights;
  const start = Math.min(...flights.map((flight) => flight.start)), end = Math.max(...flights.map((flight) => flight.end));
  const line = (name, label, role) => flights.map((flight, i) => ({
    label: i ? "" : label, role, dash: DASHES[i], width: i ? 1.3 : 1.8, opacity: i ? 0.75 : 1,
    t: flight.t, values: flight.series(name),
  }));
  const axis = { start, end };
  const poles = first.e3 === "up" ? ["inverted", "hanging"] : ["hanging", "inverted"];
  const hover = (rotors, sign = 1) => sign * first.vehicle.weight / rotors;
  const kinds = Array.from({ length: first.rotors }, (_, k) => k + 1);
  return [
    {
      ...axis, title: "Rod y₃ and thrust axis z₃", unit: "", range: [-1.12, 1.12],
      names: [[1, `y₃ = 1: ${poles[0]}`], [-1, `y₃ = −1: ${poles[1]}`]],
      lines: [...line("y3", "y₃", "rod"), ...line("z3", "z₃", "trail")],
    },
    {
      ...axis, title: "Thrust f", unit: "N", levels: [[hover(1, first.e3 === "up" ? 1 : -1), "hover"]],
      lines: line("thrust", "f", "thrust"),
    },
    {
      ...axis, title: "Rotor forces", unit: "N", levels: [[hover(first.rotors), "hover"]],
      lines: kinds.flatMap((k) => line(`rotor ${k}`, String(k), ROTORS[(k - 1) % ROTORS.length])
        .filter((_, i) => i === 0 || flights[i].rotors >= k)
        .map((curve, i) => (i ? { ...curve, opacity: 0.35 } : curve))),
    },
    {
      ...axis, title: "Position error", unit: "m",
      lines: line("distance", "|x − x_ref|", "ink"),
    },
  ];
}
