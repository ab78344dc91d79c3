// The rod in the hand: at the start, dragged over the sphere of its directions; in a flight that goes on, pulled by the bob.

import { Raycaster, Vector2 } from "three";

import { move, write } from "../drawing.js";
import { spring } from "../live/spring.js";
import { dot, norm, unit } from "../numbers.js";

const TURN = Math.PI / 36; // by an arrow key
const ARM = 0.6; // rod lengths, by which an arrow key pulls
const COIL = { turns: 9, wide: 5 }; // of the drawn spring; CSS pixels
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

export class Handle {
  /** Over the scene of `viewer`; `moved` is told the direction of the rod, `pulled` a place in space or null; e3 up. */
  constructor(viewer, moved, pulled) {
    Object.assign(this, { viewer, moved, pulled, ray: new Raycaster(), going: false });
    this.root = document.createElement("button");
    Object.assign(this.root, { type: "button", className: "handle" });
    this.root.dataset.keys = "";
    this.invite = document.createElement("span");
    this.invite.className = "invite";
    this.root.append(this.invite);
    this.#name(false);
    this.coil = document.createElementNS("http://www.w3.org/2000/svg", "svg");
    this.coil.classList.add("coil");
    this.coil.setAttribute("aria-hidden", "true");
    this.coil.innerHTML = "<polyline/>";
    this.newtons = Object.assign(document.createElement("p"), { className: "newtons", hidden: true });
    viewer.parts.scene.append(this.coil, this.newtons, this.root);
    this.root.addEventListener("pointerdown", (event) => {
      this.root.setPointerCapture(event.pointerId);
      this.#hold(true);
      event.stopPropagation();
    });
    this.root.addEventListener("pointermove", (event) => this.held && this.#drag(event));
    for (const name of ["pointerup", "pointercancel", "lostpointercapture"]) this.root.addEventListener(name, () => this.#hold(false));
    this.root.addEventListener("keydown", (event) => this.#key(event));
    for (const name of ["keyup", "blur"]) this.root.addEventListener(name, () => this.going && !this.held && this.pulled(null));
  }

  get flyer() {
    return this.viewer.stage?.flyers[0];
  }

  /** Go where the bob is; there is nothing to drag later than at the start, unless the flight goes on: `going`. Draw a `pull`. */
  show(going, pull) {
    const { viewer, flyer } = this, { clock } = viewer;
    if (going !== this.going) this.#name(going);
    this.root.hidden = !flyer || (!going && (clock.playing || clock.time > clock.start + 1e-9));
    const seen = !this.root.hidden && !going;
    if (flyer && viewer.stage.barred.place(seen && flyer.pose.x, viewer.stage.factor * flyer.flight.vehicle.rod_length)) viewer.wake();
    this.#spring(going && flyer ? pull : null);
    if (this.root.hidden) return;
    const [left, top] = viewer.stage.screen(0, viewer.stage.factor).bob;
    if (!this.held) this.y = flyer.pose.y;
    this.pivot = flyer.pose.x;
    move(this.root, `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`);
    this.root.classList.toggle("deep", 2 * top > viewer.stage.height);
  }

  /** Draw the spring of a `pull` from the bob to the hand, with its force; null: none. */
  #spring(pull) {
    this.newtons.hidden = !pull;
    this.coil.classList.toggle("none", !pull);
    if (!pull) return;
    const { pose: { x_dot, y_dot }, flight: { vehicle: { rod_length } } } = this.flyer, bob = this.#bob();
    const force = norm(spring(pull, bob, x_dot.map((value, k) => value + rod_length * y_dot[k])));
    const from = this.viewer.stage.locate(bob), to = this.viewer.stage.locate(pull.place);
    this.coil.firstChild.setAttribute("points", coil(from, to).map((place) => place.map((value) => value.toFixed(1)).join()).join(" "));
    write(this.newtons, `${force.toFixed(1)} N`);
    move(this.newtons, `translate(${to[0].toFixed(1)}px, ${to[1].toFixed(1)}px)`);
  }

  #name(going) {
    this.going = going;
    this.root.title = going ? "Drag the bob and fling it (arrow keys pull)" : "Drag the rod to set the start (arrow keys turn it)";
    this.invite.textContent = going ? "Grab the ball" : "Drag to set the start";
    this.root.setAttribute("aria-label", `${this.invite.textContent}: ${going ? "bob in flight" : "rod"}`);
  }

  #hold(held) {
    if (this.held === held) return;
    if (held) this.invite.hidden = true; // they know
    this.held = held;
    if (this.going && !held) this.pulled(null);
    this.viewer.stage.hold("rod", held && !this.going);
    this.viewer.wake();
  }

