// Calls a kernel through the engine of the pages: a JSON of names, arrays and integers comes in, the arrays go out.
import { readFileSync, writeFileSync } from "node:fs";
import { Engine } from "../../web/src/engine.js";

const [, , code, names, from, to] = process.argv;
const KINDS = { float64: Float64Array, int64: BigInt64Array };
const given = {};
for (const [name, { kind, bytes, number }] of Object.entries(JSON.parse(readFileSync(from)))) {
  if (kind) given[name] = new KINDS[kind](Uint8Array.from(Buffer.from(bytes, "base64")).buffer);
  else given[name] = BigInt(number);
}
const engine = await Engine.from(readFileSync(code), names.split(","));
engine.call(given);
const out = Object.entries(given).filter(([, value]) => ArrayBuffer.isView(value));
writeFileSync(to, JSON.stringify(Object.fromEntries(out.map(([name, { buffer }]) => [name, Buffer.from(buffer).toString("base64")]))));
