// A module of WebAssembly that the package has compiled: its functions on memory of the page.

import { clamp } from "./numbers.js";

const PAGE = 1 << 16; // bytes of a page of WebAssembly's memory
const STACK = 1 << 20; // bytes at the beginning for constants and the stack, which grows down from their end
const LINE = 64; // bytes of a cache line, at whose beginning every array lies
const NAMES = [
  "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh", "atanh", "exp", "log", "pow", "hypot",
];
// What the C library would give.
const LIBRARY = { ...Object.fromEntries(NAMES.map((name) => [name, Math[name]])), fmod: (a, b) => a % b, erf };

export class Engine {
  /** Of `module`, a WebAssembly.Module. */
  static async from(module) {
    const memory = new WebAssembly.Memory({ initial: (2 * STACK) / PAGE });
    const top = new WebAssembly.Global({ value: "i32", mutable: true }, STACK);
    const env = { __linear_memory: memory, __stack_pointer: top, ...LIBRARY };
    const { exports } = await WebAssembly.instantiate(module, { env });
    return new Engine(memory, exports);
  }

  constructor(memory, functions) {
    Object.assign(this, { memory, functions, end: STACK });
  }

  /** An array of `length` numbers of a `kind` (Float64Array or BigInt64Array) for good, all 0. */
  reserve(kind, length) {
    const place = this.end;
    this.end += Math.ceil((length * kind.BYTES_PER_ELEMENT) / LINE) * LINE;
    const lacking = this.end - this.memory.buffer.byteLength;
    if (lacking > 0) this.memory.grow(Math.ceil(lacking / PAGE));
    return { place, kind, length, view: () => new kind(this.memory.buffer, place, length) };
  }

  /** Call the function `name` with `given`: arrays of `reserve`, integers as BigInt, real numbers, null for none. */
  call(name, ...given) {
    this.functions[name](...given.map((value) => (typeof value === "object" ? value?.place ?? 0 : value)));
  }
}

/** The error function, by a series of positive terms; beyond 6 it is 1 to the last digit. */
function erf(x) {
  if (Math.abs(x) > 6) return Math.sign(x);
  let term = x, sum = x;
  for (let n = 3; n < 250; n += 2) sum += term *= (2 * x * x) / n;
  return clamp((2 / Math.sqrt(Math.PI)) * Math.exp(-x * x) * sum, -1, 1);
}