  #drag(event) {
    const { viewer, flyer } = this, view = viewer.stage.views[0];
    const area = viewer.parts.canvas.getBoundingClientRect();
    const across = (event.clientX - area.left - view.left) / view.width, down = (event.clientY - area.top - view.top) / view.height;
    this.ray.setFromCamera(new Vector2(2 * across - 1, 1 - 2 * down), view.camera);
    const from = this.ray.ray.origin.toArray(), way = this.ray.ray.direction.toArray();
    if (this.going) {
      this.pulled(this.#across(from, way, view.back));
      return;
    }
    // A flight that has just come has no pose before its first frame; its pivot starts where that of the last did.
    const pivot = flyer.pose?.x ?? this.pivot, radius = flyer.flight.vehicle.rod_length * viewer.stage.factor;
    this.y = nearest(from.map((value, k) => (value - pivot[k]) / radius), way, this.y);
    this.moved(this.y);
  }

  /** Where a ray meets the plane through the bob that faces the camera. */
  #across(from, way, back) {
    const bob = this.#bob(), distance = dot(bob.map((value, k) => value - from[k]), back) / dot(way, back);
    return from.map((value, k) => value + distance * way[k]);
  }

  #bob() {
    const { pose, flight } = this.flyer;
    return pose.x.map((value, k) => value + flight.vehicle.rod_length * pose.y[k]);
  }

  #key(event) {
    const steps = ARROWS[event.key];
    if (!steps) return;
    event.preventDefault();
    this.invite.hidden = true;
    if (this.going) {
      const { right: across, up: along } = this.viewer.stage.views[0], arm = ARM * this.flyer.flight.vehicle.rod_length;
      this.pulled(this.#bob().map((value, k) => value + arm * (steps[0] * across[k] + steps[1] * along[k])));
      return;
    }
    const { right, up } = this.viewer.stage.views[0], sine = Math.sin(TURN);
    this.y = unit(this.y.map((value, k) => value + sine * (steps[0] * right[k] + steps[1] * up[k])));
    this.moved(this.y);
  }
}

/** Corners of a spring on the screen, between two places. */
function coil(from, to) {
  const way = to.map((value, k) => value - from[k]), size = Math.hypot(...way) || 1, aside = [-way[1] / size, way[0] / size];
  const turns = Array.from({ length: COIL.turns }, (_, i) => {
    const share = (i + 1) / (COIL.turns + 1), out = i % 2 ? COIL.wide : -COIL.wide;
    return from.map((value, k) => value + share * way[k] + out * aside[k]);
  });
  return [from, ...turns, to];
}

/** Where a ray from `from` along the unit vector `way` meets the unit sphere, nearest to `last`; or comes closest. */
function nearest(from, way, last) {
  const along = dot(from, way), gap = along ** 2 - dot(from, from) + 1;
  const at = (distance) => unit(from.map((value, k) => value + distance * way[k]));
  if (gap <= 0) return at(-along);
  const ends = [at(-along - Math.sqrt(gap)), at(-along + Math.sqrt(gap))];
  return dot(ends[0], last) >= dot(ends[1], last) ? ends[0] : ends[1];
}
