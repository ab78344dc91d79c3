// node words.mjs RUNS: what a page says of packed runs at their samples, by the page's own sources: words and states, as JSON.

import { readFileSync } from "node:fs";

import { Flight } from "../../web/src/flight.js";

const runs = JSON.parse(readFileSync(process.argv[2], "utf8"));
console.log(JSON.stringify(runs.map((record) => {
  const flight = new Flight(record), times = Array.from(flight.t);
  return { t: times, words: times.map((t) => flight.phase(t)), states: times.map((t) => flight.state(t)), verdict: flight.verdict, recoveries: flight.recoveries(flight.end).all };
})));
