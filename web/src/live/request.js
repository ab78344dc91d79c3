// From a setting of the page to what the simulation takes: gains, knobs of the plant, start, pokes.

const ORDER = ["x", "x_dot", "R", "omega", "y", "y_dot"];

/** Gains and knobs that `setting` tells, for a module with `facts`; the reference moves in a `live` flight alone. */
export function turned(setting, facts, live = false) {
  const { plant = {}, vehicle = {}, law = {}, origin = {} } = setting, { wind = {} } = plant;
  const told = {
    lag: single(plant.lag), delay: single(Math.min(plant.delay, facts.delay)), noise: plant.noise && facts.noise.map((name) => plant.noise[name] ?? 0),
    on_vehicle: wind.on_vehicle, on_bob: wind.on_bob, gust_on_vehicle: single(wind.gust_on_vehicle), gust_on_bob: single(wind.gust_on_bob),
    rotor_limits: vehicle.rotor_limits, origin: live ? ["x", "y", "z"].map((name) => origin[name] ?? 0) : undefined,
  };
  return { gains: law.gains ?? {}, knobs: Object.fromEntries(Object.entries(told).filter(([, value]) => value?.every(Number.isFinite))) };
}

const single = (value) => (value === undefined ? undefined : [value]);

/** The packed state of a start, e3 up; its fields stand as flypend packs them. A start may be a seed: `random`. */
export const packed = (start) => ORDER.flatMap((name) => start[name].flat());

/** Impulses on vehicle and bob (six numbers, N s) that would give the body `on` a `velocity` if it were free. */
export function blow(on, velocity, { masses }) {
  const impulse = velocity.map((value) => value * masses[on]);
  return on === "bob" ? [0, 0, 0, ...impulse] : [...impulse, 0, 0, 0];
}

/** The whole flight of `setting`: also where it begins, for how many ticks, and with which pokes. */
export function request(setting, facts, seed) {
  const tick = (time) => Math.round(time / facts.period);
  const pokes = (setting.pokes ?? []).map(({ time, on, velocity }) => ({ tick: tick(time), impulses: blow(on, velocity, facts) }));
  const begun = pokes.length ? pokes[pokes.length - 1].tick : 0;
  return { ...turned(setting, facts), start: packed(setting.start), seed: setting.plant?.seed ?? seed, pokes, ticks: begun + tick(setting.duration) };
}
