// The controls beside the picture: what flies, the start, gains, plant, pokes, export.

import { calm } from "../motion.js";
import { Group, Slider } from "./slider.js";

const IN_SIGHT = 200; // CSS pixels of the panel

const NAMES = { hehn2011: "hehn2011, 0.5 kg", nayak2018: "nayak2018, 0.4 kg" };
const WAYS = [["right", "→ right"], ["left", "← left"], ["away", "↗ away"], ["towards", "↙ towards"], ["up", "↑ up"], ["down", "↓ down"]];

const OWN = ["gains", "plant", "place", "defects"]; // groups of sliders that have a section of their own

/** What is in sight. */
const BAR = `<div class="five"><button type="button" class="go live" aria-pressed="false" title="Let the flight go on, and take the bob in hand (l)">Fly live</button>
  <button type="button" class="again" title="Begin again (r)">Start again</button>
  <label>Start <select class="starts"></select></label>
  <button type="button" class="kick" title="Hit the bob now (p)">Poke the ball</button>
  <button type="button" class="open" aria-expanded="false" aria-controls="tune" title="Start, pokes, gains, plant, files">Tune</button></div>`;

/** What is behind Tune; what only a server can do is left out of a page that has none. */
const html = (chosen, served) => `
  <section><h2>Flight <button type="button" class="small undo" title="Take back the last change (Ctrl+Z)" disabled>undo</button>
    <button type="button" class="small redo" title="Do it again (Ctrl+Shift+Z)" disabled>redo</button></h2>
    ${chosen ? `<label class="row">Vehicle <select data-path="vehicle.base"></select></label>
    <label class="row">Mount <select data-path="vehicle.mount"></select></label>
    <label class="row">Law <select data-path="law.name"></select></label>
    <label class="row">Plant <select data-path="plant.base"></select></label>
    <label class="row">Sensors <select data-path="plant.sensors"></select></label>` : ""}
    <div class="flight"></div></section>
  <section><h2>Start</h2>
    ${chosen ? `<div class="chips papers" data-whose="Experiment"><span>paper</span></div>` : ""}
    <div class="rod"></div><p class="hint">Drag the rod to set the start; when live, drag the bob.</p></section>
  <section class="poke"><h2>Poke <small></small></h2>
    <div class="row two"><button type="button" data-on="bob">Poke bob</button><button type="button" data-on="vehicle">Poke vehicle</button></div>
    <label class="row">Direction <select class="way" aria-label="Direction"></select></label>
    <div class="strength"></div>
    <button type="button" class="unpoke" hidden>Remove pokes</button></section>
  <section class="has-place"><h2 data-whose="Place to hold:">Place to hold <button type="button" class="small reset" title="The reference as it is by itself">reset</button></h2><div class="place"></div></section>
  <section class="has-gains"><h2 data-whose="Gains:">Gains <button type="button" class="small reset" title="The gains that the law proposes">reset</button></h2><div class="gains"></div></section>
  <section class="has-plant"><h2 data-whose="Plant:">Plant <button type="button" class="small reset" title="The plant as it is by itself">reset</button></h2><div class="plant"></div></section>
  <section class="has-defects"><h2 data-whose="Sensor defects:">Sensor defects <button type="button" class="small reset" title="The sensors as they are by themselves">reset</button></h2>
    <p class="hint fell" role="status"></p><div class="defects"></div></section>
  ${served ? `<section><h2>Export</h2>
    <div class="row two"><button type="button" data-export="toml">TOML</button><button type="button" data-export="python">Python</button></div>
    <div class="export" hidden><textarea readonly rows="9" spellcheck="false" aria-label="Export"></textarea>
    <div class="row two"><button type="button" class="copy">Copy</button><a class="save" download>Save</a></div></div></section>` : ""}`;

