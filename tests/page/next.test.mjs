// A button says what will happen and does it: Add adds, Try tries, with the RMSE that stands there; what is told can be
// repaired where it is told, and the search goes on; a verdict stays when the language changes.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { at_rest, drop, kLong, live, rmse } from "./live_page.mjs";
import { of_run } from "./reports.mjs";

const noise = (seed) => {
  let state = seed;
  return () => {
    let sum = 0;
    for (let k = 0; k < 12; ++k) sum += (state = (state * 48271) % 2147483647) / 2147483647;
    return sum - 6;
  };
};
const table = (names, rows) => `${names.join(",")}\n${rows.map((row) => row.map((value) => (value === null ? "" : Number(value.toFixed(4)))).join(",")).join("\n")}\n`;
// A spindle that runs and stands still: its bearing heats within the hour.
const bearing_degC = (() => {
  let warm = 0;
  return Array.from({ length: 1200 }, (_, k) => 20 + (warm += ((Math.floor(k / 130) % 2 === 0 ? 30 : k % 7 === 0 ? 2 : 0) - warm) / 45));
})();
const bearing = (k) => bearing_degC[k];
const log = (drift, gone = () => false) => {
  const random = noise(11);
  const row = (k) => [60 * k, gone(k) ? null : bearing(k), 30 + 4 * Math.sin(k / 55 + 2), 0.5 * (bearing(k) - 20) + drift(k) + 0.3 * random()];
  return table(["time_s", "front_bearing_degC", "motor_degC", "z_um"], Array.from({ length: 1200 }, (_, k) => row(k)));
};
// A coolant that no column has: -6 um, 20 min, switched now and then.
const hidden_coolant = () => {
  let [on, lag] = [0, 0];
  return log((k) => {
    if (k % 197 === 140 || k % 311 === 150) on = 1 - on;
    lag += (on - lag) / 20;
    return -6 * lag;
  });
};
const bearing_alone = () => log(() => 0);

const next = (page) => page.locator(".live-loop .verdict > button.act:visible");
const said = (page) => page.innerText(".live-loop .said");
const searched = async (page) => {
  await page.getByRole("button", { name: "Find what is missing" }).click();
  await page.waitForSelector('.live-loop[data-search="done"]', { timeout: kLong });
  await at_rest(page);
};

