// From a module of machine code to its simulation, by the kind of its plant.

import { Ideal } from "./ideal.js";
import { Sampled } from "./sampled.js";

const KINDS = { ideal: Ideal, sampled: Sampled };

/** The simulation of a `module` of WebAssembly, with `facts` about it. */
export const simulation = (module, facts) => KINDS[facts.kind].from(module, facts);
