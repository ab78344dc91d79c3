// The region of attraction: every direction of the rod on a disc of equal areas, upright in the middle, hanging at the rim.

import { clear, lettering } from "../drawing.js";
import { rise } from "../flight.js";
import { degrees } from "../numbers.js";
import { axes, direction, place, rings, way } from "../sphere.js";

const STOPS = ["#00224e", "#3b496c", "#7d7c78", "#bcae6c", "#fee838"]; // cividis, which every kind of vision reads

const REDRAW = 200; // ms between two pictures of a map that grows

const HTML = `<div class="disc"><canvas role="img" aria-label="Region of attraction over the directions of the rod"></canvas></div>
  <div class="told"><p class="share"></p><p class="hint">A point of the disc is a direction of the rod at the start, at rest; the rest of the
  start is that of the flight. Equal areas are equal shares of the sphere. Touch a point to fly from there.</p>
  <div class="scale"><span>0 s</span><i></i><span class="longest"></span><b></b><span>does not settle</span></div><p class="here"></p></div>`;

export class Map {
  /** In `parent`; `chosen` is told a direction (e3 up) that was touched. */
  constructor(parent, chosen) {
    this.root = document.createElement("section");
    Object.assign(this.root, { className: "map", innerHTML: HTML, hidden: true, ariaLabel: "Region of attraction" });
    parent.append(this.root);
    const find = (selector) => this.root.querySelector(selector);
    Object.assign(this, { canvas: find("canvas"), disc: find(".disc"), share: find(".share"), longest: find(".longest"), here: find(".here"), points: [], total: 0, path: [] });
    this.canvas.addEventListener("click", (event) => {
      const y = this.#direction(event);
      if (y) chosen(y);
    });
    this.canvas.addEventListener("pointermove", (event) => this.#tell(this.#direction(event)));
    new ResizeObserver(() => this.draw()).observe(this.disc);
  }

  /** Begin anew, for flights of `duration` seconds of which the present one begins with the rod along `y`. */
  clear(duration, y) {
    Object.assign(this, { points: [], total: 0, duration, y });
    this.longest.textContent = `${+duration.toPrecision(3)} s`;
    this.draw();
  }

  add({ y, settling, cause, done, total }) {
    this.total = total;
    const first = done - y.length; // of a map that is asked for again when the line was cut, points that are there
    y.forEach((direction, i) => (this.points[first + i] = { y: direction, settling: settling[i], cause: cause[i] }));
    // Points come faster than pictures are worth.
    this.due ??= setTimeout(() => requestAnimationFrame(() => this.draw()), this.points.length < total ? REDRAW : 0);
  }

  /** Draw over the map the way of the rod in `flight` (flight.js). */
  follow(flight) {
    this.path = Array.from(flight.t, (_, i) => rise(flight.sample("y", i), flight.e3));
    if (!this.root.hidden) this.draw();
  }

  /** Say why there is no map. */
  refuse(message) {
    this.share.textContent = `not computed: ${message}`;
  }

  get good() {
    return this.points.filter((point) => point.settling !== null).length;
  }

  draw() {
    clearTimeout(this.due);
    this.due = null;
    const { width, height } = this.disc.getBoundingClientRect(), side = Math.floor(Math.min(width, height));
    if (side < 20) return;
    this.larger = lettering();
    const size = (this.size = side / this.larger);
    this.canvas.style.width = this.canvas.style.height = `${side}px`;
    const context = this.canvas.getContext("2d"), style = getComputedStyle(document.documentElement);
    const role = (name) => style.getPropertyValue(`--${name}`).trim();
    clear(context, size, size);
    context.translate(size / 2, size / 2);
    this.radius = size / 2 - 26;
    const count = this.points.length, dot = Math.min(this.radius / Math.sqrt(count || 1), this.radius / 8);
    context.save();
    context.beginPath();
    context.arc(0, 0, this.radius, 0, 2 * Math.PI);
    context.fillStyle = role("sky");
    context.fill();
    context.clip();
    const failed = between(role("paper"), role("rod"), 0.5); // calm, for there can be much of it
    this.root.style.setProperty("--failed", failed);
    // Wide dots first, which leave no gap, then narrower ones, so that a point has its own surroundings.
    for (const width of count < 30 ? [1] : [2.4, 1.7, 1.2]) {
      for (const point of this.points) {
        context.fillStyle = point.settling === null ? failed : colour(point.settling / this.duration);
        context.beginPath();
        context.arc(...this.#place(point.y), width * dot, 0, 2 * Math.PI);
        context.fill();
      }
    }
    this.#way(context, role);
    context.restore();
    this.#frame(context, role);
    const share = +(100 * this.good / count).toFixed(count < 500 ? 0 : 1);
    this.share.textContent = count ? `Settles from ${share} % of ${count} directions${count < this.total ? "…" : ""}` : "computing…";
  }

  /** The way of the rod, from the ring. */
  #way(context, role) {
    const places = this.path.flatMap((y) => place(y));
    for (const [lineWidth, tone] of [[4, role("paper")], [1.8, role("ink")]]) {
      Object.assign(context, { lineWidth, strokeStyle: tone, lineJoin: "round" });
      way(context, places, this.radius);
    }
  }

  #frame(context, role) {
    rings(context, this.radius, "rgb(255 255 255 / 0.45)", role("muted"));
    axes(context, this.radius, "up", role("muted"));
    context.fillText("outer edge: hanging", 0, this.radius + 14);
    const label = (words, x, y) => {
      Object.assign(context, { lineWidth: 4, lineJoin: "round", strokeStyle: role("paper"), fillStyle: role("ink") });
      context.strokeText(words, x, y);
      context.fillText(words, x, y);
    };
    label("upright", 0, 0);
    label("level", 0, this.radius * Math.SQRT1_2);
    if (!this.y) return;
    const [x, y] = this.#place(this.y);
    for (const [width, tone] of [[5, role("paper")], [2.5, role("ink")]]) {
      Object.assign(context, { lineWidth: width, strokeStyle: tone });
      context.beginPath();
      context.arc(x, y, 8, 0, 2 * Math.PI);
      context.stroke();
    }
  }

  #place(y) {
    return place(y).map((share) => this.radius * share);
  }

  #direction(event) {
    const area = this.canvas.getBoundingClientRect();
    const share = (pixels) => (pixels / this.larger - this.size / 2) / this.radius;
    return direction([share(event.clientX - area.left), share(event.clientY - area.top)]);
  }

  #tell(y) {
    this.here.textContent = "";
    if (!y || !this.points.length) return;
    const near = (point) => point.y.reduce((sum, value, k) => sum + value * y[k], 0);
    const point = this.points.reduce((best, other) => (near(other) > near(best) ? other : best));
    const tilt = degrees(y[2]).toFixed(0);
    this.here.textContent = `${tilt}° from upright: ${point.settling === null ? `does not settle (${point.cause})` : `settles after ${point.settling.toFixed(1)} s`}`;
  }
}

function colour(share) {
  const place = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1), i = Math.min(Math.floor(place), STOPS.length - 2);
  return between(STOPS[i], STOPS[i + 1], place - i);
}

/** The colour a `share` of the way from one #rrggbb to another. */
function between(from, to, share) {
  const part = (text, k) => parseInt(text.slice(1 + 2 * k, 3 + 2 * k), 16);
  return `rgb(${[0, 1, 2].map((k) => Math.round(part(from, k) + share * (part(to, k) - part(from, k)))).join(" ")})`;
}
