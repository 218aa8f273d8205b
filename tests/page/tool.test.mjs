// ballbar.html in Chromium and in Firefox: opened from a disk, files chosen, a model grown, kept over a reload, deleted;
// and what no page should stumble over.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { kinds, started } from "./browsers.mjs";
import { folder, of_run } from "./reports.mjs";
import { tool } from "./tool.mjs";

const kRest = 400; // ms in which work may follow on work

const idle = async (tab) => {
  for (let k = 0; k < 3; ++k) {
    await tab.wait("no work", () => document.querySelector(".live-work").dataset.waiting === "0" && !document.querySelector(".live-loop[aria-busy]"));
    await new Promise((done) => setTimeout(done, kRest));
  }
};
const there = (tab, selector) => tab.wait(selector, (selector) => document.querySelector(selector) !== null, selector);

const sound = readFileSync(of_run("qc20-style-b5r", "00.b5r"));
const broken = {
  "empty.b5r": "",
  "half.b5r": sound.subarray(0, sound.length / 2),
  "noise.b5r": Buffer.from(Array.from({ length: 4000 }, (_, k) => (k * 7919) % 256)),
  "deep.json": "[".repeat(100_000),
  "nul.csv": "time_s,x_um\n0,1\n1,\u00002\n",
  "words.csv": "time_s,x_um\n0,one\n1,two\n2,three\n",
  "other.toml": 'format = "ballbar-session 1"\nmethod = "none"\n',
  "not.xlsx": "PK\u0003\u0004 nothing",
  "page.html": "<script id=report>{}</script><script>window.ran = true</script>",
  "<img src=x onerror=alert(1)>.csv": "time_s,<b>x</b>_um\n0,1\n",
};

for (const kind of kinds) {
  let browser;
  before(async () => {
    browser = await started(kind);
  });
  after(() => browser.close());

  test(`${kind}: a ballbar test is chosen: its ranked table, and the picture beside it`, async () => {
    const tab = await browser.opened(tool);
    await tab.choose([of_run("qc20-style-b5r", "00.b5r")]);
    await there(tab, ".side-by-side tbody tr");
    await there(tab, 'figure[data-picture="machine-errors"] canvas');
    assert.deepEqual(tab.wrong, []);
    await tab.close();
  });

  test(`${kind}: an effect is found, added, taken back; a reload loses nothing, and it can be deleted`, async () => {
    const tab = await browser.opened(tool);
    await tab.choose([of_run("hidden-effect", "01", "data.csv"), of_run("hidden-effect", "01", "model.toml")]);
    await there(tab, ".live-candidates .plus");
    const rmse = async () => Number(/RMSE ([\d.]+)/.exec(await tab.text(".live-fall .rmse"))?.[1]);
    const before = await rmse();
    await tab.click(".live-candidates .plus");
    await there(tab, '.live-loop[data-revisions="2"] .live-fall[data-beside="before"]');
    const added = await rmse();
    assert.ok(added < 0.4 * before, `${before} to ${added}`);
    await idle(tab);
    await tab.reload();
    await tab.click(".kept button", "Continue");
    await there(tab, ".live-fall .rmse:not(:empty)");
    assert.equal(await rmse(), added);
    await idle(tab);
    await tab.click("button", "Undo");
    await there(tab, '.live-loop:not([data-revisions="2"])');
    assert.equal((await rmse()).toFixed(2), before.toFixed(2));
    await idle(tab);
    await tab.reload();
    await tab.click(".kept button", "Delete");
    await there(tab, ".live-told:not(:empty)");
    assert.match(await tab.text(".live-told"), /Deleted/);
    await tab.reload();
    assert.equal(await tab.evaluate(() => document.querySelector(".kept")), null);
    assert.deepEqual(tab.wrong, []);
    await tab.close();
  });

  test(`${kind}: broken files, one by one and together: a sentence, and nothing runs`, async () => {
    const tab = await browser.opened(tool);
    const drop = (files) =>
      tab.evaluate(
        (files) => {
          const transfer = new DataTransfer();
          for (const [name, base64] of files) transfer.items.add(new File([Uint8Array.from(atob(base64), (sign) => sign.charCodeAt(0))], name));
          document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
        },
        files.map(([name, content]) => [name, Buffer.from(content).toString("base64")]),
      );
    const told = () => tab.evaluate(() => document.querySelector(".live-told").textContent + [...document.querySelectorAll(".live-files .faulty")].map((one) => one.textContent).join(" "));
    for (const one of Object.entries(broken)) {
      await drop([one]);
      await idle(tab);
      assert.match(await told(), /\w+ \w+/, `nothing is said of ${one[0]}`);
    }
    await drop(Object.entries(broken));
    await idle(tab);
    assert.equal(await tab.evaluate(() => window.ran ?? null), null);
    assert.equal(await tab.evaluate(() => document.querySelectorAll("img[src=x]").length), 0);
    assert.deepEqual(tab.wrong, []);
    await tab.close();
  });

  test(`${kind}: a file of a million rows is read while the page answers`, async () => {
    const path = join(folder, `long-${kind}.csv`);
    const row = (k) => `${k},${Array.from({ length: 19 }, (_, c) => ((k * (c + 1)) % 997) / 10).join(",")}`;
    const pieces = [`time_s,${Array.from({ length: 19 }, (_, c) => (c === 0 ? "y_um" : `T${c}_degC`)).join(",")}\n`];
    for (let k = 0; k < 1e6; ++k) pieces.push(`${row(k)}\n`);
    writeFileSync(path, pieces.join(""));
    const tab = await browser.opened(tool);
    await tab.evaluate(() => {
      window.longest = 0;
      let last = performance.now();
      setInterval(() => {
        const now = performance.now();
        window.longest = Math.max(window.longest, now - last);
        last = now;
      }, 20);
    });
    await tab.choose([path]);
    await there(tab, '.live-work:not([data-waiting="0"])');
    const longest_at_work = await tab.evaluate(() => window.longest);
    assert.ok(longest_at_work < 2000, `the page stood still for ${longest_at_work} ms`);
    await there(tab, '.live-work[data-waiting="0"]');
    assert.deepEqual(tab.wrong, []);
    await tab.close();
  });
}