test("Add adds, and the RMSE is what was promised; undo takes it back", async () => {
  const { page, wrong, close } = await live();
  await drop(page, { "alone.csv": bearing_alone() });
  await at_rest(page);
  await searched(page);
  assert.equal(await next(page).getAttribute("data-action"), "add");
  assert.match(await next(page).innerText(), /^Add .*front_bearing.*: RMSE 0\.\d+ µm$/);
  const promised = Number(await next(page).getAttribute("data-rmse"));
  await next(page).click();
  await page.waitForSelector('.live-loop[data-revisions="2"], .live-loop[data-revisions="1"]', { timeout: kLong });
  await at_rest(page);
  assert.equal(await rmse(page), promised);
  assert.ok((await page.$$eval(".live-model .effect bdi", (all) => all.map(({ title }) => title))).some((one) => one.startsWith("expansion(front_bearing_degC")));
  assert.ok(!(await page.isDisabled('button:text-is("Undo")')));
  // The table of candidates has what the list promised before; here nothing is left to add.
  assert.equal(await next(page).count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test("what is only to be tried says Try, and adds nothing until it is added", async () => {
  const { page, wrong, close } = await live();
  await drop(page, { "coolant.csv": hidden_coolant() });
  await at_rest(page);
  await searched(page);
  const before = await rmse(page);
  assert.equal(await next(page).getAttribute("data-action"), "try");
  assert.match(await next(page).innerText(), /^Try .*: RMSE [\d.]+ µm$/);
  const promised = Number(await next(page).getAttribute("data-rmse"));
  assert.ok(promised < before);
  const stars = await page.$$eval(".live-candidates bdi", (all) => all.filter((one) => one.textContent.endsWith("*")).length);
  assert.equal(stars, 1, "one proposal");
  // In the table below too: the number, and one star.
  const cells = await page.evaluate(() => {
    document.querySelector('section[id^="diagnosis"] > details').open = true;
    const rows = [...document.querySelectorAll('section[id^="diagnosis"] table')].find((one) => /2 ln B/.test(one.textContent)).querySelectorAll("tbody tr");
    return [...rows].map((row) => [...row.cells].map((cell) => cell.textContent));
  });
  assert.match(cells[0][0], /^1\*$/);
  assert.ok(cells.slice(1).every(([number]) => !number.includes("*")));
  assert.ok(Math.abs(Number(cells[0][5]) - promised) < 0.01, String(cells[0]));
  await next(page).click();
  await page.waitForSelector(".live-loop .refusal:visible button", { timeout: kLong });
  await at_rest(page);
  assert.equal(await rmse(page), before);
  assert.equal(await page.locator('.live-loop[data-revisions="0"]').count(), 1);
  await page.getByRole("button", { name: "Add it to the model" }).click();
  await page.waitForSelector('.live-loop[data-revisions]:not([data-revisions="0"])', { timeout: kLong });
  await at_rest(page);
  assert.equal(await rmse(page), promised);
  assert.deepEqual(wrong, []);
  await close();
});

test("the verdict stays when the language changes, and comes back with it", async () => {
  const { page, wrong, close } = await live();
  await drop(page, { "alone.csv": bearing_alone() });
  await at_rest(page);
  await searched(page);
  const english = await said(page);
  assert.match(english, /sure/);
  const speak = async (language) => {
    await page.evaluate((language) => {
      const select = [...document.querySelectorAll("select")].find((one) => [...one.options].some(({ value }) => value === "de"));
      select.value = language;
      select.dispatchEvent(new Event("change", { bubbles: true }));
    }, language);
    await page.waitForSelector(`html[lang^=${language}]`);
    await at_rest(page);
  };
  await speak("de");
  assert.match(await said(page), /% sicher/);
  assert.match(await next(page).innerText(), /hinzufügen: RMSE 0,\d+ µm$/);
  await speak("en");
  assert.equal(await said(page), english);
  assert.deepEqual(wrong, []);
  await close();
});

test("of two targets the one that is chosen is searched, drawn and chosen still in another language", async () => {
  const random = noise(5);
  const motor = (k) => 30 + 4 * Math.sin(k / 55 + 2);
  const row = (k) => [60 * k, bearing(k), motor(k), 0.5 * (bearing(k) - 20) + 0.3 * random(), 0.4 * (motor(k) - 30) + 0.1 * random()];
  const { page, wrong, close } = await live();
  await drop(page, { "two.csv": table(["time_s", "front_bearing_degC", "motor_degC", "z_um", "x_um"], Array.from({ length: 1200 }, (_, k) => row(k))) });
  await at_rest(page);
  await searched(page);
  const target = page.getByRole("combobox", { name: "Explains" });
  const sections = () => page.$$eval('section[id^="model-"]', (all) => all.map(({ id }) => id));
  assert.equal(await target.inputValue(), "z_um");
  assert.deepEqual(await sections(), ["model-z_um"]);
  const of_z = await rmse(page);
  await target.selectOption("x_um");
  await page.locator(".page-tools select").selectOption("de");
  await page.waitForSelector('.live-loop[lang="de"]');
  assert.equal(await page.getByRole("combobox", { name: "Erklärt" }).inputValue(), "x_um");
  await page.locator(".page-tools select").selectOption("en");
  await page.waitForSelector('.live-loop[lang="en"]');
  await searched(page);
  assert.deepEqual(await sections(), ["model-x_um"]);
  assert.notEqual(await rmse(page), of_z);
  assert.equal(await page.getAttribute(".live-candidates li bdi", "title"), "expansion(motor_degC)");
  // Of searches one upon the other the last counts.
  await page.evaluate(() => {
    for (const target of ["x_um", "z_um", "z_um"]) window.ballbar.doing({ action: "find", target })();
  });
  await page.waitForSelector("section#model-z_um", { state: "attached", timeout: kLong });
  await at_rest(page);
  assert.deepEqual(await sections(), ["model-z_um"]);
  assert.equal(await rmse(page), of_z);
  assert.equal(await page.getAttribute(".live-loop", "data-search"), "done");
  assert.doesNotMatch(await said(page), /Stopped/);
  assert.deepEqual(wrong, []);
  await close();
});

test("gaps of a signal: the longest is offered at once, one click fits across all, and the search goes on", async () => {
  const text = log(() => 0, (k) => (k > 60 && k < 200) || (k > 300 && k < 500) || (k > 560 && k < 690));
  const { page, wrong, close } = await live();
  await drop(page, { "gaps.csv": text });
  await at_rest(page);
  await page.getByRole("button", { name: "Find what is missing" }).click();
  const across = page.getByRole("button", { name: /^Fit across gaps up to 3 h 20 min$/ });
  await across.waitFor({ timeout: kLong });
  assert.match(await said(page), /front_bearing_degC has gaps too long to be interpolated\. The longest, of 3 h 20 min, begins after 5 h/);
  const speak = (language) => page.locator(".page-tools select").selectOption(language);
  await speak("de");
  await page.waitForSelector('.live-loop[lang="de"]');
  assert.match(await said(page), /^front_bearing_degC hat Lücken/);
  await speak("en");
  await page.waitForSelector('.live-loop[lang="en"]');
  assert.match(await said(page), /^front_bearing_degC has gaps/);
  await across.click();
  await page.waitForSelector('.live-loop[data-search="done"]', { timeout: kLong });
  await at_rest(page);
  assert.match(await said(page), /sure/);
  assert.equal(await page.getByRole("button", { name: /^Fit across gaps/ }).count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test("wild readings are set aside without being asked, and said; the fit is as without them", async () => {
  const { page, wrong, close } = await live();
  const text = bearing_alone();
  await drop(page, { "wild.csv": text.split("\n").map((line, k) => ([400, 900].includes(k) ? line.replace(/[^,]*$/, k === 400 ? "900" : "-750") : line)).join("\n") });
  await at_rest(page);
  await searched(page);
  assert.match(await said(page), /^2 readings far from the others are set aside\. .*front_bearing_degC.* sure/);
  await next(page).click();
  await page.waitForSelector('.live-loop[data-revisions="2"]', { timeout: kLong });
  await at_rest(page);
  assert.ok((await rmse(page)) < 0.4, String(await rmse(page)));
  assert.deepEqual(wrong, []);
  await close();
});

test("a header that was found wrongly is told by its line; the unit of counts is told; both are read at once", async () => {
  const random = noise(9);
  const rows = Array.from({ length: 300 }, (_, k) => `${10 * k};${bearing(k).toFixed(2)};${(22 + Math.sin(k / 30)).toFixed(2)};${(0.2 * (bearing(k) - 20) + 0.05 * random()).toFixed(3)}`).join("\n");
  const text = `t s;front degC;room degC;probe um\nn1;n2;n3;n4\n${rows}\n`;
  const { page, wrong, close } = await live();
  await drop(page, { "two heads.csv": text });
  await at_rest(page);
  if (await page.locator(".live-columns").isHidden()) await page.getByRole("button", { name: "Columns" }).first().click();
  const headers = () => page.$$eval(".live-columns tbody tr td:first-child", (all) => all.map((one) => one.textContent));
  const read = async (line) => {
    await page.locator('.live-columns [data-option="header-line"]').fill(line);
    await page.locator('.live-columns [data-option="header-line"]').press("Tab");
    await page.locator(".live-columns button[type=submit]").click();
    await at_rest(page);
    return headers();
  };
  assert.deepEqual((await read("2")).slice(-3), ["n2", "n3", "n4"]);
  assert.deepEqual((await read("1")).slice(-3), ["front degC", "room degC", "probe um"]);
  assert.deepEqual(wrong, []);
  await close();
});

test("a circle of deviations without its radius: the field is where it is told, and the circle opens", async () => {
  const rows = Array.from({ length: 360 }, (_, deg) => `${deg},${(3 * Math.cos((deg * Math.PI) / 180) + 2 * Math.cos((2 * deg * Math.PI) / 180)).toFixed(3)}`).join("\n");
  const { page, wrong, close } = await live();
  await drop(page, { "circle.csv": `angle_deg,deviation_um\n${rows}\n` });
  await at_rest(page);
  const field = page.locator('.live-columns [data-option="radius"]');
  await field.waitFor({ timeout: kLong });
  await field.fill("100 mm");
  await field.press("Tab");
  await page.locator(".live-columns button[type=submit]").click();
  await page.waitForSelector('figure[data-picture="machine-errors"], figure[data-picture="recording-circle"]', { timeout: kLong });
  assert.deepEqual(wrong, []);
  await close();
});

test("a record of weeks has days on its axis and in its words, one of a day hours", async () => {
  const random = noise(2);
  const of = (step_s) => table(["time_s", "room_degC", "z_um"], Array.from({ length: 600 }, (_, k) => [step_s * k, 21 + 2 * Math.sin(k / 23), 1.5 * Math.sin(k / 23) + 0.2 * random()]));
  for (const [step_s, name, unit] of [[11763, "weeks.csv", "time, d"], [180, "day.csv", "time, h"]]) {
    const { page, wrong, close } = await live();
    await drop(page, { [name]: of(step_s) });
    await at_rest(page);
    const axis = await page.evaluate(() => {
      const [figure] = [...window.ballbar.figures.values()].filter((one) => one.chart());
      return figure.chart().getOption().xAxis.map((one) => one.name);
    });
    assert.ok(axis.includes(unit), String(axis));
    assert.deepEqual(wrong, []);
    await close();
  }
});

test("a record of 46 h: how far the search is and what it knows so far, then the verdict", async () => {
  const { page, wrong, close } = await live();
  await drop(page, { "measured.csv": readFileSync(of_run("spindle-46h", "measured.csv"), "utf8"), "ch5.toml": readFileSync(of_run("spindle-46h", "ch5.toml"), "utf8") });
  await page.evaluate(() => {
    window.seen = [];
    new MutationObserver(() => {
      const [said, work] = [".live-loop .said", ".live-work .what"].map((one) => document.querySelector(one)?.textContent ?? "");
      window.seen.push(said, work);
    }).observe(document.body, { childList: true, characterData: true, subtree: true });
  });
  await page.waitForSelector(".live-loop", { timeout: kLong });
  await at_rest(page);
  if ((await page.getAttribute(".live-loop", "data-search")) !== "done") await searched(page);
  const seen = await page.evaluate(() => window.seen);
  assert.ok(seen.some((text) => /^So far most likely: .+\. The search goes on\.$/.test(text)));
  assert.ok(seen.some((text) => /^Searching for what is missing.*\d+ %/.test(text)), [...new Set(seen)].join("\n").slice(0, 2000));
  assert.doesNotMatch(await said(page), /So far most likely/);
  assert.deepEqual(wrong, []);
  await close();
});
