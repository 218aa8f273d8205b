// node plus_timing.mjs BALLBAR_HTML [SAMPLE_RUNS]: how soon an effect that is added by "+" is fitted and drawn, and how
// soon after it is known what is missing then. Asserts nothing: a busy machine is slow.
import { readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { started } from "./browsers.mjs";
import { first_rows, hidden_effect } from "./hidden_effect.mjs";

const [tool, sample_runs = new URL("../../sample-runs", import.meta.url).pathname] = process.argv.slice(2);
if (!tool) {
  console.error("usage: node plus_timing.mjs BALLBAR_HTML [SAMPLE_RUNS]");
  process.exit(2);
}
const kTimes = 3;
const hidden = hidden_effect(sample_runs);
const long = join(sample_runs, "spindle-46h");
const cases = [
  ["hidden-effect, first 1333 rows", [["data.csv", Buffer.from(first_rows(sample_runs, 1333))], ["model.toml", readFileSync(join(hidden, "model.toml"))]]],
  ["hidden-effect", ["data.csv", "model.toml"].map((name) => [name, readFileSync(join(hidden, name))])],
  ["spindle-46h", [["measured.csv", readFileSync(join(long, "measured.csv"))], ["speed.toml", readFileSync(join(long, "speed.toml"))]]],
];

const browser = await started("chrome");
for (const [what, files] of cases) {
  const drawn = [], known = [];
  for (let k = 0; k < kTimes; ++k) {
    const tab = await browser.opened(tool);
    const [first, second] = await tab.evaluate(async (files) => {
      await window.ballbar.engine.ready;
      const transfer = new DataTransfer();
      for (const [name, base64] of files) transfer.items.add(new File([Uint8Array.from(atob(base64), (sign) => sign.charCodeAt(0))], name));
      const frame = () => new Promise(requestAnimationFrame);
      const until = async (is) => {
        while (!is()) await frame();
        await frame();
        return performance.now();
      };
      const look = (selector) => document.querySelector(selector);
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
      await until(() => look(".live-loop"));
      await frame();
      if (!look('.live-loop[data-search="running"]') && !look(".live-candidates .plus")) [...document.querySelectorAll(".live-loop .buttons button")][0].click();
      await until(() => look(".live-candidates .plus"));
      await until(() => look(".live-work").dataset.waiting === "0");
      const rmse = look(".live-fall .rmse").textContent;
      const begin = performance.now();
      look(".live-candidates .plus").click();
      const seen = await until(() => look(".live-fall .rmse").textContent !== rmse);
      await until(() => look('.live-loop[data-revisions="2"]'));
      if (!look('.live-loop[data-search="running"]')) await until(() => look('.live-loop[data-search="running"]') || look(".live-work").dataset.waiting === "0");
      const found = await until(() => look(".live-work").dataset.waiting === "0" && !look(".live-loop[aria-busy]"));
      return [seen - begin, found - seen];
    }, files.map(([name, bytes]) => [basename(name), bytes.toString("base64")]));
    drawn.push(first);
    known.push(second);
    await tab.close();
  }
  const said = (values) => `${values.map((value) => value.toFixed(0)).join(", ")} ms`;
  console.log(`${what}: fitted and drawn ${said(drawn)}; what is missing then, after ${said(known)} more`);
}
await browser.close();
