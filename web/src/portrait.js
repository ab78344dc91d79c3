// The phase portrait of the rod: the path of each flight over the sphere of directions, where the rods are, and where the
// rate of the first takes it.

import { clear, lettering, move, write } from "./drawing.js";
import { rise } from "./flight.js";
import { degrees, indexBefore } from "./numbers.js";
import { DASHES } from "./series.js";
import { axes, place, rings, way } from "./sphere.js";

const AHEAD = 0.2; // s, the time that the hand of the rod shows
const MARGIN = 24; // pixels of a usual screen, as all sizes here (drawing.js), for the words at the rim
const NEAR = 20; // pixels between a touch and the path that is meant
const CLEAR = 0.85; // opacity of the disc, behind which the picture goes on
const HTML = `<div class="globe"><canvas role="img"></canvas><i class="hand"></i></div>
  <figcaption><button type="button" class="fold" title="The direction of the rod on its sphere (s)">Rod direction</button>
  <span class="lean"><output></output> from upright, <output></output> rad/s</span>
  <button type="button" class="over">⇅</button></figcaption>`;

export class Portrait {
  /** At the foot of the picture, in `parent`; `seek` is called with a time when the path is touched. */
  constructor(parent, seek) {
    this.root = document.createElement("figure");
    Object.assign(this.root, { className: "portrait", innerHTML: HTML, hidden: true });
    parent.append(this.root);
    const find = (selector) => this.root.querySelector(selector);
    Object.assign(this, { globe: find(".globe"), canvas: find("canvas"), hand: find(".hand"), button: find(".fold"), over: find(".over"), dots: [], flights: [] });
    this.outputs = [...this.root.querySelectorAll("output")];
    this.context = this.canvas.getContext("2d");
    new ResizeObserver(([{ contentRect: { width } }]) => {
      const larger = lettering(), size = width / larger;
      Object.assign(this, { larger, size, radius: size / 2 - MARGIN });
      if (this.colours && this.seen) this.draw(this.colours);
      if (this.poses) this.show(this.poses, false);
    }).observe(this.globe);
    this.globe.addEventListener("pointerdown", (event) => this.#touch(event, seek));
    this.button.addEventListener("click", () => this.fold());
    this.over.addEventListener("click", () => {
      this.#middle(-this.pole);
      this.#anew();
    });
    this.fold(false);
  }

  /** Whether there is anything to draw on. */
  get seen() {
    return this.flights.length > 0 && !this.folded && this.radius > 0;
  }

  /** Put the sphere away, or show it again. */
  fold(folded = !this.folded) {
    this.folded = folded;
    this.button.setAttribute("aria-expanded", String(!folded));
    for (const part of [this.globe, ...this.root.querySelectorAll(".lean, .over")]) part.hidden = folded;
    if (this.flights.length) this.#anew();
  }

  /** Show the paths of `flights` (flight.js), of the first from the time `since` on; `draw` puts them on the canvas. */
  load(flights, since = -Infinity) {
    const [first] = flights, kind = `${first.law} ${first.e3}`;
    Object.assign(this, { flights, since });
    if (this.kind !== kind) this.#middle(rise(first.sample("y", first.t.length - 1), first.e3)[2] < 0 ? -1 : 1);
    this.kind = kind;
    for (const dot of this.dots.splice(flights.length)) dot.remove();
    while (this.dots.length < flights.length) this.dots.push(this.#dot());
    this.root.hidden = false;
    if (this.folded) return;
    this.paths = flights.map((flight, i) => path(flight, i ? -Infinity : since, this.pole));
    this.times = first.t.slice(indexBefore(first.t, since)); // a copy: a flight that goes on moves its own
    this.#tell();
  }

  /** A dot for a rod; that of the first flight is over the others. */
  #dot() {
    const dot = document.createElement("i");
    dot.className = this.dots.length ? "rod ghost" : "rod";
    this.canvas.after(dot);
    return dot;
  }

  /** Have upright (1) or hanging (−1) in the middle: the other is the whole rim, where little can be read. */
  #middle(pole) {
    this.pole = pole;
    this.rim = pole === 1 ? "hanging" : "upright";
    this.over.title = this.over.ariaLabel = `Put ${this.rim} in the middle`;
  }

