// A pole beside the start, banded like a surveyor's rod, by which one sees how high the machine is.

import { Color, CylinderGeometry, Mesh, ShaderMaterial } from "three";

import { roundUp } from "../numbers.js";
import { PLACED } from "./world.js";

const ASIDE = 1.5, ABOVE = 2; // reaches of the machine, to the side of the start and over the highest point
const BAND = 0.25, MARK = 0.8; // reaches, at least, of a band and between two marks with a number
const NEAR = 1.6; // reaches over and under the machine, as far as there are numbers

const FRAGMENT = `
uniform vec3 dark, bright;
uniform float band, zero;
varying vec3 place;
void main() {
  gl_FragColor = vec4(mod(floor((place.z - zero) / band), 2.0) < 0.5 ? dark : bright, 1.0);
  #include <colorspace_fragment>
}`;

export class Pole extends Mesh {
  /** For a flight from `start` in the horizontal `direction`, over the `ground` and up to `top`, by a machine of a `reach`; m. */
  constructor(start, direction, ground, top, reach) {
    const end = top + ABOVE * reach, shape = new CylinderGeometry(0.012 * reach, 0.012 * reach, end - ground, 10).rotateX(Math.PI / 2);
    super(shape, new ShaderMaterial({ vertexShader: PLACED, fragmentShader: FRAGMENT, uniforms: {
      dark: { value: new Color() }, bright: { value: new Color() }, band: { value: roundUp(BAND * reach) }, zero: { value: start[2] },
    } }));
    const size = Math.hypot(direction[0], direction[1]) || 1;
    this.position.set(start[0] - (ASIDE * reach * direction[1]) / size, start[1] + (ASIDE * reach * direction[0]) / size, (ground + end) / 2);
    Object.assign(this, { zero: start[2], ground, end, step: roundUp(MARK * reach), reach, frustumCulled: false });
  }

  /** Heights over the start (m) that are marked near a machine at the height `z`, and where they are. */
  marks(z) {
    const { zero, step, reach, position: { x, y } } = this, first = Math.ceil((Math.max(z - NEAR * reach, this.ground) - zero) / step);
    const last = Math.floor((Math.min(z + NEAR * reach, this.end) - zero) / step);
    return Array.from({ length: Math.max(last - first + 1, 0) }, (_, i) => ({ height: (first + i) * step, place: [x, y, zero + (first + i) * step] }));
  }

  colour(colours) {
    this.material.uniforms.dark.value.set(colours.muted);
    this.material.uniforms.bright.value.set(colours.paper);
  }
}
