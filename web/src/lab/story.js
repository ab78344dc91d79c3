// The derivation in chapters, each of them a flight: a row of numbers, what there is to see, and one slider to drag.

import { Group } from "./slider.js";
import { kind } from "./setting.js";

const TILT = { path: "start.y.tilt", words: "rod from upright", unit: "°", low: 0, high: 180 };

export class Story {
  /** Of `steps` ({ title, words, setting, drag, phase }), at the end of `parent`; `lab` is told which to show, and what is dragged. */
  constructor(parent, steps, lab) {
    Object.assign(this, { steps, lab, now: null });
    this.root = document.createElement("section");
    this.root.className = "story";
    this.root.innerHTML = `<h2>How it works <small>chapter</small></h2><div class="chips" data-whose="Chapter"></div>
      <div class="step" hidden aria-live="polite"><h3></h3><p></p><div class="drag"></div><button type="button" class="next"></button></div>`;
    parent.append(this.root);
    const find = (selector) => this.root.querySelector(selector);
    Object.assign(this, { step: find(".step"), title: find("h3"), words: find("p"), next: find(".next") });
    this.drag = new Group(find(".drag"), (facts, value) => this.#moved(facts, value));
    this.buttons = steps.map(({ title }, i) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: i + 1, title });
      button.setAttribute("aria-label", `Chapter ${i + 1}: ${title}`);
      button.addEventListener("click", () => this.go(i));
      find(".chips").append(button);
      return button;
    });
    this.next.addEventListener("click", () => this.go(this.now + 1));
    this.#show();
  }

  get told() {
    return this.now !== null;
  }

  /** Tell chapter `i`. */
  go(i) {
    this.lab.tell(this.steps[i]);
    this.now = i; // not before: a flight that goes on is of the last chapter to its end
    this.drag.show([]);
    this.#show();
  }

  /** The setting of the page has become another; one with another machine, law or plant is another story. */
  changed(setting) {
    if (this.now === null || kind(setting) === kind(this.steps[this.now].setting)) return;
    this.now = null;
    this.#show();
  }

  /** A flight has come, of a `setting` and with the `sliders` of it. */
  flown(setting, sliders) {
    const step = this.steps[this.now];
    if (!step) return;
    const [a, b, c] = setting.start.y, tilt = (Math.atan2(Math.hypot(a, b), c) * 180) / Math.PI;
    this.drag.show([{ ...TILT, value: +tilt.toFixed(1) }, ...sliders].filter(({ path }) => path === step.drag));
  }

  #moved(facts, value) {
    if (facts.path === TILT.path) this.lab.rod([Math.sin((value * Math.PI) / 180), 0, Math.cos((value * Math.PI) / 180)]);
    else this.lab.slide(facts, value);
  }

  #show() {
    const step = this.steps[this.now];
    this.buttons.forEach((button, i) => button.setAttribute("aria-pressed", String(i === this.now)));
    this.step.hidden = !step;
    if (!step) return;
    this.title.textContent = step.title;
    this.words.textContent = step.words;
    const next = this.steps[this.now + 1];
    this.next.hidden = !next;
    this.next.textContent = next && `Next: ${next.title}`;
  }
}
