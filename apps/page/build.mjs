// Bundles the page: node build.mjs OUT_DIR writes page.js, pictures.js, worker.js, boot.js and page.css there.
import { build } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { catalogue_of, page_texts } from "./catalogues.mjs";

const here = dirname(fileURLToPath(import.meta.url));
const out = process.argv[2];
if (!out) {
  console.error("usage: node build.mjs OUT_DIR");
  process.exit(2);
}

page_texts();
const catalogues = {
  name: "catalogues",
  setup: ({ onLoad }) => onLoad({ filter: /\.toml$/ }, ({ path }) => ({ contents: JSON.stringify(catalogue_of(path)), loader: "json" })),
};
// ASCII only: the program may write the bytes wherever it likes.
const common = {
  bundle: true,
  minify: true,
  target: "es2020",
  legalComments: "eof",
  charset: "ascii",
  loader: { ".html": "text" },
  plugins: [catalogues],
  logLevel: "warning",
};
// The licences under which a page may hold what it is made of, with every page.
const notices = ["echarts/NOTICE", "echarts/LICENSE", "echarts/licenses/LICENSE-d3", "zrender/LICENSE", "@preact/signals-core/LICENSE"].map((file) =>
  readFileSync(join(here, "node_modules", file), "ascii").replaceAll("*/", "* /"),
);
const footer = { js: ["/*!", ...notices, "*/"].join("\n") };
const script = { ...common, footer, format: "iife", define: { "process.env.NODE_ENV": '"production"' } };
await build({ ...script, entryPoints: [join(here, "src/main.ts")], outfile: join(out, "page.js") });
await build({ ...script, entryPoints: [join(here, "src/pictures.ts")], outfile: join(out, "pictures.js") });
for (const name of ["worker", "boot"]) {
  const entryPoints = [join(here, `src/${name}.ts`)];
  await build({ ...common, format: "iife", entryPoints, outfile: join(out, `${name}.js`) });
}
await build({ ...common, entryPoints: [join(here, "src/page.css")], outfile: join(out, "page.css") });

// What is left of other signs stands in regular expressions, where they may be written so too.
for (const name of ["page.js", "pictures.js"]) {
  const escaped = (sign) => "\\u" + sign.charCodeAt(0).toString(16).padStart(4, "0");
  const file = join(out, name);
  writeFileSync(file, readFileSync(file, "utf8").replace(/[^\0-\x7f]/g, escaped));
}
