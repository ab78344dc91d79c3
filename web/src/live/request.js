// From a setting of the page to what the simulation takes: gains, knobs of the plant, start, pokes.

import { WIND } from "../lab/readable.js";
import { clamp, dot, norm, unit } from "../numbers.js";

const LONGEST = 600; // s of flight that a page holds
const LEAST = 1e-3, CLOSE = 1e-4; // as flypend.lab.setting and State take them
const PLANT = ["base", "lag", "delay", "noise", "wind", "sensors", "defects", "seed"]; // what machine code takes of a plant
const ORDER = ["x", "x_dot", "R", "omega", "y", "y_dot"];

/** Whether a start is told in numbers, all of them. */
export const isWhole = (start) => !("random" in start) && ORDER.every((name) => start[name]);

/** Gains and knobs that `setting` tells, for a module with `facts`; the reference moves in a `live` flight alone. */
export function turned(setting, facts, live = false) {
  const { plant = {}, vehicle = {}, law = {}, origin = {} } = setting, { wind = {} } = plant, sizes = facts.knobs.defects;
  const told = {
    lag: single(plant.lag), delay: single(clamp(plant.delay, 0, facts.delay)), noise: plant.noise && facts.noise.map((name) => plant.noise[name] ?? 0),
    defects: plant.defects && facts.defects.map((name, i) => plant.defects[name] ?? sizes[i]),
    on_vehicle: wind.on_vehicle, on_bob: wind.on_bob, gust_on_vehicle: single(wind.gust_on_vehicle), gust_on_bob: single(wind.gust_on_bob),
    rotor_limits: vehicle.rotor_limits, origin: live ? ["x", "y", "z"].map((name) => origin[name] ?? 0) : undefined,
  };
  return { gains: law.gains ?? {}, knobs: Object.fromEntries(Object.entries(told).filter(([, value]) => value?.every(Number.isFinite))) };
}

const single = (value) => (value === undefined ? undefined : [value]);

/** The packed state of a start, e3 up; its fields stand as flypend packs them. A rod that was dragged keeps no rate along itself. */
export function packed(start) {
  const y = unit(start.y), along = dot(y, start.y_dot);
  const whole = { ...start, y, y_dot: start.y_dot.map((value, k) => value - along * y[k]) };
  return ORDER.flatMap((name) => whole[name].flat());
}

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

/** Why a page cannot fly `setting`, which is a readable one (readable.js) with a start in numbers; "" if it can. */
export function refused(setting, facts) {
  const { start, duration, pokes = [] } = setting, { masses, period } = facts;
  const lacking = ORDER.find((name) => !start[name]);
  if (lacking) return `start.${lacking}: expected numbers, got nothing`;
  if (norm(start.y) < LEAST) return `start.y: expected a direction, got one of length ${norm(start.y)}`;
  if (!rotation(start.R)) return "start.R: expected a rotation matrix";
  if (!(duration >= period)) return `duration: expected at least ${period} s`;
  if (pokes.some(({ on }) => !Object.hasOwn(masses, on))) return `pokes: expected one of ${Object.keys(masses).join(", ")}`;
  if (pokes.some(({ time }, i) => (i ? time <= pokes[i - 1].time : time < 0))) return "pokes: expected increasing times";
  if (duration + (pokes.at(-1)?.time ?? 0) > LONGEST) return `duration: expected at most ${LONGEST} s of flight, pokes included`;
  return beyond(setting, facts);
}

/** Which gains or numbers of the plant of a setting are out of range; "" if none is. */
export const beyond = ({ law, plant, vehicle }, facts) =>
  gainBeyond(law.gains, facts) || (facts.kind === "ideal" ? "" : plantBeyond(plant, vehicle, facts.delay)); // the ideal plant keeps numbers for later

/** Which gain is outside its bounds, of which the table of the law's gains tells those that it has; "" if none is. */
function gainBeyond(given = {}, { gains, bounds }) {
  const found = gains.findIndex((name, i) => given[name] <= bounds[i].above || given[name] < bounds[i].at_least || given[name] > bounds[i].at_most);
  if (found < 0) return "";
  const name = gains[found], value = given[name], { above, at_least: least, at_most: most } = bounds[found];
  const expected = value > most ? `at most ${most}` : above === undefined ? `at least ${least}` : `more than ${above}`;
  return `law.gains.${name}: expected ${expected}, got ${value}`;
}

/** Which numbers of a sampled plant are out of range, with delays up to `longest` (s); "" if none is. */
function plantBeyond({ lag, delay, noise, defects, wind: { gust_on_vehicle, gust_on_bob } = {} } = {}, { rotor_limits: [least, most] = [0, 1] } = {}, longest) {
  const sizes = { lag, delay, ...noise, ...defects, gust_on_vehicle, gust_on_bob };
  const negative = Object.keys(sizes).find((name) => sizes[name] < 0);
  if (negative) return `plant.${negative}: expected at least 0, got ${sizes[negative]}`;
  if (delay > Math.max(longest, +longest.toPrecision(3))) return `plant.delay: expected at most ${longest} s, got ${delay}`; // a slider rounds
  return least >= 0 && least < most ? "" : `vehicle.rotor_limits: expected 0 <= least < largest, got ${least}, ${most}`;
}

/** The first gain or number of a plant that a setting tells and machine code with such `gains` does not take; "" if it takes all. */
export function unknown({ law, plant = {} }, { gains }) {
  const other = (table = {}, known) => Object.keys(table).find((name) => !known.includes(name));
  const gain = other(law.gains, gains);
  if (gain) return `law.gains.${gain}`;
  if (plant.base === "ideal") return "";
  const force = other(plant.wind, Object.keys(WIND)), number = force ? `wind.${force}` : other(plant, PLANT);
  return number ? `plant.${number}` : "";
}

/** As `unknown`, for machine code with gains that its law took from rotor limits. */
export const untaken = (setting, facts) => (setting.vehicle?.rotor_limits ? "vehicle.rotor_limits" : unknown(setting, facts));

/** Whether the rows of `R` are an orthonormal, right-handed frame. */
function rotation([a, b, c]) {
  const across = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
  return [norm(a) - 1, norm(b) - 1, dot(a, b), ...across.map((value, k) => value - c[k])].every((error) => Math.abs(error) < CLOSE);
}
