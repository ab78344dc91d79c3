// The bar below the picture and the keys: play, time line, speed, cameras, layout, theme.

import { SPEEDS } from "./clock.js";
import { write } from "./drawing.js";

const ICONS = {
  play: "M8 5.5v13l11-6.5z", pause: "M7 5h3.6v14H7zM13.4 5H17v14h-3.6z", again: "M12 5V1.8L7 6l5 4.2V7a5 5 0 1 1-5 5H5a7 7 0 1 0 7-7z",
};

/** The player: play button, time line and speed, for a `clock`, in `parent`. */
export class Player {
  constructor(parent, clock) {
    this.clock = clock;
    parent.innerHTML = `<button class="play" type="button"><svg viewBox="0 0 24 24" aria-hidden="true"><path/></svg></button>
      <output class="time"></output>
      <span class="track"><input class="line" type="range" step="any" aria-label="Time"></span>
      <label class="speed"><span>speed</span> <select aria-label="Speed"></select></label>`;
    const find = (selector) => parent.querySelector(selector);
    Object.assign(this, { button: find(".play"), icon: find("path"), time: find(".time"), line: find(".line"), speed: find("select") });
    this.button.addEventListener("click", () => clock.toggle());
    this.line.addEventListener("input", () => clock.seek(Number(this.line.value)));
    this.speed.addEventListener("change", () => clock.setSpeed(Number(this.speed.value)));
  }

  /** Mark on the time line where a rod touched, and say what. */
  mark(flights) {
    const { clock } = this, track = this.line.parentElement;
    for (const old of track.querySelectorAll(".touch")) old.remove(); // the line stays: it may be in focus
    track.append(...flights.filter((flight) => flight.verdict.part).map(({ end, verdict }) => {
      const mark = document.createElement("i"), words = `${verdict.reason} at ${end.toFixed(2)} s`;
      Object.assign(mark, { className: "touch", role: "img", ariaLabel: words, title: words });
      mark.style.setProperty("--at", (end - clock.start) / (clock.end - clock.start || 1));
      return mark;
    }));
  }

  /** Show the time on the line, and with `words` in numbers. */
  show(words = true) {
    const { clock } = this;
    const icon = clock.playing ? "pause" : !clock.drive && clock.time >= clock.end && clock.end > clock.start ? "again" : "play";
    if (this.shown !== icon) {
      this.shown = icon;
      this.icon.setAttribute("d", ICONS[icon]);
      this.button.setAttribute("aria-label", { play: "Play", pause: "Pause", again: "Play again" }[icon]);
      this.button.title = `${this.button.getAttribute("aria-label")} (space)`;
    }
    const digits = clock.end >= 1 ? 2 : 4;
    if (words) write(this.time, `${clock.time.toFixed(digits)} / ${clock.end.toFixed(digits)} s`);
    this.#speeds();
    const share = (clock.time - clock.start) / (clock.end - clock.start || 1);
    if (!words && share === this.share) return; // such as at the end of a flight that goes on
    this.share = share;
    Object.assign(this.line, { min: clock.start, max: clock.end, value: clock.time });
    this.line.style.setProperty("--done", `${100 * share}%`);
  }

  #speeds() {
    const { speed, clock } = this;
    if (this.offered === clock.speed) return;
    this.offered = clock.speed;
    const all = [...new Set([...SPEEDS, clock.speed])].sort((a, b) => a - b);
    speed.replaceChildren(...all.map((value) => new Option(`${value}×`, value, false, value === clock.speed)));
  }
}

/** A row of buttons of which one is pressed: `choices` are [name, words, hint]; `choose` is told the name. */
export class Choice {
  constructor(parent, label, choices, choose) {
    this.root = document.createElement("div");
    Object.assign(this.root, { className: "choice", role: "group", ariaLabel: label });
    this.buttons = choices.map(([name, words, hint]) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: words, title: hint });
      button.dataset.name = name;
      button.addEventListener("click", () => choose(name));
      return button;
    });
    this.root.append(...this.buttons);
    parent.append(this.root);
  }

  show(name) {
    for (const button of this.buttons) button.setAttribute("aria-pressed", String(button.dataset.name === name));
  }
}

let tabbed = false; // whether the focus was moved by key, not by pointer

document.addEventListener("keydown", ({ key }) => (tabbed ||= key === "Tab"), true);
document.addEventListener("pointerdown", () => (tabbed = false), true);

/** Keys: `actions` maps the name of a key, as in KeyboardEvent.key, to what it does; Shift is told as `true`. */
export function keys(actions) {
  document.addEventListener("keydown", (event) => {
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.target.closest("select, textarea")) return;
    if (event.target.closest("[data-keys]") && event.key.length > 1) return; // a control with arrow keys of its own
    if (event.key === " " && event.target.closest("button")) {
      if (tabbed) return; // it presses what is in focus
      event.target.blur();
    }
    event.preventDefault();
    action(event.shiftKey);
  });
}
