// Hands on the model: any effect added by search or taken out, values typed, held and freed, rows left out, two
// hypotheses side by side, and undo for all of it in its order.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { at_rest, kLong, live, rmse, saved } from "./live_page.mjs";
import { json_of, of_run } from "./reports.mjs";

const effects_of = (page) => page.$$eval(".live-model .effect bdi", (all) => all.map((one) => one.title));
const hidden = async (options = {}) => {
  const made = await live(options);
  await made.page.getByRole("button", { name: "hidden-effect", exact: true }).click();
  await made.page.waitForSelector(".live-candidates .plus", { timeout: kLong });
  await at_rest(made.page);
  return made;
};
const find = async (page, word) => {
  if (!(await page.locator(".live-effects").evaluate((one) => one.open))) await page.click(".live-effects > summary");
  await page.fill(".live-effects input", word);
  return page.$$eval(".live-effects li", (all) => all.map((one) => one.dataset.effect));
};
const data = () => of_run("hidden-effect", "01", "data.csv");
const model = () => of_run("hidden-effect", "01", "model.toml");
const parameter = (page, label) => page.locator(`.parameter:has(.name:text-is("${label}"))`);

test("any effect is found by a word of any language, with the columns that suit, added, and taken out", async () => {
  const { page, wrong, close } = await hidden();
  assert.ok((await find(page, "ther")).includes("thermostat_cycle"));
  const expansions = await find(page, "expansion");
  assert.deepEqual(expansions.slice(0, 2).sort(), ["expansion", "lagged_expansion"]);
  assert.ok((await find(page, "Reibung")).includes("speed_heating"), "a German word on an English page");
  assert.ok((await find(page, "膨胀")).includes("expansion"));
  assert.deepEqual(await find(page, "coffee"), []);
  await find(page, "gradient");
  const row = page.locator('.live-effects li[data-effect="gradient_bending"]');
  assert.equal(await row.locator("select").count(), 2);
  const [hot, cold] = await row.locator("select").all();
  const first = await hot.inputValue();
  assert.ok(!(await cold.locator("option").evaluateAll((all) => all.map(({ value }) => value))).includes(first));
  await find(page, "expansion");
  const lagged = page.locator('.live-effects li[data-effect="lagged_expansion"]');
  const offered = await lagged.locator("option").allTextContents();
  assert.ok(!offered.includes("T_motor_degC"), "it is in the model");
  await lagged.locator("select").selectOption("T_room_degC");
  await lagged.locator(".plus").click();
  await page.waitForSelector('.live-loop[data-revisions="2"]', { timeout: kLong });
  assert.deepEqual(await effects_of(page), ["constant", "lagged_expansion(T_motor_degC)", "lagged_expansion(T_room_degC)"]);
  const both = await rmse(page);
  await at_rest(page);
  await page.getByRole("button", { name: "Take delayed expansion (T_motor_degC) out of the model" }).click();
  await page.waitForSelector('.live-loop[data-revisions="3"]', { timeout: kLong });
  assert.deepEqual(await effects_of(page), ["constant", "lagged_expansion(T_room_degC)"]);
  assert.ok((await rmse(page)) > both);
  await at_rest(page);
  const kept = await saved(page, "Model (.toml)");
  assert.equal(json_of("check", data(), "--model", kept).rmse_um.toFixed(2), (await rmse(page)).toFixed(2));
  await page.keyboard.press("Control+z");
  await page.waitForSelector('.live-loop[data-revisions="2"]', { timeout: kLong });
  assert.equal(await rmse(page), both);
  assert.equal((await effects_of(page)).length, 3);
  assert.deepEqual(wrong, []);
  await close();
});

