// Quantities over time on a canvas, with a cursor that follows the clock and that one can drag.

import { clear, font, lettering, move, write } from "./drawing.js";
import { drawMark, markIcon } from "./marks.js";
import { clamp, indexBefore, mix, roundUp } from "./numbers.js";
import { large, power, reading, scientific, tick } from "./words.js";

const LEFT = 46, RIGHT = 12, TOP = 8, BOTTOM = 20; // margins; all sizes are pixels of a usual screen, see drawing.js
const APART = 92; // pixels between two marks of a curve
const HALF = 9; // pixels from the middle of a word up and down, within which it hides a curve
const FAINT = 1e-8; // of the largest value: a logarithmic axis goes no further down, and curves leave it there
const TINY = Number.MIN_VALUE; // in place of zero, which has no logarithm
const SPIKE = 10, KEPT = 4; // a peak of more than ten times the usual is cut off at four times that

/**
 * One plot. `options`: title (of this program, may hold tags; `plain` without), unit, `lines` ([{label, role, mark, dash,
 * width, t, values}], a role being a key of the theme), and optionally `range` ([low, high]), `names` ([[value, word], ...]), `levels` ([[value, word]]: dotted lines), `limits` ([low, high], null for none: shaded beyond),
 * `scale` (the usual size of a value), `least` (the shortest axis), `touches` (times of collisions), `phases` ([{ from, to, name }]:
 * words along the time), `end` (time that all share), `log` (a logarithmic axis), `wide` (many curves: it gets more room). `seek` is called with a time when the plot is touched.
 */
export class Plot {
  constructor(parent, options, seek) {
    this.root = document.createElement("figure");
    this.root.className = "plot";
    this.root.innerHTML = `<figcaption><span class="what"></span><span class="values"></span></figcaption>
      <div class="area"><canvas></canvas><i class="cursor"></i></div>`;
    parent.append(this.root);
    const find = (selector) => this.root.querySelector(selector);
    this.area = find(".area");
    this.canvas = find("canvas");
    this.cursor = find(".cursor");
    this.canvas.setAttribute("role", "img");
    this.#listen(seek);
    this.load(options);
  }

  /** Show something else, with options as for a new plot; `draw` puts it on the canvas. */
  load(options) {
    Object.assign(this, { names: [], levels: [], limits: [null, null], range: null, wide: false, scale: 0, least: 0, touches: [], phases: [], log: false, ...options });
    if (this.log) Object.assign(this, decades(this));
    this.#head();
    this.root.classList.toggle("wide", this.wide);
    [this.span, this.peak] = this.range ? [this.range, null] : range(this);
    this.canvas.setAttribute("aria-label", this.#told());
  }

  /** What is drawn, for those who do not see it. */
  #told() {
    const { plain, unit, span: [low, high], limits: [least, most], peak } = this;
    const word = this.log ? power : tick, of = (value) => `${word(value)}${unit && ` ${unit}`}`;
    const beyond = most !== null && most < high ? `; rotor limit ${of(most)}` : least !== null && least > low ? `; least rotor force ${of(least)}` : "";
    const told = this.phases.map(({ from, name }) => `${name} from ${from.toFixed(1)} s`).join(", ");
    return `${plain} over time, ${word(low)} to ${of(high)}${told && `; the rod ${told}`}${beyond}${peak ? `; cut off, peak ${large(peak)}${unit}` : ""}`;
  }

  /** Title and readings: made anew only if they are others, for in a flight that goes on plots are loaded many times. */
  #head() {
    const { title, unit } = this, told = this.lines.filter((line) => line.label);
    const same = JSON.stringify([title, unit, told.map(({ label, role, mark }) => [label, role, mark])]);
    if (same === this.same) this.readings.forEach((reading, i) => (reading.line = told[i]));
    else {
      this.same = same;
      this.root.querySelector(".what").innerHTML = unit ? `${title} (${unit})` : title;
      const values = this.root.querySelector(".values");
      values.replaceChildren();
      this.readings = told.map((line) => this.#reading(values, line));
    }
  }

