// Walls with openings to fly through: a translucent plate about each, with an edge along opening and rim.

import {
  BufferGeometry, DoubleSide, ExtrudeGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineLoop, Matrix4, Mesh,
  MeshBasicMaterial, Path, Shape, Vector3,
} from "three";

const BEYOND = 0.7; // times its larger side, so far the plate reaches beyond an opening; the wall has no end
const THINNEST = 0.01; // of that side

export class Walls extends Group {
  /** About `windows` with centre, axes (along width, height and normal), halves and depth; world with e3 up, m. */
  constructor(windows) {
    super();
    this.plates = new MeshBasicMaterial({ transparent: true, opacity: 0.1, side: DoubleSide, depthWrite: false });
    this.edges = new LineBasicMaterial({ transparent: true, opacity: 0.8 });
    for (const window of windows) this.add(this.#wall(window));
  }

  #wall({ centre, axes, halves: [a, b], depth }) {
    const wall = new Group(), side = 2 * Math.max(a, b), thick = Math.max(depth, THINNEST * side);
    const opening = corners(a, b), rim = corners(a + BEYOND * side, b + BEYOND * side);
    const shape = new Shape().setFromPoints(rim);
    shape.holes.push(new Path().setFromPoints(opening));
    wall.add(new Mesh(new ExtrudeGeometry(shape, { depth: thick, bevelEnabled: false }).translate(0, 0, -thick / 2), this.plates));
    for (const points of [opening, rim]) {
      for (const z of [-thick / 2, thick / 2]) wall.add(this.#loop(points, z));
    }
    const [u, v, n] = axes.map((axis) => new Vector3(...axis));
    wall.applyMatrix4(new Matrix4().makeBasis(u, v, n).setPosition(...centre));
    return wall;
  }

  #loop(points, z) {
    const places = points.flatMap(({ x, y }) => [x, y, z]);
    return new LineLoop(new BufferGeometry().setAttribute("position", new Float32BufferAttribute(places, 3)), this.edges);
  }

  colour(colours) {
    for (const material of [this.plates, this.edges]) material.color.set(colours.muted);
  }
}

function corners(a, b) {
  return [[-a, -b], [a, -b], [a, b], [-a, b]].map(([x, y]) => new Vector3(x, y, 0));
}
