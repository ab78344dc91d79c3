// Bundle the pages of flypend: node build.mjs [folder], by default into the package.

import { copyFile, mkdir } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { join, resolve } from "node:path";
import { build } from "esbuild";

const here = fileURLToPath(new URL(".", import.meta.url));
const out = resolve(process.argv[2] ?? join(here, "../src/flypend/pages/web"));
await mkdir(out, { recursive: true });
await build({
  absWorkingDir: here,
  entryPoints: ["src/replay.js", "src/lab.js"],
  bundle: true,
  minify: true,
  format: "iife",
  target: ["chrome100", "firefox100", "safari15.4"],
  charset: "ascii",
  legalComments: "inline",
  loader: { ".css": "text" },
  outdir: out,
});
await copyFile(join(here, "node_modules/three/LICENSE"), join(out, "THREE-LICENSE.txt"));
