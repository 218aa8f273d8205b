// The page with the program in it says nothing in English on a German or a Chinese page, for all sample runs that it
// carries: the verdict with how sure it is and where it fails, effects, parameters, what the program remarks.
import assert from "node:assert/strict";
import { test } from "node:test";
import { at_rest, kLong, live } from "./live_page.mjs";

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
