// The dialogue of a log's columns: opened by itself where the log leaves something open, by a button else; what is set
// in it goes with every later command; a sentence of the program comes without its advice for a terminal.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launched, opened } from "./browser.mjs";
import { folder, json_of } from "./reports.mjs";
import { tool } from "./tool.mjs";

const kLong = 120_000; // ms, on a busy machine
const kRest = 400; // in which work may follow on work

const rows = (count, row) => Array.from({ length: count }, (_, k) => row(k)).join("\n") + "\n";
const wave = (k, period) => (20 + Math.sin((2 * Math.PI * k) / period)).toFixed(3);
const logs = {
  // Neither a time nor a unit; the lengths are in mm.
  "no_time.csv": "T0,T1,T2,T3,delta L\n" + rows(60, (k) => `${wave(k, 60)},${wave(k, 50)},${wave(k, 40)},${wave(k, 30)},${(0.0005 * k).toFixed(4)}`),
  "clear.csv": "Time (s),Room (°C),Probe X (µm)\n" + rows(60, (k) => `${10 * k},${wave(k, 60)},${(0.5 * k).toFixed(2)}`),
  "dates.csv": "Time,Room (°C),Probe X (µm)\n" + rows(60, (k) => `03/04/2026 10:${String(k).padStart(2, "0")},${wave(k, 60)},${(0.5 * k).toFixed(2)}`),
};
logs["hostile.csv"] = `--out=x,a=b=c,__proto__,<img src=x onerror=window.ran=1>\n${rows(60, (k) => `${k % 7},${k % 5},${k % 3},${k}`)}`;
const on_disk = (name) => {
  const path = join(folder, name);
  writeFileSync(path, logs[name]);
  return path;
};

let browser;
before(async () => {
  browser = await launched();
});
after(() => browser.close());

const at_rest = async (page) => {
  for (let k = 0; k < 3; ++k) {
    await page.waitForFunction(() => document.querySelector(".live-work").dataset.waiting === "0" && !document.querySelector(".live-loop[aria-busy]"), null, { timeout: kLong });
    await page.waitForTimeout(kRest);
  }
};
// All that is asked of the engine is kept in the page, as words.
const listen = (page) =>
  page.evaluate(() => {
    const { engine } = window.ballbar;
    const { run, call } = engine;
    window.asked = [];
    engine.run = (words, ...more) => (window.asked.push(words), run.call(engine, words, ...more));
    engine.call = (what, ...more) => (window.asked.push([what.call, ...what.words]), call.call(engine, what, ...more));
  });
const with_log = async (name, options = {}) => {
  const one = await opened(browser, tool, { viewport: { width: 1400, height: 900 }, ...options });
  await listen(one.page);
  await one.page.evaluate(
    ([name, text]) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([text], name));
      document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
    },
    [name, logs[name]],
  );
  await at_rest(one.page);
  return { ...one, box: one.page.locator(".live-columns") };
};
const asked = (page) => page.evaluate(() => window.asked.splice(0));
const option_in_focus = (page) => page.evaluate(() => document.activeElement.dataset.option);
const read_again = async (page) => {
  await page.locator(".live-columns button[type=submit]").click();
  await at_rest(page);
};
const without_advice = async (page) => assert.doesNotMatch(await page.innerText(".live-columns"), /--[a-z]|\bballbar \w/);
// Values as they are shown, by the header of their row.
const values = (page, header) =>
  page.evaluate((header) => {
    const row = [...document.querySelectorAll(".live-columns tbody tr")].find((one) => one.children[0].textContent === header);
    return [...row.children].slice(7).map((cell) => Number(cell.textContent));
  }, header);

test("a log without a time: the dialogue opens, what is set is read, and stands in every later command", async () => {
  const { page, box, wrong, close } = await with_log("no_time.csv");
  assert.ok(await box.isVisible());
  assert.match(await box.locator(".unclear, .fault").first().innerText(), /\w+ \w+/);
  await without_advice(page);
  await asked(page);
  await box.locator("select[data-option=time]").selectOption("every");
  await page.keyboard.type("10 s");
  await box.getByLabel("role: T0").selectOption("ambient");
  await box.getByLabel("unit: T0", { exact: true }).fill("°C");
  await box.getByLabel("target: T1").check();
  assert.equal(await box.getByLabel("role: T1").inputValue(), "measured");
  await box.getByLabel("target: T1").uncheck();
  await box.getByLabel("role: T1").selectOption("bearing");
  await box.getByLabel("left out: T3").check();
  await box.getByLabel("unit: delta L", { exact: true }).fill("um");
  await box.getByLabel("one unit is: delta L").fill("1 mm"); // in the place of a unit
  await read_again(page);
  const options = ["--every=10s", "--role=T0=ambient", "--unit=T0=°C", "--role=T1=bearing", "--leave-out=T3", "--scale=delta L=1mm"];
  const first = await asked(page);
  for (const words of first.filter(([verb]) => verb === "import" || verb === "report")) {
    assert.deepEqual(options.filter((one) => !words.includes(one)), [], words.join(" "));
    assert.ok(!words.includes("--unit=delta L=um"));
  }
  assert.ok(first.some(([verb]) => verb === "report"));
  assert.equal(await page.innerText(".live-told"), "");
  const told = json_of("import", on_disk("no_time.csv"), ...options);
  const of_length = told.columns.find(({ source }) => source === "delta L");
  assert.equal(of_length.name, "delta_L_um");
  assert.deepEqual(of_length.first, [0, 0.5, 1, 1.5, 2]);
  assert.deepEqual(await values(page, "delta L"), of_length.first);
  assert.match(await page.innerText(".live-report"), /delta L/);
  // A search is of the log as it was read.
  await page.getByRole("button", { name: "Find what is missing" }).click();
  await at_rest(page);
  const search = (await asked(page)).find(([verb]) => verb === "search");
  assert.deepEqual(options.filter((one) => !search.includes(one)), []);
  // And so it is after a reload.
  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  await page.locator(".kept button").first().click();
  await at_rest(page);
  if (!(await box.isVisible())) await page.getByRole("button", { name: "Columns" }).first().click();
  assert.equal(await box.locator("input[data-option=every]").inputValue(), "10s");
  assert.ok(await box.getByLabel("left out: T3").isChecked());
  await page.getByRole("button", { name: "As found" }).click();
  await at_rest(page);
  assert.equal(await box.locator("select[data-option=time]").inputValue(), "");
  assert.deepEqual(wrong, []);
  await close();
});

