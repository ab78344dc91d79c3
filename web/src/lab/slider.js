// One slider with its words, its value and a place for what the server has against it.

const STEPS = 400;

export class Slider {
  /** Of `facts` { path, words, unit, value, low, high, log }, appended to `parent`; `moved` is told the value. */
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
    this.words.textContent = facts.words;
    const { value, low, high, log } = facts;
    const share = log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    this.input.value = Math.round(STEPS * share);
    this.#write(value);
  }

  #value(share) {
    const { low, high, log } = this.facts;
    const value = log ? low * (high / low) ** share : low + share * (high - low);
    return +value.toPrecision(3);
  }

  #write(value) {
    const { unit, low, high, log } = this.facts;
    const share = log ? Math.log(value / low) / Math.log(high / low) : (value - low) / (high - low);
    this.input.style.setProperty("--done", `${100 * share}%`);
    const words = `${String(+value.toPrecision(3)).replace("-", "−")}${unit ? ` ${unit}` : ""}`;
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
