// A kernel of sampled flights in WebAssembly: the machine code of flypend, on the memory of the page.

const PAGE = 1 << 16; // bytes of a page of WebAssembly's memory
const STACK = 1 << 20; // bytes at the beginning for constants and the stack, which grows down from their end
// What the C library would give.
const LIBRARY = Object.fromEntries(
  ["sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "exp", "log", "pow", "hypot"].map((name) => [name, Math[name]]),
);

export class Engine {
  /** Of `code`, the bytes of a module, whose function takes the `names` in this order. */
  static async from(code, names) {
    const memory = new WebAssembly.Memory({ initial: (2 * STACK) / PAGE });
    const top = new WebAssembly.Global({ value: "i32", mutable: true }, STACK);
    const env = { __linear_memory: memory, __stack_pointer: top, ...LIBRARY };
    const { instance } = await WebAssembly.instantiate(code, { env });
    return new Engine(memory, instance.exports.kernel, names);
  }

  constructor(memory, kernel, names) {
    Object.assign(this, { memory, kernel, names });
  }

  /**
   * Call the kernel with `given`, by name: a typed array is copied in before and back afterwards, a number is an
   * integer, and what is missing is null.
   */
  call(given) {
    let end = STACK;
    const places = new Map();
    for (const name of this.names) {
      const value = given[name];
      if (!ArrayBuffer.isView(value)) continue;
      places.set(name, end);
      end = Math.ceil((end + value.byteLength) / 64) * 64;
    }
    const lacking = end - this.memory.buffer.byteLength;
    if (lacking > 0) this.memory.grow(Math.ceil(lacking / PAGE));
    const seen = (name) => {
      const { constructor, length } = given[name];
      return new constructor(this.memory.buffer, places.get(name), length);
    };
    for (const name of places.keys()) seen(name).set(given[name]);
    this.kernel(...this.names.map((name) => (places.has(name) ? places.get(name) : typeof given[name] === "bigint" ? given[name] : 0)));
    for (const name of places.keys()) given[name].set(seen(name));
  }
}
