// node timing.mjs PROGRAM: prints how large a page is and how fast it answers. Asserts nothing: a busy machine is slow.
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { launched } from "./browser.mjs";
import { long_series } from "./long_series.mjs";
import { session } from "./session.mjs";

const program = process.argv[2];
if (!program) {
  console.error("usage: node timing.mjs PROGRAM");
  process.exit(2);
}
const folder = mkdtempSync(join(tmpdir(), "ballbar-timing-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

const report = (data, name) => {
  const out = join(folder, name);
  const begin = performance.now();
  execFileSync(program, ["report", data, "--out", out], { stdio: "ignore" });
  const text = readFileSync(out, "latin1");
  const [, data_text] = /id="report">(.*?)<\/script>/s.exec(text);
  console.log(`  made in ${((performance.now() - begin) / 1000).toFixed(2)} s; ${(statSync(out).size / 1e6).toFixed(2)} MB, ${((text.length - data_text.length) / 1e6).toFixed(2)} MB without the data`);
  return out;
};

const middle = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];

// To data-ready, in milliseconds: the middle of five.
const opening = async (browser, file) => {
  const times = [];
  for (let k = 0; k < 5; ++k) {
    const page = await browser.newPage({ viewport: { width: 1100, height: 900 } });
    await page.addInitScript(() => {
      new MutationObserver(() => {
        if (document.documentElement?.dataset.ready) window.ready_ms ??= performance.now();
      }).observe(document, { attributes: true, subtree: true });
    });
    const begin = Date.now();
    await page.goto(pathToFileURL(file).href);
    await page.waitForFunction(() => window.ready_ms);
    times.push({ inside: await page.evaluate(() => window.ready_ms), whole: Date.now() - begin });
    await page.close();
  }
  console.log(`  open to interactive in ${Math.round(middle(times.map((one) => one.inside)))} ms, ${middle(times.map((one) => one.whole))} ms with the start of a tab`);
};

// Each window is drawn at once; and by the key +, as far as the next picture on the screen.
const redraws = async (browser, file, name) => {
  const page = await browser.newPage({ viewport: { width: 1100, height: 900 } });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  const times = await page.evaluate(async (name) => {
    const one = window.ballbar.figures.get(name);
    one.element.scrollIntoView({ block: "center", behavior: "instant" });
    const frame = () => new Promise(requestAnimationFrame);
    while (!one.chart()) await frame();
    await frame();
    const [from, to] = one.whole();
    const [at, width] = [(from + to) / 2, to - from];
    const drawing = [];
    const frames = [];
    for (let k = 0; k < 24; ++k) {
      const begin = performance.now();
      one.see([at - width / 2 / 1.5 ** (k % 12), at + width / 3 / 1.5 ** (k % 12)]);
      await frame();
      await frame();
      frames.push(performance.now() - begin);
      const again = performance.now();
      one.draw_now();
      drawing.push(performance.now() - again);
    }
    return { drawing, frames };
  }, name);
  await page.close();
  const said = (values) => `${middle(values).toFixed(1)} ms, at most ${Math.max(...values).toFixed(1)} ms`;
  console.log(`  one picture drawn in ${said(times.drawing)}; from zoom to the screen, two frames, ${said(times.frames)}`);
};

const browser = await launched();
console.log("15 tests of two arcs of 1500 readings:");
const run = report(session(join(folder, "run"), { tests: 15, readings: 1500 }), "session.html");
await opening(browser, run);
await redraws(browser, run, "drift");

console.log("A series of 10^6 rows and two columns:");
const series = report(long_series(join(folder, "long.csv"), 1e6), "series.html");
await opening(browser, series);
await redraws(browser, series, "measured");
await browser.close();