  #reading(parent, line) {
    const chip = document.createElement("span");
    chip.style.setProperty("--tone", `var(--${line.role})`);
    chip.innerHTML = `${markIcon(line.mark)}<b>${line.label}</b> <output></output>`;
    parent.append(chip);
    return { line, output: chip.querySelector("output") };
  }

  #listen(seek) {
    const at = (event) => {
      const { left } = this.canvas.getBoundingClientRect();
      seek(mix(this.start, this.end, clamp(((event.clientX - left) / this.larger - LEFT) / (this.width - LEFT - RIGHT), 0, 1)));
    };
    this.area.addEventListener("pointerdown", (event) => {
      this.area.setPointerCapture(event.pointerId);
      at(event);
    });
    this.area.addEventListener("pointermove", (event) => event.buttons && at(event));
    new ResizeObserver(([{ contentRect: { width, height } }]) => {
      const larger = lettering();
      Object.assign(this, { larger, width: width / larger, height: height / larger });
      if (this.colours) this.draw(this.colours);
      this.show(this.now ?? this.start, false);
    }).observe(this.area);
  }

  /** Draw everything but the cursor, in the colours of a theme, once it is known how large it is. */
  draw(colours) {
    this.colours = colours;
    const { width, height } = this;
    if (!width || !height) return;
    const context = this.canvas.getContext("2d");
    clear(context, width, height);
    const [low, high] = this.span;
    const place = {
      x: (t) => LEFT + (t - this.start) / (this.end - this.start || 1) * (width - LEFT - RIGHT),
      y: (value) => TOP + (high - value) / (high - low) * (height - TOP - BOTTOM),
    };
    this.#axes(context, place, colours);
    context.save();
    context.beginPath();
    context.rect(LEFT, TOP - 2, width - LEFT - RIGHT, height - TOP - BOTTOM + 4);
    context.clip();
    for (const line of this.lines) curve(context, place, line, colours);
    this.#marks(context, place, colours);
    context.restore();
    this.#words(context, place, colours);
  }

  /** Marks along the curves, each in turn, so that curves on top of each other show which they are. */
  #marks(context, place, colours) {
    const marked = this.lines.filter((line) => line.mark), across = this.width - LEFT - RIGHT;
    marked.forEach((line, i) => {
      for (let x = (i + 0.5) * APART / marked.length; x < across; x += APART) {
        const t = mix(this.start, this.end, x / across);
        if (t > line.t[line.t.length - 1]) break;
        drawMark(context, line.mark, LEFT + x, place.y(valueAt(line, t)), colours[line.role], colours.paper);
      }
    });
  }

  /** What no rotor can do, shaded. */
  #beyond(context, place, colours) {
    const { width, height, span: [low, high], limits: [least, most] } = this;
    const shade = (from, to) => {
      const top = Math.max(place.y(to), TOP), bottom = Math.min(place.y(from), height - BOTTOM);
      context.fillStyle = colours.barred;
      if (bottom > top) context.fillRect(LEFT, top, width - LEFT - RIGHT, bottom - top);
    };
    if (most !== null && most < high) shade(most, high);
    if (least !== null && least > low) shade(low, least);
  }

  #axes(context, place, colours) {
    const { width, height, span: [low, high] } = this;
    this.#beyond(context, place, colours);
    context.font = font(11);
    Object.assign(context, { lineWidth: 1, textBaseline: "middle" });
    const line = (x0, y0, x1, y1, colour, dash = []) => {
      context.setLineDash(dash);
      context.strokeStyle = colour;
      context.beginPath();
      context.moveTo(x0, y0);
      context.lineTo(x1, y1);
      context.stroke();
      context.setLineDash([]);
    };
    context.fillStyle = colours.muted;
    context.textAlign = "right";
    for (const value of ticks(low, high, this.range && !this.log ? 3 : Math.max(2, Math.floor(height / 34)), this.log ? 1 : 0)) {
      line(LEFT, place.y(value), width - RIGHT, place.y(value), colours.line);
      context.fillText((this.log ? power : tick)(value), LEFT - 7, place.y(value));
    }
    context.textBaseline = "alphabetic";
    for (const value of ticks(this.start, this.end, Math.max(3, Math.floor(width / 75)))) {
      line(place.x(value), TOP, place.x(value), height - BOTTOM, colours.line);
      const last = place.x(value) > width - RIGHT - 14;
      context.textAlign = last ? "right" : "center";
      context.fillText(last ? `${tick(value)} s` : tick(value), last ? width - 2 : place.x(value), height - 5);
    }
    for (const [value] of this.levels) line(LEFT, place.y(value), width - RIGHT, place.y(value), colours.muted, [2, 3]);
    for (const { left, right } of this.#captions(context, place)) {
      for (const x of [left, right]) if (x > LEFT + 1 && x < width - RIGHT - 1) line(x, TOP, x, height - BOTTOM, colours.muted, [1, 3]);
    }
    for (const t of this.touches) line(place.x(t), TOP, place.x(t), height - BOTTOM, colours.failed, [4, 2]);
  }

  /** Words where they hide least of the curves, rather at the right edge, with a rim that keeps them legible. */
  #words(context, place, colours) {
    const { width, height, span: [low, high] } = this, edge = width - RIGHT - 4, middle = (TOP + height - BOTTOM) / 2 + 4;
    Object.assign(context, { textAlign: "right", textBaseline: "alphabetic", lineWidth: 4, fillStyle: colours.muted });
    const taken = [], write = (word, y, right, behind = colours.paper) => {
      taken.push({ y, right, left: right - context.measureText(word).width });
      context.strokeStyle = behind;
      context.strokeText(word, right, y);
      context.fillText(word, right, y);
    };
    for (const { name, left, right, size } of this.#captions(context, place)) write(name, middle, (left + right + size) / 2);
    if (this.peak) {
      const cut = `cut off, peak ${large(this.peak)}${this.unit}`;
      write(cut, TOP + 10, LEFT + 6 + context.measureText(cut).width);
    }
    const label = (word, heights, behind) => {
      const size = context.measureText(word).width;
      const free = ({ y, right }) => y > TOP + 8 && y < height - BOTTOM - 2
        && taken.every((other) => Math.abs(other.y - y) > 12 || other.left > right || other.right < right - size);
      const spots = [edge, LEFT + 4 + size, (LEFT + edge + size) / 2].flatMap((right) => heights.map((y) => ({ y, right }))).filter(free);
      const hidden = spots.map((spot) => this.#hidden(place, spot.right - size, spot.right, spot.y - 4));
      const best = spots[hidden.indexOf(Math.min(...hidden))];
      if (best) write(word, best.y, best.right, best.y === heights[0] ? behind : colours.paper);
    };
    const [least, most] = this.limits;
    if (most !== null && most < high) label(`Rotor limit ${tick(most)} ${this.unit}`, [place.y(most) - 5, place.y(most) + 14], colours.barred);
    else if (least !== null && least > low) label(`Least rotor force ${tick(least)} ${this.unit}`, [place.y(least) + 14], colours.barred);
    for (const [value, word] of this.levels) label(word, [place.y(value) - 6, place.y(value) + 14]);
    for (const [value, word] of this.names) label(word, [place.y(value) + (value > (low + high) / 2 ? 15 : -7)]);
  }

  /** How much of the curves a word from `left` to `right` at the height `y` would hide. */
  #hidden(place, left, right, y) {
    const { lines, start, end, width } = this;
    let count = 0;
    for (let k = 0; k <= 8; k++) {
      const t = mix(start, end, (mix(left, right, k / 8) - LEFT) / (width - LEFT - RIGHT));
      for (const line of lines) count += t <= line.t[line.t.length - 1] && Math.abs(place.y(valueAt(line, t)) - y) < HALF;
    }
    return count;
  }

  /** The phases that are wide enough for their names, from `left` to `right`; a name is `size` wide. Pixels. */
  #captions(context, place) {
    return this.phases.map(({ from, to, name }) =>
      ({ name, left: place.x(Math.max(from, this.start)), right: place.x(to), size: context.measureText(name).width }))
      .filter(({ left, right, size }) => right - left > size + 6);
  }

  /** Put the cursor to the time `t` and, with `words`, write the values there. */
  show(t, words = true) {
    this.now = t;
    const share = (clamp(t, this.start, this.end) - this.start) / (this.end - this.start || 1);
    move(this.cursor, `translateX(${(this.larger ?? 1) * (LEFT + share * ((this.width ?? 0) - LEFT - RIGHT))}px)`);
    if (!words) return;
    for (const { line, output } of this.readings) {
      write(output, (this.log ? scientific : reading)(valueAt(line, t)));
    }
  }
}

