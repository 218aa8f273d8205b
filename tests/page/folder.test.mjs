// A folder first: several ballbar tests are a table of all, worst first by the number shown, from which one is opened, two
// are compared, and the trend is a tab; a folder of logs is runs.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { at_rest, drop, kLong, live } from "./live_page.mjs";
import { json_of, of_run } from "./reports.mjs";
import { files_below } from "./tool.mjs";

const kTable = ".first .table table";
const head_of = (page) => page.$$eval(`${kTable} th`, (all) => all.map((one) => one.textContent));
const rows_of = (page) => page.$$eval(`${kTable} tbody tr`, (all) => all.map((row) => [...row.cells].map((cell) => cell.textContent.trim())));
const column = async (page, name) => {
  const at = (await head_of(page)).indexOf(name);
  assert.notEqual(at, -1, `${name} in ${await head_of(page)}`);
  return (await rows_of(page)).map((row) => row[at]);
};
const worst = (text) => Math.max(...text.split(" / ").map(Number));
const tab = (page, name) => page.getByRole("button", { name, exact: true });
const table = (page) => page.waitForSelector(kTable, { timeout: kLong });
const all_below = (disk) => Object.fromEntries(files_below("folder", disk).filter(([path]) => path.endsWith(".b5r")).map(([path, file]) => [path.slice(7).replaceAll("/", "-"), [...readFileSync(file)]]));

test("a folder of tests: all rows with G, F, D, worst first, by the file's limits or a tolerance; the program's numbers", async () => {
  const { page, wrong, close } = await live();
  await page.setInputFiles("input[webkitdirectory]", of_run("machine-history"));
  await table(page);
  await at_rest(page);
  const g = await column(page, "G µm, CCW / CW");
  assert.equal(g.length, 10);
  assert.deepEqual(g.map(worst), g.map(worst).sort((a, b) => b - a), String(g));
  const fitted = json_of("fit", of_run("machine-history", "2026-01-19", "XY.b5r")).iso230_4;
  const shown = (await rows_of(page)).find((row) => /2026-01-19\/XY/.test(row[0]));
  assert.ok(shown.includes(`${fitted.g_ccw_um.toFixed(2)} / ${fitted.g_cw_um.toFixed(2)}`), shown.join(" | "));
  assert.ok(shown.includes(fitted.d_um.toFixed(2)), shown.join(" | "));
  assert.match(await page.innerText(".first .verdict"), /^Worst of 10 tests: XY, 20\d\d-\d\d-\d\d.*circular deviation G \d/);
  await page.getByLabel("Tolerance µm").fill("6");
  await page.getByLabel("Tolerance µm").press("Enter");
  await page.waitForFunction(() => /fail the tolerance of 6/.test(document.querySelector(".first .verdict")?.textContent ?? ""), null, { timeout: kLong });
  const fails = json_of("errors", of_run("machine-history")).tests.filter(({ errors }) => errors.find(({ name }) => name === "circularity").value > 6);
  const result = await column(page, "result");
  assert.equal(result.filter((one) => one === "fail").length, fails.length);
  assert.equal(result.filter((one) => one === "pass").length, 10 - fails.length);
  assert.deepEqual(wrong, []);
  await close();
});

test("a click opens one, with machine, date, feed; back; two are compared; the trend is a tab", async () => {
  const { page, wrong, close } = await live();
  await page.setInputFiles("input[webkitdirectory]", of_run("machine-history"));
  await table(page);
  await page.getByRole("button", { name: "2026-01-19/XY.b5r" }).click();
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  assert.match(await page.innerText(".first .verdict .made-with"), /2026-01-19 \d\d:\d\d · XY, bar of 100 mm · 1000 mm\/min/);
  await tab(page, "all tests").click();
  await table(page);
  const boxes = page.locator(`${kTable} tbody input[type=checkbox]`);
  const compare = page.getByRole("button", { name: "Compare the two" });
  assert.ok(await compare.isDisabled());
  const names = (await rows_of(page)).map(([name]) => name);
  for (const name of ["2025-01-20/XY.b5r", "2026-01-19/XY.b5r"]) await boxes.nth(names.indexOf(name)).check();
  await compare.click();
  await page.waitForFunction(() => /^Backlash of X grew from 0\.\d to 3\.\d µm, circularity grew from 4\.7 to 6\.7 µm/.test(document.querySelector(".first .verdict")?.innerText ?? ""), null, { timeout: kLong });
  await tab(page, "Trend over time").click();
  await page.waitForFunction(() => /^Backlash of X \+ 3\.88/.test(document.querySelector(".first .verdict")?.innerText ?? ""), null, { timeout: kLong });
  assert.deepEqual(wrong, []);
  await close();
});

