// Where the camera stands: an azimuth, an elevation and a distance about a target, with presets that it glides to and
// pointers that turn it. Elevation 90 degrees looks straight down along gravity, which no look-at can.

import { clamp, dot, mix } from "../numbers.js";

export const FIELD = 32; // of view, degrees, along the shorter side of the picture
export const PRESETS = ["overview", "side", "follow", "axis"];
const GLIDE = 0.16; // s, time constant
const LARGER = 0.06; // of the distance: room in the overview for a machine drawn larger than it is, see stage.js

export class Rig {
  /** `direction` is the horizontal way of the flight; `reach` the radius of the machine; `box` all that flies, m. */
  constructor(direction, reach, box) {
    Object.assign(this, { direction, reach, box, zoom: 1, preset: "follow", aspect: 1 });
    this.now = null;
  }

  /** Go to a preset; true if there is one of that name. */
  choose(preset) {
    if (!PRESETS.includes(preset)) return false;
    Object.assign(this, { preset, zoom: 1, turn: 0, lift: 0 });
    return true;
  }

  /** Turn by angles in radians and zoom by a factor, on top of the preset. */
  move(turn, lift, zoom = 1) {
    this.turn += turn;
    this.lift = clamp(this.lift + lift, -Math.PI / 2 - this.#place().elevation, Math.PI / 2 - this.#place().elevation);
    this.zoom = clamp(this.zoom * zoom, 0.15, 12);
    if (this.now) Object.assign(this.now, this.#aim(), { follow: this.now.follow });
  }

  #place() {
    const heading = Math.atan2(this.direction[1], this.direction[0]);
    const tangent = Math.tan(FIELD * Math.PI / 360);
    const near = 1.3 * this.reach / tangent;
    const side = heading - Math.PI / 2;
    if (this.preset === "overview") {
      const way = { azimuth: side - 0.3, elevation: 0.2 };
      return { ...way, distance: Math.max(this.#fit(way, tangent), near), follow: 0 };
    }
    if (this.preset === "side") return { azimuth: side, elevation: 0.21, distance: 1.15 * near, follow: 1 };
    if (this.preset === "axis") return { azimuth: -Math.PI / 2, elevation: Math.PI / 2, distance: 1.15 * near, follow: 1 };
    return { azimuth: side - 0.75, elevation: 0.3, distance: 1.2 * near, follow: 1 };
  }

  /** The distance from which the whole box is in the picture, with room for the machine. */
  #fit(way, tangent) {
    const { right, up, back } = axes(way), { half } = this.box, room = 0.6 * this.reach;
    const across = tangent * Math.max(this.aspect, 1) - LARGER, along = tangent * Math.max(1 / this.aspect, 1) - LARGER;
    const corners = [-1, 1].flatMap((i) => [-1, 1].flatMap((j) => [-1, 1].map((k) => [i * half[0], j * half[1], k * half[2]])));
    return Math.max(...corners.map((corner) => dot(corner, back)
      + Math.max((Math.abs(dot(corner, right)) + room) / across, (Math.abs(dot(corner, up)) + room) / along)));
  }

  #aim() {
    const place = this.#place();
    return {
      azimuth: place.azimuth + this.turn, elevation: place.elevation + this.lift,
      distance: place.distance / this.zoom, follow: place.follow,
    };
  }

  /** Glide for `elapsed` seconds (Infinity: jump); true while still on the way. */
  glide(elapsed) {
    const aim = this.#aim();
    if (!this.now || elapsed === Infinity) {
      this.now = aim;
      return false;
    }
    const share = 1 - Math.exp(-elapsed / GLIDE), { now } = this;
    let way = ((aim.azimuth - now.azimuth + Math.PI) % (2 * Math.PI) + 2 * Math.PI) % (2 * Math.PI) - Math.PI;
    const far = Math.abs(way) + Math.abs(aim.elevation - now.elevation)
      + Math.abs(Math.log(aim.distance / now.distance)) + Math.abs(aim.follow - now.follow);
    if (far < 1e-3) {
      this.now = aim;
      return false;
    }
    now.azimuth += share * way;
    now.elevation = mix(now.elevation, aim.elevation, share);
    now.distance *= (aim.distance / now.distance) ** share;
    now.follow = mix(now.follow, aim.follow, share);
    return true;
  }

  /** The point looked at, for a machine whose pivot is at `pivot`. */
  target(pivot) {
    return this.box.centre.map((value, k) => mix(value, pivot[k], this.now.follow));
  }

  /** Put a three.js perspective camera where it belongs to look at `pivot`. */
  apply(camera, pivot, aspect) {
    const { distance } = this.now, target = this.target(pivot), { back, up, right } = axes(this.now);
    camera.matrix.set(
      right[0], up[0], back[0], target[0] + distance * back[0],
      right[1], up[1], back[1], target[1] + distance * back[1],
      right[2], up[2], back[2], target[2] + distance * back[2],
      0, 0, 0, 1);
    camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
    const half = Math.tan(FIELD * Math.PI / 360) * (aspect < 1 ? 1 / aspect : 1);
    Object.assign(camera, { aspect, fov: 360 / Math.PI * Math.atan(half), near: 0.02 * distance, far: 60 * distance });
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld(true);
    return { target, distance, back, up, right, follow: this.now.follow };
  }
}

/** Unit vectors of a camera in the world: to the right and up the picture, and back from the target to the camera. */
function axes({ azimuth, elevation }) {
  const [ca, sa, ce, se] = [Math.cos(azimuth), Math.sin(azimuth), Math.cos(elevation), Math.sin(elevation)];
  return { back: [ce * ca, ce * sa, se], up: [-se * ca, -se * sa, ce], right: [-sa, ca, 0] };
}
