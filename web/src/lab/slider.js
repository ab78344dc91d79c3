// One slider with its words, its value and a place for what the server has against it.

import { tick, unitOf, writeSymbol } from "../words.js";

const STEPS = 400;

export class Slider {
  /**
   * Of `facts` { path, words, unit, value, low, high, log, allowed }, appended to `parent`; `moved` is told the value.
   * Outside `allowed` ([low, high], if there is one) the track is shaded: the law refuses such a value beside the others.
   */
  constructor(parent, facts, moved) {
    this.root = document.createElement("label");
    this.root.className = "slider";
    this.root.dataset.path = facts.path;
    this.root.innerHTML = `<span class="words"></span><output></output><input type="range" min="0" max="${STEPS}" step="1" data-keys>`;
    const find = (selector) => this.root.querySelector(selector);
    Object.assign(this, { words: find(".words"), output: find("output"), input: find("input") });
    this.input.setAttribute("aria-label", facts.words);
    this.input.addEventListener("input", () => {
      const value = this.#value(Number(this.input.value) / STEPS);
      this.facts.value = value;
      this.#write(value);
      moved(this.facts, value);
    });
    this.input.addEventListener("pointerdown", () => (this.held = true));
    for (const name of ["pointerup", "pointercancel", "change"]) this.input.addEventListener(name, () => (this.held = false));
    parent.append(this.root);
    this.show(facts);
  }

  /** Take other facts; a slider that is being moved stays under the hand. */
  show(facts) {
    if (this.held) return;
    this.facts = { ...facts };
    this.words.replaceChildren();
    writeSymbol(this.words, facts.words);
    this.input.value = Math.round(STEPS * this.#share(facts.value));
    const [least, most] = facts.allowed ?? [facts.low, facts.high];
    this.input.style.setProperty("--least", `${100 * this.#share(least)}%`);
    this.input.style.setProperty("--most", `${100 * this.#share(most)}%`);
    this.#write(facts.value);
  }

  /** The range that the law allows, in words, or "" if all of it is allowed. */
  bound() {
    const { low, high, allowed, unit, words } = this.facts;
    if (!allowed || (allowed[0] <= low && allowed[1] >= high)) return "";
    return `With the other gains as they are, ${words} may be ${tick(+allowed[0].toPrecision(3))} to ${tick(+allowed[1].toPrecision(3))}${unitOf(unit)}`;
  }

  /** Where on the slider a value is, from 0 to 1. */
  #share(value) {
    const { low, high, log } = this.facts;
    return log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
  }

  #value(share) {
    const { low, high, log } = this.facts;
    const value = log ? low * (high / low) ** share : low + share * (high - low);
    return +value.toPrecision(3);
  }

  #write(value) {
    const { unit } = this.facts;
    this.input.style.setProperty("--done", `${100 * this.#share(value)}%`);
    const words = `${tick(+value.toPrecision(3))}${unitOf(unit)}`;
    this.output.textContent = words;
    this.input.setAttribute("aria-valuetext", words);
  }
}

/** A group of sliders that follow what the server says there is. */
export class Group {
  constructor(parent, moved) {
    Object.assign(this, { parent, moved, sliders: [], paths: "" });
  }

  show(all) {
    const paths = all.map((facts) => facts.path).join(" ");
    if (paths === this.paths) {
      all.forEach((facts, i) => this.sliders[i].show(facts));
      return;
    }
    this.paths = paths;
    this.parent.replaceChildren();
    this.sliders = all.map((facts) => new Slider(this.parent, facts, this.moved));
  }
}
