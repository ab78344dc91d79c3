// The rod at the start, to be dragged over the sphere of its directions, or turned by the arrow keys.

import { Raycaster, Vector2 } from "three";

import { dot, unit } from "../numbers.js";

const TURN = Math.PI / 36; // by an arrow key

export class Handle {
  /** Over the scene of `viewer`; `moved` is told the direction of the rod, e3 up. */
  constructor(viewer, moved) {
    Object.assign(this, { viewer, moved, ray: new Raycaster() });
    this.root = document.createElement("button");
    Object.assign(this.root, { type: "button", className: "handle", title: "Drag the rod (arrow keys turn it)" });
    this.root.setAttribute("aria-label", "Rod at the start");
    this.root.dataset.keys = "";
    viewer.parts.scene.append(this.root);
    this.root.addEventListener("pointerdown", (event) => {
      this.root.setPointerCapture(event.pointerId);
      this.#hold(true);
      event.stopPropagation();
    });
    this.root.addEventListener("pointermove", (event) => this.held && this.#drag(event));
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) this.root.addEventListener(name, () => this.#hold(false));
    this.root.addEventListener("keydown", (event) => this.#key(event));
  }

  get flyer() {
    return this.viewer.stage?.flyers[0];
  }

  /** Go where the bob is; there is nothing to drag later than at the start. */
  show() {
    const { viewer, flyer } = this, { clock } = viewer;
    this.root.hidden = !flyer || clock.playing || clock.time > clock.start + 1e-9;
    if (this.root.hidden) return;
    const [left, top] = viewer.stage.screen(0, viewer.stage.factor).bob;
    if (!this.held) this.y = flyer.pose.y;
    this.pivot = flyer.pose.x;
    this.root.style.transform = `translate(${left}px, ${top}px)`;
  }

  #hold(held) {
    if (this.held === held) return;
    this.held = held;
    this.viewer.stage.hold("rod", held);
    this.viewer.wake();
  }

  #drag(event) {
    const { viewer, flyer } = this, view = viewer.stage.views[0];
    const area = viewer.parts.canvas.getBoundingClientRect();
    const across = (event.clientX - area.left - view.left) / view.width, down = (event.clientY - area.top - view.top) / view.height;
    this.ray.setFromCamera(new Vector2(2 * across - 1, 1 - 2 * down), view.camera);
    const from = this.ray.ray.origin.toArray(), way = this.ray.ray.direction.toArray();
    // A flight that has just come has no pose before its first frame; its pivot starts where that of the last did.
    const pivot = flyer.pose?.x ?? this.pivot, radius = flyer.flight.vehicle.rod_length * viewer.stage.factor;
    this.y = nearest(from.map((value, k) => (value - pivot[k]) / radius), way, this.y);
    this.moved(this.y);
  }

  #key(event) {
    const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (!steps) return;
    event.preventDefault();
    const { right, up } = this.viewer.stage.views[0], sine = Math.sin(TURN);
    this.y = unit(this.y.map((value, k) => value + sine * (steps[0] * right[k] + steps[1] * up[k])));
    this.moved(this.y);
  }
}

/** Where a ray from `from` along the unit vector `way` meets the unit sphere, nearest to `last`; or comes closest. */
function nearest(from, way, last) {
  const along = dot(from, way), gap = along ** 2 - dot(from, from) + 1;
  const at = (distance) => unit(from.map((value, k) => value + distance * way[k]));
  if (gap <= 0) return at(-along);
  const ends = [at(-along - Math.sqrt(gap)), at(-along + Math.sqrt(gap))];
  return dot(ends[0], last) >= dot(ends[1], last) ? ends[0] : ends[1];
}
