// node tool_timing.mjs PROGRAM BALLBAR_HTML: how large the tool is and how fast it answers, beside the program on one
// processor. Asserts nothing: a busy machine is slow. Of the program the whole command counts, with its start.
import { spawnSync } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, readdirSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { basename, join } from "node:path";
import { started } from "./browsers.mjs";
import { first_rows, hidden_effect } from "./hidden_effect.mjs";
import { session } from "./session.mjs";

const [program, tool, sample_runs = new URL("../../sample-runs", import.meta.url).pathname] = process.argv.slice(2);
if (!tool) {
  console.error("usage: node tool_timing.mjs PROGRAM BALLBAR_HTML [SAMPLE_RUNS]");
  process.exit(2);
}
const kTimes = 7;
const folder = mkdtempSync(join(tmpdir(), "ballbar-timing-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

const middle = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const said = (values) => `${middle(values).toFixed(0)} ms (${Math.min(...values).toFixed(0)} to ${Math.max(...values).toFixed(0)})`;

const native = (words) => {
  const times = [];
  for (let k = 0; k < kTimes; ++k) {
    const begin = performance.now();
    const done = spawnSync("taskset", ["-c", "0", program, ...words], { stdio: "ignore", cwd: folder });
    times.push(performance.now() - begin);
    if (done.status !== 0) throw new Error(`status ${done.status}: ${words.join(" ")}`);
  }
  return times;
};

copyFileSync(join(sample_runs, "qc20-style-b5r", "00.b5r"), join(folder, "00.b5r"));
copyFileSync(join(hidden_effect(sample_runs), "model.toml"), join(folder, "model.toml"));
writeFileSync(join(folder, "data.csv"), first_rows(sample_runs, 1333));
session(join(folder, "run"), { tests: 15, readings: 1500 });
const of_session = readdirSync(join(folder, "run")).map((name) => `run/${name}`);

// From the drop to what is on the screen, by the page's own clock, two frames after it is there.
const dropped = async (tab, paths, shown) => {
  const files = paths.map((path) => [basename(path), readFileSync(join(folder, path)).toString("base64")]);
  return tab.evaluate(
    async (files, shown) => {
      const transfer = new DataTransfer();
      for (const [name, base64] of files) transfer.items.add(new File([Uint8Array.from(atob(base64), (sign) => sign.charCodeAt(0))], name));
      const frame = () => new Promise(requestAnimationFrame);
      await frame();
      const begin = performance.now();
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
      while (!document.querySelector(shown)) await frame();
      await frame();
      return performance.now() - begin;
    },
    files,
    shown,
  );
};

const engine_run = (tab, words) =>
  tab.evaluate(async (words) => {
    const begin = performance.now();
    const { status, err } = await window.ballbar.engine.run(words);
    if (status !== 0) throw new Error(err);
    return performance.now() - begin;
  }, words);

console.log(`${basename(tool)}: ${(statSync(tool).size / 1e6).toFixed(2)} MB (asked: 4)`);
const browser = await started("chrome");
const ready = [], b5r = [], of_15 = [], diagnosed = [], engine = { b5r: [], of_15: [], diagnosed: [] };
for (let k = 0; k < kTimes; ++k) {
  const tab = await browser.opened(tool);
  ready.push(await tab.evaluate(async () => {
    const engine = window.ballbar.engine;
    await engine.ready;
    return performance.now();
  }));
  const put = async (path) =>
    tab.evaluate((path, base64) => window.ballbar.engine.put(path, Uint8Array.from(atob(base64), (sign) => sign.charCodeAt(0))), path, readFileSync(join(folder, path)).toString("base64"));
  await tab.evaluate(() => window.ballbar.engine.warmed.then(() => new Promise((done) => setTimeout(done, 1500)))); // who drops a file has looked for it first
  b5r.push(await dropped(tab, ["00.b5r"], ".live-report .side-by-side tbody tr"));
  for (const path of ["00.b5r", "data.csv", "model.toml", ...of_session]) await put(path);
  engine.b5r.push(await engine_run(tab, ["report", "00.b5r", "--json"]));
  engine.of_15.push(await engine_run(tab, ["report", "run/session.toml", "--json"]));
  engine.diagnosed.push(await engine_run(tab, ["diagnose", "data.csv", "--model", "model.toml", "--json"]));
  await tab.close();
  const other = await browser.opened(tool);
  await other.evaluate(() => window.ballbar.engine.ready);
  of_15.push(await dropped(other, of_session, ".live-report main figure"));
  await other.close();
  const third = await browser.opened(tool);
  await third.evaluate(() => window.ballbar.engine.ready);
  diagnosed.push(await dropped(third, ["data.csv", "model.toml"], ".live-candidates .plus"));
  await third.close();
}
await browser.close();

console.log(`ready, from the start of its loading: ${said(ready)} (asked: 1500)`);
const lines = [
  [".b5r dropped to ranked table", 200, b5r, engine.b5r, ["report", "00.b5r", "--json"]],
  ["session of 15 tests of 3000 readings, made for it", 1000, of_15, engine.of_15, ["report", "run/session.toml", "--json"]],
  ["diagnosis of 1333 rows x 5 inputs, of hidden-effect", 1500, diagnosed, engine.diagnosed, ["diagnose", "data.csv", "--model", "model.toml", "--json"]],
];
for (const [what, asked, seen, inside, words] of lines) {
  const alone = native(words);
  console.log(`${what}: ${said(seen)} from the drop to the screen (asked: ${asked})`);
  console.log(`  the command in the engine ${said(inside)}, the program ${said(alone)}: ${(middle(inside) / middle(alone)).toFixed(2)} times; to the screen ${(middle(seen) / middle(alone)).toFixed(2)} times (asked: 2.5)`);
}
