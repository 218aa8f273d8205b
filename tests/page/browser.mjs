// Chromium, and reports opened in it. What must never happen is kept in `wrong`: errors, dialogs, anything loaded.
import { chromium } from "playwright-core";
import { address_of, kQuiet, watched } from "./watched.mjs";

export const launched = () =>
  chromium.launch({
    executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
    args: kQuiet,
  });

// options: as of newContext(), such as colorScheme.
export const opened = async (browser, file, options = {}) => {
  const context = await browser.newContext({ viewport: { width: 1100, height: 900 }, ...options });
  const page = await context.newPage();
  const url = address_of(file);
  const wrong = watched(page, url);
  await page.goto(url);
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  return { page, wrong, close: () => context.close() };
};

export const figure = (page, name) => page.locator(`figure[data-picture="${name}"]`);

// All sections, or one of them.
export const unfold = (page, id = "") =>
  page.evaluate((id) => {
    for (const one of document.querySelectorAll(id === "" ? "details.folded" : `#${id} > details.folded`)) one.open = true;
  }, id);

// Unfolded, scrolled to and drawn.
export const seen = async (page, name) => {
  await page.evaluate(async (name) => {
    const one = window.ballbar.figures.get(name);
    const folded = one.element.closest("details.folded");
    if (folded) folded.open = true;
    // Of another target: chosen on the first screen.
    const panel = one.element.closest(".panel");
    if (panel?.hidden) {
      const select = document.querySelector(".first > .choice select");
      select.value = String([...document.querySelectorAll(".panel")].indexOf(panel));
      select.dispatchEvent(new Event("change", { bubbles: true }));
    }
    one.element.scrollIntoView({ block: "center", behavior: "instant" });
    const frame = () => new Promise(requestAnimationFrame);
    for (let k = 0; k < 600 && !one.chart(); ++k) await frame();
    await frame();
    await frame();
  }, name);
  return figure(page, name);
};

// All that has been asked for is drawn with the next frame.
export const drawn = (page) => page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));

// By a click on its button: { name, path }. The path ends in that name, in a temporary folder.
export const saved = async (page, name, kind) => {
  const [download] = await Promise.all([
    page.waitForEvent("download"),
    figure(page, name).getByRole("button", { name: kind, exact: true }).click(),
  ]);
  const name_of_file = download.suggestedFilename();
  const path = `${await download.path()}-${name_of_file}`;
  await download.saveAs(path);
  return { name: name_of_file, path };
};
