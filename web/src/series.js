// Which quantities of which flights are plotted, and how: colour and marks tell the quantity, dashes tell the flight.

import { MARKS } from "./marks.js";
import { indexBefore } from "./numbers.js";

export const DASHES = [[], [6, 3], [2, 3], [8, 3, 2, 3]];
const NESTED = [3.4, 2.5, 1.6, 0.8]; // pixels, of the curves of rotors: one that lies on another leaves its rim to be seen
export const ROTORS = ["rotor1", "rotor2", "rotor3", "rotor4"];
const LEAST_DISTANCE = 0.05; // m: an axis of the position error shows at least this, not the noise of the integration
const LEAST_V = 1e-3; // and one of V reaches at least this high

/** Options of the plots of `flights`, for `Plot`: from the time `since`, up to which the first may have gone on, or all. */
export function plots(flights, since = -Infinity) {
  const [first] = flights, going = since > -Infinity;
  const start = Math.max(since, Math.min(...flights.map((flight) => flight.start)));
  const end = going ? first.end : Math.max(...flights.map((flight) => flight.end));
  const line = (name, label, role, mark, of = flights) => of.map((flight, k) => {
    const i = flights.indexOf(flight), style = { dash: DASHES[i], width: i ? 1.3 : 1.8, opacity: i ? 0.75 : 1 };
    const from = going ? indexBefore(flight.t, start) : 0;
    return { label: k ? "" : label, role, mark: k ? "" : mark, ...style, t: flight.t.subarray(from), values: flight.series(name, from) };
  });
  const touches = flights.filter((flight) => flight.verdict.part).map((flight) => flight.end);
  const axis = { start, end, touches };
  const poles = first.e3 === "up" ? ["inverted", "hanging"] : ["hanging", "inverted"];
  const weight = (first.e3 === "up" ? 1 : -1) * first.vehicle.weight, share = first.vehicle.weight / first.rotors;
  const free = flights.filter((flight) => flight.columns.clearance); // of a rod on a gimbal nothing is in the way
  const proved = flights.filter((flight) => flight.columns.V); // of laws that have a Lyapunov function
  const kinds = Array.from({ length: first.rotors }, (_, k) => k);
  const phases = first.phases.filter(({ to }) => to > start);
  return [
    {
      ...axis, phases, title: "Rod <i>y</i>₃ and thrust axis <i>z</i>₃", plain: "Rod y₃ and thrust axis z₃", unit: "", range: [-1.12, 1.12],
      names: [[1, `y₃ = 1: ${poles[0]}`], [-1, `y₃ = −1: ${poles[1]}`]],
      lines: [...line("y3", "<i>y</i>₃", "rod", "disc"), ...line("z3", "<i>z</i>₃", "trail", "square")],
    },
    ...(proved.length ? [{
      ...axis, title: "Lyapunov function <i>V</i>", plain: "Lyapunov function V", unit: "", log: true, least: LEAST_V,
      lines: line("V", "<i>V</i>", "trail", "square", proved),
    }] : []),
    {
      ...axis, title: "Thrust <i>f</i>", plain: "Thrust", unit: "N", levels: [[weight, "hover"]], scale: Math.abs(weight),
      lines: line("thrust", "<i>f</i>", "thrust", "disc"),
    },
    {
      ...axis, wide: true, title: "Rotor forces", plain: "Rotor forces", unit: "N", levels: [[share, "hover"]], scale: share,
      limits: first.vehicle.rotor_limits,
      lines: kinds.flatMap((k) => line(`rotor ${k + 1}`, String(k + 1), ROTORS[k % ROTORS.length], MARKS[k % MARKS.length])
        .filter((_, i) => i === 0 || flights[i].rotors > k)
        .map((curve, i) => (i ? { ...curve, opacity: 0.35 } : { ...curve, width: NESTED[k % NESTED.length] }))),
    },
    {
      ...axis, title: "Distance from the reference", plain: "Distance from the reference", unit: "m", least: LEAST_DISTANCE,
      lines: line("distance", "‖<i>x</i> − <i>x</i><sub>ref</sub>‖", "ink", "disc"),
    },
    ...(free.length ? [{
      ...axis, title: "Clearance of the rod", plain: "Clearance of the rod", unit: "m", levels: [[0, "touches"]],
      lines: line("clearance", "distance", "rod", "disc", free),
    }] : []),
  ];
}
