// The setting of the laboratory: plain data that the server understands, kept in the address so that a reload keeps it.

import { readable } from "./readable.js";

const HASH_DELAY = 250; // ms
const PAUSE = 1500; // ms between two moves of a slider that are two changes
const MOST = 200; // changes that can be taken back

export class Setting {
  /**
   * `first` is what to begin with unless the address has a setting; `changed` is called with it after every change, `linked` with
   * what the address has later.
   */
  constructor(first, changed, linked) {
    Object.assign(this, { first, changed, value: read() ?? structuredClone(first), past: [], future: [] });
    this.unreadable = location.hash.length > 1 && !read();
    addEventListener("pagehide", () => this.keep());
    addEventListener("hashchange", ({ newURL }) => {
      const value = read(new URL(newURL).hash); // the address itself may have been written again meanwhile
      if (value && JSON.stringify(value) !== JSON.stringify(this.value)) linked(value);
    });
  }

  get(path) {
    return path.split(".").reduce((table, key) => table?.[key], this.value);
  }

  /** Put `value` at a path such as "law.gains.k_d". */
  put(path, value) {
    this.#remember(path);
    const keys = path.split("."), last = keys.pop();
    let table = this.value;
    for (const key of keys) table = (table[key] ??= {});
    table[last] = value;
    this.#tell();
  }

  /** Put what a slider says: its `put`, in which { "#": factor } stands for factor times the value, or the value. */
  slide({ path, put }, value) {
    this.put(path, put ? filled(put, value) : value);
  }

  replace(value) {
    this.#remember("");
    this.value = structuredClone(value);
    this.#tell();
  }

  /** Take back the last change; the moves of one slider, one after the other, are one change. */
  undo() {
    this.#step(this.past, this.future);
  }

  redo() {
    this.#step(this.future, this.past);
  }

  #step(from, to) {
    if (!from.length) return;
    to.push(structuredClone(this.value));
    this.value = from.pop();
    this.moved = null;
    this.#tell();
  }

  /** Keep what was before a change at `path`, unless the same slider has just been moved. */
  #remember(path) {
    const now = performance.now();
    const same = path && this.moved?.path === path && now - this.moved.time < PAUSE;
    this.moved = { path, time: now };
    if (same) return;
    this.past = [...this.past.slice(1 - MOST), structuredClone(this.value)];
    this.future = [];
  }

  /** Take the numbers of a start that was asked for in other words; nothing changes by it. */
  adopt(start) {
    this.value.start = start;
    this.keep();
  }

  #tell() {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => this.keep(), HASH_DELAY);
    this.changed(this.value);
  }

  /** Write the setting into the address, where there is one: a page within a page has none. */
  keep() {
    if (location.protocol !== "about:") history.replaceState(null, "", `#${encodeURIComponent(JSON.stringify(this.value))}`);
  }
}

function filled(put, value) {
  if (Array.isArray(put)) return put.map((entry) => filled(entry, value));
  if (put === null || typeof put !== "object") return put;
  if ("#" in put) return put["#"] * value;
  return Object.fromEntries(Object.entries(put).map(([key, entry]) => [key, filled(entry, value)]));
}

/** What machine code is for: vehicle, law and plant, whatever their numbers, as flypend.lab.standalone names it. An address may lack them. */
export const kind = ({ vehicle, law, plant }) =>
  [vehicle?.base, vehicle?.mount ?? "gimbal", law.name, plant?.base, (plant?.base !== "ideal" && plant?.sensors) || "perfect"].join("/");

function read(hash = location.hash) {
  try {
    const value = JSON.parse(decodeURIComponent(hash.slice(1)));
    return readable(value) ? value : null;
  } catch {
    return null;
  }
}