function curve(context, place, line, colours) {
  Object.assign(context, { strokeStyle: colours[line.role], lineWidth: line.width ?? 1.6, lineJoin: "round" });
  context.globalAlpha = line.opacity ?? 1;
  context.setLineDash(line.dash ?? []);
  context.beginPath();
  line.t.forEach((t, i) => context.lineTo(place.x(t), place.y(line.values[i])));
  context.stroke();
  context.setLineDash([]);
  context.globalAlpha = 1;
}

function valueAt({ t, values }, time) {
  const i = Math.min(indexBefore(t, time), Math.max(t.length - 2, 0)), j = Math.min(i + 1, t.length - 1);
  const share = t[j] > t[i] ? clamp((time - t[i]) / (t[j] - t[i]), 0, 1) : 0;
  return mix(values[i], values[j], share);
}

/** Low and high of what is drawn, and the height of a spike, in which a singular law ends, that is cut off. */
function range({ lines, levels, limits, scale, least }) {
  const peak = Math.max(...lines.map((line) => line.values.reduce((size, value) => Math.max(size, Math.abs(value)), 0)));
  const usual = scale || usually(lines);
  const limit = peak > SPIKE * usual && usual > 0 ? KEPT * usual : Infinity;
  let [low, high] = [0, least];
  const include = (value) => {
    low = Math.min(low, clamp(value, -limit, limit));
    high = Math.max(high, clamp(value, -limit, limit));
  };
  lines.forEach((line) => line.values.forEach(include));
  levels.forEach(([value]) => include(value));
  if (limits[1] !== null && limits[1] < 1.6 * high) include(1.12 * limits[1]); // what is shaded is seen where it is near
  const room = 0.06 * (high - low) || 1;
  return [[low < 0 ? low - room : low, high + room], Number.isFinite(limit) ? peak : null];
}

