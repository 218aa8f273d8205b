// The order of a page: on the first screen the verdict, what to do next and the picture that proves it; then the details,
// folded. On a wide screen and on a phone's.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { drawn, figure, launched, opened, seen, unfold } from "./browser.mjs";
import { batch, hidden_effect, history, of_run, report, two_arcs } from "./reports.mjs";

const wide = { width: 1400, height: 900 };
const phone = { width: 390, height: 844 };
const kScreens = 6;

// [name, page, what is on the first screen]
const cases = [
  ["two arcs with a model", two_arcs, "drift"],
  ["two arcs", () => report("order-two-arcs", of_run("two-arcs-he2015")), "drift"],
  ["a turning spindle", () => report("order-rotation", of_run("spindle-rotation-huang2022")), "drift"],
  ["a ballbar test", () => report("order-b5r", of_run("qc20-style-b5r", "00.b5r")), "machine-errors"],
  ["ballbar tests", () => report("order-b5r-folder", of_run("qc20-style-b5r")), "machine-errors"],
  ["46 hours with a model", () => report("order-46h", of_run("spindle-46h", "measured.csv"), "--model", of_run("spindle-46h", "speed.toml"), "--target", "ch3_um"), "five-probe"],
  ["a hidden effect", hidden_effect, "with-without"],
  ["a comparison", () => report("order-compare", of_run("two-arcs-he2015", "five-probe.csv"), "--compare", of_run("two-arcs-he2015")), "comparison-y"],
  ["a history", history, "history-1"],
  ["batches", batch, "batch"],
];

let browser;
const pages = new Map();
before(async () => {
  for (const [name, make] of cases) {
    pages.set(name, make());
    pages.get(name).catch(() => {}); // is thrown where it is awaited
  }
  browser = await launched();
});
after(() => browser.close());

const height_of = (page) => page.evaluate(() => document.documentElement.scrollHeight);
const width_of = (page) => page.evaluate(() => document.documentElement.scrollWidth);
const box_of = (page, selector) => page.locator(`${selector}:visible`).first().boundingBox();

// Pixels of no grey, as axes and grids are.
const coloured = (page, name) =>
  page.evaluate((name) => {
    const copy = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    const layers = [...window.ballbar.figures.get(name).element.querySelectorAll(".canvas canvas")];
    if (layers.length === 0) return 0;
    Object.assign(copy.canvas, { width: layers[0].width, height: layers[0].height });
    for (const layer of layers) copy.drawImage(layer, 0, 0);
    const { data } = copy.getImageData(0, 0, copy.canvas.width, copy.canvas.height);
    let count = 0;
    for (let k = 0; k < data.length; k += 4) {
      if (data[k + 3] > 100 && Math.max(data[k], data[k + 1], data[k + 2]) - Math.min(data[k], data[k + 1], data[k + 2]) > 50) ++count;
    }
    return count;
  }, name);

const names_of = (page) => page.$$eval("figure[data-picture]", (all) => all.map((one) => one.dataset.picture));

// Text that a chart has drawn beyond its edge; text of the page that its own box cuts off.
const clipped = (page, name) =>
  page.evaluate((name) => {
    const chart = window.ballbar.figures.get(name).chart();
    const [width, height] = [chart.getWidth(), chart.getHeight()];
    return chart
      .getZr()
      .storage.getDisplayList(true)
      .flatMap((one) => {
        if (one.style?.text === undefined || one.style.text === null || String(one.style.text) === "" || one.invisible || one.ignore) return [];
        const rect = one.getBoundingRect().clone();
        if (one.transform) rect.applyTransform(one.transform);
        const out = Math.max(-rect.x, -rect.y, rect.x + rect.width - width, rect.y + rect.height - height);
        return out > 1.5 ? [`${name}: “${one.style.text}” is ${out.toFixed(1)} pixels out of its picture`] : [];
      });
  }, name);
const cut_off = (page) =>
  page.evaluate(() =>
    [...document.querySelectorAll("h1, h2, h3, p, li, label, button, summary, span, figcaption")].flatMap((one) => {
      const { overflowX } = getComputedStyle(one);
      if (!one.checkVisibility() || one.closest(".voice, .table, nav") || ["auto", "scroll"].includes(overflowX)) return [];
      const { right, left } = one.getBoundingClientRect();
      return right > innerWidth + 1 || left < -1 || (overflowX !== "visible" && one.scrollWidth > one.clientWidth + 1)
        ? [`${one.localName} “${one.textContent.slice(0, 60)}”`]
        : [];
    }),
  );

