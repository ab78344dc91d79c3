// A rotor: two blades that blur as through a shutter, by the speed that goes with the force; rim, hub and motor. Metres.

import { CircleGeometry, Color, CylinderGeometry, DoubleSide, Group, Mesh, RingGeometry, ShaderMaterial } from "three";

import { calm } from "../motion.js";

const SWEPT = 1.5; // rad that a blade sweeps while the shutter is open, in hover; the speed goes with the root of the force
const FASTEST = 3; // times the speed in hover

const VERTEX = `
varying vec2 place;
void main() {
  place = 2.0 * uv - 1.0;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

// On the unit disc, in which the blades rest. A blade leaves a trail that fades over the angle swept, behind its leading edge;
// what it covers there is what it covers at rest, so the trail is the paler the longer it is.
const FRAGMENT = `
uniform vec3 color;
uniform float opacity, swept, way;
varying vec2 place;
const float APART = 3.14159265; // rad between two blades
void main() {
  float r = length(place), pixel = max(length(fwidth(place)), 1e-4);
  float chord = mix(0.1, 0.24, smoothstep(0.08, 0.32, r)) * (1.0 - 0.5 * smoothstep(0.3, 1.0, r));
  float blade = min(chord / max(r, 0.05), 0.9 * APART), edge = min(1.5 * pixel / max(r, 0.05), 0.5 * blade);
  float behind = mod(0.5 * blade - way * atan(place.y, place.x), APART);
  float trail = clamp(1.0 - (behind - blade) / max(swept, 1e-3), 0.0, 1.0);
  float sharp = smoothstep(0.0, edge, behind) * (1.0 - smoothstep(blade - edge, blade, behind));
  float over = clamp(1.0 - (behind + APART - blade) / max(swept, 1e-3), 0.0, 1.0); // of the other blade
  float shown = sqrt(blade / (blade + 0.5 * swept)) * max(mix(trail * step(blade - edge, behind), 1.0, sharp), over);
  float whole = sqrt(blade / APART); // of a rotor too fast to be seen turning
  float ink = mix(shown, whole, smoothstep(0.7 * APART, 1.6 * APART, swept));
  gl_FragColor = vec4(color, opacity * max(0.2, ink));
  #include <colorspace_fragment>
}`;

/** Paint of a disc; `opacity` of the whole, at most 1. */
function blurred(opacity) {
  return new ShaderMaterial({
    vertexShader: VERTEX, fragmentShader: FRAGMENT, transparent: true, depthWrite: false, side: DoubleSide,
    uniforms: { color: { value: new Color() }, opacity: { value: opacity }, swept: { value: 0 }, way: { value: 1 } },
  });
}

export class Rotor extends Group {
  /**
   * Of `radius`, on a motor of `height`; `spin` is 1 if it turns clockwise seen from above, else −1. `paint` has the paints of
   * rim and body, of which the body casts a shadow unless it is a `ghost`.
   */
  constructor(radius, height, spin, paint, ghost) {
    super();
    this.spin = spin;
    this.blades = blurred(ghost ? 0.35 : 0.85);
    this.disc = new Mesh(new CircleGeometry(radius, 48), this.blades);
    const rim = new Mesh(new RingGeometry(0.965 * radius, radius, 64), paint.rim);
    const motor = new Mesh(new CylinderGeometry(0.16 * radius, 0.19 * radius, height, 20), paint.body);
    motor.rotation.x = Math.PI / 2;
    motor.position.z = -height / 2;
    const hub = new Mesh(new CylinderGeometry(0.05 * radius, 0.11 * radius, 0.12 * radius, 20), paint.body);
    hub.rotation.x = Math.PI / 2;
    hub.position.z = 0.06 * radius;
    for (const part of [motor, hub]) part.castShadow = !ghost;
    this.add(this.disc, rim, motor, hub);
    this.touched = [this.disc, rim];
  }

  /** Turn to `angle` (rad), with a force of `share` times that in hover; less than nothing turns it the other way. */
  show(angle, share) {
    const still = calm(), { swept, way } = this.blades.uniforms, speed = Math.min(Math.sqrt(Math.abs(share)), FASTEST);
    // Spin +1 is a negative angle about the body's third axis. For whoever wants little motion nothing is seen to turn.
    this.disc.rotation.z = still ? 0 : -this.spin * angle;
    swept.value = still && speed > 0 ? 2 * Math.PI : SWEPT * speed;
    way.value = -this.spin * (share < 0 ? -1 : 1);
  }

  colour(css) {
    this.blades.uniforms.color.value.set(css);
  }
}
