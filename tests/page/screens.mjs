// node screens.mjs FOLDER [KIND...]: the first screen of ten kinds of data and of the start, at two sizes, light and
// dark, English and German, as FOLDER/KIND-SIZE-LOOK-LANGUAGE.png; what runs out of the page, what lies on something
// else, which text is cut: FOLDER/screens.json, and a line each. Exit 1 where something does.
//
// BALLBAR_HTML  the page; CHROMIUM  the browser; SAMPLE_RUNS  default ../../sample-runs
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { launched } from "./browser.mjs";
import { address_of } from "./watched.mjs";

const [folder, ...wanted] = process.argv.slice(2);
const tool = process.env.BALLBAR_HTML;
if (!folder || !tool) throw new Error("usage: BALLBAR_HTML=... node screens.mjs FOLDER [KIND...]");
const sample_runs = process.env.SAMPLE_RUNS ?? new URL("../../sample-runs", import.meta.url).pathname;
const of_run = (...parts) => join(sample_runs, ...parts);
const below = (name, like) => readdirSync(of_run(name)).filter((one) => like.test(one)).sort().map((one) => of_run(name, one));
mkdirSync(folder, { recursive: true });

const faulty = () => {
  const place = mkdtempSync(join(tmpdir(), "screens-"));
  writeFileSync(join(place, "cut.b5r"), readFileSync(of_run("qc20-style-b5r/00.b5r"), "utf8").slice(0, 3000));
  writeFileSync(join(place, "words.csv"), "time_s;y_um\nyesterday;about two\n");
  writeFileSync(join(place, "empty.csv"), "");
  return ["cut.b5r", "words.csv", "empty.csv"].map((name) => join(place, name));
};
const kinds = {
  start: [],
  "b5r-test": [of_run("qc20-style-b5r/03.b5r")],
  "three-planes": ["XY", "YZ", "ZX"].map((plane) => of_run(`machine-history/2025-01-20/${plane}.b5r`)),
  "two-tests": [of_run("qc20-style-b5r/00.b5r"), of_run("qc20-style-b5r/05.b5r")],
  "drift-session": below("two-arcs-he2015", /\.(csv|toml)$/),
  "spindle-rotation": below("spindle-rotation-huang2022", /-[zr]\.csv$|signals\.csv$|session\.toml$/),
  "five-probes": [of_run("two-arcs-he2015/five-probe.csv")],
  "series-with-model": [of_run("hidden-effect/01/data.csv"), of_run("hidden-effect/01/model.toml")],
  "series-without-model": [of_run("compensation/train.csv")],
  "machine-history": { folder: of_run("machine-history") },
  "foreign-log": [of_run("foreign-logs/warmup.csv")],
  "faulty-file": faulty(),
};
const sizes = { wide: { width: 1400, height: 900 }, phone: { width: 390, height: 844 } };
const kLong_ms = 60_000;

