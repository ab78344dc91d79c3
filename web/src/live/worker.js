// The simulation beside the page: whole flights that are asked for, and one that goes on piece by piece.

import { chosen, columns } from "./columns.js";
import { simulation as made } from "./kinds.js";
import { joined } from "./simulation.js";

let still, running, ready;

const actions = {
  load({ code, facts }) {
    const inflated = new Blob([code]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    ready = new Response(inflated).arrayBuffer()
      .then((module) => WebAssembly.compile(module))
      .then((module) => Promise.all([made(module, facts), made(module, facts)]))
      .then((both) => ([still, running] = both));
  },

  /** A whole flight. */
  fly({ number, asked }) {
    const begun = performance.now(), rows = flown(still, asked, asked.ticks);
    const kept = chosen(still, rows, 0);
    return { kind: "flown", number, columns: columns(still, rows, kept, 0), outcome: still.outcome(), milliseconds: performance.now() - begun };
  },

  /** How flights from several `starts`, the first of which is number `first`, end. */
  several({ number, asked: { gains, knobs, seed, ticks }, starts, first }) {
    const begun = performance.now();
    still.tune(gains);
    still.turn(knobs);
    return { kind: "several", number, endings: still.several(starts, ticks, seed + first), milliseconds: performance.now() - begun };
  },

  /** The clearance of the rod at the beginning of several `starts`, m. */
  clear({ number, starts }) {
    const idle = new Array(still.facts.rotors).fill(0);
    return { kind: "clear", number, clearances: starts.map((start) => still.shown(0, [...start, ...idle])[4]) };
  },

  /** Begin a flight that goes on, and fly it up to a tick at once. */
  begin({ number, asked, until }) {
    return piece(number, flown(running, asked, until), 0);
  },

  /** Fly on. */
  advance({ number, ticks, gains, knobs, pokes, pull }) {
    const first = running.tick + 1;
    running.tune(gains);
    running.turn(knobs);
    const kicks = pokes.reduce(added, null);
    return piece(number, pull ? running.pulled(ticks, pull, kicks) : running.advance(ticks, kicks), first);
  },
};

function flown(simulation, { start, seed, gains, knobs, pokes }, ticks) {
  simulation.tune(gains);
  simulation.turn(knobs);
  simulation.begin(start, seed);
  const parts = [];
  let impulses = null;
  for (const poke of pokes.filter(({ tick }) => tick < ticks)) {
    if (poke.tick > simulation.tick) {
      parts.push(simulation.advance(poke.tick - simulation.tick, impulses));
      impulses = null;
    }
    impulses = added(impulses, poke.impulses);
  }
  parts.push(simulation.advance(Math.max(ticks - simulation.tick, 1), impulses));
  return joined(parts);
}

const added = (sum, impulses) => (sum ? sum.map((value, i) => value + impulses[i]) : impulses);

function piece(number, rows, first) {
  const kept = chosen(running, rows, first);
  return { kind: "piece", number, columns: columns(running, rows, kept, first), tick: running.tick, outcome: running.outcome() };
}

addEventListener("message", async ({ data }) => {
  try {
    if (data.kind !== "load") await ready;
    const reply = actions[data.kind](data);
    if (reply) postMessage(reply);
  } catch (error) {
    postMessage({ kind: "error", number: data.number, message: `this browser cannot fly it: ${error.message}` });
  }
});
