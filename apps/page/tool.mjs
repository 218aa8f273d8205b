// node tool.mjs MADE ENGINE SAMPLE_RUNS VERSION OUT: the page of build.mjs in the folder MADE and the module in the
// folder ENGINE as one file, OUT.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { gzipSync } from "node:zlib";

const [made, engine, sample_runs, version, out] = process.argv.slice(2);
if (!out) {
  console.error("usage: node tool.mjs MADE ENGINE SAMPLE_RUNS VERSION OUT");
  process.exit(2);
}

const text_of = (file, encoding = "utf8") => readFileSync(file, encoding);
// Base64 in short lines: no server that states another charset, and no mail program, changes it.
const base64 = (bytes) => bytes.toString("base64").replace(/.{900}/g, "$&\n");
const gzipped = (bytes) => base64(gzipSync(bytes, { level: 9 }));
// What is large, and unpacked by the worker.
const xz = (bytes) => base64(execFileSync("xz", ["-9e", "--check=crc32", "--stdout"], { input: bytes, maxBuffer: 1 << 28 }));
const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;

// Of each sample run the files that its first use reads; "*.csv" are all of the folder.
const named = (folder, pattern) =>
  pattern.startsWith("*") ? readdirSync(folder).filter((name) => name.endsWith(pattern.slice(1))).sort() : [pattern];
const samples = JSON.parse(text_of(new URL("engine/samples.json", import.meta.url))).map((sample) => {
  const folder = join(sample_runs, sample.name);
  const paths = sample.files.flatMap((pattern) => named(folder, pattern));
  return { ...sample, files: paths.map((path) => ({ path, text: text_of(join(folder, path), "latin1") })) };
});

const script = text_of(join(made, "page.js"));
const boot = text_of(join(made, "boot.js"));
const style = text_of(join(made, "page.css"));
const worker = text_of(join(engine, "engine.js")) + "\n" + text_of(join(made, "worker.js"));
if (/[^\0-\x7f]/.test(boot + script + worker + style)) throw new Error("expected ASCII alone");
for (const text of [boot, style.replace(/<\/style/i, "</script")]) {
  if (/<\/script|<!--/i.test(text)) throw new Error("a script or style would end its own element in the page");
}
const carried = (id, text, more = "") => `<script type="text/plain" id="${id}"${more}>${text}</script>\n`;
const marks = {
  CHARSET: "utf-8",
  SCRIPT_HASH: hash(boot),
  STYLE_HASH: hash(style),
  ENGINE_SCRIPTS: " 'wasm-unsafe-eval' blob:",
  ENGINE_WORKERS: "; worker-src blob:; connect-src 'none'",
  MADE_BY: `ballbar ${version}`,
  TITLE: "ballbar",
  STYLE: style,
  SCRIPT: boot,
  CARRIED:
    carried("page-script", gzipped(script), ` data-hash="${hash(script)}"`) +
    carried("engine", xz(readFileSync(join(engine, "engine.wasm")))) +
    carried("engine-worker", gzipped(worker)) +
    carried("notices", gzipped(readFileSync(join(made, "notices.txt")))) +
    carried("samples", gzipped(JSON.stringify(samples.map(({ files, ...sample }) => sample)))) +
    carried("sample-files", xz(JSON.stringify(Object.fromEntries(samples.map(({ name, files }) => [name, files]))))),
};
const page = text_of(new URL("src/page.html", import.meta.url)).replace(/@([A-Z_]+)@/g, (_, name) => marks[name]);
writeFileSync(out, page, "ascii");
console.log(`${out}: ${(page.length / 1e6).toFixed(2)} MB`);
