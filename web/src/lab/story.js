// A story in steps, each of them a flight: a row of numbers, and what there is to see.

import { kind } from "./setting.js";

const COUNTS = ["no flight", "one flight", "two flights", "three flights", "four flights", "five flights"];

export class Story {
  /** Of `steps` ({ title, words, setting }), at the end of `parent`; `tell` is called with the setting of a step. */
  constructor(parent, steps, tell) {
    Object.assign(this, { steps, tell, now: null });
    this.root = document.createElement("section");
    this.root.className = "story";
    this.root.innerHTML = `<h2>The story <small>in ${COUNTS[steps.length]}</small></h2><div class="chips"></div>
      <div class="step" hidden aria-live="polite"><h3></h3><p></p><button type="button" class="next"></button></div>`;
    parent.append(this.root);
    const find = (selector) => this.root.querySelector(selector);
    Object.assign(this, { step: find(".step"), title: find("h3"), words: find("p"), next: find(".next") });
    this.buttons = steps.map(({ title }, i) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: i + 1, title });
      button.setAttribute("aria-label", `Step ${i + 1}: ${title}`);
      button.addEventListener("click", () => this.go(i));
      find(".chips").append(button);
      return button;
    });
    this.next.addEventListener("click", () => this.go(this.now + 1));
    this.#show();
  }

  /** Tell step `i`. */
  go(i) {
    this.now = i;
    this.tell(this.steps[i].setting);
    this.#show();
  }

  /** The setting of the page has become another; one with another machine, law or plant is another story. */
  changed(setting) {
    if (this.now === null || kind(setting) === kind(this.steps[this.now].setting)) return;
    this.now = null;
    this.#show();
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
