// Milliseconds a flight of a page's machine code takes in Node.js: arguments are a JSON of facts, starts and ticks, and the module.
import { readFileSync } from "node:fs";
import { simulation } from "../web/src/live/kinds.js";

const [, , asked, code] = process.argv, { facts, starts, ticks } = JSON.parse(readFileSync(asked));
const flown = await simulation(new WebAssembly.Module(readFileSync(code)), facts), took = [];
flown.turn({});
for (let i = 0; i < 5; i++) {
  const begun = process.cpuUsage();
  flown.several(starts, ticks);
  took.push(process.cpuUsage(begun).user / 1e3 / starts.length);
}
console.log(Math.min(...took));
