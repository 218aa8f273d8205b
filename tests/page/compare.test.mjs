// Two ballbar tests side by side, and a folder of a machine's tests as its history, in the page with the program in it.
// The pairs are simulated, with errors that are given.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { dropped, kLong, live } from "./live_page.mjs";
import { folder, json_of, of_run, program } from "./reports.mjs";

// A test of the machine of the sample run machine-history, with these values.
const made = (name, { seed, started, backlash, plane = "XY", feed = 1000, length = 100 }) => {
  const text = readFileSync(of_run("machine-history", "machine.toml"), "utf8")
    .replace("SEED", seed)
    .replace("STARTED", started)
    .replaceAll("PLANE", plane)
    .replace("RADIUS_ERROR", "2.0")
    .replace("HALF_OVAL", "2.0")
    .replace("BACKLASH", backlash)
    .replace("feed_mm_per_min = 1000.0", `feed_mm_per_min = ${feed}.0`)
    .replace("nominal_length_mm = 100.0", `nominal_length_mm = ${length}.0`);
  const at = join(folder, "compare", name);
  mkdirSync(at, { recursive: true });
  writeFileSync(join(at, "machine.toml"), text);
  execFileSync(program, ["simulate", join(at, "machine.toml"), "--b5r", "--force", "--out", join(at, "out")], { stdio: "ignore" });
  const file = join(at, `${name}.b5r`);
  writeFileSync(file, readFileSync(join(at, "out", "00.b5r")));
  return file;
};

const kBefore = { seed: 301, started: "2025-03-03T08:00:00", backlash: "8.1" };
const kAfter = { seed: 302, started: "2025-03-03T15:00:00", backlash: "1.2" };

const verdict = (page, pattern) =>
  page.waitForFunction(
    (pattern) => new RegExp(pattern).test(([...document.querySelectorAll(".verdict")].find((one) => one.offsetParent)?.innerText ?? "").replace(/\s+/g, " ")),
    pattern,
    { timeout: kLong },
  );
const table = (page) => page.$$eval(".first table tbody tr", (rows) => rows.map((row) => [...row.cells].map((cell) => cell.textContent)));
const choices = (page) =>
  page.$$eval(".live-bar .choice", (all) => Object.fromEntries(all.filter((one) => one.querySelector("select")).map((one) => [one.querySelector("span").textContent, one.querySelector("select").selectedOptions[0].textContent])));
const choose = (page, name, label) => page.locator(".live-bar .choice", { hasText: name }).locator("select").selectOption({ label });

test("a second test that is dropped: what changed clearly, and that nothing else did", async () => {
  const [first, second] = [made("before", kBefore), made("after", kAfter)];
  const { page, wrong, close } = await live();
  await dropped(page, first);
  await verdict(page, "Correcting");
  await dropped(page, second);
  await verdict(page, "^Backlash of X fell from 8\\.1 to 1\\.\\d µm, circularity fell from 9\\.\\d to 5\\.\\d µm\\. No other significant change\\.$");
  const clear = (await table(page)).filter((row) => row.at(-1) === "yes").map(([name]) => name);
  assert.deepEqual(clear.sort(), ["backlash of X +", "backlash of X −", "circularity"]);
  // The numbers are the program's.
  const said = json_of("errors", first, second, "--show", "change");
  const play = said.quantities.find(({ name }) => name === "backlash_a_neg");
  const row = (await table(page)).find(([name]) => name === "backlash of X −");
  assert.equal(row[3], `${play.difference.toFixed(2)} ± ${play.sigma.toFixed(2)}`);
  assert.deepEqual(await page.$$eval('figure[data-picture="change"] label', (all) => all.map((one) => one.textContent.trim()).filter((text) => /CW/.test(text))), [
    "before CCW",
    "before CW",
    "after CCW",
    "after CW",
  ]);
  assert.deepEqual(wrong, []);
  await close();
});

test("the older of two tests is the one before, in whatever order they come", async () => {
  const { page, wrong, close } = await live();
  await dropped(page, made("after", kAfter), made("before", kBefore));
  await verdict(page, "^Backlash of X fell from 8\\.1 to");
  await choose(page, "Compare with", "nothing");
  await verdict(page, "Correcting");
  assert.deepEqual(wrong, []);
  await close();
});

