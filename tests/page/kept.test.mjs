// Nothing that is in no file is deleted without a question, and a saved model holds what was fitted.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { at_rest, kLong, live, saved } from "./live_page.mjs";
import { json_of, of_run } from "./reports.mjs";

// The sample run with what it lacks added.
const changed = async () => {
  const opened_page = await live();
  const { page } = opened_page;
  await page.getByRole("button", { name: "hidden-effect", exact: true }).click();
  await page.waitForSelector(".live-candidates .plus", { timeout: kLong });
  await page.locator(".live-candidates .plus").first().click();
  await page.waitForSelector('.live-loop[data-revisions="2"]', { timeout: kLong });
  await at_rest(page);
  return opened_page;
};
const close_button = (page) => page.getByRole("button", { name: "Close", exact: true });
const parameters = (page) => page.locator(".live-model .slider output").allInnerTexts();

test("Close asks where something is in no file, by keyboard too; else it closes", async () => {
  const { page, wrong, close } = await changed();
  await close_button(page).click();
  const question = page.locator("dialog.live-question");
  await question.waitFor();
  assert.match(await question.innerText(), /in no file yet/);
  await page.keyboard.press("Escape");
  await question.waitFor({ state: "detached" });
  assert.equal(await question.count(), 0);
  assert.ok(await page.locator(".live-report main").count(), "it is still open");
  await close_button(page).focus();
  await page.keyboard.press("Enter");
  await question.waitFor();
  await page.keyboard.press("Tab"); // "Delete it"
  await page.keyboard.press("Enter");
  await page.waitForSelector(".samples button:visible");
  await page.getByRole("button", { name: "hidden-effect", exact: true }).click();
  await page.waitForSelector(".live-report main", { timeout: kLong });
  await close_button(page).click(); // nothing was changed
  await page.waitForSelector(".samples button:visible");
  assert.equal(await question.count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test("closed while an effect is added: nothing is left of it, and the page goes on", async () => {
  const { page, wrong, close } = await live();
  const open = async () => {
    await page.getByRole("button", { name: "hidden-effect", exact: true }).click();
    await page.waitForSelector(".live-candidates .plus", { timeout: kLong });
  };
  await open();
  await page.evaluate(() => {
    document.querySelector(".live-candidates .plus").click();
    const shown = document.querySelector(".live-fall .rmse");
    const before = shown.textContent;
    const watching = new MutationObserver(() => {
      if (shown.textContent === before) return;
      watching.disconnect();
      [...document.querySelectorAll(".live-bar button")].find((one) => one.textContent === "Close").click();
      setTimeout(() => document.querySelector("dialog.live-question button:last-of-type")?.click(), 20);
    });
    watching.observe(shown, { childList: true });
  });
  await page.waitForSelector(".live-start:not([hidden]) .drop", { timeout: kLong });
  await page.waitForTimeout(500);
  assert.equal(await page.textContent(".live-told"), "");
  await open();
  await at_rest(page);
  assert.match(await page.textContent(".live-fall .rmse"), /RMSE 1\.36/);
  assert.deepEqual(wrong, []);
  await close();
});

test("after a reload, other files do not delete what was kept without a question", async () => {
  const { page, wrong, close } = await changed();
  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  await page.getByRole("button", { name: "qc20-style-b5r", exact: true }).click();
  await page.locator("dialog.live-question").waitFor();
  await page.getByRole("button", { name: "Cancel", exact: true }).click();
  await page.getByRole("button", { name: /^Continue where you were/ }).click();
  await page.waitForSelector(".live-fall .rmse:not(:empty)", { timeout: kLong });
  assert.ok((await page.$$eval(".live-model .effect bdi", (all) => all.map(({ title }) => title))).includes("lagged_expansion(T_room_degC)"));
  assert.deepEqual(wrong, []);
  await close();
});

test("after a reload, a change that is taken back leaves nothing to ask about; one that stays is asked about", async () => {
  const { page, wrong, close } = await changed();
  const again = async () => {
    await page.reload();
    await page.waitForSelector("html[data-ready]", { state: "attached" });
    await page.getByRole("button", { name: /^Continue where you were/ }).click();
    await page.waitForSelector(".live-fall .rmse:not(:empty)", { timeout: kLong });
    await at_rest(page);
  };
  const question = page.locator("dialog.live-question");
  await again();
  await close_button(page).click();
  await question.waitFor();
  await page.keyboard.press("Escape");
  await page.getByRole("button", { name: "Undo", exact: true }).click();
  await page.waitForSelector('.live-loop:not([data-revisions="2"])', { timeout: kLong });
  await at_rest(page);
  await again();
  await close_button(page).click();
  await page.waitForSelector(".samples button:visible");
  assert.equal(await question.count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test("a saved model has every fitted value: opened, it is the same fit", async () => {
  const { page, wrong, close } = await changed();
  const [rmse, values] = [await page.textContent(".live-fall .rmse"), await parameters(page)];
  const path = await saved(page, "Model (.toml)");
  const text = readFileSync(path, "utf8");
  const fitted = await page.evaluate(() => [...document.querySelectorAll(".live-model .slider")].length);
  const starts = text.slice(0, text.indexOf("[[history]]")).match(/start = /g) ?? [];
  assert.equal(starts.length, fitted - 1, text); // all but the constant, which is no effect's
  const checked = json_of("check", of_run("hidden-effect", "01", "data.csv"), "--model", path);
  assert.equal(`RMSE ${checked.rmse_um.toFixed(3)} µm`, rmse);
  await close_button(page).click(); // it is in a file
  await page.waitForSelector(".samples button:visible");
  await page.locator("input[type=file]:not([webkitdirectory])").first().setInputFiles([of_run("hidden-effect", "01", "data.csv"), path]);
  await page.waitForSelector(".live-fall .rmse:not(:empty)", { timeout: kLong });
  await at_rest(page);
  assert.equal(await page.textContent(".live-fall .rmse"), rmse);
  assert.deepEqual((await parameters(page)).sort(), values.sort());
  assert.deepEqual(wrong, []);
  await close();
});

test("two tabs keep their own record; a reload of each goes on with its own", async () => {
  const { page, wrong, close } = await changed();
  const second = await page.context().newPage();
  await second.goto(page.url());
  await second.waitForSelector("html[data-ready]", { state: "attached" });
  assert.equal(await second.locator(".kept").count(), 0, "what another tab has open is not offered");
  await second.getByRole("button", { name: "qc20-style-b5r", exact: true }).click();
  await second.waitForSelector(".live-report main", { timeout: kLong });
  assert.equal(await second.locator("dialog.live-question").count(), 0);
  await at_rest(second);
  for (const [one, words] of [[page, /hidden-effect|01\/data|data\.csv/], [second, /b5r/]]) {
    await one.reload();
    await one.waitForSelector("html[data-ready]", { state: "attached" });
    await one.getByRole("button", { name: /^Continue where you were/ }).click();
    await one.waitForSelector(".live-report main", { timeout: kLong });
    await at_rest(one);
    assert.match(await one.textContent(".live-shelf"), words);
  }
  assert.ok((await page.$$eval(".live-model .effect bdi", (all) => all.map(({ title }) => title))).includes("lagged_expansion(T_room_degC)"));
  // A closed tab's record is offered in a new one, and stays where other files are opened.
  await second.close();
  const third = await page.context().newPage();
  await third.goto(page.url());
  await third.waitForSelector("html[data-ready]", { state: "attached" });
  await third.getByRole("button", { name: /^Continue where you were: 6 files/ }).waitFor();
  assert.deepEqual(wrong, []);
  await close();
});
