// Bundle the pages of flypend: node build.mjs [folder], by default into the package.

import { copyFile, mkdir, readFile } from "node:fs/promises";
import { fileURLToPath } from "node:url";
import { join, resolve } from "node:path";
import { build } from "esbuild";

const here = fileURLToPath(new URL(".", import.meta.url));
const out = resolve(process.argv[2] ?? join(here, "../src/flypend/pages/web"));
const common = {
  absWorkingDir: here, bundle: true, minify: true, format: "iife", target: ["chrome100", "firefox100", "safari15.4"], charset: "ascii",
};

/** `import text from "worker:./file.js"`: the file, bundled, as text, for a worker that a page makes of it. */
const worker = {
  name: "worker",
  setup({ onResolve, onLoad }) {
    onResolve({ filter: /^worker:/ }, ({ path, resolveDir }) => ({ path: resolve(resolveDir, path.slice(7)), namespace: "worker" }));
    onLoad({ filter: /./, namespace: "worker" }, async ({ path }) => {
      const { outputFiles } = await build({ ...common, entryPoints: [path], write: false });
      return { contents: outputFiles[0].text, loader: "text" };
    });
  },
};

const LETTER = 14; // px, of the page's letters on a usual screen
const KEPT = /@media[^{]*|:root \{[^}]*/.source; // the size of the screen, and that of the letters by it

/** Style sheets as text, with lengths that grow as letters do on a large screen: in rem where they say px. */
const style = {
  name: "style",
  setup({ onLoad }) {
    onLoad({ filter: /\.css$/ }, async ({ path }) => {
      const lengths = new RegExp(`${KEPT}|(-?[\\d.]+)px`, "g");
      const contents = (await readFile(path, "utf8")).replace(lengths, (all, px) => (px ? `${+(px / LETTER).toFixed(5)}rem` : all));
      return { contents, loader: "text" };
    });
  },
};

await mkdir(out, { recursive: true });
await build({
  ...common, entryPoints: ["src/page.js"], legalComments: "inline", outdir: out, plugins: [style, worker],
});
await copyFile(join(here, "node_modules/three/LICENSE"), join(out, "THREE-LICENSE.txt"));
