// The page with the program in it, in a browser that the tests of a file share: opened, dropped on, waited for, read.
import { readFileSync } from "node:fs";
import { basename, join } from "node:path";
import { after, before } from "node:test";
import { launched, opened } from "./browser.mjs";
import { folder } from "./reports.mjs";
import { tool } from "./tool.mjs";

let browser;
before(async () => {
  browser = await launched();
});
after(() => browser.close());

export const kLong = 180_000; // ms, for a search on a busy machine

export const live = (options = {}) => opened(browser, tool, { viewport: { width: 1400, height: 900 }, acceptDownloads: true, ...options });

// A page that was saved.
export const opened_file = (path) => opened(browser, path);

// As if they were dropped: { name: text or bytes }, without folders.
export const drop = (page, files) =>
  page.evaluate((files) => {
    const transfer = new DataTransfer();
    for (const [name, content] of files) {
      transfer.items.add(new File([typeof content === "string" ? content : new Uint8Array(content)], name));
    }
    for (const type of ["dragenter", "dragover", "drop"]) {
      document.body.dispatchEvent(new DragEvent(type, { dataTransfer: transfer, bubbles: true, cancelable: true }));
    }
  }, Object.entries(files));

export const dropped = (page, ...paths) => drop(page, Object.fromEntries(paths.map((path) => [basename(path), [...readFileSync(path)]])));

export const idle = (page) =>
  page.waitForFunction(
    () => document.querySelector(".live-work").dataset.waiting === "0" && !document.querySelector(".live-loop[aria-busy]"),
    null,
    { timeout: kLong },
  );
// Work may follow on work.
export const at_rest = async (page) => {
  for (let k = 0; k < 3; ++k) {
    await idle(page);
    await page.waitForTimeout(400);
  }
  await idle(page);
};

export const rmse = async (page) => Number(/RMSE ([\d.]+)/.exec(await page.textContent(".live-fall .rmse"))?.[1]);

// By an entry of the menu: the path of the file.
export const saved = async (page, name) => {
  if (!(await page.locator(".live-saves").evaluate((one) => one.open))) await page.click(".live-saves > summary");
  const [download] = await Promise.all([page.waitForEvent("download"), page.getByRole("button", { name, exact: true }).click()]);
  const path = join(folder, `${Date.now()}-${download.suggestedFilename()}`);
  await download.saveAs(path);
  return path;
};
