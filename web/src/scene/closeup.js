// The pass of the rod between the arms from near by: a second camera that the vehicle carries, in a corner of the picture.

import { PerspectiveCamera, Vector3 } from "three";

import { lettering } from "../drawing.js";

const FIELD = 32; // of view, degrees
const HALF = 2.7; // radii of the hub from the middle of the picture to its edge
const TILT = 0.35; // rad, off the thrust axis
const SIDE = { share: 0.34, least: 112, most: 560 }; // of the picture's shorter side; CSS pixels
const MARGIN = { right: 14, top: 112 }; // CSS pixels, below the compass
export const NEAR = 1; // the layer of three.js with what is seen: machine and light

export class CloseUp {
  constructor() {
    this.top = MARGIN.top * lettering();
    this.camera = new PerspectiveCamera(FIELD, 1);
    this.camera.matrixAutoUpdate = false;
    this.camera.layers.set(NEAR);
  }

  /** Where it is in a picture of `width` by `height`: CSS pixels from the upper left. */
  place(width, height) {
    const side = Math.round(Math.min(Math.max(SIDE.share * Math.min(width, height), SIDE.least), SIDE.most));
    return { left: width - MARGIN.right - side, top: this.top, side };
  }

  /** Look at the hub of `model`, which is drawn larger by `factor` than it is; returns the way back to the camera. */
  aim(model, factor) {
    const distance = (factor * HALF * model.vehicle.body.hub_radius) / Math.tan((FIELD * Math.PI) / 360);
    const [sine, cosine] = [Math.sin(TILT), Math.cos(TILT)], turned = (...way) => new Vector3(...way).applyQuaternion(model.body.quaternion);
    const back = turned(-sine, 0, cosine), up = turned(cosine, 0, sine), right = turned(0, -1, 0);
    this.camera.matrix.makeBasis(right, up, back).setPosition(back.clone().multiplyScalar(distance).add(model.position));
    Object.assign(this.camera, { near: 0.05 * distance, far: 20 * distance });
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrixWorld(true);
    return back;
  }
}