for (const [name, , picture] of cases) {
  for (const [what, viewport] of [["wide", wide], ["phone", phone]]) {
    test(`${name}, ${what}: the first screen, and no more than ${kScreens}`, async () => {
      const { page, wrong, close } = await opened(browser, await pages.get(name), { viewport });
      await drawn(page);
      const height = await height_of(page);
      assert.ok(height <= kScreens * viewport.height, `${height} px are ${(height / viewport.height).toFixed(1)} screens`);
      assert.equal(await width_of(page), viewport.width);
      const verdict = await box_of(page, ".verdict p");
      const button = await box_of(page, "button.act");
      const chart = await box_of(page, ".first .chart");
      const ends = [verdict, button].map((box) => box.y + box.height);
      assert.ok(verdict.y <= button.y + 1 && Math.max(...ends) < chart.y, "the verdict and the button, then the picture");
      const seen_px = Math.min(viewport.height, chart.y + chart.height) - chart.y;
      assert.ok(seen_px >= (what === "wide" ? chart.height : 260), `${seen_px} of ${chart.height} px of the picture are seen, from ${chart.y}`);
      assert.equal(await page.locator(".first figure:visible").first().getAttribute("data-picture"), picture);
      assert.ok((await coloured(page, picture)) > 200, "it is drawn");
      assert.match((await page.locator(".verdict:visible").innerText()).trim(), /^\S.{8,}/s);
      assert.match(await page.locator("code.command:visible").textContent(), /^ballbar \w+/);
      // What is folded is not drawn.
      const folded = await page.$$eval("details.folded figure", (all) => all.map((one) => one.dataset.picture));
      const early = await page.evaluate((names) => names.filter((one) => window.ballbar.figures.get(one).chart()), folded);
      assert.deepEqual(early, []);
      for (const result of await page.locator("summary .result").allTextContents()) assert.doesNotMatch(result, /^$|NaN|undefined|null|Infinity/);
      assert.deepEqual(wrong, []);
      await close();
    });
  }

  test(`${name}: captions of one line`, async () => {
    const { page, close } = await opened(browser, await pages.get(name), { viewport: wide });
    await unfold(page);
    const captions = await page.$$eval(".caption", (all) =>
      all.filter((one) => one.checkVisibility()).map((one) => [one.textContent, one.getBoundingClientRect().height, parseFloat(getComputedStyle(one).lineHeight)]),
    );
    assert.ok(captions.length > 0);
    for (const [text, height, line] of captions) {
      assert.ok(height < 1.5 * line, `“${text}” takes ${height} px, a line is ${line}`);
      assert.ok(text.length <= 95, `“${text}” has ${text.length} letters`);
    }
    await close();
  });

  test(`${name}: on a phone nothing is clipped, and nothing is wider than the screen`, async () => {
    const { page, wrong, close } = await opened(browser, await pages.get(name), { viewport: phone });
    await unfold(page);
    const faults = [];
    for (const one of await names_of(page)) {
      await seen(page, one);
      faults.push(...(await clipped(page, one)));
    }
    faults.push(...(await cut_off(page)));
    assert.deepEqual(faults, []);
    assert.equal(await width_of(page), phone.width);
    assert.deepEqual(wrong, []);
    await close();
  });
}

test("unfolded by a key, by a link, and on paper", async () => {
  // Without smooth scrolling, which a busy machine may not bring to its end.
  const still = { viewport: wide, reducedMotion: "reduce" };
  const { page, wrong, close } = await opened(browser, await pages.get("two arcs with a model"), still);
  const open = (id) => page.evaluate((id) => document.querySelector(`#${id} > details`).open, id);
  const chart_of = (name) => page.evaluate((name) => window.ballbar.figures.get(name).chart() !== null, name);
  assert.deepEqual([await open("signals"), await chart_of("temperatures")], [false, false]);
  await page.locator("#signals > details > summary").focus();
  await page.keyboard.press("Enter");
  await page.waitForFunction(() => window.ballbar.figures.get("temperatures").chart() !== null);
  assert.ok(await open("signals"));
  await page.keyboard.press("Space");
  assert.ok(!(await open("signals")));

  await page.locator("nav").getByRole("link", { name: "Recordings" }).press("Enter");
  await page.waitForFunction(() => document.querySelector("#recordings > details").open);
  await page.waitForFunction(() => document.querySelector("#recordings h2").getBoundingClientRect().top < innerHeight);

  const all = () => page.$$eval("details.folded", (of) => of.map((one) => one.open));
  const before_paper = await all();
  await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
  assert.ok((await all()).every((one) => one));
  await page.evaluate(() => dispatchEvent(new Event("afterprint")));
  assert.deepEqual(await all(), before_paper);

  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  assert.deepEqual(await all().then((of) => of.filter((one) => one).length), page.url().includes("#") ? 1 : 0, "folds are not kept");
  assert.deepEqual(wrong, []);
  await close();
});

