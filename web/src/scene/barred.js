// Where a rod cannot start: the part of the sphere of its directions on which it would touch, shaded.

import { Color, DoubleSide, Float32BufferAttribute, Mesh, ShaderMaterial, SphereGeometry } from "three";

const VERTEX = `
attribute float clearance;
varying float room;
void main() {
  room = clearance;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const FRAGMENT = `
uniform vec3 color;
varying float room;
void main() {
  if (room > 0.0) discard;
  gl_FragColor = vec4(color, 0.3);
  #include <colorspace_fragment>
}`;

export class Barred extends Mesh {
  constructor() {
    const paint = { transparent: true, depthWrite: false, side: DoubleSide, uniforms: { color: { value: new Color() } } };
    super(new SphereGeometry(1, 96, 64), new ShaderMaterial({ vertexShader: VERTEX, fragmentShader: FRAGMENT, ...paint }));
    this.visible = false;
  }

  /** The directions of which it has to know whether they are free; unit vectors, e3 up. */
  get directions() {
    const { array, count } = this.geometry.attributes.position;
    return Array.from({ length: count }, (_, i) => Array.from(array.subarray(3 * i, 3 * i + 3)));
  }

  /** Take the clearance of the rod in each of the directions, m. */
  take(clearances) {
    this.geometry.setAttribute("clearance", new Float32BufferAttribute(clearances, 1));
    this.known = clearances.some((clearance) => clearance <= 0);
  }

  /** Show it about `pivot` for a rod of a `length`, or with null not at all; true if that changes what is seen. */
  place(pivot, length) {
    const seen = Boolean(pivot && this.known), changed = seen !== this.visible;
    this.visible = seen;
    if (seen) this.position.set(...pivot);
    if (seen) this.scale.setScalar(length);
    return changed;
  }

  colour(colours) {
    this.material.uniforms.color.value.set(colours.failed);
  }
}
