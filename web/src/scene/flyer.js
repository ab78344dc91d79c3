// One run in the scene: its machine, the path of its bob and pivot, its reference. World with e3 up.

import { Group, Mesh, MeshBasicMaterial, TorusGeometry } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { clamp, indexBefore, norm } from "../numbers.js";
import { upright } from "../flight.js";
import { Model } from "./model.js";
import { Ribbon } from "./ribbon.js";

const FINEST = 0.06; // rad that the rod may turn between two points of a drawn path
const MOST = 12000; // points of a path
const REACHED = 0.2, FAINT = 0.12; // rod lengths from the reference within which its mark gives way to the machine, and how far

export class Flyer extends Group {
  /** A `flight` (flight.js), drawn as a ghost or not. It takes over the machine of `last`, a flyer that goes, if it is of one build. */
  constructor(flight, ghost, last) {
    super();
    this.flight = flight;
    this.model = last?.model.built(flight.vehicle) ? last.model : new Model(flight.vehicle, { ghost });
    this.model.vehicle = flight.vehicle;
    const rod = flight.vehicle.rod_length;
    const { times, pivots, bobs, references } = path(flight);
    Object.assign(this, { pivots, bobs, base: pivots[2] });
    const opacity = ghost ? 0.7 : 1;
    this.trail = new Ribbon(this.bobs, times, { width: 2.6, tail: 1.2, faint: 0.28, opacity });
    this.track = new Ribbon(this.pivots, times, { width: 1.4, tail: 1.2, faint: 0.3, opacity: 0.7 * opacity });
    this.planned = new Ribbon(references, times, { width: 1.6, opacity: 0.9, dash: 0.25 * rod });
    const ring = () => new TorusGeometry(0.09 * rod, 0.008 * rod, 8, 40);
    this.paint = new MeshBasicMaterial({ transparent: true, opacity: 0.9 });
    this.marker = new Mesh(mergeGeometries([ring(), ring().rotateX(Math.PI / 2), ring().rotateY(Math.PI / 2)]), this.paint);
    this.add(this.track, this.trail, this.planned, this.marker, this.model);
  }

  /** Draw what a growing flight has flown since the last time, or if `anew` its last `span` seconds alone. */
  grow(span, anew) {
    const { flight } = this, { x, y } = flight.columns;
    const first = anew || !this.until ? indexBefore(flight.t, flight.end - span) : indexBefore(flight.t, this.until) + 1;
    const times = flight.t.subarray(first), rod = flight.vehicle.rod_length, size = 3 * times.length;
    Object.assign(this, { pivots: new Float64Array(size), bobs: new Float64Array(size) });
    for (let i = 0, from = 3 * first; i < size; i++) {
      const sign = i % 3 && flight.e3 === "down" ? -1 : 1;
      this.pivots[i] = sign * x[from + i];
      this.bobs[i] = sign * (x[from + i] + rod * y[from + i]);
    }
    for (const [ribbon, places] of [[this.trail, this.bobs], [this.track, this.pivots]]) {
      if (anew || !this.until) ribbon.put(places, times);
      else ribbon.add(places, times);
    }
    this.until = flight.end;
  }

  /** Take `pose`, in the frame of the run. */
  show(pose) {
    this.pose = upright(pose, this.flight.e3);
    this.model.show(this.pose);
    this.model.touch(pose.t >= this.flight.end ? this.flight.verdict.part : null);
    const { x, x_ref } = this.pose, off = norm(x.map((value, k) => value - x_ref[k]));
    this.marker.position.set(...x_ref);
    this.paint.opacity = 0.9 * clamp(off / (REACHED * this.flight.vehicle.rod_length), FAINT, 1);
  }

  /** Draw in a viewport of `width` by `height` pixels, the machine larger by `factor` than it is. */
  draw(width, height, factor) {
    this.model.scale.setScalar(factor);
    for (const ribbon of [this.trail, this.track]) ribbon.draw(this.pose.t, width, height);
    this.planned.draw(Infinity, width, height);
  }

  colour(colours) {
    this.model.colour(colours);
    this.trail.colour(this.model.ghost ? colours.ghost : colours.trail, colours.sky);
    this.track.colour(this.model.ghost ? colours.ghost : colours.ink, colours.sky);
    this.planned.colour(colours.reference, colours.sky);
    this.paint.color.set(colours.reference);
  }
}

/** Along a flight, e3 up: times (its samples, and more where the rod turns fast), and places one after the other. */
function path(flight) {
  const times = [], spare = Math.max(1, Math.floor(MOST / flight.t.length)), rod = flight.vehicle.rod_length;
  flight.t.forEach((t, i) => {
    const step = i + 1 < flight.t.length ? flight.t[i + 1] - t : 0;
    const pieces = Math.min(spare, Math.max(1, Math.ceil(step * norm(flight.sample("y_dot", i)) / FINEST)));
    for (let k = 0; k < (step ? pieces : 1); k++) times.push(t + k / pieces * step);
  });
  const [pivots, bobs, references] = [0, 1, 2].map(() => new Float64Array(3 * times.length));
  times.forEach((t, i) => {
    const { x, y, x_ref } = upright(flight.at(t), flight.e3);
    pivots.set(x, 3 * i);
    bobs.set(x.map((value, k) => value + rod * y[k]), 3 * i);
    references.set(x_ref, 3 * i);
  });
  return { times, pivots, bobs, references };
}
