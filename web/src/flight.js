// A run as the page knows it: columns of samples, and the pose at any time between them.
//
// A pose holds, in the frame of the run and in SI units: t, x, x_dot, quat_xyzw (body to world), y, y_dot, thrust (along
// the body's e3), rotor_forces, x_ref, excess over the tolerances of the verdict, and `turned`, the angle of each drawn rotor in radians.

import { clamp, dot, hermite, indexBefore, matrix, mix, slerp, unit } from "./numbers.js";
import { phases, STANDS } from "./phases.js";
import { Recoveries } from "./recoveries.js";

const TURNS_IN_HOVER = 2.5; // drawn turns of a rotor per second of flight that carries its share of the weight
const ABOUT = 0.15, LEVEL = Math.SQRT1_2; // s and sine: of a pass between the arms
const QUARTER_TURN = Math.cos(Math.PI / 4); // |<q, q'>| of a quarter turn: beyond it nothing can be interpolated

/** Little-endian 32-bit floats from base64 text. */
export function floats(base64) {
  const bytes = Uint8Array.from(atob(base64), (character) => character.charCodeAt(0));
  return new Float32Array(bytes.buffer);
}

export class Flight {
  /** `record` is one entry of `runs` that flypend.pages.replay writes: facts about the run, and `columns`, arrays or in base64. */
  constructor(record) {
    const { columns, ...facts } = record;
    Object.assign(this, facts);
    this.columns = Object.fromEntries(Object.entries(columns).map(([name, values]) => [name, typeof values === "string" ? floats(values) : values]));
    this.t = this.columns.t;
    this.rotors = this.vehicle.rotor_positions.length;
    this.turned = angles(this);
  }

  get start() {
    return this.t[0];
  }

  get end() {
    return this.t[this.t.length - 1];
  }

  /** The sample `i` of a column with `width` numbers to a sample, as an array. */
  sample(name, i, width = 3) {
    const values = this.columns[name], out = new Array(width); // by hand: a slice of a typed array takes five times as long
    for (let k = 0; k < width; k++) out[k] = values[i * width + k];
    return out;
  }

  /** The pose at the time `t`; before the start and after the end, the first and the last. */
  at(t) {
    const time = clamp(t, this.start, this.end);
    const i = Math.min(indexBefore(this.t, time), Math.max(this.t.length - 2, 0));
    const j = Math.min(i + 1, this.t.length - 1);
    const step = this.t[j] - this.t[i];
    let share = step > 0 ? (time - this.t[i]) / step : 0;
    const [q, q1] = [this.sample("quat_xyzw", i, 4), this.sample("quat_xyzw", j, 4)];
    const [y, y1] = [this.sample("y", i), this.sample("y", j)];
    if (Math.abs(dot(q, q1)) < QUARTER_TURN || dot(y, y1) < 0) share = Math.round(share);
    const between = (name, width) => this.sample(name, i, width).map((value, k) =>
      mix(value, this.columns[name][j * width + k], share));
    const curve = (name, rate) =>
      hermite(this.sample(name, i), this.sample(rate, i), this.sample(name, j), this.sample(rate, j), step, share);
    return {
      t: time,
      x: curve("x", "x_dot"),
      x_dot: between("x_dot", 3),
      quat_xyzw: slerp(q, q1, share),
      y: unit(curve("y", "y_dot")),
      y_dot: between("y_dot", 3),
      thrust: between("thrust", 1)[0],
      rotor_forces: between("rotor_forces", this.rotors),
      x_ref: between("x_ref", 3),
      excess: between("excess", 1)[0],
      ...(this.columns.clearance && { clearance: between("clearance", 1)[0] }),
      turned: this.turned[i].map((value, k) => mix(value, this.turned[j][k], share)),
    };
  }

  /** What the rod does from when to when, see phases.js. */
  get phases() {
    return (this.found ??= phases(this));
  }

  /** How it is at the time `t`, in one word: "done" while the rod stands, "failed" at the end of a flight that has, else "recovering". */
  state(t) {
    if (t >= this.end && this.verdict.state === "failed") return "failed";
    return this.phase(t) === STANDS ? "done" : "recovering";
  }

  /** What the rod does at the time `t`, in one word. */
  phase(t) {
    return (this.phases.find(({ to }) => t < to) ?? this.phases[this.phases.length - 1]).name;
  }

  /** Its recoveries as they are known at the time `t`, see recoveries.js. */
  recoveries(t) {
    if (!(this.counted?.until <= t)) this.counted = new Recoveries(this.hold);
    return this.counted.read(this, t);
  }

  /** Whether the rod passes between the arms about the time `t`: within 45° of their plane, on a mount where they are in its way. */
  passes(t) {
    if (this.vehicle.mount !== "hub") return false;
    for (let i = indexBefore(this.t, t - ABOUT); i < this.t.length && this.t[i] <= t + ABOUT; i++) {
      const axis = matrix(this.sample("quat_xyzw", i, 4)).map((row) => row[2]);
      if (Math.abs(dot(axis, this.sample("y", i))) < LEVEL) return true;
    }
    return false;
  }

  /** Values to plot over `t` from sample `from` on: "y3", "z3", "thrust", "distance" from the reference, "clearance", "V", or "rotor k". */
  series(name, from = 0) {
    const rotor = /^rotor (\d+)$/.exec(name);
    const read = {
      y3: (i) => this.columns.y[3 * i + 2],
      z3: (i) => matrix(this.sample("quat_xyzw", i, 4))[2][2],
      thrust: (i) => this.columns.thrust[i],
      clearance: (i) => this.columns.clearance[i],
      V: (i) => this.columns.V[i],
      distance: (i) => Math.hypot(...this.sample("x", i).map((value, k) => value - this.columns.x_ref[3 * i + k])),
    }[name] ?? ((i) => this.columns.rotor_forces[this.rotors * i + Number(rotor[1]) - 1]);
    return Float32Array.from({ length: this.t.length - from }, (_, i) => read(from + i));
  }
}

/**
 * Angle of every rotor at every sample, so that the picture at a time does not depend on how one got there; `turned` are those
 * of the first samples, if they are known.
 */
export function angles(flight, turned = []) {
  const { t, rotors, columns, vehicle } = flight;
  const share = vehicle.weight > 0 ? vehicle.weight / rotors : 1;
  const rate = (i, k) => {
    const force = columns.rotor_forces[i * rotors + k] / share;
    return 2 * Math.PI * TURNS_IN_HOVER * Math.sign(force) * Math.sqrt(Math.min(Math.abs(force), 9));
  };
  if (!turned.length) turned.push(new Array(rotors).fill(0));
  for (let i = turned.length; i < t.length; i++) {
    turned.push(turned[i - 1].map((angle, k) => angle + (t[i] - t[i - 1]) * (rate(i, k) + rate(i - 1, k)) / 2));
  }
  return turned;
}

/** A vector of a run in the frame with e3 up: turned by a half turn about e1 if the run has e3 down. */
export const rise = ([a, b, c], e3) => (e3 === "up" ? [a, b, c] : [a, -b, -c]);

/** A pose in the frame with e3 up; what a scene draws. */
export function upright(pose, e3) {
  if (e3 === "up") return pose;
  const turn = (v) => rise(v, e3);
  const [x, y, z, w] = pose.quat_xyzw;
  return {
    ...pose,
    x: turn(pose.x), x_dot: turn(pose.x_dot), y: turn(pose.y), y_dot: turn(pose.y_dot), x_ref: turn(pose.x_ref),
    quat_xyzw: [x, -y, -z, w],
    thrust: -pose.thrust,
  };
}
