// Chromium and Firefox, driven alike. What must never happen is kept in `wrong`: errors, dialogs, windows, anything loaded.
import { existsSync, mkdtempSync, readdirSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { launch } from "puppeteer-core";
import { address_of, kQuiet, watched } from "./watched.mjs";

const programs = {
  chrome: process.env.CHROMIUM || "/usr/bin/chromium",
  firefox: process.env.FIREFOX || "/usr/bin/firefox-esr",
};

// Those that are installed.
export const kinds = Object.keys(programs).filter((kind) => existsSync(programs[kind]));

const kMinutes = 10 * 60_000; // a diagnosis takes its time on a busy machine

// dark: what the system wears, for the browser as a whole; Firefox has it so.
export const started = async (kind, { dark = false, args = [] } = {}) => {
  const saved = mkdtempSync(join(tmpdir(), "ballbar-saved-"));
  const browser = await launch({
    browser: kind,
    executablePath: programs[kind],
    args: [...(kind === "chrome" ? [...kQuiet, "--font-render-hinting=none"] : []), ...args],
    protocolTimeout: kMinutes,
    extraPrefsFirefox: {
      "browser.download.folderList": 2,
      "browser.download.dir": saved,
      "browser.download.alwaysOpenPanel": false,
      "layout.css.prefers-color-scheme.content-override": dark ? 0 : 1,
      "ui.prefersReducedMotion": 0,
    },
  });
  const close = async () => {
    await browser.close();
    rmSync(saved, { recursive: true, force: true });
  };
  return { kind, dark, browser, saved, close, opened: (file, options) => opened({ kind, dark, browser, saved }, file, options) };
};

const kKeep = 50; // ms between two looks

const until = async (what, of_it, longest = kMinutes) => {
  for (const begin = Date.now(); ; await new Promise((done) => setTimeout(done, kKeep))) {
    const value = await of_it();
    if (value) return value;
    if (Date.now() - begin > longest) throw new Error(`not within ${longest / 1000} s: ${what}`);
  }
};

// A page in a profile of its own, whose storage lasts until it is closed.
const opened = async ({ kind, dark, browser, saved }, file, { width = 1100, height = 900, before = null } = {}) => {
  const context = await browser.createBrowserContext(kind === "chrome" ? { downloadBehavior: { policy: "allow", downloadPath: saved } } : {});
  const page = await context.newPage();
  const url = address_of(file);
  const wrong = watched(page, url);
  page.setDefaultTimeout(kMinutes);
  await page.setViewport({ width, height });
  if (kind === "chrome") await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
  if (before) await page.evaluateOnNewDocument(before);
  const ready = () => page.waitForSelector("html[data-ready]");
  await page.goto(url);
  await ready();

  const tab = {
    kind,
    page,
    wrong,
    evaluate: (work, ...values) => page.evaluate(work, ...values),
    // Until the function of the page gives something true, which is returned.
    wait: (what, work, ...values) => until(what, () => page.evaluate(work, ...values)),
    text: (selector) => page.evaluate((selector) => document.querySelector(selector)?.textContent ?? "", selector),
    // Of the elements by that selector the first that is seen and says this; a button as a person finds it.
    async click(selector, says = "") {
      const found = await until(`${selector} "${says}"`, async () => {
        const handle = await page.evaluateHandle(
          (selector, says) =>
            [...document.querySelectorAll(selector)].find((one) => (one.textContent.includes(says) || one.ariaLabel?.includes(says)) && one.checkVisibility() && !one.disabled) ?? null,
          selector,
          says,
        );
        return handle.asElement();
      });
      await found.click();
    },
    press: (...keys) => keys.reduce((last, key) => last.then(() => page.keyboard.press(key)), Promise.resolve()),
    // By the choice of files, which is there without being seen.
    async choose(paths, selector = ".live-start input[type=file]:not([webkitdirectory])") {
      const input = await page.$(selector);
      await input.uploadFile(...paths);
    },
    // What the click saves, whole: its path.
    async saves(click) {
      const before = new Set(readdirSync(saved));
      await click();
      return until("a file that is saved", () => {
        const [name] = readdirSync(saved).filter((one) => !before.has(one) && !/\.(part|crdownload)$/.test(one) && statSync(join(saved, one)).size > 0);
        return name && !existsSync(join(saved, `${name}.part`)) ? join(saved, name) : "";
      });
    },
    async reload() {
      await page.reload();
      await ready();
    },
    picture: (path, options = {}) => page.screenshot({ path, ...options }),
    close: () => context.close(),
  };
  return tab;
};