test("a log that is clear: the dialogue stays shut until its button is pressed; Escape shuts it", async () => {
  const { page, box, wrong, close } = await with_log("clear.csv");
  assert.ok(!(await box.isVisible()), await box.innerText());
  const button = page.getByRole("button", { name: "Columns" }).first();
  await button.focus();
  await page.keyboard.press("Enter");
  assert.ok(await box.isVisible());
  assert.deepEqual(await values(page, "Probe X (µm)"), [0, 0.5, 1, 1.5, 2]);
  assert.ok(await box.getByLabel("target: Probe X (µm)").isChecked());
  assert.equal(await box.getByLabel("role: Room (°C)").inputValue(), "ambient");
  await without_advice(page);
  await page.keyboard.press("Escape");
  assert.ok(!(await box.isVisible()));
  assert.equal(await button.getAttribute("aria-expanded"), "false");
  assert.ok(await button.evaluate((one) => one === document.activeElement));
  assert.deepEqual(wrong, []);
  await close();
});

test("a log that cannot be read: why, without advice, and the focus in the field that mends it", async () => {
  const { page, box, wrong, close } = await with_log("dates.csv");
  assert.match(await box.locator(".fault").innerText(), /^dates\.csv:2: expected an unambiguous date, found "03\/04\/2026 10:00"\. The third number is the year\.$/);
  await without_advice(page);
  assert.equal(await option_in_focus(page), "dates");
  await box.locator("select[data-option=dates]").selectOption("day-first");
  await read_again(page);
  assert.equal(await box.locator(".fault").count(), 0);
  assert.equal(await page.locator(".live-files .faulty").count(), 0);
  assert.match(await page.innerText(".live-report"), /Probe X/);
  await box.locator("select[data-option=time]").selectOption("every");
  await page.keyboard.type("soon");
  await read_again(page);
  assert.match(await box.locator(".fault").innerText(), /\w+ \w+/);
  await without_advice(page);
  assert.equal(await option_in_focus(page), "every");
  assert.deepEqual(wrong, []);
  await close();
});

test("headers that look like markup, options or pairs are headers", async () => {
  const { page, box, wrong, close } = await with_log("hostile.csv");
  if (!(await box.isVisible())) await page.getByRole("button", { name: "Columns" }).first().click();
  for (const header of ["--out=x", "a=b=c", "__proto__"]) await box.getByLabel(`role: ${header}`).selectOption("load");
  await box.locator("select[data-option=time]").selectOption("none");
  await read_again(page);
  assert.equal(await box.locator(".fault").count(), 0);
  for (const header of ["--out=x", "a=b=c", "__proto__"]) assert.equal(await box.getByLabel(`role: ${header}`).inputValue(), "load");
  assert.equal(await page.evaluate(() => window.ran ?? document.querySelector("img[src=x]")), null);
  assert.deepEqual(wrong, []);
  await close();
});

const axe = readFileSync(new URL("node_modules/axe-core/axe.min.js", import.meta.url), "utf8");

for (const colorScheme of ["light", "dark"]) {
  test(`the dialogue on a phone, ${colorScheme}: no serious fault for who reads otherwise, nothing runs out of the page`, async () => {
    const { page, box, wrong, close } = await with_log("no_time.csv", { colorScheme, viewport: { width: 390, height: 844 } });
    assert.ok(await box.isVisible());
    assert.equal(await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth), 0);
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => window.axe.run(".live-columns", { resultTypes: ["violations"] }));
    assert.deepEqual(violations.filter(({ impact }) => ["serious", "critical"].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes[0].html}`), []);
    assert.deepEqual(wrong, []);
    await close();
  });
}
