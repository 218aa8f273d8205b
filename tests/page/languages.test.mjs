// The page with the program in it says nothing in English on a German or a Chinese page, for all sample runs that it
// carries: the verdict with how sure it is and where it fails, effects, parameters, what the program remarks.
import assert from "node:assert/strict";
import { test } from "node:test";
import { at_rest, drop, kLong, live } from "./live_page.mjs";

const samples = ["hidden-effect", "qc20-style-b5r", "two-arcs-he2015", "spindle-rotation-huang2022", "foreign-logs", "compensation"];

const english = /\b(the|and|with|without|less|each|below|above|measured|recording|readings|deviation|residual|lacks|likely|from|largest|least|reference|error|errors|centre|about|show|save|select|time|angle|speed|none|all|gain|constant|offset|rate|floor|times|probes)\b/i;

// A name of a file, a column or an effect as it is typed is of no language; so is what a file states of itself. What is
// marked as English is a sentence that the page does not have: these too.
const names = [
  /^Five probes, 25 mm from plane 1/, // a source, as files name it
  /^SIMULATED by ballbar/, // what a test is called by its file
  /^[AB](: |：)(five probes, 25 mm from plane 1|ballbar, two_arcs)/,
];
const english_on = (page) =>
  page.evaluate(
    ({ pattern, names }) => {
      for (const fold of document.querySelectorAll("details")) fold.open = true;
      const title = document.querySelector("h1").textContent;
      const found = [...document.querySelectorAll("[lang=en]")].map((one) => `marked: ${one.textContent.slice(0, 200)}`).filter((one) => one !== "marked: ");
      const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
      for (let node = walk.nextNode(); node; node = walk.nextNode()) {
        const holder = node.parentElement;
        if (holder.closest("[lang=en], [hidden], script, style, noscript, h1, code, pre, option, .numbers, .live-start, .files, .live-shelf")) continue;
        const text = node.textContent.replace(title, "").replace(/\w*_\w*(\([^)]*\))?|expansion\([^)]*\)|settling|step\b|\S+\.(csv|toml|b5r)/g, "").trim();
        if (names.some((name) => new RegExp(name).test(node.textContent.trim()))) continue;
        if (new RegExp(pattern, "i").test(text)) found.push(node.textContent.slice(0, 200));
      }
      return found;
    },
    { pattern: english.source, names: names.map((one) => one.source) },
  );

for (const [locale, verdict] of [["de-DE", /\((über )?\d+ % sicher\)|^Der Restfehler von .* keine aufgezeichnete Spalte erklärt ihn/], ["zh-CN", /（把握 (超过 )?\d+ %）|^\S+ 的剩余误差.*没有记录的列能解释它/]]) {
  for (const name of samples) {
    test(`${name} in ${locale}`, async () => {
      const { page, wrong, close } = await live({ locale });
      await page.getByRole("button", { name, exact: true }).click();
      await page.waitForSelector(".live-report main", { timeout: kLong });
      await at_rest(page);
      const next = page.locator(".next button.act:visible");
      if ((await next.count()) > 0) {
        await next.first().click();
        await page.waitForTimeout(500);
        await at_rest(page);
      }
      assert.deepEqual(await english_on(page), []);
      if ((await page.locator('.live-loop[data-search="done"]').count()) > 0) assert.match(await page.innerText(".live-loop .said"), verdict);
      for (const bdi of await page.locator(".live-candidates bdi, .live-model .effect bdi").all()) {
        const title = (await bdi.getAttribute("title")) ?? "";
        assert.notEqual(title, "", await bdi.innerText()); // the program's name of it
      }
      assert.deepEqual(wrong, []);
      await close();
    });
  }
}

// Two bearings that warm nearly alike: the data do not tell which moves the spindle.
const two_bearings = (names) => {
  let [front, rear, state] = [0, 0, 7];
  const noise = () => Array.from({ length: 12 }, () => (state = (state * 48271) % 2147483647) / 2147483647).reduce((sum, one) => sum + one, -6);
  const rows = Array.from({ length: 240 }, (_, k) => {
    const goal = Math.floor(k / 60) % 2 === 0 ? 12 : 0;
    front += (goal - front) / 25;
    rear += (goal - rear) / 26;
    return [60 * k, 20 + front, 20.4 + 0.8 * rear + 0.02 * noise(), 0.5 * front + 0.8 * noise()].map((value) => value.toFixed(4)).join();
  });
  return `${names.join()}\n${rows.join("\n")}\n`;
};
const searched = async (page) => {
  await at_rest(page);
  await page.click(".next button.act:visible");
  await page.waitForSelector('.live-loop[data-search="done"]', { timeout: kLong });
  await at_rest(page);
};
// The button is pressed and the language changed before the program can answer.
const pressed_and_said = (page, button, language) =>
  page.evaluate(
    ([button, language]) => {
      document.querySelector(button).click();
      const select = document.querySelector(".page-tools select");
      select.value = language;
      select.dispatchEvent(new Event("change", { bubbles: true }));
      const work = document.querySelector(".live-work");
      return [Number(work.dataset.waiting), work.textContent];
    },
    [button, language],
  );