test("three planes of one machine: ranked by the G that is shown, each circularity named", async () => {
  const { page, wrong, close } = await live();
  await drop(page, all_below(of_run("machine-history", "2026-01-19")));
  await table(page);
  const g = await column(page, "G µm, CCW / CW");
  const planes = await column(page, "plane");
  assert.deepEqual([...planes].sort(), ["XY", "YZ", "ZX"]);
  assert.deepEqual(g.map(worst), g.map(worst).sort((a, b) => b - a));
  await tab(page, "circles and errors").click();
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  assert.match(await page.innerText(".first .verdict"), new RegExp(`${planes[0]} is the worst of 3 planes: circular deviation G`));
  const named = await page.$$eval(".summary tbody tr td:first-child", (all) => all.map((one) => one.textContent));
  for (const name of ["circular deviation G, CCW / CW", "G, both directions (2005)", "circularity of both runs, one centre"]) assert.ok(named.includes(name), String(named));
  assert.deepEqual(wrong, []);
  await close();
});

test("files with stored results alone, and several machines: one table", async () => {
  const stored = (k) => {
    const features = { CIRCULARITY: 5 + k, SQUARENESS: 10 + k };
    const lines = Object.entries(features).map(([key, value]) => `<FEATURE NAME="AF_${key}" DT="${key === "CIRCULARITY" ? "UT_LENGTH_UM" : "UT_UM_PER_M"}">${value}</FEATURE>`);
    return readFileSync(of_run("qc20-style-b5r", "00.b5r"), "utf8")
      .replace(/<READINGS>.*\n/g, "")
      .replace("20260115-080000", `202601${10 + k}-080000`)
      .replace('<ANALYSIS NAME="ISO230_4"', (start) => `<ANALYSIS NAME="RENISHAW_DIAGNOSTICS" version="2.1">${lines.join("")}</ANALYSIS>\n  ${start}`);
  };
  const { page, wrong, close } = await live();
  const files = Object.fromEntries(Array.from({ length: 21 }, (_, k) => [`test ${k}.b5r`, stored(k)]));
  await drop(page, files);
  await table(page);
  const from = await column(page, "from");
  assert.equal(from.length, 21);
  assert.ok(from.every((one) => one === "stored"));
  const both = (await column(page, "both runs µm")).map(Number);
  assert.ok(both.every((one) => one >= 5 && one <= 25), String(both));
  assert.deepEqual(wrong, []);
  await close();
});

test("logs of one folder with the same columns open as runs, as on the terminal; each is opened alone too", async () => {
  const rows = (run) => Array.from({ length: 240 }, (_, k) => `${60 * k},${(20 + 3 * Math.sin(0.07 * k + run)).toFixed(3)},${(2 * (3 * Math.sin(0.07 * k + run)) + 0.05 * Math.sin(9 * k)).toFixed(3)}`).join("\n");
  const files = Object.fromEntries(Array.from({ length: 9 }, (_, run) => [`run ${run + 1}.csv`, `time_s,T_housing_degC,y_um\n${rows(run)}\n`]));
  const { page, wrong, close } = await live();
  await drop(page, files);
  await at_rest(page);
  const select = page.locator(".live-shelf select");
  assert.match(await select.locator("option").first().innerText(), /^All 9 as runs/);
  assert.equal(await select.inputValue(), await select.locator("option").first().getAttribute("value"));
  assert.equal(await page.locator(".live-shelf .fault").count(), 0);
  await page.getByRole("button", { name: "Find what is missing" }).click();
  await page.waitForSelector('.live-loop[data-search="done"]', { timeout: kLong });
  assert.match(await page.innerText(".live-loop .said"), /T_housing|housing/);
  await select.selectOption({ index: 3 });
  await at_rest(page);
  assert.match(await page.innerText(".live-report h1"), /run 3\.csv/);
  assert.deepEqual(wrong, []);
  await close();
});
