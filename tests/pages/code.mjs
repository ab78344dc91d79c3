// node code.mjs NODE_MODULES: reads from its input the path of a drawn QR code and its size, and prints what another library reads in it.

import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const jsQR = createRequire(`${process.argv[2]}/`)("jsqr");
const SCALE = 4;

const { path, size } = JSON.parse(readFileSync(0, "utf8")), side = SCALE * size, pixels = new Uint8ClampedArray(4 * side * side).fill(255);
for (const [, x, y] of path.matchAll(/M(\d+) (\d+)h1v1h-1z/g)) {
  for (let i = 0; i < SCALE * SCALE; i++) {
    const at = 4 * ((SCALE * y + Math.floor(i / SCALE)) * side + SCALE * x + (i % SCALE));
    pixels.fill(0, at, at + 3);
  }
}
process.stdout.write(jsQR(pixels, side, side).data);
