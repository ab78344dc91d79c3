// Flies a module through the simulation of the pages: a JSON of facts, start, seed and pieces comes in, rows go out.
import { readFileSync, writeFileSync } from "node:fs";
import { Simulation } from "../../web/src/live/simulation.js";

const [, , code, from, to] = process.argv;
const { facts, start, seed, pieces } = JSON.parse(readFileSync(from));
const simulation = await Simulation.from(new WebAssembly.Module(readFileSync(code)), facts);
simulation.begin(start, seed);
const rows = pieces.map(({ ticks, gains, knobs, impulses }) => {
  simulation.tune(gains ?? {});
  simulation.turn(knobs ?? {});
  return Buffer.from(simulation.advance(ticks, impulses).buffer);
});
writeFileSync(to, JSON.stringify({ rows: Buffer.concat(rows).toString("base64"), outcome: simulation.outcome() }));
