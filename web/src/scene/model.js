// The machine: hub, arms, rotors, thrust arrows, rod and bob, as a group that takes poses with e3 up. Metres.

import {
  BoxGeometry, Color, ConeGeometry, CylinderGeometry, DoubleSide, Group, Mesh, MeshBasicMaterial, MeshStandardMaterial, ShaderMaterial,
  SphereGeometry, TorusGeometry, Vector3,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { NEAR } from "./closeup.js";
import { motor, Rotors } from "./rotor.js";

const UP = new Vector3(0, 1, 0); // along which three.js builds cylinders
const Z = new Vector3(0, 0, 1);
const HOVER_ARROW = 0.7, LONGEST_ARROW = 1.1; // lengths of the thrust arrow over the rod, as in the figures
const ROTOR_ARROW = 0.32; // the same for one rotor that carries its share
const CAGE = { room: 1.08, most: 0.8, thick: 0.007 }; // of a gimbal: radius over that of the machine, at most of the rod; of its bars
const CUP = 0.24; // slant height of a cup over the rod
const SWOLLEN = 2; // how much thicker an arm that was touched is drawn, to be seen

const MADE = { // carbon, aluminium, lacquer, plastic
  body: { roughness: 0.42, metalness: 0.25 }, rod: { roughness: 0.32, metalness: 0.08 }, front: { roughness: 0.5, metalness: 0 },
  rear: { roughness: 0.4, metalness: 0.3 }, thrust: { roughness: 0.6, metalness: 0 },
};
const BUILD = ["rod_length", "rod_end", "rotor_positions", "rotor_spins", "rotor_radius", "mount", "body"];

const RIM_VERTEX = `
varying vec3 normalSeen, seen;
void main() {
  vec4 view = modelViewMatrix * vec4(position, 1.0);
  normalSeen = normalMatrix * normal;
  seen = -view.xyz;
  gl_Position = projectionMatrix * view;
}`;

const RIM_FRAGMENT = `
uniform vec3 color;
uniform float opacity;
varying vec3 normalSeen, seen;
void main() {
  float facing = abs(dot(normalize(normalSeen), normalize(seen)));
  gl_FragColor = vec4(color, opacity * mix(0.08, 1.0, 1.0 - smoothstep(0.35, 0.62, facing)));
  #include <colorspace_fragment>
}`;

/** Paint that shows the outline of a body, and lets be seen what is inside and behind. */
function outline(opacity) {
  return new ShaderMaterial({
    vertexShader: RIM_VERTEX, fragmentShader: RIM_FRAGMENT, transparent: true, depthWrite: false,
    uniforms: { color: { value: new Color() }, opacity: { value: opacity } },
  });
}

/** Where the parts of the machine get their colours; a ghost is translucent, casts no shadow, and has one colour. */
function paints(ghost) {
  const roles = ["body", "front", "rear", "rod", "thrust"];
  return Object.fromEntries(roles.map((role) => {
    const paint = new MeshStandardMaterial({ ...MADE[role], side: DoubleSide });
    if (ghost) Object.assign(paint, { transparent: true, opacity: 0.38, depthWrite: false, forceSinglePass: true });
    return [role, paint];
  }));
}

function solid(geometry, paint, ghost) {
  const mesh = new Mesh(geometry, paint);
  mesh.castShadow = !ghost;
  return mesh;
}

/** A cylinder from `start` to `end`, thinner there where `taper` is less than 1, and where it goes. */
function bar(start, end, radius, taper = 1) {
  const along = end.clone().sub(start), mesh = new Mesh(new CylinderGeometry(taper * radius, radius, along.length(), 14));
  mesh.quaternion.setFromUnitVectors(UP, along.clone().normalize());
  mesh.position.copy(start).addScaledVector(along, 0.5);
  return mesh;
}

/** The shape of `mesh` where it is. */
function placed(mesh) {
  mesh.updateMatrix();
  return mesh.geometry.applyMatrix4(mesh.matrix);
}

/** Plates, standoffs and the battery between the arms of a machine of a `span`. */
function hull(span) {
  const plate = (z, radius) => new CylinderGeometry(radius, radius, 0.02 * span, 8).rotateX(Math.PI / 2).rotateZ(Math.PI / 8).translate(0, 0, z);
  const standoff = (x, y) => new CylinderGeometry(0.014 * span, 0.014 * span, 0.14 * span, 8).rotateX(Math.PI / 2).translate(x, y, 0.05 * span);
  const corners = [[1, 1], [-1, 1], [-1, -1], [1, -1]].map(([x, y]) => standoff(0.13 * x * span, 0.13 * y * span));
  const battery = new BoxGeometry(0.4 * span, 0.19 * span, 0.14 * span).translate(0, 0, -0.1 * span);
  return [plate(-0.02 * span, 0.26 * span), plate(0.12 * span, 0.2 * span), battery, ...corners];
}

/** Shaft and head of an arrow, of length and width 1; `open` as an outline. */
const arrow = (open) => [new CylinderGeometry(0.5, 0.5, 1, 24, 1, open), new ConeGeometry(open ? 1 : 1.5, 1, 32, 1, open)];

/** An arrow along +z of its group, of length 1 before `stretch`; a force casts no shadow. */
class Arrow extends Group {
  constructor(width, [shaft, head], paint, heads = 4.5) {
    super();
    Object.assign(this, { width, heads, shaft: new Mesh(shaft, paint), head: new Mesh(head, paint) });
    this.add(this.shaft, this.head);
    for (const part of [this.shaft, this.head]) part.rotation.x = Math.PI / 2;
  }

  stretch(length) {
    const size = Math.abs(length), head = Math.min(this.heads * this.width, 0.6 * size);
    this.visible = size > 0.4 * this.width;
    this.rotation.x = length < 0 ? Math.PI : 0;
    this.shaft.scale.set(this.width, Math.max(size - head, 1e-6), this.width);
    this.shaft.position.z = (size - head) / 2;
    this.head.scale.set(this.width, Math.max(head, 1e-6), this.width);
    this.head.position.z = size - head / 2;
  }
}

export class Model extends Group {
  /**
   * `vehicle` has rod_length, rod_end, weight, rotor_positions, rotor_spins, rotor_radius (SI, body frame front-left-up),
   * mount and body. What the rod can touch is drawn to scale, and is in `parts` by its name.
   */
  constructor(vehicle, { ghost = false } = {}) {
    super();
    Object.assign(this, { vehicle, ghost, paint: paints(ghost), parts: {}, touched: null });
    this.alarm = new MeshBasicMaterial({ transparent: true, opacity: 0.85, side: DoubleSide, forceSinglePass: true });
    const rod = vehicle.rod_length;
    const span = Math.max(...vehicle.rotor_positions.map((position) => Math.hypot(...position)));
    this.body = new Group();
    this.add(this.body, this.#rod(rod));
    this.#frame(span);
    this.rim = outline(ghost ? 0.4 : 0.85);
    this.thrust = new Arrow(0.085 * rod, arrow(true), this.rim, 1.8); // wide enough for the rod to stand inside
    for (const part of [this.body, this.pole]) part.traverse((one) => one.layers.enable(NEAR));
    for (const one of this.arrows) one.traverse((part) => part.layers.disable(NEAR));
    this.body.add(this.thrust);
    this.traverse((part) => (part.frustumCulled = false)); // it is in the picture, and cheaper drawn than looked for
  }

  /** Whether this is what `vehicle` looks like, whatever it weighs and its rotors can. */
  built(vehicle) {
    return BUILD.every((name) => JSON.stringify(vehicle[name]) === JSON.stringify(this.vehicle[name]));
  }

  #frame(span) {
    const { vehicle, paint, ghost } = this;
    const open = vehicle.mount === "hub"; // the rod passes between the arms, and through the ring that carries them
    const { hub_radius: hub, arm_radius: arm } = open ? vehicle.body : { hub_radius: 0, arm_radius: 0.045 * span };
    const lift = open ? 0 : 0.13 * span; // how high discs are drawn above the arms, where nothing can touch them
    if (vehicle.mount === "cup") this.#cup();
    const ends = vehicle.rotor_positions.map((position) => new Vector3(...position));
    const places = ends.map((end) => end.clone().add(new Vector3(0, 0, lift)));
    const still = open ? [new TorusGeometry(hub, arm, 14, 48)] : hull(span);
    for (const place of places) still.push(...motor(vehicle.rotor_radius, 0.13 * span, place));
    ends.forEach((end, k) => {
      const strut = bar(end.clone().setLength(hub), end, arm, open ? 1 : 2 / 3);
      if (open) this.#touchable(`arm ${k + 1}`, strut);
      else still.push(placed(strut));
    });
    this.body.add(solid(mergeGeometries(still), paint.body, ghost), this.#rotors(places));
  }

  /** A part that a rod can touch is a mesh of its own. */
  #touchable(name, mesh) {
    Object.assign(mesh, { material: this.paint.body, castShadow: !this.ghost });
    this.parts[name] = [mesh];
    this.body.add(mesh);
  }

  #rotors(places) {
    const { vehicle, paint, ghost } = this, front = Math.max(...places.map(({ x }) => x)) - 1e-9, shape = arrow(false);
    const sides = places.map(({ x }) => (x > front ? "front" : "rear"));
    this.rotors = new Rotors(vehicle.rotor_radius, places, vehicle.rotor_spins, sides, paint, ghost);
    this.arrows = places.map((place) => new Arrow(0.02 * vehicle.rod_length, shape, paint.thrust));
    this.arrows.forEach((one, k) => one.position.copy(places[k]));
    this.body.add(...this.arrows);
    return this.rotors;
  }

  /** The cup, as far as its cone goes: the rod is lost beyond it, or where the cup would have to pull. */
  #cup() {
    const { vehicle, ghost } = this, angle = vehicle.body.cup_angle, slant = CUP * vehicle.rod_length;
    const height = slant * Math.cos(angle), wide = slant * Math.sin(angle);
    const glass = new MeshBasicMaterial({ transparent: true, opacity: ghost ? 0.12 : 0.3, side: DoubleSide, depthWrite: false, forceSinglePass: true });
    const cup = new Mesh(new CylinderGeometry(wide, 0, height, 48, 1, true), glass);
    const rim = solid(new TorusGeometry(wide, 0.008 * vehicle.rod_length, 8, 64), this.paint.body, ghost);
    cup.rotation.x = Math.PI / 2;
    cup.position.z = height / 2;
    rim.position.z = height;
    this.glass = glass;
    this.body.add(cup, rim);
    Object.assign(this.parts, { cone: [cup, rim], cup: [cup, rim] });
  }

  #rod(length) {
    const { paint, ghost } = this;
    this.pole = new Group();
    const thick = this.vehicle.mount === "gimbal" ? 0.016 * length : this.vehicle.body.rod_radius;
    const { rod_end: end, mount } = this.vehicle, cage = mount === "gimbal" ? this.#cage() : null, from = cage?.radius ?? 0;
    const stick = new CylinderGeometry(thick, thick, end - from, 16).rotateX(Math.PI / 2).translate(0, 0, (end + from) / 2);
    const bob = new SphereGeometry(0.08 * length, 36, 24).translate(0, 0, length); // may sit below the far end of the stick
    const joint = cage?.bars ?? [new SphereGeometry(0.032 * length, 20, 14)];
    this.pole.add(solid(mergeGeometries([stick, bob, ...joint]), paint.rod, ghost));
    return this.pole;
  }

  /** The cage of a gimbal, which carries the rod and turns freely about the machine: hoops through the rod and across it. */
  #cage() {
    const { rotor_positions, rotor_radius, rod_length, rod_end } = this.vehicle;
    const machine = Math.max(...rotor_positions.map((place) => Math.hypot(...place))) + rotor_radius;
    const radius = Math.min(CAGE.room * machine, CAGE.most * rod_end), hoop = () => new TorusGeometry(radius, CAGE.thick * rod_length, 8, 72);
    return { radius, bars: [hoop(), hoop().rotateX(Math.PI / 2), hoop().rotateY(Math.PI / 2)] };
  }

  /** Paint the `part` that the rod touched in the colour of alarm; null for none. */
  touch(part) {
    if (part === this.touched) return;
    for (const mesh of this.parts[this.touched] ?? []) {
      mesh.material = mesh.userData.paint;
      mesh.scale.set(1, 1, 1);
    }
    for (const mesh of this.parts[part] ?? []) {
      Object.assign(mesh, { userData: { paint: mesh.material }, material: this.alarm });
      if (part.startsWith("arm")) mesh.scale.set(SWOLLEN, 1, SWOLLEN);
    }
    this.rotors.touch(/^disc/.test(part) ? Number(part.slice(5)) - 1 : -1);
    this.touched = part;
  }

  /** Show `pose`, in the frame with e3 up. */
  show(pose) {
    const { vehicle } = this, hover = Math.max(vehicle.weight, 1e-9);
    const length = (force, share, scale) => {
      const relative = scale * force / share;
      return vehicle.rod_length * Math.max(Math.min(relative, scale * LONGEST_ARROW / HOVER_ARROW), -scale * LONGEST_ARROW / HOVER_ARROW);
    };
    this.position.set(...pose.x);
    this.body.quaternion.set(...pose.quat_xyzw);
    this.pole.quaternion.setFromUnitVectors(Z, new Vector3(...pose.y));
    this.thrust.stretch(length(pose.thrust, hover, HOVER_ARROW));
    const share = hover / this.arrows.length;
    this.arrows.forEach((one, k) => {
      this.rotors.show(k, pose.turned[k], pose.rotor_forces[k] / share);
      one.stretch(length(pose.rotor_forces[k], share, ROTOR_ARROW));
    });
  }

  /** Take the colours of a theme: an object from roles (body, front, rear, rod, thrust, ghost) to CSS colours. */
  colour(colours) {
    const tone = (role) => (this.ghost ? colours.ghost : colours[role]);
    for (const [role, paint] of Object.entries(this.paint)) paint.color.set(tone(role));
    this.rim.uniforms.color.value.set(tone("thrust"));
    this.glass?.color.set(tone("body"));
    this.rotors.colour(tone, colours.failed);
    this.alarm.color.set(colours.failed);
  }
}
