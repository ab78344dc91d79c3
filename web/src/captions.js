// Words over the pictures: which flight, its height and speed, how it ended; the key; the compass of each.

import { move, write } from "./drawing.js";
import { norm } from "./numbers.js";
import { recovered } from "./recoveries.js";
import { Compass } from "./scene/compass.js";

const KEY = [
  ["failed", "no start: the rod would touch"], ["rod", "rod and bob"], ["front", "front rotor"], ["thrust", "thrust of each rotor, total in outline"], ["trail", "path of the bob"], ["ink", "path of the vehicle"],
  ["reference", "reference"],
];
const BESIDE = 14; // CSS pixels between the middle of a height and other words
const FALL = 1; // m below the start, from which on a descent is called a fall

export class Captions {
  /** Over the element `parent`, the key in `low` at its foot. */
  constructor(parent, low) {
    Object.assign(this, { parent, views: [], marks: [], heights: document.createElement("div") });
    parent.querySelector(".picture").after(this.heights); // below all other words
    const key = document.createElement("p");
    key.className = "key";
    key.innerHTML = KEY.map(([role, words]) => `<span><i style="background:var(--${role})"></i>${words}</span>`).join("")
      + `<span class="grid"></span>`;
    low.append(key);
    this.grid = key.querySelector(".grid");
    this.barred = key.firstChild;
    this.near = Object.assign(document.createElement("p"), { className: "near", hidden: true });
    this.room = this.near.appendChild(document.createElement("span"));
    parent.append(this.near);
    this.low = low;
    this.sizes = new ResizeObserver(() => this.#measure());
    this.sizes.observe(low);
  }

  /** For other `flights`. */
  load(flights) {
    this.several = flights.length > 1;
    for (const view of this.views) {
      this.sizes.unobserve(view.said);
      view.root.remove();
    }
    this.views = flights.map((flight) => {
      const root = document.createElement("div");
      root.className = "view";
      root.innerHTML = `<div class="said"><p class="motion"><span class="name"></span><b></b> <span class="moving"></span></p><p class="recovered"></p><p class="ended"></p></div>`;
      this.parent.append(root);
      const said = root.querySelector(".said");
      this.sizes.observe(said);
      return { flight, root, said, phase: root.querySelector(".motion b"), motion: root.querySelector(".moving"), name: root.querySelector(".name"), recovered: root.querySelector(".recovered"), ended: root.querySelector(".ended"), compass: new Compass(root) };
    });
  }

  /** For the pictures of `stage` as last drawn, at the time `t`; numbers only with `words`. */
  show(stage, t, colours, words = true) {
    this.views.forEach((view, i) => {
      const picture = stage.views[i], { flight } = view;
      if (view.root.hidden === Boolean(picture)) view.root.hidden = !picture; // to write the same has styles computed anew
      if (!picture) return;
      place(view, picture);
      view.compass.draw(picture, flight.e3, colours);
      const { x, x_dot } = stage.flyers[i].pose;
      const rise = x[2] - stage.flyers[i].base, height = rise.toFixed(1).replace("-0.0", "0.0").replace("-", "−");
      write(view.name, this.several ? `${flight.title}: ` : "");
      const state = flight.state(t), broken = state === "failed" && !flight.completed;
      write(view.phase, broken ? flight.verdict.words.split(" ")[0] : flight.phase(t));
      if (view.phase.className !== state) view.phase.className = state;
      if (words) write(view.motion, `${rise < -FALL ? `fell ${(-rise).toFixed(1)} m` : `height ${height} m`}, speed ${norm(x_dot).toFixed(1)} m/s`);
      if (words) write(view.recovered, flight.e3 === "up" ? recovered(flight.recoveries(t), Math.min(t, flight.end)) : "");
      write(view.ended, t >= flight.end && !flight.completed ? flight.verdict.words : "");
    });
    if (this.barred.hidden === stage.barred.visible) this.barred.hidden = !stage.barred.visible;
    this.#heights(stage.marks());
    this.#near(stage.near);
    const larger = stage.factor > 1 ? `machine × ${stage.factor}, ` : "";
    write(this.grid, `${larger}grid ${+stage.spacing.toPrecision(2)} m`);
  }

  /** Frame the pass between the arms, and write how much room it has. */
  #near(picture) {
    if (this.near.hidden === Boolean(picture)) this.near.hidden = !picture;
    if (!picture) return;
    const { left, top, side, clearance } = picture;
    place({ root: this.near, box: this.framed }, { left, top, width: side, height: side });
    this.framed = [left, top, side, side].join();
    write(this.room, room(clearance));
  }

  /** Where words, key and sphere of directions are, over which no height is written: CSS pixels of the picture. */
  #measure() {
    const { left, top } = this.parent.getBoundingClientRect();
    this.taken = [...this.low.querySelectorAll(".globe, figcaption, .key"), ...this.views.map(({ said }) => said)]
      .map((element) => element.getBoundingClientRect()).filter(({ width }) => width)
      .map((box) => ({ left: box.left - left, top: box.top - top, right: box.right - left, bottom: box.bottom - top }));
    if (this.pole) this.#heights(this.pole); // also while nothing moves
  }

  /** Write the heights at the `marks` of the pole where nothing else stands. */
  #heights(marks) {
    this.pole = marks;
    marks = marks.filter(({ at: [across, down], before, size }) => !this.taken?.some((box) => (
      across - before < box.right && across - before + size > box.left && down + BESIDE > box.top && down - BESIDE < box.bottom)));
    while (this.marks.length < marks.length) {
      const mark = document.createElement("span");
      mark.className = "height";
      this.heights.append(mark);
      this.marks.push(mark);
    }
    this.marks.forEach((mark, i) => {
      if (mark.hidden !== i >= marks.length) mark.hidden = i >= marks.length;
      if (mark.hidden) return;
      const { height, at: [left, top], before } = marks[i];
      write(mark, `${+height.toFixed(2)} m`.replace("-", "−"));
      move(mark, `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)${before ? " translateX(-100%) translateX(-1.2rem)" : ""}`); // away from the machine
    });
  }
}

/** Words for the clearance of the rod, m. */
export const room = (clearance) => (clearance > 0 ? `${(1000 * clearance).toFixed(0)} mm gap` : "touches");

/** Put the words of `view` where its picture is: to write what stands there has styles computed anew. */
function place(view, { left, top, width, height }) {
  const box = [left, top, width, height].join();
  if (view.box === box) return;
  view.box = box;
  Object.assign(view.root.style, { left: `${left}px`, top: `${top}px`, width: `${width}px`, height: `${height}px` });
}