const faults = () => {
  const seen = (one) => one.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true });
  const name = (one) => `${one.tagName.toLowerCase()}${typeof one.className === "string" && one.className ? `.${one.className.split(" ")[0]}` : ""} "${(one.getAttribute("aria-label") ?? one.innerText ?? "").trim().replace(/\s+/g, " ").slice(0, 50)}"`;
  // What of it is not cut away by what it scrolls in.
  const rect = (one, own = one.getBoundingClientRect()) => {
    let { left, top, right, bottom } = own;
    for (let box = one.parentElement; box; box = box.parentElement) {
      const style = getComputedStyle(box);
      if (style.overflowX === "visible" && style.overflowY === "visible") continue;
      const of = box.getBoundingClientRect();
      left = Math.max(left, of.left); right = Math.min(right, of.right); top = Math.max(top, of.top); bottom = Math.min(bottom, of.bottom);
    }
    return { left, top, right, bottom, area: Math.max(0, right - left) * Math.max(0, bottom - top) };
  };
  const shared = (a, b) => Math.max(0, Math.min(a.right, b.right) - Math.max(a.left, b.left)) * Math.max(0, Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top));
  // Where its own letters are: a heading is as wide as the page.
  const letters = (one) => {
    const range = document.createRange();
    const nodes = [...one.childNodes].filter((node) => node.nodeType === 3 && node.textContent.trim() !== "");
    range.setStartBefore(nodes[0]);
    range.setEndAfter(nodes.at(-1));
    return range.getBoundingClientRect();
  };
  const pairs = (all, share, of_one = (one) => one.getBoundingClientRect()) => {
    const of = all.map((one) => ({ one, at: rect(one, of_one(one)) })).filter(({ at }) => at.area > 4);
    const found = [];
    for (let i = 0; i < of.length; ++i)
      for (let k = i + 1; k < of.length; ++k) {
        const [a, b] = [of[i], of[k]];
        if (a.one.contains(b.one) || b.one.contains(a.one)) continue;
        if (shared(a.at, b.at) > share * Math.min(a.at.area, b.at.area)) found.push(`${name(a.one)} on ${name(b.one)}`);
      }
    return found;
  };
  const all = [...document.body.querySelectorAll("*")].filter((one) => seen(one) && !one.closest("svg, canvas, [aria-hidden=true]"));
  const controls = all.filter((one) => one.matches("button, select, input:not([type=file]), summary, a[href], textarea"));
  const texts = all.filter((one) => [...one.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim() !== "") && one.getBoundingClientRect().width > 2);
  const root = document.documentElement;
  const hides = (value) => value === "hidden" || value === "clip";
  const faults = [];
  const add = (kind, what) => what.slice(0, 6).forEach((one) => faults.push({ kind, what: one }));
  if (root.scrollWidth > innerWidth) add("runs out of the page", [`${root.scrollWidth} px of ${innerWidth}`, ...all.filter((one) => rect(one).right > innerWidth + 1).map(name).slice(-3)]);
  add("controls overlap", pairs(controls, 0.03));
  add("text overlaps", pairs(texts.filter((one) => !one.matches("option, script, style")), 0.25, letters));
  add("text is cut", texts.filter((one) => {
    const style = getComputedStyle(one);
    return (hides(style.overflowX) && one.scrollWidth > one.clientWidth + 1 && one.clientWidth > 2) || (hides(style.overflowY) && one.scrollHeight > one.clientHeight + 3 && one.clientHeight > 2);
  }).map(name));
  add("select cuts its choice", all.filter((one) => one.matches("select")).filter((one) => {
    const canvas = (window.measuring ??= document.createElement("canvas").getContext("2d"));
    canvas.font = getComputedStyle(one).font;
    return canvas.measureText(one.selectedOptions[0]?.text ?? "").width > one.clientWidth - 6;
  }).map(name));
  add("scrolls sideways", all.filter((one) => /auto|scroll/.test(getComputedStyle(one).overflowX) && one.scrollWidth > one.clientWidth + 2).map((one) => `${name(one)} ${one.scrollWidth} px in ${one.clientWidth}`));
  // 24 px is the least of WCAG 2.2.
  if (innerWidth < 500) add("small for a finger", controls.filter((one) => { const { height, width } = one.getBoundingClientRect(); return !one.matches("[type=range]") && Math.min(height, width) < 24; }).map((one) => { const { height, width } = one.getBoundingClientRect(); return `${name(one)} ${width.toFixed(0)} x ${height.toFixed(0)}`; }));
  const first = [...document.querySelectorAll("main .verdict, .live-loop .verdict, .first")].find(seen);
  return { faults, screens: Number((root.scrollHeight / innerHeight).toFixed(1)), verdict_at: first ? Math.round(first.getBoundingClientRect().top + scrollY) : null };
};

const browser = await launched();
const all = [];
for (const [kind, files] of Object.entries(kinds)) {
  if (wanted.length > 0 && !wanted.includes(kind)) continue;
  for (const [size, viewport] of Object.entries(sizes))
    for (const language of ["en", "de"]) {
      const context = await browser.newContext({ viewport, colorScheme: "light" });
      const page = await context.newPage();
      const wrong = [];
      page.on("pageerror", (error) => wrong.push(`exception: ${error?.message ?? error}`));
      await page.goto(address_of(tool));
      await page.waitForSelector("html[data-ready]", { state: "attached" });
      await page.evaluate(() => window.ballbar?.engine?.ready);
      if (language !== "en") await page.locator(".page-tools select").first().selectOption(language);
      if (!Array.isArray(files)) await page.locator("input[webkitdirectory]").first().setInputFiles(files.folder);
      else if (files.length > 0) await page.locator("input[type=file]:not([webkitdirectory])").first().setInputFiles(files);
      if (kind !== "start") {
        await page.waitForSelector(".live-report main, .live-files .faulty, .live-told:not(:empty)", { timeout: kLong_ms, state: "attached" }).catch(() => wrong.push("nothing came"));
        const idle = () => page.waitForFunction(() => (document.querySelector(".live-work")?.dataset.waiting ?? "0") === "0" && !document.querySelector(".live-loop[aria-busy]"), null, { timeout: kLong_ms }).catch(() => wrong.push("it is not done"));
        for (let k = 0; k < 3; ++k) { await idle(); await page.waitForTimeout(250); }
      }
      for (const look of ["light", "dark"]) {
        await page.emulateMedia({ colorScheme: look });
        await page.waitForTimeout(250);
        const found = await page.evaluate(faults);
        const name = `${kind}-${size}-${look}-${language}`;
        await page.screenshot({ path: join(folder, `${name}.png`), fullPage: true });
        all.push({ name, ...found, wrong: [...wrong] });
        // Light and dark have the same boxes: said once.
        if (look === "light") for (const { kind: of, what } of found.faults) console.log(`${name}: ${of}: ${what}`);
        for (const one of wrong.splice(0)) console.log(`${name}: ${one}`);
      }
      await context.close();
    }
}
await browser.close();
writeFileSync(join(folder, "screens.json"), JSON.stringify(all, null, 1));
const counts = new Map();
for (const { faults } of all) for (const { kind } of faults) counts.set(kind, (counts.get(kind) ?? 0) + 1);
console.log(`${all.length} screens; ${[...counts].map(([kind, count]) => `${kind} ${count}`).join(", ") || "no faults"}`);
process.exitCode = all.some(({ faults, wrong }) => wrong.length > 0 || faults.some(({ kind }) => /out of the page|overlap|cut/.test(kind))) ? 1 : 0;
