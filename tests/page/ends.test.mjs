// The page with the program in it has no dead end: nothing on it sends a reader to a terminal, each of its buttons does
// its step, and what cannot be read is said in a sentence.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { at_rest, drop, dropped, kLong, live } from "./live_page.mjs";
import { of_run } from "./reports.mjs";

// All that the page says, folded or not, which only a terminal could do.
const for_terminals = (page) =>
  page.evaluate(() => {
    const advice = /\bterminals?\b|\bcommand line\b|Terminal\b|终端|`ballbar |\bballbar (add|check|compare|could|diagnose|drift|effects|errors|fit|history|import|plan|predict|simulate|train|undo)\b|(?<![\w-])--[a-z]/;
    const found = [];
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walk.nextNode(); node; node = walk.nextNode()) {
      if (node.parentElement.closest("script, style, noscript, [hidden]")) continue;
      if (advice.test(node.textContent)) found.push(node.textContent.slice(0, 200));
    }
    for (const one of document.querySelectorAll("[title], [aria-label], [placeholder]")) {
      for (const name of ["title", "aria-label", "placeholder"]) if (advice.test(one.getAttribute(name) ?? "")) found.push(`${name}: ${one.getAttribute(name)}`);
    }
    return found;
  });

// Presses the button that says what to do next: the page changes, goes elsewhere, or saves a file.
const pressed = async (page) => {
  const buttons = page.locator(".next button.act:visible, .live-loop .verdict button.act:visible");
  for (let k = 0; k < (await buttons.count()); ++k) {
    const button = buttons.nth(k);
    const label = await button.innerText();
    await page.evaluate(() => {
      window.done = 0;
      new MutationObserver(() => ++window.done).observe(document.body, { childList: true, attributes: true, characterData: true, subtree: true });
      addEventListener("scroll", () => ++window.done, { once: true });
    });
    const download = page.waitForEvent("download", { timeout: 3000 }).catch(() => null);
    await button.click();
    await page.waitForTimeout(500);
    await at_rest(page);
    const did = (await page.evaluate(() => window.done)) > 0 || (await download) !== null;
    assert.ok(did, `"${label}" does nothing`);
    return label;
  }
  return "";
};

const samples = ["hidden-effect", "qc20-style-b5r", "two-arcs-he2015", "spindle-rotation-huang2022", "foreign-logs", "compensation"];
for (const name of samples) {
  test(`${name}: nothing refers to a terminal, and what to do next is done`, async () => {
    const { page, wrong, close } = await live();
    await page.getByRole("button", { name, exact: true }).click();
    await page.waitForSelector(".live-report main", { timeout: kLong });
    await at_rest(page);
    assert.deepEqual(await for_terminals(page), []);
    const label = await pressed(page);
    assert.deepEqual(await for_terminals(page), [], `after "${label}"`);
    assert.deepEqual(wrong, []);
    await close();
  });
}

const runs = {
  "recordings without errors of the machine": [["two-arcs-he2015", "00-c.csv"], ["two-arcs-he2015", "01-c.csv"]],
  "a log without a measured column": [["two-arcs-he2015", "signals.csv"]],
  "a log of another machine": [["foreign-logs", "control.csv"]],
  "a job without its model": [["batches-tan2024", "test1.csv"]],
  "a list of batches without the batches": [["batches-tan2024", "runs.csv"]],
};
for (const [what, paths] of Object.entries(runs)) {
  test(`${what}: the same`, async () => {
    const { page, wrong, close } = await live();
    await dropped(page, ...paths.map((path) => of_run(...path)));
    await page.waitForSelector(".live-report main, .live-told:not(:empty), .faulty", { timeout: kLong });
    await at_rest(page);
    assert.deepEqual(await for_terminals(page), []);
    const label = await pressed(page);
    assert.deepEqual(await for_terminals(page), [], `after "${label}"`);
    assert.deepEqual(wrong, []);
    await close();
  });
}

test("a series with a long gap is shown, with why it is not fitted and a step across", async () => {
  const { page, wrong, close } = await live();
  // Ten hours of a day without a speed: too many rows to be left out.
  const lines = readFileSync(of_run("hidden-effect", "01", "data.csv"), "utf8").split("\n");
  const speed = lines.find((line) => line.startsWith("time_s")).split(",").indexOf("speed_rpm");
  const blank = (line) => line.split(",").map((cell, k) => (k === speed ? "" : cell)).join(",");
  const data = lines.map((line) => (parseFloat(line) > 600 * 60 && parseFloat(line) < 1200 * 60 ? blank(line) : line)).join("\n");
  await drop(page, { "data.csv": data, "model.toml": readFileSync(of_run("hidden-effect", "01", "model.toml"), "utf8") });
  const across = page.getByRole("button", { name: "Fit across gaps up to 10 h" });
  await across.waitFor({ timeout: kLong });
  assert.match(await page.innerText(".live-loop .said"), /speed_rpm has gaps too long to be interpolated\. The longest, of 10 h, begins after 10 h\.$/);
  assert.equal(await page.locator('figure[data-picture="measured"], main figure').first().isVisible(), true);
  assert.ok(await page.isDisabled('button:text-is("Back to the optimum")'));
  await across.click();
  await page.waitForSelector('figure[data-picture="live-fit"]', { timeout: kLong });
  assert.deepEqual(await page.locator(".faulty").count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test("an empty file is told, and the others are read", async () => {
  const { page, wrong, close } = await live();
  await drop(page, { "nothing.csv": "", "00.b5r": [...readFileSync(of_run("qc20-style-b5r", "00.b5r"))] });
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  assert.match(await page.innerText(".live-files .faulty"), /nothing\.csv[^]*The file is empty/);
  assert.deepEqual(wrong, []);
  await close();
});

for (const viewport of [{ width: 1400, height: 900 }, { width: 390, height: 844 }]) {
  test(`after an error no button lies under another, ${viewport.width}`, async () => {
    const { page, wrong, close } = await live({ viewport });
    await drop(page, { "broken.csv": "a,b\n1,x\n" });
    await page.waitForSelector(".live-told:not(:empty), .faulty", { timeout: kLong });
    await at_rest(page);
    const covered = await page.evaluate(() =>
      [...document.querySelectorAll("button, select, summary, input:not([hidden])")]
        .filter((one) => one.getClientRects().length > 0)
        .flatMap((one) => {
          const { left, right, top, bottom } = one.getBoundingClientRect();
          const [x, y] = [(left + right) / 2, (top + bottom) / 2];
          if (y < 0 || y > innerHeight) return [];
          const on_top = document.elementFromPoint(x, y);
          return on_top && !one.contains(on_top) && !on_top.contains(one) ? [`${one.textContent.slice(0, 30)} under ${on_top.outerHTML.slice(0, 60)}`] : [];
        }),
    );
    assert.deepEqual(covered, []);
    assert.deepEqual(wrong, []);
    await close();
  });
}
