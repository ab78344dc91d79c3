// Flies a module through the simulation of the pages: a JSON of facts, start, seed and pieces comes in; rows go out, and what is
// shown beside the last of each piece. With `starts` and `ticks` in place of a start, how flights from there end goes out.
import { readFileSync, writeFileSync } from "node:fs";
import { simulation as made } from "../../web/src/live/kinds.js";

const [, , code, from, to] = process.argv;
const { facts, start, seed, pieces, starts, ticks } = JSON.parse(readFileSync(from));
const simulation = await made(new WebAssembly.Module(readFileSync(code)), facts);
if (starts) {
  simulation.turn({});
  writeFileSync(to, JSON.stringify(simulation.several(starts, ticks, seed)));
  process.exit();
}
simulation.begin(start, seed);
const shown = [];
const rows = pieces.map(({ ticks, gains, knobs, impulses }) => {
  simulation.tune(gains ?? {});
  simulation.turn(knobs ?? {});
  const flown = simulation.advance(ticks, impulses);
  shown.push(Array.from(simulation.shown(simulation.tick * facts.period, flown.subarray(flown.length - simulation.row))));
  return Buffer.from(flown.buffer);
});
writeFileSync(to, JSON.stringify({ rows: Buffer.concat(rows).toString("base64"), shown, outcome: simulation.outcome() }));
