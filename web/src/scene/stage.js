// The scene on a canvas: flyers, world, camera; all in one picture, the others as ghosts, or side by side.

import { Euler, PerspectiveCamera, PCFShadowMap, PMREMGenerator, Scene, SRGBColorSpace, Vector3, WebGLRenderer } from "three";
import { RoomEnvironment } from "three/addons/environments/RoomEnvironment.js";

import { lettering } from "../drawing.js";
import { calm } from "../motion.js";
import { norm, roundUp } from "../numbers.js";
import { Barred } from "./barred.js";
import { CloseUp } from "./closeup.js";
import { Flyer } from "./flyer.js";
import { Pole } from "./pole.js";
import { Rig } from "./rig.js";
import { Walls } from "./walls.js";
import { World } from "./world.js";

const FLOOR = { under: 1.25, below: 0.35 }; // reaches of the machine: of a floor that is only drawn, under the start, and below all that a flight passes
const LEAST = 0.03; // of its distance: a machine that is further away is drawn larger than it is
const ROOM = 0.55, BLURRED = 0.04; // strength of the light that comes from a room, and how far it is blurred, rad
const SOFTWARE = /swiftshader|llvmpipe|softpipe|software|basic render/i;
const HEIGHT = 70; // CSS pixels that a height beside the pole takes
const EDGE = 12; // CSS pixels from the edge of the picture, at least, to the middle of a height
const STEEP = 0.9; // sine of the camera's elevation from which on a pole is a point

export const LAYOUTS = ["overlay", "beside"];

