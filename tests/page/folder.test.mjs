// A folder first: several ballbar tests are a table of all, worst first by the number shown, from which one is opened, two
// are compared, and the trend is a tab; a folder of logs is runs.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { at_rest, drop, dropped, kLong, live, saved } from "./live_page.mjs";
import { folder, json_of, of_run } from "./reports.mjs";
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

// { name in the archive: file on the disk, or text }
const zip_of = (name, entries) => {
  const path = join(folder, name);
  const script = "import json, os, sys, zipfile\nwith zipfile.ZipFile(sys.argv[1], 'w', zipfile.ZIP_DEFLATED) as made:\n  for name, held in json.load(sys.stdin).items(): made.write(held, name) if os.path.isabs(held) else made.writestr(name, held)";
  execFileSync("python3", ["-c", script, path], { input: JSON.stringify(entries), env: { ...process.env, PYTHONUTF8: "1" } });
  return path;
};
const tests_of_days = (...days) =>
  Object.fromEntries(days.flatMap((day) => files_below(day, of_run("machine-history", day)).filter(([path]) => path.endsWith(".b5r"))));

test("archives are the tests inside: the same table as of the files, sub folders, names of any language, nothing of what systems hide", async () => {
  const days = tests_of_days("2025-01-20", "2026-01-19");
  const paths = Object.keys(days);
  const strange = (path) => `机床 Prüfungen/${path}`;
  const junk = Object.fromEntries(paths.flatMap((path) => [[`__MACOSX/${strange(path).replace(/[^/]*$/, "._$&")}`, "\0\u0005\u0016\u0007"], [`${strange(path).replace(/[^/]*$/, "")}.DS_Store`, "Bud1"], ["liesmich.txt", "?"]]));
  const whole = zip_of("Prüfungen.zip", { ...Object.fromEntries(Object.entries(days).map(([path, file]) => [strange(path), file])), ...junk });
  const [expected, opened] = [await live(), await live()];
  await drop(expected.page, Object.fromEntries(Object.entries(days).map(([path, file]) => [path.replaceAll("/", "-"), [...readFileSync(file)]])));
  await dropped(opened.page, whole);
  for (const { page } of [expected, opened]) {
    await table(page);
    await at_rest(page);
  }
  const numbers = async ({ page }) => (await rows_of(page)).map((row) => row.slice(1));
  assert.equal((await numbers(opened)).length, paths.length);
  assert.deepEqual(await numbers(opened), await numbers(expected));
  assert.deepEqual(await head_of(opened.page), await head_of(expected.page));
  const { page } = opened;
  assert.equal(await page.locator(".live-shelf .fault").count(), 0);
  await page.getByRole("button", { name: "2026-01-19/XY.b5r" }).click();
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  assert.match(await page.innerText(".first .verdict .made-with"), /2026-01-19 \d\d:\d\d · XY/);
  await tab(page, "all tests").click();
  await table(page);
  const boxes = page.locator(`${kTable} tbody input[type=checkbox]`);
  const names = (await rows_of(page)).map(([name]) => name);
  for (const name of ["2025-01-20/XY.b5r", "2026-01-19/XY.b5r"]) await boxes.nth(names.indexOf(name)).check();
  await page.getByRole("button", { name: "Compare the two" }).click();
  await page.waitForFunction(() => /^Backlash of X grew/.test(document.querySelector(".first .verdict")?.innerText ?? ""), null, { timeout: kLong });
  // After a reload the same is compared, out of the archive that the browser kept.
  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  await page.locator(".kept button").first().click();
  await page.waitForFunction(() => /^Backlash of X grew/.test(document.querySelector(".first .verdict")?.innerText ?? ""), null, { timeout: kLong });
  await at_rest(page);
  // One test, out of the archive that a saved page carries.
  await tab(page, "all tests").click();
  await table(page);
  await page.getByRole("button", { name: "2026-01-19/XY.b5r" }).click();
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  const made_with = await page.innerText(".first .verdict .made-with");
  const kept = await saved(page, "Report page with the files (.html)");
  const again = await live();
  await dropped(again.page, kept);
  await again.page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  assert.equal(await again.page.innerText(".first .verdict .made-with"), made_with);
  for (const { wrong, close } of [expected, opened, again]) {
    assert.deepEqual(wrong, []);
    await close();
  }
});

test("a folder that holds archives, files and what systems hide: one table; an archive without tests says so", async () => {
  const disk = join(folder, "stick");
  mkdirSync(join(disk, "__MACOSX"), { recursive: true });
  cpSync(zip_of("one.zip", tests_of_days("2025-01-20")), join(disk, "2025.zip"));
  cpSync(zip_of("two.zip", tests_of_days("2026-01-19")), join(disk, "2026.zip"));
  cpSync(of_run("qc20-style-b5r", "00.b5r"), join(disk, "00.b5r"));
  writeFileSync(join(disk, "._00.b5r"), "\0\u0005\u0016\u0007");
  writeFileSync(join(disk, ".DS_Store"), "Bud1");
  const { page, wrong, close } = await live();
  await page.setInputFiles("input[webkitdirectory]", disk);
  await table(page);
  await at_rest(page);
  const tests = Object.keys(tests_of_days("2025-01-20", "2026-01-19")).length + 1;
  assert.equal((await rows_of(page)).length, tests);
  assert.deepEqual(await page.$$eval(".live-shelf .live-files li bdi", (all) => all.map((one) => one.textContent).sort()), ["stick/00.b5r", "stick/2025.zip", "stick/2026.zip"]);
  assert.equal(await page.locator(".live-shelf .fault").count(), 0);
  await dropped(page, zip_of("holiday.zip", { "beach.txt": "sand" }));
  await page.waitForSelector(".live-shelf .fault", { state: "attached", timeout: kLong });
  assert.deepEqual(wrong, []);
  await close();
});
