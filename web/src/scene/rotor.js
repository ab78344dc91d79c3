// Rotors: two blades each, that blur as through a shutter, by the speed that goes with the force; rims, hubs and motors. Metres.
// All blades of a machine are one mesh, and its rims two: each mesh costs a frame as much as another, however small.

import { CircleGeometry, Color, CylinderGeometry, DoubleSide, Float32BufferAttribute, Group, Mesh, RingGeometry, ShaderMaterial } from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import { calm } from "../motion.js";

const SWEPT = 1.5; // rad that a blade sweeps while the shutter is open, in hover; the speed goes with the root of the force
const FASTEST = 3; // times the speed in hover

const VERTEX = `
attribute float rotor;
uniform vec3 color[ROTORS];
uniform float angle[ROTORS], swept[ROTORS], way[ROTORS];
varying vec2 place;
varying vec3 tone;
varying float sweep, turn, which;
void main() {
  int k = int(rotor + 0.5);
  float c = cos(angle[k]), s = sin(angle[k]);
  place = mat2(c, -s, s, c) * (2.0 * uv - 1.0);
  tone = color[k];
  sweep = swept[k];
  turn = way[k];
  which = rotor;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// On the unit disc, in which the blades rest. A blade leaves a trail that fades over the angle swept, behind its leading edge;
// what it covers there is what it covers at rest, so the trail is the paler the longer it is.
const FRAGMENT = `
uniform vec3 alarm;
uniform float opacity, touched;
varying vec2 place;
varying vec3 tone;
varying float sweep, turn, which;
const float APART = 3.14159265; // rad between two blades
void main() {
  if (abs(which - touched) < 0.5) {
    gl_FragColor = vec4(alarm, 0.85);
    #include <colorspace_fragment>
    return;
  }
  float r = length(place), pixel = max(length(fwidth(place)), 1e-4);
  float chord = mix(0.1, 0.24, smoothstep(0.08, 0.32, r)) * (1.0 - 0.5 * smoothstep(0.3, 1.0, r));
  float blade = min(chord / max(r, 0.05), 0.9 * APART), edge = min(1.5 * pixel / max(r, 0.05), 0.5 * blade);
  float behind = mod(0.5 * blade - turn * atan(place.y, place.x), APART);
  float trail = clamp(1.0 - (behind - blade) / max(sweep, 1e-3), 0.0, 1.0);
  float sharp = smoothstep(0.0, edge, behind) * (1.0 - smoothstep(blade - edge, blade, behind));
  float over = clamp(1.0 - (behind + APART - blade) / max(sweep, 1e-3), 0.0, 1.0); // of the other blade
  float shown = sqrt(blade / (blade + 0.5 * sweep)) * max(mix(trail * step(blade - edge, behind), 1.0, sharp), over);
  float whole = sqrt(blade / APART); // of a rotor too fast to be seen turning
  float ink = mix(shown, whole, smoothstep(0.7 * APART, 1.6 * APART, sweep));
  gl_FragColor = vec4(tone, opacity * max(0.2, ink));
  #include <colorspace_fragment>
}`;

/** Paint of `count` discs; `opacity` of the whole, at most 1. */
function blurred(count, opacity) {
  const zeros = () => new Float32Array(count);
  return new ShaderMaterial({
    vertexShader: VERTEX, fragmentShader: FRAGMENT, defines: { ROTORS: count }, transparent: true, depthWrite: false, side: DoubleSide,
    forceSinglePass: true, // the blades are flat: a second pass would draw nothing
    uniforms: {
      color: { value: new Float32Array(3 * count) }, alarm: { value: new Color() }, opacity: { value: opacity },
      angle: { value: zeros() }, swept: { value: zeros() }, way: { value: zeros() }, touched: { value: -1 },
    },
  });
}

/** Motor and hub of a rotor of `radius` at `place`, on a motor of `height`. */
export function motor(radius, height, place) {
  const upright = (top, bottom, length, z) => new CylinderGeometry(top, bottom, length, 20).rotateX(Math.PI / 2).translate(place.x, place.y, place.z + z);
  return [upright(0.16 * radius, 0.19 * radius, height, -height / 2), upright(0.05 * radius, 0.11 * radius, 0.12 * radius, 0.06 * radius)];
}

export class Rotors extends Group {
  /**
   * Of `radius` at `places`; `spins` are 1 for those that turn clockwise seen from above, else −1; `sides` tells which of the
   * paints "front" and "rear" in `paint` a rim has. Faint if the machine is a `ghost`.
   */
  constructor(radius, places, spins, sides, paint, ghost) {
    super();
    Object.assign(this, { spins, sides });
    const at = (shape, { x, y, z }) => shape.translate(x, y, z);
    const discs = places.map((place, k) => {
      const disc = at(new CircleGeometry(radius, 48), place), numbers = new Array(disc.attributes.position.count).fill(k);
      return disc.setAttribute("rotor", new Float32BufferAttribute(numbers, 1));
    });
    this.blades = blurred(places.length, ghost ? 0.35 : 0.85);
    this.add(new Mesh(mergeGeometries(discs), this.blades));
    for (const side of new Set(sides)) {
      const rims = places.filter((_, k) => sides[k] === side).map((place) => at(new RingGeometry(0.965 * radius, radius, 64), place));
      this.add(new Mesh(mergeGeometries(rims), paint[side]));
    }
  }

  /** Turn rotor `k` to `angle` (rad), with a force of `share` times that in hover; less than nothing turns it the other way. */
  show(k, angle, share) {
    const still = calm(), { angle: turned, swept, way } = this.blades.uniforms, speed = Math.min(Math.sqrt(Math.abs(share)), FASTEST);
    // Spin +1 is a negative angle about the body's third axis. For whoever wants little motion nothing is seen to turn.
    turned.value[k] = still ? 0 : -this.spins[k] * angle;
    swept.value[k] = still && speed > 0 ? 2 * Math.PI : SWEPT * speed;
    way.value[k] = -this.spins[k] * (share < 0 ? -1 : 1);
  }

  /** Have the disc `k` in the colour of alarm; −1 for none. */
  touch(k) {
    this.blades.uniforms.touched.value = k;
  }

  /** Take the colours of a theme: `tone` of a side, and that of alarm. */
  colour(tone, alarm) {
    this.sides.forEach((side, k) => new Color(tone(side)).toArray(this.blades.uniforms.color.value, 3 * k));
    this.blades.uniforms.alarm.value.set(alarm);
  }
}