export class Stage {
  /** On `canvas`, with `flights` as in `load`. Throws where WebGL is missing. */
  constructor(canvas, flights) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.outputColorSpace = SRGBColorSpace;
    Object.assign(this.renderer.shadowMap, { enabled: true, type: PCFShadowMap });
    Object.assign(this, { canvas, layout: "overlay", views: [], flyers: [], ghosts: [], left: [], holds: new Set() });
    this.scene = new Scene();
    this.#surround();
    this.closeUp = new CloseUp();
    this.barred = new Barred();
    this.scene.add(this.barred);
    this.camera = new PerspectiveCamera();
    this.camera.matrixAutoUpdate = false;
    this.load(flights);
  }

  /** Light from a room, which the machine reflects; not where a processor draws, which would take seconds to prepare it. */
  #surround() {
    if (SOFTWARE.test(drawnBy(this.renderer.getContext()))) return;
    const filter = new PMREMGenerator(this.renderer), room = new RoomEnvironment();
    this.scene.environment = filter.fromScene(room, BLURRED).texture;
    this.scene.environmentRotation = new Euler(Math.PI / 2, 0, 0); // from y up, as three.js has its rooms
    this.scene.environmentIntensity = ROOM;
    room.dispose();
    filter.dispose();
  }

  /** Show other `flights` (flight.js); the camera follows the first, from where it is if there was one before. */
  load(flights) {
    this.left.push(...this.#things());
    this.scene.remove(...this.left);
    // A flight that can be a ghost has two machines, one of each kind; only one of them is seen at a time.
    this.flyers = flights.map((flight, i) => new Flyer(flight, false, this.flyers[i]));
    this.ghosts = flights.map((flight, i) => (i ? new Flyer(flight, true, this.ghosts[i]) : null));
    const reach = Math.max(...flights.map((flight) => flight.vehicle.reach));
    const box = bounds(this.flyers.flatMap((flyer) => [flyer.pivots, flyer.bobs]));
    const start = Array.from(this.flyers[0].pivots.subarray(0, 3));
    const floor = flights[0].floor ?? Math.min(start[2] - FLOOR.under * reach, box.centre[2] - box.half[2] - FLOOR.below * reach);
    this.world = new World(floor, reach, Boolean(this.scene.environment));
    this.pole = new Pole(start, flights[0].direction, floor, box.centre[2] + box.half[2], reach);
    this.walls = new Walls(flights[0].windows ?? []);
    this.box = box;
    if (this.rig) Object.assign(this.rig, { direction: flights[0].direction, reach, box: this.holds.size ? this.rig.box : box });
    else {
      this.rig = new Rig(flights[0].direction, reach, box);
      this.rig.choose("follow");
    }
    this.scene.add(...this.#things());
    if (this.colours) this.colour(this.colours);
  }

  /** Compile all shaders side by side, before the first picture waits for one after the other. */
  compile() {
    this.renderer.compile(this.scene, this.camera);
  }

  /** Show what the first flight, one that grows, has flown since, or if `anew` its last `span` seconds alone. */
  grow(span, anew) {
    const [flyer] = this.flyers;
    flyer.grow(span, anew);
    if (!flyer.pivots.length) return;
    const { centre, half } = bounds([flyer.pivots, flyer.bobs]);
    const low = centre.map((value, k) => Math.min(value - half[k], this.box.centre[k] - this.box.half[k]));
    const high = centre.map((value, k) => Math.max(value + half[k], this.box.centre[k] + this.box.half[k]));
    this.box = { centre: low.map((value, k) => (value + high[k]) / 2), half: low.map((value, k) => (high[k] - value) / 2) };
    if (!this.holds.size) this.rig.box = this.box;
  }

  /** Free what was shown before: once the new is drawn, so that it finds the shaders that both use. */
  #free() {
    for (const thing of this.left.splice(0)) {
      thing.traverse((part) => {
        part.geometry?.dispose();
        part.material?.dispose();
        part.dispose?.(); // lights hold the map of their shadow
      });
    }
  }

  /** Hold the camera for a reason, such as something that is dragged, or let it go once there is none. */
  hold(reason, held) {
    if (held) this.holds.add(reason);
    else this.holds.delete(reason);
    if (!this.holds.size) this.rig.box = this.box;
  }

  #things() {
    return [this.world, this.pole, this.walls, ...this.flyers, ...this.ghosts].filter(Boolean);
  }

  /** Colours of a theme, see `Model.colour`. */
  colour(colours) {
    this.colours = colours;
    for (const thing of [this.barred, ...this.#things()]) thing.colour(colours);
  }

  /** Put every flyer to its pose (in the frame of its run). */
  show(poses) {
    poses.forEach((pose, i) => {
      this.flyers[i].show(pose);
      this.ghosts[i]?.show(pose);
    });
  }

  resize(width, height, ratio) {
    Object.assign(this, { width, height, ratio, larger: lettering() });
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
  }

  /** The rectangles of the picture, CSS pixels from the upper left, and which flyers each shows. */
  viewports() {
    const { width, height, flyers } = this;
    if (this.layout === "overlay") return [{ left: 0, top: 0, width, height, main: 0 }];
    const upright = height > 1.15 * width; // narrow pictures go below each other
    const [w, h] = upright ? [width, height / flyers.length] : [width / flyers.length, height];
    return flyers.map((_, main) => ({ left: upright ? 0 : main * w, top: upright ? main * h : 0, width: w, height: h, main }));
  }

  /** Draw, `elapsed` seconds after the last time; true while the camera is on its way. */
  render(elapsed) {
    const { renderer, rig } = this;
    const ports = this.viewports();
    rig.aspect = ports[0].width / ports[0].height;
    const moving = rig.glide(calm() ? Infinity : elapsed);
    renderer.setScissorTest(true);
    this.views = ports.map((port) => {
      const { left, top, width, height, main } = port;
      const pivot = this.flyers[main].pose.x;
      const seen = rig.apply(this.camera, pivot, width / height);
      const away = norm(pivot.map((value, k) => value - this.camera.position.getComponent(k)));
      this.factor = roundUp(Math.max(1, LEAST * away / this.world.reach));
      this.#select(main, width, height);
      const above = this.camera.position.z - this.world.ground;
      this.spacing = roundUp(Math.max(seen.distance, above) / 9);
      this.world.surround(pivot, seen, this.spacing, 2.4 * this.ratio * this.larger);
      const bottom = this.height - top - height;
      renderer.setViewport(left, bottom, width, height);
      renderer.setScissor(left, bottom, width, height);
      renderer.render(this.scene, this.camera);
      return { ...port, ...seen, camera: this.camera.clone() };
    });
    this.near = this.#closeUp();
    this.#free();
    return moving;
  }

  /** Draw the rod near by while it passes between the arms; where, or null. */
  #closeUp() {
    const { renderer, scene, closeUp, width, height, flyers: [flyer] } = this;
    if (this.layout === "beside" || !flyer.flight.passes(flyer.pose.t)) return null;
    const { left, top, side } = closeUp.place(width, height), rectangle = [left, height - top - side, side, side];
    this.world.fill.position.copy(closeUp.aim(flyer.model, this.factor));
    renderer.setViewport(...rectangle);
    renderer.setScissor(...rectangle);
    renderer.shadowMap.autoUpdate = false; // it has just been drawn
    renderer.render(scene, closeUp.camera);
    renderer.shadowMap.autoUpdate = true;
    return { left, top, side, clearance: flyer.pose.clearance };
  }

  #select(main, width, height) {
    const beside = this.layout === "beside";
    this.flyers.forEach((flyer, i) => {
      flyer.visible = i === main;
      if (this.ghosts[i]) this.ghosts[i].visible = !beside;
      (flyer.visible ? flyer : this.ghosts[i])?.draw(width / this.larger, height / this.larger, this.factor);
    });
  }

  /** Where pivot and bob of a flyer are, its rod `factor` times as long: CSS pixels from the upper left of the canvas. */
  screen(which, factor = 1) {
    const view = this.views.find((port) => port.main === which) ?? this.views[0];
    const { x, y } = this.flyers[which].pose, rod = factor * this.flyers[which].flight.vehicle.rod_length;
    return { pivot: project(x, view), bob: project(x.map((value, k) => value + rod * y[k]), view) };
  }

  /** Where a `point` of the world is in the first picture: CSS pixels from the upper left of the canvas. */
  locate(point) {
    return project(point, this.views[0]);
  }

  /**
   * Heights over the start that the pole marks near the first machine, m, their CSS pixels, and how many are free
   * `before` them: 0 where the machine is to the left of the pole, so that no word hides it; and the `size` of their words.
   * None side by side or from above.
   */
  marks() {
    const [view] = this.views;
    if (!view || this.layout === "beside" || Math.abs(view.back[2]) > STEEP) return [];
    const [left, right] = [view.left, view.left + view.width], [machine] = this.screen(0).pivot, size = HEIGHT * this.larger;
    return this.pole.marks(this.flyers[0].pose.x[2]).map(({ height, place }) => ({ height, at: project(place, view) }))
      .map(({ height, at }) => ({ height, at, size, before: machine > at[0] && at[0] - left > size ? size : 0 }))
      .filter(({ at: [across, down] }) => across > left && across < right && down > EDGE && down < view.height - EDGE);
  }
}

/** What draws for `context`, in the words of its maker. */
function drawnBy(context) {
  return String(context.getParameter(context.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? context.RENDERER));
}

/** Where a point of the world is in a `view`: CSS pixels from the upper left of the canvas. */
function project(point, view) {
  const { x: across, y: up } = new Vector3(...point).project(view.camera);
  return [view.left + (across + 1) / 2 * view.width, view.top + (1 - up) / 2 * view.height];
}

/** Middle and half the size of the box around places, which are in arrays one after the other. */
function bounds(arrays) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const places of arrays) {
    for (let i = 0; i < places.length; i++) {
      low[i % 3] = Math.min(low[i % 3], places[i]);
      high[i % 3] = Math.max(high[i % 3], places[i]);
    }
  }
  return { centre: low.map((value, k) => (value + high[k]) / 2), half: low.map((value, k) => (high[k] - value) / 2) };
}
