// A path in space as a ribbon of constant width on the screen, drawn up to a time and paler with age, or dashed.

import {
  Color, InstancedBufferGeometry, InstancedInterleavedBuffer, InterleavedBufferAttribute, Float32BufferAttribute, Mesh, ShaderMaterial,
  Vector2,
} from "three";

const POINT = 5; // numbers of a point: place, time, length of the path to it

const VERTEX = `
attribute vec3 from, to;
attribute vec2 begun, ended;
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
  time = mix(begun.x, ended.x, position.x);
  along = mix(begun.y, ended.y, position.x);
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
   * A path through `points` at `times` as `put` takes them: `width` pixels wide, after `tail` seconds as faint as
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

  /** Take another path, through `points` (x, y, z of each, one after the other; m) at `times` (s). */
  put(points, times) {
    this.count = 0;
    this.add(points, times);
  }

  /** Go on along the path, through `points` at `times` as for `put`. */
  add(points, times) {
    const begun = this.count, count = begun + times.length, into = this.#room(count).array;
    for (let i = begun, from = 0, to = POINT * begun; i < count; i++, from += 3, to += POINT) {
      const [x, y, z] = [points[from], points[from + 1], points[from + 2]];
      const step = i ? Math.sqrt((x - into[to - 5]) ** 2 + (y - into[to - 4]) ** 2 + (z - into[to - 3]) ** 2) : 0;
      into[to] = x;
      into[to + 1] = y;
      into[to + 2] = z;
      into[to + 3] = times[i - begun];
      into[to + 4] = (i ? into[to - 1] : 0) + step;
    }
    this.points.addUpdateRange(POINT * begun, POINT * times.length);
    this.points.needsUpdate = true;
    this.count = count;
    this.geometry.instanceCount = Math.max(count - 1, 0);
    this.visible = count > 1;
  }

  /** A buffer for `count` points: that which there is, if it is large enough, so that the graphics card's is written over. */
  #room(count) {
    if (!this.points || this.points.count < count) {
      const old = this.points?.array.subarray(0, POINT * this.count) ?? [];
      if (this.points) this.geometry.dispose();
      this.points = new InstancedInterleavedBuffer(new Float32Array(POINT * (this.points ? 2 * count : Math.max(count, 2))), POINT);
      this.points.array.set(old);
      const attribute = (name, size, offset) => this.geometry.setAttribute(name, new InterleavedBufferAttribute(this.points, size, offset));
      attribute("from", 3, 0);
      attribute("to", 3, POINT); // of the next point
      attribute("begun", 2, 3);
      attribute("ended", 2, POINT + 3);
    }
    return this.points;
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