  #anew() {
    this.load(this.flights, this.since);
    if (this.colours) this.draw(this.colours);
    if (this.poses) this.show(this.poses);
  }

  /** What is drawn, for those who do not see it. */
  #tell() {
    const from = (flight, i) => degrees(rise(flight.sample("y", i), flight.e3)[2]).toFixed(0);
    const words = `Path of the rod over the sphere of directions: ${this.flights.map((flight, k) =>
      `${this.flights.length > 1 ? `${flight.title} ` : ""}from ${from(flight, k ? 0 : indexBefore(flight.t, this.since))}° to ${from(flight, flight.t.length - 1)}° from upright`).join("; ")}`;
    if (words !== this.words) this.canvas.setAttribute("aria-label", words);
    this.words = words;
  }

  /** Draw all that stands still, in the colours of a theme. */
  draw(colours) {
    this.colours = colours;
    if (!this.seen) return;
    const { context, size } = this;
    clear(context, size, size);
    context.translate(size / 2, size / 2);
    Object.assign(context, { fillStyle: colours.sky, globalAlpha: CLEAR });
    context.beginPath();
    context.arc(0, 0, this.radius, 0, 2 * Math.PI);
    context.fill();
    context.globalAlpha = 1;
    rings(context, this.radius, `${colours.grid}60`, colours.muted);
    axes(context, this.radius, this.flights[0].e3, colours.muted);
    context.fillText(`outer edge: ${this.rim}`, 0, (this.flights[0].e3 === "up" ? 1 : -1) * (this.radius + 15));
    for (let i = this.flights.length - 1; i >= 0; i--) {
      this.#pen(i);
      way(context, this.paths[i], this.radius);
      this.#start(this.paths[i], colours);
    }
    this.drawn = this.flights[0].end;
  }

  #pen(i) {
    const { context, colours } = this;
    Object.assign(context, { strokeStyle: i ? colours.ghost : colours.rod, lineWidth: i ? 1.3 : 1.8, lineJoin: "round" });
    context.setLineDash(DASHES[i]);
  }

  /** A ring where a path begins. */
  #start([x, y], colours) {
    const { context, radius } = this;
    context.setLineDash([]);
    context.beginPath();
    context.arc(radius * x, radius * y, 4, 0, 2 * Math.PI);
    context.fillStyle = colours.sky;
    context.fill();
    context.stroke();
  }

  /** The first flight has grown: draw what is new of its path. */
  grow() {
    const [flight] = this.flights;
    if (!this.seen || flight.end <= this.drawn) return;
    this.#pen(0);
    way(this.context, path(flight, this.drawn, this.pole), this.radius);
    this.drawn = flight.end;
  }

  /** Put the rods to their `poses` (in the frames of their runs) and, with `words`, write how they are. */
  show(poses, words = true) {
    this.poses = poses;
    const [{ y, y_dot }] = poses, { e3 } = this.flights[0];
    if (words) {
      write(this.outputs[0], `${degrees(rise(y, e3)[2]).toFixed(0)}°`);
      write(this.outputs[1], Math.hypot(...y_dot).toFixed(1));
    }
    if (!this.seen) return;
    poses.forEach((pose, i) => {
      const [x, y] = this.#pixels(rise(pose.y, this.flights[i].e3));
      move(this.dots[i], `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`);
    });
    this.#reach(rise(y, e3), rise(y_dot, e3));
  }

  /** Turn the hand from where the rod is to where its rate takes it. */
  #reach(y, rate) {
    const next = y.map((value, k) => value + AHEAD * rate[k]), size = Math.hypot(...next);
    const from = place(y, this.pole), to = place(next.map((value) => value / size), this.pole);
    const [x, z] = this.#pixels(y), radius = this.larger * this.radius, across = radius * (to[0] - from[0]), down = radius * (to[1] - from[1]);
    const far = Math.hypot(across, down), long = far > radius ? 0 : far; // that far only through the rim
    move(this.hand, `translate(${x.toFixed(1)}px, ${z.toFixed(1)}px) rotate(${Math.atan2(down, across).toFixed(3)}rad) scaleX(${long.toFixed(1)})`);
  }

  /** Where a direction is on the page, in CSS pixels. */
  #pixels(y) {
    return place(y, this.pole).map((share) => this.larger * (this.size / 2 + this.radius * share));
  }

  /** Go to the time at which the first rod was nearest to a touch. */
  #touch(event, seek) {
    const { left, top } = this.globe.getBoundingClientRect(), [spots] = this.paths;
    const [x, y] = [event.clientX - left, event.clientY - top].map((pixels) => (pixels / this.larger - this.size / 2) / this.radius);
    let best = 0, least = Infinity;
    for (let i = 0; i < spots.length; i += 2) {
      const away = Math.hypot(spots[i] - x, spots[i + 1] - y);
      if (away < least) [best, least] = [i / 2, away];
    }
    if (least * this.radius < NEAR) seek(this.times[best]);
  }
}

/** Places on the disc of the rod of `flight` from the time `since` on. */
function path(flight, since, pole) {
  const first = indexBefore(flight.t, since), out = new Float64Array(2 * (flight.t.length - first));
  for (let i = first; i < flight.t.length; i++) out.set(place(rise(flight.sample("y", i), flight.e3), pole), 2 * (i - first));
  return out;
}