test("what a caption leaves out: behind the button, closed by Escape, read out", async () => {
  const { page, close } = await opened(browser, await pages.get("a hidden effect"), { viewport: wide });
  const of = figure(page, "with-without");
  const button = of.getByRole("button", { name: /^About/ });
  const note = of.locator(".about");
  const described = await of.locator(".chart").getAttribute("aria-describedby");
  assert.ok(described.split(" ").includes(await note.getAttribute("id")));
  assert.ok(await note.isHidden());
  await button.press("Enter");
  assert.ok(await note.isVisible());
  assert.equal(await button.getAttribute("aria-expanded"), "true");
  await page.keyboard.press("Escape");
  assert.ok(await note.isHidden());
  assert.ok(await button.evaluate((one) => one === document.activeElement));
  await close();
});

test("the button copies the command, and says so", async () => {
  const { page, close } = await opened(browser, await pages.get("a hidden effect"), { viewport: wide, permissions: ["clipboard-read", "clipboard-write"] });
  // It is said for a short while: what was said is kept.
  await page.evaluate(() => {
    const told = document.querySelector(".told");
    window.told = [];
    new MutationObserver(() => window.told.push(told.textContent)).observe(told, { childList: true });
  });
  await page.locator("button.act").click();
  await page.waitForSelector('button.act[data-copied="true"]');
  assert.match((await page.evaluate(() => window.told)).join("\n"), /Copied/);
  const command = await page.locator("code.command").first().textContent();
  assert.match(command, /^ballbar (add|check|plan) /);
  assert.equal(await page.evaluate(() => navigator.clipboard.readText()), command);
  await close();
});

test("the verdict goes with what is chosen in the picture", async () => {
  const { page, close } = await opened(browser, await pages.get("ballbar tests"), { viewport: wide });
  const verdict = () => page.locator(".verdict").innerText();
  const first = await verdict();
  await figure(page, "machine-errors").getByRole("combobox", { name: "Test" }).selectOption({ index: 1 });
  await drawn(page);
  assert.notEqual(await verdict(), first);
  await close();
});

test("of several groups one is shown, and the others can be chosen", async () => {
  const { page, close } = await opened(browser, await pages.get("a history"), { viewport: wide });
  const shown = () => page.locator(".first figure:visible").getAttribute("data-picture");
  const first = await shown();
  await page.locator(".first > .choice select").selectOption({ index: 1 });
  await drawn(page);
  assert.notEqual(await shown(), first);
  assert.ok((await coloured(page, await shown())) > 200);
  assert.equal(await page.locator(".verdict:visible").count(), 1);
  await close();
});

test("many temperatures: in groups by role, all and none of a group at once", async () => {
  const { page, close } = await opened(browser, await pages.get("46 hours with a model"), { viewport: phone });
  await seen(page, "temperatures");
  const of = figure(page, "temperatures");
  const groups = await of.locator(".group").evaluateAll((all) => all.map((one) => [one.getAttribute("aria-label"), one.querySelectorAll("input").length]));
  assert.ok(groups.length > 1, `${groups}`);
  assert.equal(groups.reduce((sum, [, n]) => sum + n, 0), await page.evaluate(() => window.ballbar.figures.get("temperatures").picture.toggles({ chosen: {} }).length));
  const [last, n] = groups[groups.length - 1];
  const on = () => of.getByRole("group", { name: last, exact: true }).locator("input:checked").count();
  await of.getByRole("button", { name: `${last}: none` }).press("Enter");
  await drawn(page);
  assert.equal(await on(), 0);
  await of.getByRole("button", { name: `${last}: all` }).click();
  await drawn(page);
  assert.equal(await on(), n);
  const legend = await of.locator(".legend").boundingBox();
  assert.ok(legend.width <= phone.width && legend.height < 400, `${legend.height} px high`);
  await close();
});
