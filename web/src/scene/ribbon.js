// A path in space as a ribbon of constant width on the screen, drawn up to a time and paler with age, or dashed.

import {
  Color, InstancedBufferAttribute, InstancedBufferGeometry, Float32BufferAttribute, Mesh, ShaderMaterial, Vector2,
} from "three";

const VERTEX = `
attribute vec3 from, to;
attribute vec2 times, lengths;
uniform vec2 resolution;
uniform float width;
varying float time, along;
void main() {
  vec4 a = projectionMatrix * modelViewMatrix * vec4(from, 1.0);
  vec4 b = projectionMatrix * modelViewMatrix * vec4(to, 1.0);
  float nearest = 1e-3;
  if (a.w < nearest && b.w < nearest) { gl_Position = vec4(2.0, 2.0, 2.0, 1.0); return; }
  if (a.w < nearest) a = mix(a, b, (nearest - a.w) / (b.w - a.w));
  if (b.w < nearest) b = mix(b, a, (nearest - b.w) / (a.w - b.w));
  vec2 way = (b.xy / b.w - a.xy / a.w) * resolution;
  way = length(way) > 1e-6 ? normalize(way) : vec2(1.0, 0.0);
  vec4 here = mix(a, b, position.x);
  vec2 offset = vec2(-way.y, way.x) * position.y + way * (position.x - 0.5) * 0.7;
  here.xy += offset * width / resolution * here.w;
  time = mix(times.x, times.y, position.x);
  along = mix(lengths.x, lengths.y, position.x);
  gl_Position = here;
}`;

const FRAGMENT = `
uniform vec3 color, behind;
uniform float now, tail, faint, opacity, dash;
varying float time, along;
void main() {
  if (time > now) discard;
  if (dash > 0.0 && fract(along / dash) > 0.55) discard;
  float age = clamp((now - time) / tail, 0.0, 1.0);
  gl_FragColor = vec4(mix(behind, color, opacity * mix(1.0, faint, age)), 1.0);
  #include <colorspace_fragment>
}`;

export class Ribbon extends Mesh {
  /**
   * A path through `points` ([[x, y, z], ...], m) at `times` (s): `width` pixels wide, after `tail` seconds as faint as
   * `faint`, in dashes of `dash` metres unless that is 0.
   */
  constructor(points, times, { width = 2, tail = 1, faint = 1, opacity = 1, dash = 0 } = {}) {
    const geometry = new InstancedBufferGeometry();
    geometry.setAttribute("position", new Float32BufferAttribute([0, -1, 0, 1, -1, 0, 1, 1, 0, 0, 1, 0], 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    super(geometry, new ShaderMaterial({
      vertexShader: VERTEX, fragmentShader: FRAGMENT,
      uniforms: {
        resolution: { value: new Vector2(1, 1) }, color: { value: new Color() }, behind: { value: new Color() }, width: { value: width },
        now: { value: Infinity }, tail: { value: tail }, faint: { value: faint }, opacity: { value: opacity },
        dash: { value: dash },
      },
    }));
    this.frustumCulled = false;
    this.put(points, times);
  }

  /** Take another path. */
  put(points, times) {
    const { geometry } = this, count = Math.max(points.length - 1, 0), lengths = [0];
    for (let i = 1; i < points.length; i++) {
      lengths.push(lengths[i - 1] + Math.hypot(...points[i].map((value, k) => value - points[i - 1][k])));
    }
    const pair = (values) => (i) => values[(i >> 1) + (i & 1)];
    this.#set("from", 3, count, (i) => points[Math.floor(i / 3)][i % 3]);
    this.#set("to", 3, count, (i) => points[Math.floor(i / 3) + 1][i % 3]);
    this.#set("times", 2, count, pair(times));
    this.#set("lengths", 2, count, pair(lengths));
    geometry.instanceCount = count;
    this.visible = count > 0;
  }

  /** Fill an attribute, in the room that it has if that is enough: what the graphics card holds is written over. */
  #set(name, width, count, value) {
    let attribute = this.geometry.getAttribute(name);
    if (!attribute || attribute.count < count) {
      if (attribute) this.geometry.dispose();
      attribute = new InstancedBufferAttribute(new Float32Array(width * (attribute ? 2 * count : count)), width);
      this.geometry.setAttribute(name, attribute);
    }
    for (let i = 0; i < width * count; i++) attribute.array[i] = value(i);
    attribute.needsUpdate = true;
  }

  /** Show the path up to the time `now`, for a viewport of `width` by `height` pixels. */
  draw(now, width, height) {
    this.material.uniforms.now.value = now;
    this.material.uniforms.resolution.value.set(width, height);
  }

  /** Colours of the path, and of what it fades into: opaque, so that its pieces may overlap. */
  colour(css, behind) {
    this.material.uniforms.color.value.set(css);
    this.material.uniforms.behind.value.set(behind);
  }
}