/** What the sizes of values stay below for 95 % of the time, however densely a spike is sampled. */
function usually(lines) {
  const sizes = lines.flatMap(({ t, values }) =>
    Array.from(values, (value, i) => [Math.abs(value), i ? t[i] - t[i - 1] : 0])).sort((a, b) => a[0] - b[0]);
  let left = 0.95 * sizes.reduce((sum, [, span]) => sum + span, 0);
  return (sizes.find(([, span]) => (left -= span) <= 0) ?? sizes[0])[0];
}

/** Lines and range of a logarithmic plot, as exponents of ten: whole decades, of which the last reaches `least`. */
function decades({ lines, least }) {
  const largest = lines.reduce((most, { values }) => values.reduce((size, value) => (value > size ? value : size), most), least);
  const raised = lines.map((line) => ({ ...line, values: line.values.map((value) => Math.log10(Math.max(value, TINY))) }));
  const lowest = raised.reduce((low, { values }) => values.reduce((size, value) => Math.min(size, value), low), Math.log10(largest));
  const high = Math.ceil(Math.log10(largest)), faint = Math.log10(FAINT * largest);
  return { lines: raised, range: [Math.min(Math.floor(Math.max(lowest, faint)), high - 1), high] };
}

function ticks(low, high, count, finest = 0) {
  const step = Math.max(roundUp((high - low) / count || 1), finest), first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
}