export class Panel {
  /** `lab` has setting, offer, and what the buttons do. */
  constructor(parent, lab) {
    this.lab = lab;
    this.root = document.createElement("section");
    const chosen = Boolean(lab.offer.vehicles);
    this.served = chosen && !lab.offer.alone;
    Object.assign(this.root, { id: "tune", className: "panel", innerHTML: html(chosen, this.served), ariaLabel: "Tune", hidden: true });
    this.bar = document.createElement("section");
    Object.assign(this.bar, { className: "bar", innerHTML: BAR, ariaLabel: "Controls" });
    parent.querySelector("header").after(this.bar, this.root); // before the picture, for those who go by keys
    this.groups = Object.fromEntries(["flight", ...OWN].map((name) =>
      [name, new Group(this.#find(`.${name}`), (facts, value) => lab.slide(facts, value))]));
    this.selects = [];
    if (chosen) this.#choices();
    this.#buttons();
    this.#starts();
    this.#pokes();
    if (this.served) this.#exports();
  }

  #find(selector) {
    return this.root.querySelector(selector);
  }

  #choices() {
    const { offer } = this.lab;
    const options = {
      "vehicle.base": offer.vehicles.map((name) => [name, NAMES[name] ?? name]), "vehicle.mount": Object.entries(offer.mounts),
      "law.name": offer.laws.map((name) => [name, name]), "plant.base": Object.entries(offer.plants),
      "plant.sensors": Object.entries(offer.sensors),
    };
    this.selects = Object.entries(options).map(([path, entries]) => {
      const select = this.#find(`select[data-path="${path}"]`);
      select.append(...entries.map(([name, words]) => new Option(words, name)));
      select.addEventListener("change", () => this.lab.choose(path, select.value));
      select.closest("label").hidden = entries.length < 2;
      return select;
    });
  }

  #buttons() {
    const inBar = (name, act) => {
      this[name] = this.bar.querySelector(`.${name}`);
      this[name].addEventListener("click", act);
    };
    inBar("go", () => this.lab.running.toggle());
    inBar("again", () => this.lab.restart());
    inBar("kick", () => this.poke("bob"));
    inBar("open", () => this.tune(this.root.hidden));
    this.go.disabled = true; // until there is machine code
    this.#find(".undo").addEventListener("click", () => this.lab.setting.undo());
    this.#find(".redo").addEventListener("click", () => this.lab.setting.redo());
    for (const name of OWN) this.#find(`.has-${name} .reset`).addEventListener("click", () => this.lab.reset(name));
  }

  #starts() {
    const { lab } = this, { starts, experiments } = lab.offer, choice = this.bar.querySelector(".starts");
    choice.append(new Option("choose", ""), ...Object.keys(starts).map((name) => new Option(name, name)), new Option("random", "random"));
    choice.addEventListener("change", () => {
      if (choice.value) lab.start(starts[choice.value] ?? { random: Math.floor(Math.random() * 1e9) });
      choice.value = ""; // so that it can be chosen again
    });
    for (const [name, setting] of Object.entries(experiments ?? {})) {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: name, title: `Experiment ${name} of the paper, its vehicle and law` });
      button.addEventListener("click", () => lab.preset(setting));
      this.#find(".papers").append(button);
    }
    const facts = [
      { path: "start.y.tilt", words: "rod from upright", unit: "°", low: 0, high: 180, value: 180 },
      { path: "start.y.heading", words: "heading", unit: "°", low: -180, high: 180, value: 0 },
    ];
    this.rod = facts.map((entry) => new Slider(this.#find(".rod"), entry, () => {
      const [tilt, heading] = this.rod.map((slider) => slider.facts.value * Math.PI / 180);
      lab.rod([Math.sin(tilt) * Math.cos(heading), Math.sin(tilt) * Math.sin(heading), Math.cos(tilt)]);
    }));
  }

  #pokes() {
    const way = this.#find(".way");
    way.append(...WAYS.map(([name, words]) => new Option(words, name)));
    this.strength = new Slider(this.#find(".strength"), { path: "pokes.velocity", words: "strength", unit: "m/s", low: 0.1, high: 10, value: 1, log: true }, () => {});
    for (const button of this.root.querySelectorAll("[data-on]")) {
      button.title = "Apply an impulse of this Δv (p)";
      button.addEventListener("click", () => this.poke(button.dataset.on));
    }
    this.#find(".unpoke").addEventListener("click", () => this.lab.unpoke());
  }

  /** Show whether the page can let the flight go on. */
  able(able) {
    this.go.disabled = !able;
  }

  /** Show or hide what is behind Tune. */
  tune(open) {
    this.root.hidden = !open;
    this.lab.main.classList.toggle("tuned", open);
    this.open.setAttribute("aria-expanded", String(open));
    if (open) this.#reveal();
  }

  /** Scroll to what has been opened, where it lies below what is in sight: under the picture, which stays. */
  #reveal() {
    const top = this.root.getBoundingClientRect().top, { height } = this.lab.viewer.parts.scene.getBoundingClientRect();
    if (top > innerHeight - IN_SIGHT) scrollBy({ top: top - height, behavior: calm() ? "auto" : "smooth" });
  }

  /** Show whether the flight goes on. */
  live(on) {
    this.go.setAttribute("aria-pressed", String(on));
    this.#find(".unpoke").hidden = on || !this.lab.setting.value.pokes?.length;
  }

  /** Show whether a flight is pinned. */
  pins(pinned) {
    this.pin.setAttribute("aria-pressed", String(pinned));
  }

  poke(on) {
    this.lab.poke(on, this.#find(".way").value, this.strength.facts.value);
  }

  #exports() {
    const box = this.#find(".export"), text = box.querySelector("textarea"), save = box.querySelector(".save");
    for (const button of this.root.querySelectorAll("[data-export]")) {
      button.addEventListener("click", () => {
        this.exported = this.exported === button.dataset.export ? null : button.dataset.export;
        this.#export();
      });
    }
    box.querySelector(".copy").addEventListener("click", (event) => {
      const { target } = event;
      text.select();
      const done = navigator.clipboard?.writeText(text.value) ?? Promise.reject(new Error("no clipboard"));
      done.catch(() => document.execCommand("copy")).then(() => (target.textContent = "Copied"));
      setTimeout(() => (target.textContent = "Copy"), 1200);
    });
    save.addEventListener("click", () => {
      URL.revokeObjectURL(save.href);
      save.href = URL.createObjectURL(new Blob([text.value], { type: "text/plain" }));
    });
  }

  /** Ask for the setting in the words that are chosen, if any are. */
  #export() {
    for (const button of this.root.querySelectorAll("[data-export]")) button.setAttribute("aria-pressed", String(button.dataset.export === this.exported));
    if (this.exported) this.asked = this.lab.link.ask("export", { setting: this.lab.setting.value });
    else this.texts({});
  }

  /** Show the `texts` that were asked for, if there are any. */
  texts(texts) {
    const box = this.#find(".export"), text = texts[this.exported], opened = box.hidden;
    box.hidden = !text;
    if (box.hidden) return;
    box.querySelector("textarea").value = text;
    if (opened) box.scrollIntoView({ block: "nearest" });
    box.querySelector(".save").download = this.exported === "toml" ? "flight.toml" : "flight.py";
  }

  /** Show the setting, as far as it says so itself. */
  setting(value) {
    this.#find(".undo").disabled = !this.lab.setting.past.length;
    this.#find(".redo").disabled = !this.lab.setting.future.length;
    for (const select of this.selects) {
      const [what, key] = select.dataset.path.split(".");
      select.value = value[what]?.[key] ?? this.lab.offer.first[what][key] ?? select.options[0].value; // an older address tells no mount
      if (key === "sensors") select.disabled = value.plant?.base === "ideal"; // whose law knows the state
    }
    const y = value.start.y;
    if (y) {
      const level = Math.hypot(y[0], y[1]), degrees = (angle) => +(angle * 180 / Math.PI).toFixed(1);
      const tilt = degrees(Math.atan2(level, y[2]));
      const heading = level > 1e-6 ? degrees(Math.atan2(y[1], y[0])) : this.rod[1].facts.value;
      [tilt, heading].forEach((angle, i) => this.rod[i].show({ ...this.rod[i].facts, value: angle }));
    }
    if (this.exported) this.#export();
    const pokes = value.pokes ?? [];
    this.#find(".unpoke").hidden = pokes.length === 0 || this.lab.running.on;
    this.#find(".poke small").textContent = pokes.length ? `at ${pokes.map((poke) => poke.time.toFixed(1)).join(", ")} s` : "";
  }

  /** Show what the engine said with a flight. */
  flight({ sliders }) {
    this.sliders(sliders);
    this.able(this.lab.running.able);
    this.complain("", "");
  }

  sliders(sliders) {
    for (const [name, group] of Object.entries(this.groups)) group.show(sliders.filter((facts) => facts.group === name));
    for (const name of OWN) this.#find(`.has-${name}`).hidden = this.groups[name].sliders.length === 0;
  }

  /** Say at which sizes of the sensors' defects the flight `fails` (what it does), if there are any; "" takes it back. */
  fell(fails) {
    const present = this.groups.defects.sliders.filter(({ facts }) => facts.value > 0);
    const sizes = present.map(({ facts, output }) => `${facts.words} ${output.textContent}`).join(", ");
    this.#find(".fell").textContent = fails && sizes && `${fails} at ${sizes}.`;
  }

  /** Say `message` beside the control of `field`, or beside the one at `path` that was moved last; "" takes it back. */
  complain(message, field, path) {
    for (const old of this.root.querySelectorAll(".complaint")) old.remove();
    if (!message) return;
    const controls = [...this.root.querySelectorAll("[data-path]")];
    const moved = controls.find((control) => control.dataset.path === path);
    const gains = [field, path ?? ""].every((name) => name.startsWith("law.gains."));  // the one that moved does not fit the other
    const own = (gains ? moved : null)
      ?? controls.find((control) => control.dataset.path === field || field.startsWith(`${control.dataset.path}.`))
      ?? moved;
    if (!own) return;
    const words = document.createElement("p"), slider = this.groups.gains.sliders.find((other) => other.root === own);
    const bound = slider?.bound() ?? "";
    Object.assign(words, { className: "complaint", textContent: bound ? `${message}. ${bound}` : message, role: "alert" });
    (own.closest("label") ?? own).after(words);
  }
}
