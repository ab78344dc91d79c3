// Quantities over time on a canvas, with a cursor that follows the clock and that one can drag.

import { clamp, indexBefore, mix, roundUp } from "./numbers.js";

const LEFT = 46, RIGHT = 12, TOP = 8, BOTTOM = 20; // margins, CSS pixels

/**
 * One plot. `options`: title, unit, `lines` ([{label, role, dash, width, t, values}], a role being a key of the theme),
 * and optionally `range` ([low, high]), `names` ([[value, word], ...] at the right edge), `levels` ([[value, word]]:
 * dotted lines), `end` (time that all share). `seek` is called with a time when the plot is touched.
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
    Object.assign(this, { names: [], levels: [], range: null, ...options });
    this.root.querySelector(".what").textContent = options.unit ? `${options.title} (${options.unit})` : options.title;
    this.canvas.setAttribute("aria-label", `${options.title} over time`);
    const values = this.root.querySelector(".values");
    values.replaceChildren();
    this.readings = options.lines.filter((line) => line.label).map((line) => this.#reading(values, line));
    [this.span, this.peak] = options.range ? [options.range, null] : range(options.lines, this.levels);
  }

  #reading(parent, line) {
    const chip = document.createElement("span");
    chip.style.setProperty("--tone", `var(--${line.role})`);
    chip.innerHTML = "<b></b> <output></output>";
    chip.querySelector("b").textContent = line.label;
    parent.append(chip);
    return { line, output: chip.querySelector("output") };
  }

  #listen(seek) {
    const at = (event) => {
      const { left } = this.canvas.getBoundingClientRect();
      seek(mix(this.start, this.end, clamp((event.clientX - left - LEFT) / (this.width - LEFT - RIGHT), 0, 1)));
    };
    this.area.addEventListener("pointerdown", (event) => {
      this.area.setPointerCapture(event.pointerId);
      at(event);
    });
    this.area.addEventListener("pointermove", (event) => event.buttons && at(event));
  }

  /** Draw everything but the cursor, in the colours of a theme. */
  draw(colours) {
    const { width, height } = this.area.getBoundingClientRect(), ratio = window.devicePixelRatio || 1;
    if (!width || !height) return;
    Object.assign(this, { width, height });
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    const context = this.canvas.getContext("2d");
    context.scale(ratio, ratio);
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
    context.restore();
    this.#words(context, place, colours);
  }

  #axes(context, place, colours) {
    const { width, height, span: [low, high] } = this;
    context.font = "11px system-ui, sans-serif";
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
    for (const value of ticks(low, high, this.range ? 3 : Math.max(2, Math.floor(height / 34)))) {
      line(LEFT, place.y(value), width - RIGHT, place.y(value), colours.line);
      context.fillText(words(value), LEFT - 7, place.y(value));
    }
    context.textBaseline = "alphabetic";
    for (const value of ticks(this.start, this.end, Math.max(3, Math.floor(width / 75)))) {
      line(place.x(value), TOP, place.x(value), height - BOTTOM, colours.line);
      const last = place.x(value) > width - RIGHT - 14;
      context.textAlign = last ? "right" : "center";
      context.fillText(last ? `${words(value)} s` : words(value), last ? width - 2 : place.x(value), height - 5);
    }
    for (const [value] of this.levels) line(LEFT, place.y(value), width - RIGHT, place.y(value), colours.muted, [2, 3]);
  }

  /** Words at the right edge, over the curves and with a rim that keeps them legible. */
  #words(context, place, colours) {
    const { width, span: [low, high] } = this;
    Object.assign(context, { textAlign: "right", textBaseline: "alphabetic", lineWidth: 4, strokeStyle: colours.paper, fillStyle: colours.muted });
    const write = (word, y) => {
      context.strokeText(word, width - RIGHT - 4, y);
      context.fillText(word, width - RIGHT - 4, y);
    };
    for (const [value, word] of this.levels) write(word, place.y(value) - 6);
    if (this.peak) write(`off the scale: ${this.peak.toPrecision(2)} ${this.unit}`, TOP + 12);
    for (const [value, word] of this.names) write(word, place.y(value) + (value > (low + high) / 2 ? 15 : -7));
  }

  /** Put the cursor to the time `t` and write the values there. */
  show(t) {
    const share = (clamp(t, this.start, this.end) - this.start) / (this.end - this.start || 1);
    this.cursor.style.transform = `translateX(${LEFT + share * ((this.width ?? 0) - LEFT - RIGHT)}px)`;
    for (const { line, output } of this.readings) {
      output.textContent = reading(valueAt(line, t));
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
function range(lines, levels) {
  const sizes = lines.flatMap((line) => Array.from(line.values, Math.abs)).sort((a, b) => a - b);
  const usual = sizes[Math.floor(0.95 * (sizes.length - 1))], peak = sizes[sizes.length - 1];
  const limit = peak > 10 * usual && usual > 0 ? 4 * usual : Infinity;
  let [low, high] = [Infinity, -Infinity];
  const include = (value) => {
    low = Math.min(low, clamp(value, -limit, limit));
    high = Math.max(high, clamp(value, -limit, limit));
  };
  lines.forEach((line) => line.values.forEach(include));
  levels.forEach(([value]) => include(value));
  include(0);
  const room = 0.06 * (high - low) || 1;
  return [[low < 0 ? low - room : low, high + room], Number.isFinite(limit) ? peak : null];
}

function ticks(low, high, count) {
  const step = roundUp((high - low) / count || 1), first = Math.ceil(low / step - 1e-9);
  return Array.from({ length: Math.floor(high / step + 1e-9) - first + 1 }, (_, i) => (first + i) * step);
}

const words = (value) => String(+value.toPrecision(4)).replace("-", "−");

function reading(value) {
  const digits = Math.abs(value) >= 1000 ? 0 : Math.abs(value) >= 100 ? 1 : 2;
  return (Math.abs(value) >= 1e5 ? value.toExponential(1) : value.toFixed(digits)).replace("-", "−");
}
