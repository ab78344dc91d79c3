// What stands still: ground with a grid and the shadow, and a lattice of points in the air that shows motion.

import {
  BufferGeometry, Color, DirectionalLight, Float32BufferAttribute, Group, HemisphereLight, Mesh, PlaneGeometry, Points,
  ShaderMaterial, ShadowMaterial, Vector3, Vector4,
} from "three";

import { roundUp } from "../numbers.js";
import { NEAR } from "./closeup.js";

const SHADE = 0.3; // opacity of a shadow
const SPREAD = 0.3, FADE = 1.2; // of what the machine keeps of the sky's light from the ground: wider and paler with its height
const LAMPS = { alone: { sky: 2.4, fill: 1.3 }, room: { sky: 0.8, fill: 0.8 } }; // strengths beside that of the sun
const LATTICE = 5; // points to each side of the middle

/** A vertex shader that tells each point its place in the world. */
export const PLACED = `
varying vec3 place;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  place = world.xyz;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

const GRID_FRAGMENT = `
uniform vec3 color;
uniform vec2 middle;
uniform float spacing, radius;
uniform vec4 shade; // middle, radius and strength
varying vec3 place;
float lines(float step) {
  vec2 cell = place.xy / step, width = fwidth(cell);
  vec2 near = abs(fract(cell - 0.5) - 0.5) / max(width, 1e-6);
  vec2 shown = (1.0 - clamp(near - 0.1, 0.0, 1.0)) * (1.0 - smoothstep(0.15, 0.6, width));
  return max(shown.x, shown.y);
}
void main() {
  float fade = 1.0 - smoothstep(0.25, 1.0, length(place.xy - middle) / radius);
  float strength = max(0.09, max(0.3 * lines(spacing), 0.55 * lines(5.0 * spacing)));
  float drawn = strength * fade, edge = max(1.0 - dot(place.xy - shade.xy, place.xy - shade.xy) / (shade.z * shade.z), 0.0);
  float shaded = shade.w * edge * edge * (1.0 - drawn);
  gl_FragColor = vec4(color * drawn / max(drawn + shaded, 1e-6), drawn + shaded);
  #include <colorspace_fragment>
}`;

const DUST_VERTEX = `
uniform vec3 middle;
uniform float spacing, size;
varying float shown;
void main() {
  vec3 place = (position + floor(middle / spacing + 0.5)) * spacing;
  vec4 view = viewMatrix * vec4(place, 1.0);
  float away = length(place - middle) / spacing;
  shown = (1.0 - smoothstep(${(LATTICE - 2).toFixed(1)}, ${LATTICE.toFixed(1)}, away)) * smoothstep(0.3, 1.2, -view.z / spacing);
  gl_Position = projectionMatrix * view;
  gl_PointSize = size;
}`;

const DUST_FRAGMENT = `
uniform vec3 color;
uniform float strength;
varying float shown;
void main() {
  float edge = length(gl_PointCoord - 0.5);
  gl_FragColor = vec4(color, 0.6 * strength * shown * (1.0 - smoothstep(0.3, 0.5, edge)));
  #include <colorspace_fragment>
}`;

function shader(vertexShader, fragmentShader, uniforms) {
  return new ShaderMaterial({ vertexShader, fragmentShader, uniforms, transparent: true, depthWrite: false });
}

export class World extends Group {
  /** With the ground at the height `ground`, for machines that fit a sphere of radius `reach`; m. A `room` gives light of its own. */
  constructor(ground, reach, room) {
    super();
    Object.assign(this, { ground, reach, lamps: room ? LAMPS.room : LAMPS.alone });
    this.grid = new Mesh(new PlaneGeometry(1, 1), shader(PLACED, GRID_FRAGMENT, {
      color: { value: new Color() }, middle: { value: new Vector3() }, spacing: { value: 1 }, radius: { value: 10 }, shade: { value: new Vector4() },
    }));
    this.floor = new Mesh(new PlaneGeometry(1, 1), new ShadowMaterial({ depthWrite: false }));
    this.floor.receiveShadow = true;
    this.dust = new Points(lattice(), shader(DUST_VERTEX, DUST_FRAGMENT, {
      color: { value: new Color() }, middle: { value: new Vector3() }, spacing: { value: 1 }, size: { value: 2 }, strength: { value: 1 },
    }));
    this.dust.frustumCulled = false;
    this.grid.renderOrder = -2;
    this.floor.renderOrder = -1;
    this.add(this.grid, this.floor, this.dust, new HemisphereLight(0xffffff, 0xd0ccc4, this.lamps.sky), this.#sun());
    this.traverse((part) => part.isLight && part.layers.enable(NEAR));
  }

  #sun() {
    this.sun = new DirectionalLight(0xffffff, 1.4);
    const { shadow } = this.sun, half = 2.6 * this.reach;
    this.sun.castShadow = true;
    shadow.mapSize.set(1024, 1024);
    Object.assign(shadow.camera, { left: -half, right: half, top: half, bottom: -half, near: 0.1 * this.reach });
    shadow.radius = 2.5;
    const group = new Group();
    this.fill = new DirectionalLight(0xffffff, this.lamps.fill); // from the camera
    group.add(this.sun, this.sun.target, this.fill);
    return group;
  }

  /** Put grid, points and light around `pivot`, as `Rig.apply` sees it; `pixels` to a point. */
  surround(pivot, { target, distance, back, follow }, spacing, pixels) {
    const size = Math.max(14 * distance, 40 * spacing);
    this.grid.position.set(target[0], target[1], this.ground);
    this.grid.scale.set(size, size, 1);
    const grid = this.grid.material.uniforms, dust = this.dust.material.uniforms;
    grid.middle.value.set(target[0], target[1], 0);
    grid.spacing.value = spacing;
    grid.radius.value = size / 2.2;
    dust.middle.value.set(...target);
    dust.spacing.value = roundUp(distance / 9);
    dust.size.value = pixels;
    dust.strength.value = follow;
    this.fill.position.set(...back);
    const height = 6 * this.reach, { camera } = this.sun.shadow;
    this.sun.target.position.set(...pivot);
    this.sun.position.set(pivot[0] + 0.12 * height, pivot[1] + 0.08 * height, pivot[2] + height);
    const fallen = pivot[2] - this.ground, width = 2.1 * camera.right;
    this.floor.position.set(pivot[0] - 0.12 * fallen, pivot[1] - 0.08 * fallen, this.ground);
    this.floor.scale.set(width, width, 1);
    const high = Math.max(fallen, 0), strength = this.floor.material.opacity / (1 + FADE * (high / this.reach) ** 2);
    grid.shade.value.set(pivot[0], pivot[1], this.reach + SPREAD * high, strength);
    camera.far = 1.2 * (height + Math.max(pivot[2] - this.ground, 0)) + this.reach;
    camera.updateProjectionMatrix();
  }

  colour(colours) {
    this.grid.material.uniforms.color.value.set(colours.grid);
    this.dust.material.uniforms.color.value.set(colours.grid);
    this.floor.material.opacity = SHADE * (new Color(colours.sky).getHSL({}).l > 0.5 ? 1 : 2); // what is dark takes more
  }
}

function lattice() {
  const points = [];
  for (let i = -LATTICE; i <= LATTICE; i++) for (let j = -LATTICE; j <= LATTICE; j++) for (let k = -LATTICE; k <= LATTICE; k++) points.push(i, j, k);
  return new BufferGeometry().setAttribute("position", new Float32BufferAttribute(points, 3));
}
