// A small drawing of the directions: gravity, and the axes of the frame of the run, as the camera sees them.

import { lettering } from "../drawing.js";

const SIZE = 104, LENGTH = 30; // CSS pixels

export class Compass {
  /** In a canvas of its own, appended to `parent`. */
  constructor(parent) {
    this.canvas = document.createElement("canvas");
    this.canvas.className = "compass";
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", "Direction of gravity and axes of the frame");
    parent.append(this.canvas);
    const larger = lettering(), scale = larger * (window.devicePixelRatio || 1);
    this.canvas.width = this.canvas.height = SIZE * scale;
    this.canvas.style.width = this.canvas.style.height = `${SIZE * larger}px`;
    this.context = this.canvas.getContext("2d");
    this.context.scale(scale, scale);
  }

  /** Draw for a run with third axis `e3` through a camera with the unit vectors `right`, `up`, `back`. */
  draw({ right, up, back }, e3, colours) {
    const { context } = this, sign = e3 === "up" ? 1 : -1, drawn = JSON.stringify([right, up, e3, colours.ink]);
    if (this.drawn === drawn) return;
    this.drawn = drawn;
    const seen = (v) => [right, up, back].map((axis) => axis[0] * v[0] + axis[1] * v[1] + axis[2] * v[2]);
    context.clearRect(0, 0, SIZE, SIZE);
    const axes = [["e₁", [1, 0, 0]], ["e₂", [0, sign, 0]], ["e₃", [0, 0, sign]]];
    for (const [name, axis] of e3 === "up" ? axes : axes.slice(0, 2)) this.#arrow(seen(axis), name, colours.muted, 1.2, 0.72);
    const word = e3 === "up" ? "g" : "g, e₃";
    const gravity = seen([0, 0, -1]);
    if (Math.hypot(gravity[0], gravity[1]) > 0.2) this.#arrow(gravity, word, colours.ink, 2.2, 1.25);
    else this.#along(gravity[2] < 0, word, colours.ink);
  }

  #arrow([x, y], name, colour, width, size) {
    const { context } = this, centre = SIZE / 2, long = Math.hypot(x, y) * LENGTH * size;
    if (long < 8) return;
    const angle = Math.atan2(-y, x), head = Math.min(3.4 * width + 2, long);
    context.save();
    context.translate(centre, centre);
    context.rotate(angle);
    Object.assign(context, { strokeStyle: colour, fillStyle: colour, lineWidth: width });
    context.beginPath();
    context.moveTo(0, 0);
    context.lineTo(long - head, 0);
    context.stroke();
    context.beginPath();
    context.moveTo(long, 0);
    context.lineTo(long - head, 0.45 * head);
    context.lineTo(long - head, -0.45 * head);
    context.fill();
    context.restore();
    this.#word(name, centre + Math.cos(angle) * (long + 8), centre + Math.sin(angle) * (long + 8), colour, name[0] === "g");
  }

  /** Gravity into the screen, a circle with a cross, or out of it, with a dot. */
  #along(into, word, colour) {
    const { context } = this, centre = SIZE / 2, radius = 9, d = radius * Math.SQRT1_2;
    Object.assign(context, { strokeStyle: colour, fillStyle: colour, lineWidth: 1.8 });
    context.beginPath();
    context.arc(centre, centre, radius, 0, 2 * Math.PI);
    if (into) {
      for (const side of [-1, 1]) {
        context.moveTo(centre - d, centre - side * d);
        context.lineTo(centre + d, centre + side * d);
      }
    }
    context.stroke();
    if (!into) {
      context.beginPath();
      context.arc(centre, centre, 2.5, 0, 2 * Math.PI);
      context.fill();
    }
    this.#word(word, centre - radius - 9, centre + radius + 3, colour, true);
  }

  #word(text, x, y, colour, bold) {
    const { context } = this;
    context.font = `${bold ? "italic 600 15px" : "italic 11px"} "Cambria Math", Cambria, Georgia, serif`;
    Object.assign(context, { fillStyle: colour, textAlign: "center", textBaseline: "middle" });
    context.fillText(text, x, y);
  }
}