test("a test made again is asked for by a file chooser, and other conditions are said first", async () => {
  const { page, wrong, close } = await live();
  await dropped(page, made("after", kAfter));
  await verdict(page, "Correcting");
  const again = async (file) => {
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.getByRole("button", { name: "Test again, and compare" }).click()]);
    await chooser.setFiles(file);
  };
  await again(made("fast", { ...kAfter, seed: 303, started: "2025-03-04T08:00:00", feed: 3000 }));
  await verdict(page, "^The feeds differ \\(1000 and 3000 mm/min\\), so a difference may not be the machine's: No significant change");
  await page.getByRole("button", { name: "Remaining errors" }).click();
  await verdict(page, "Correcting");
  assert.deepEqual(wrong, []);
  await close();
});

test("tests of two planes are no before and after", async () => {
  const { page, wrong, close } = await live();
  await dropped(page, made("after", kAfter));
  await verdict(page, "Correcting");
  await dropped(page, made("yz", { ...kAfter, seed: 305, plane: "YZ" }));
  await page.waitForFunction(() => /XY, YZ are not before and after/.test(document.querySelector(".live-told").textContent), null, { timeout: kLong });
  assert.equal(await page.locator("#change").count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test("stored results without readings: both values, and that what is clear is not known", async () => {
  const stored = (name, play) => {
    const features = { CIRCULARITY: 5 + play, BACKLASH_A_POS: play, BACKLASH_A_NEG: play };
    const lines = Object.entries(features).map(([key, value]) => `<FEATURE NAME="AF_${key}" DT="UT_LENGTH_UM">${value}</FEATURE>`);
    const text = readFileSync(made(name, { ...kBefore, started: `2025-0${play}-03T08:00:00` }), "utf8")
      .replace(/<READINGS>.*\n/g, "")
      .replace('<ANALYSIS NAME="ISO230_4"', (start) => `<ANALYSIS NAME="RENISHAW_DIAGNOSTICS" version="2.1">${lines.join("")}</ANALYSIS>\n  ${start}`);
    const file = join(folder, "compare", `${name}-stored.b5r`);
    writeFileSync(file, text);
    return file;
  };
  const { page, wrong, close } = await live();
  await dropped(page, stored("s1", 2), stored("s2", 4));
  await verdict(page, "^Circularity 7\\.0 µm before, 9\\.0 µm after; stored results have no uncertainty");
  assert.ok((await table(page)).every((row) => row.at(-1) === "–"));
  assert.deepEqual(wrong, []);
  await close();
});

test("the trend of a folder of a machine's tests, from which a test is opened and compared", async () => {
  const { page, wrong, close } = await live();
  await page.setInputFiles("input[webkitdirectory]", of_run("machine-history"));
  await verdict(page, "^Worst of 10 tests: XY, 2026-01-19 08:05, circular deviation G 6\\.65 / 6\\.38 µm");
  await page.getByRole("button", { name: "Trend over time", exact: true }).first().click();
  await verdict(page, "^Backlash of X \\+ 3\\.88 ± 0\\.15 µm, .* per year");
  await page.evaluate(() => (document.querySelector("#tests > details").open = true));
  await page.getByRole("button", { name: "2026-01-19/XY.b5r" }).click();
  await verdict(page, "Correcting");
  await choose(page, "Compare with", "2025-01-20, 2025-01-20/XY.b5r");
  await verdict(page, "^Backlash of X grew from 0\\.\\d to 3\\.\\d µm, circularity grew from 4\\.7 to 6\\.7 µm\\. No other significant change\\.$");
  await page.getByRole("button", { name: "Trend over time", exact: true }).first().click();
  await verdict(page, "^Backlash of X \\+ 3\\.88");
  assert.deepEqual(wrong, []);
  await close();
});

test("tests of one day and plane are no history", async () => {
  const { page, close } = await live();
  await page.setInputFiles("input[webkitdirectory]", of_run("qc20-style-b5r"));
  await verdict(page, "^Worst of 6 tests");
  assert.equal((await choices(page))["Test"], "all tests");
  assert.equal(await page.getByRole("button", { name: "Trend over time" }).count(), 0);
  await close();
});
