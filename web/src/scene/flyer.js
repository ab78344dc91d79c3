// One run in the scene: its machine, the path of its bob and pivot, its reference. World with e3 up.

import { Group, Mesh, MeshBasicMaterial, TorusGeometry } from "three";

import { indexBefore, norm } from "../numbers.js";
import { upright } from "../flight.js";
import { Model } from "./model.js";
import { Ribbon } from "./ribbon.js";

const FINEST = 0.06; // rad that the rod may turn between two points of a drawn path
const MOST = 12000; // points of a path

export class Flyer extends Group {
  /** A `flight` (flight.js), drawn as a ghost or not. */
  constructor(flight, ghost) {
    super();
    this.flight = flight;
    this.model = new Model(flight.vehicle, { ghost });
    const rod = flight.vehicle.rod_length;
    const { times, poses } = path(flight);
    this.pivots = poses.map((pose) => pose.x);
    this.bobs = poses.map((pose) => pose.x.map((value, k) => value + rod * pose.y[k]));
    const opacity = ghost ? 0.7 : 1;
    this.trail = new Ribbon(this.bobs, times, { width: 2.6, tail: 1.2, faint: 0.28, opacity });
    this.track = new Ribbon(this.pivots, times, { width: 1.4, tail: 1.2, faint: 0.3, opacity: 0.7 * opacity });
    const reference = poses.map((pose) => pose.x_ref);
    this.planned = new Ribbon(reference, times, { width: 1.6, opacity: 0.9, dash: 0.25 * rod });
    this.marker = new Group();
    const ring = new TorusGeometry(0.09 * rod, 0.008 * rod, 8, 40);
    this.paint = new MeshBasicMaterial({ transparent: true, opacity: 0.9 });
    for (const [x, y] of [[0, 0], [Math.PI / 2, 0], [0, Math.PI / 2]]) {
      const mesh = new Mesh(ring, this.paint);
      mesh.rotation.set(x, y, 0);
      this.marker.add(mesh);
    }
    this.add(this.track, this.trail, this.planned, this.marker, this.model);
  }

  /** Draw what a growing flight has flown of late: the last `span` seconds. */
  grow(span) {
    const { flight } = this, { t } = flight, rod = flight.vehicle.rod_length;
    const times = Array.from(t.subarray(indexBefore(t, flight.end - span)));
    const poses = times.map((time) => upright(flight.at(time), flight.e3));
    this.pivots = poses.map((pose) => pose.x);
    this.bobs = poses.map((pose) => pose.x.map((value, k) => value + rod * pose.y[k]));
    this.trail.put(this.bobs, times);
    this.track.put(this.pivots, times);
  }

  /** Take `pose`, in the frame of the run. */
  show(pose) {
    this.pose = upright(pose, this.flight.e3);
    this.model.show(this.pose);
    this.model.touch(pose.t >= this.flight.end ? this.flight.verdict.part : null);
    this.marker.position.set(...this.pose.x_ref);
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

/** Times and poses (e3 up) along a flight: its samples, and more where the rod turns fast. */
function path(flight) {
  const times = [], spare = Math.max(1, Math.floor(MOST / flight.t.length));
  flight.t.forEach((t, i) => {
    const step = i + 1 < flight.t.length ? flight.t[i + 1] - t : 0;
    const pieces = Math.min(spare, Math.max(1, Math.ceil(step * norm(flight.sample("y_dot", i)) / FINEST)));
    for (let k = 0; k < (step ? pieces : 1); k++) times.push(t + k / pieces * step);
  });
  return { times, poses: times.map((t) => upright(flight.at(t), flight.e3)) };
}