test("a value is typed, held and freed, as the program fits it; the file holds it", async () => {
  const { page, wrong, close } = await hidden();
  const best = await rmse(page);
  const time = parameter(page, "time constant");
  const field = time.locator('.by-value input[type="number"]');
  await field.fill("3600");
  await field.press("Enter");
  await at_rest(page);
  assert.ok((await rmse(page)) > best, "typed alone, nothing else is fitted");
  await time.getByRole("button", { name: /^Hold/ }).click();
  await page.waitForSelector('.live-loop[data-revisions="2"]', { timeout: kLong });
  await at_rest(page);
  const held = await rmse(page);
  const label = "lagged_expansion(T_motor_degC).time_constant_s";
  const expected = json_of("check", data(), "--model", model(), "--set", `${label}=3600`).rmse_um;
  assert.equal(held.toFixed(2), expected.toFixed(2));
  assert.equal(Number(await field.inputValue()), 3600);
  assert.ok(await time.locator(".held").isVisible());
  const text = readFileSync(await saved(page, "Model (.toml)"), "utf8");
  assert.match(text, /\ntime_constant_s = 3600\.0\n/);
  assert.match(text, /\ngain_um_per_K = \{ start = \d/, "the fitted gain too");
  await time.getByRole("button", { name: /^Free/ }).click();
  await page.waitForSelector('.live-loop[data-revisions="3"]', { timeout: kLong });
  await at_rest(page);
  assert.equal((await rmse(page)).toFixed(2), best.toFixed(2));
  assert.ok(!(await time.locator(".held").isVisible()));
  // Outside the bounds of the catalogue nothing is taken.
  await field.fill("-5");
  await field.press("Enter");
  assert.equal((await rmse(page)).toFixed(2), best.toFixed(2));
  assert.deepEqual(wrong, []);
  await close();
});

test("undo takes back each step in its order: sliders, an added effect, a held value, rows left out", async () => {
  const { page, wrong, close } = await hidden();
  const seen = [];
  const steps = () => page.locator(".live-loop").getAttribute("data-steps").then(Number);
  const note = async () => {
    await at_rest(page);
    seen.push([await rmse(page), (await effects_of(page)).length]);
  };
  await note();
  await page.locator(".live-candidates .plus").first().click();
  await page.waitForSelector('.live-loop[data-revisions="2"]', { timeout: kLong });
  await note();
  // Two drags by the mouse.
  for (const label of ["gain", "time constant"]) {
    const slider = parameter(page, label).first().locator('input[type="range"]');
    const box = await slider.boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    for (let k = 1; k <= 5; ++k) await page.mouse.move(box.x + box.width / 2 + 6 * k, box.y + box.height / 2);
    await page.mouse.up();
    await note();
  }
  assert.equal(await steps(), 3, "one step a drag");
  await parameter(page, "gain").first().getByRole("button", { name: /^Hold/ }).click();
  await page.waitForSelector('.live-loop[data-revisions="3"]', { timeout: kLong });
  await note();
  await page.evaluate(() => window.ballbar.figures.get("live-fit").select([200, 300]));
  await page.getByRole("button", { name: "Leave out 200 to 300 min, fit again" }).click();
  await page.waitForSelector(".live-left-out .chip", { timeout: kLong });
  await note();
  assert.equal(await steps(), 5);
  for (let k = seen.length - 2; k >= 0; --k) {
    await page.keyboard.press("Control+z");
    await at_rest(page);
    assert.deepEqual([await rmse(page), (await effects_of(page)).length], seen[k], `back to step ${k}`);
  }
  for (let k = 1; k < seen.length; ++k) {
    await page.keyboard.press("Control+y");
    await at_rest(page);
    assert.deepEqual([await rmse(page), (await effects_of(page)).length], seen[k], `forth to step ${k}`);
  }
  assert.ok(await page.isDisabled(`button:text-is("Redo")`));
  assert.deepEqual(wrong, []);
  await close();
});

test("rows that are dragged over are left out of fit and search, shaded, and come back by their button", async () => {
  const { page, wrong, close } = await hidden();
  const all = await rmse(page);
  await page.click('button:text-is("Leave rows out")');
  const chart = page.locator('figure[data-picture="live-fit"] .chart');
  const box = await chart.boundingBox();
  await page.mouse.move(box.x + 0.4 * box.width, box.y + 100);
  await page.mouse.down();
  for (let k = 1; k <= 8; ++k) await page.mouse.move(box.x + (0.4 + 0.02 * k) * box.width, box.y + 100);
  await page.mouse.up();
  await page.locator(".live-left-out .act").click();
  await page.waitForSelector(".live-left-out .chip", { timeout: kLong });
  await at_rest(page);
  const [from, to] = /(\d+) to (\d+) min/.exec(await page.textContent(".live-left-out .chip")).slice(1).map(Number);
  assert.ok(to - from > 60, `${from} to ${to}`);
  const part = await rmse(page);
  assert.notEqual(part, all);
  const rows = await page.evaluate(() => window.ballbar.figures.get("live-fit").picture.numbers(window.ballbar.figures.get("live-fit").state()).columns[0].values);
  assert.ok(rows.length < 1441 && !rows.some((min) => min > from + 1 && min < to - 1));
  // As the program has it.
  const option = json_of("check", data(), "--model", model(), `--leave-out-times=${from}min..${to}min`);
  assert.ok(Math.abs(option.n - rows.length) <= 2);
  assert.ok(Math.abs(option.rmse_um - part) < 0.01 * part);
  await page.click(".live-left-out .chip");
  await page.waitForSelector(".live-left-out .chip", { state: "detached", timeout: kLong });
  await at_rest(page);
  assert.equal(await rmse(page), all);
  assert.deepEqual(wrong, []);
  await close();
});

test("two hypotheses stand side by side with curves and figures; one is kept", async () => {
  const { page, wrong, close } = await hidden();
  await page.click(".live-two > summary");
  await page.locator(".live-two select").first().selectOption("");
  await find(page, "linear");
  await page.locator('.live-effects li[data-effect="linear_drift"] button', { hasText: "Set beside" }).click();
  assert.equal(await page.locator(".live-two select").nth(1).inputValue(), "linear_drift");
  const [first] = await page.$$eval(".live-two select:first-of-type option", (all) => all.map(({ value }) => value).filter((value) => value !== "" && value !== "linear_drift"));
  await page.locator(".live-two select").first().selectOption(first);
  await page.click('.live-two button:text-is("Fit both")');
  await page.waitForSelector('figure[data-picture="hypothesis-2"]', { timeout: kLong });
  await at_rest(page);
  const cells = await page.$$eval(".live-two tbody tr", (rows) => rows.map((row) => [...row.children].map((cell) => cell.textContent)));
  const of = (name) => cells.find(([what]) => what.startsWith(name)).slice(1).map(Number);
  assert.ok(of("RMSE")[0] < of("RMSE")[1], String(of("RMSE")));
  assert.ok(of("P of the two")[0] > 0.9);
  const drawn = await page.$$eval(".live-two figure canvas, .live-two figure svg", (all) => all.length);
  assert.ok(drawn >= 2);
  assert.deepEqual((await effects_of(page)).length, 2, "the model is as it was");
  await page.locator(".live-two .side").first().getByRole("button", { name: /^Keep/ }).click();
  await page.waitForSelector('.live-loop[data-revisions="2"]', { timeout: kLong });
  assert.deepEqual(await effects_of(page), ["constant", "lagged_expansion(T_motor_degC)", first]);
  assert.equal((await rmse(page)).toFixed(3), of("RMSE")[0].toFixed(3));
  assert.deepEqual(wrong, []);
  await close();
});

test("in German and on a phone the same stands there", async () => {
  const { page, wrong, close } = await hidden({ viewport: { width: 390, height: 844 } });
  await page.evaluate(() => {
    const select = [...document.querySelectorAll("select")].find((one) => [...one.options].some(({ value }) => value === "de"));
    select.value = "de";
    select.dispatchEvent(new Event("change", { bubbles: true }));
  });
  await page.waitForSelector("html[lang=de]");
  await at_rest(page);
  assert.ok((await find(page, "Reibung")).includes("speed_heating"));
  assert.match(await page.textContent('.live-effects li[data-effect="speed_heating"]'), /Reibungswärme der Drehzahl/);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert.ok(wide <= 390, `${wide} px wide`);
  assert.deepEqual(wrong, []);
  await close();
});