test("a plan and a comparison that run when the language changes come in the new one, and stay in the next; so does the verdict", async () => {
  const { page, wrong, close } = await live();
  await drop(page, { "two.csv": two_bearings(["time_s", "front_bearing_degC", "rear_bearing_degC", "z_um"]) });
  await searched(page);
  const said = () => page.innerText(".live-loop .said");
  const english_verdict = await said();
  const speak = async (language) => {
    await page.locator(".page-tools select").selectOption(language);
    await page.waitForSelector(`.live-loop[lang="${language}"]`);
  };

  await page.click(".live-plan > summary");
  await page.locator(".live-plan select").selectOption("4");
  const [waiting] = await pressed_and_said(page, ".live-plan .buttons > button", "de");
  assert.ok(waiting > 0);
  const plan = page.locator(".live-plan [aria-live] p");
  await plan.waitFor({ timeout: kLong });
  assert.equal(await plan.innerText(), "Kein Test bis 4 h würde es entscheiden. Keiner wird vorgeschlagen.");
  assert.equal(await page.inputValue(".live-plan select"), "4");
  assert.notEqual(await said(), english_verdict);
  await speak("en");
  assert.equal(await plan.innerText(), "No test of up to 4 h would decide. None is proposed.");
  assert.equal(await said(), english_verdict);

  await page.click(".live-two > summary");
  const chosen = () => page.$$eval(".live-two select", (all) => all.map(({ value }) => value));
  await page.locator(".live-two select").first().selectOption("");
  const both = await chosen();
  assert.notEqual(both[0], both[1]);
  const [fitting, words] = await pressed_and_said(page, ".live-two .buttons > button", "de");
  assert.ok(fitting > 0);
  assert.doesNotMatch(words, /Fitting/);
  await page.waitForSelector('figure[data-picture="hypothesis-2"]', { timeout: kLong });
  await at_rest(page);
  assert.deepEqual(await chosen(), both);
  assert.match(await page.innerText(".live-two .sides h4 >> nth=0"), /Modell/);
  const numbers = () => page.$$eval(".live-two tbody td + td", (all) => all.map((one) => one.textContent.replace(",", ".")).filter((one) => /^[\d.]+$/.test(one)));
  const of_german = await numbers();
  assert.ok(of_german.length > 6);
  await speak("en");
  assert.deepEqual(await numbers(), of_german);
  assert.equal(await page.locator(".live-two figure canvas").count(), 2);
  assert.equal(await said(), english_verdict);
  assert.deepEqual(wrong, []);
  await close();
});

test("names with numbers in them keep their points on a German page", async () => {
  const names = ["T7.31_degC", "Lager 7.31 hinten_degC"];
  const { page, wrong, close } = await live({ locale: "de-DE" });
  await drop(page, { "run_8.27.csv": two_bearings(["time_s", ...names, "z 7.31_um"]), "Lauf 8.27 b.csv": two_bearings(["time_s", ...names, "z 7.31_um"]) });
  await searched(page);
  await page.evaluate(() => {
    for (const fold of document.querySelectorAll("details")) fold.open = true;
  });
  await at_rest(page);
  const seen = await page.evaluate(() => [document.body.innerText, ...[...document.querySelectorAll("[title]")].map(({ title }) => title)].join("\n"));
  for (const name of ["T7.31", "Lager 7.31", "z 7.31", "run_8.27.csv", "Lauf 8.27 b.csv"]) assert.ok(seen.includes(name), name);
  assert.deepEqual(seen.split("\n").filter((line) => /(?<!\d)(7,31|8,27)/.test(line)), []);
  assert.match(seen, /RMSE \d,\d+ µm/);
  assert.deepEqual(wrong, []);
  await close();
});
