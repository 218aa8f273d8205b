// One ballbar test on one sheet: printed by the browser, and written as PDF by the program.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { figure, launched, opened, seen } from "./browser.mjs";
import { folder, of_run, report, run } from "./reports.mjs";

let browser, late;
before(async () => {
  browser = await launched();
  // Limits as a file may state them, and a calibration of two years before.
  const spec =
    '<ANALYSIS_SPEC NAME="ISO230_4" version="1996"><FEATURE_SPEC NAME="AF_CIRCULAR_DEVIATION_CCW" DT="UT_LENGTH_UM"><TOLERANCE LEVEL="ERROR">' +
    "<UPPER_LIMIT>5</UPPER_LIMIT></TOLERANCE></FEATURE_SPEC></ANALYSIS_SPEC>";
  const text = readFileSync(of_run("qc20-style-b5r", "00.b5r"), "utf8");
  late = join(folder, "late.b5r");
  writeFileSync(
    late,
    text.replace("</INSTRUMENT>", `</INSTRUMENT>${spec}`).replace("</MODEL>", "</MODEL><LAST_CALIBRATED>20240115</LAST_CALIBRATED>"),
  );
});
after(() => browser.close());

const pages_in = (pdf) => (pdf.toString("latin1").match(/\/Type\s*\/Page\b/g) ?? []).length;

// The sheet as the picture that is printed.
const sheet_of = (page) =>
  page.evaluate(async () => {
    const image = document.querySelector(".handover img");
    await image.decode();
    const svg = decodeURIComponent(image.src.slice(image.src.indexOf(",") + 1));
    const canvas = document.createElement("canvas");
    Object.assign(canvas, { width: image.naturalWidth, height: image.naturalHeight });
    const paper = canvas.getContext("2d", { willReadFrequently: true });
    paper.drawImage(image, 0, 0);
    const { data } = paper.getImageData(0, 0, canvas.width, canvas.height);
    const ink = (x, y, width, height) => {
      let count = 0;
      for (let j = y; j < y + height; ++j) {
        for (let i = x; i < x + width; ++i) if (data[4 * (j * canvas.width + i)] < 0xa0) ++count;
      }
      return count;
    };
    const beyond = ink(0, 0, 20, canvas.height) + ink(canvas.width - 20, 0, 20, canvas.height);
    return { words: [...svg.matchAll(/<text[^>]*>([^<]*)</g)].map(([, one]) => one), size: [canvas.width, canvas.height], circle: ink(42, 280, 400, 320), beyond };
  });

test("the sheet has what a customer asks for, with the error that is chosen", async () => {
  const file = await report("handover", late);
  const { page, wrong, close } = await opened(browser, file);
  await page.waitForFunction(() => document.querySelector(".handover img").src !== "");
  const sheet = await sheet_of(page);
  assert.deepEqual(sheet.size, [794, 1123]);
  assert.ok(sheet.circle > 500, `a circle of ${sheet.circle} dark pixels`);
  assert.equal(sheet.beyond, 0, "text runs into the margins");
  const all = sheet.words.join("\n");
  for (const words of ["machine", "operator", "Calibration ran out", "ISO 230-4", "circular deviation G, CCW", "fail", "Signature", "scale mismatch", "magnified"]) {
    assert.ok(all.includes(words), `${words} in ${all}`);
  }
  await seen(page, "machine-errors");
  await figure(page, "machine-errors").locator("select").first().selectOption("backlash_a");
  await page.waitForFunction(() => decodeURIComponent(document.querySelector(".handover img").src).includes("Errors on the circle, backlash of X"));
  assert.deepEqual(wrong, []);
  await close();
});

test("it is the first page of print, and the only one where its button asks for it", async () => {
  const file = await report("handover", late);
  const { page, wrong, close } = await opened(browser, file);
  await page.waitForFunction(() => document.querySelector(".handover img").src !== "");
  assert.ok(await page.locator(".handover").isHidden());
  const whole = await page.pdf({ preferCSSPageSize: true });
  assert.ok(pages_in(whole) > 1);
  await page.evaluate(() => {
    window.print = () => (window.asked = document.documentElement.dataset.print);
  });
  await page.getByRole("button", { name: "One page to hand over" }).click();
  await page.waitForFunction(() => window.asked !== undefined);
  assert.equal(await page.evaluate(() => window.asked), "handover");
  await page.evaluate(() => (document.documentElement.dataset.print = "handover"));
  const sheet = await page.pdf({ preferCSSPageSize: true });
  assert.equal(pages_in(sheet), 1);
  assert.deepEqual(wrong, []);
  await close();
});

// What stands on the first screen, and where it comes from.
for (const [name, words, sheet_words] of [
  ["several-planes", [of_run("machine-history", "2026-01-19")], ["XY is the worst of 3 planes", "ISO 230-4, all 3 tests", "2026-01-19 08:05 – 2026-01-19 09:15", "XY.b5r, YZ.b5r, ZX.b5r", "magnified"]],
  ["drift", [of_run("two-arcs-he2015")], ["Thermal distortion by a rotating spindle", "Largest drift: combined 32.46", "Drift of the spindle", "00-a.csv", "T_room_degC", "stable after", "Made by ballbar"]],
  ["verdict", [of_run("hidden-effect", "01", "data.csv"), "--model", of_run("hidden-effect", "01", "model.toml"), "--diagnose"], ["Missing from the model of y_um", "Candidates", "data.csv, model.toml", "Signature"]],
]) {
  test(`a sheet of ${name}: conclusion, picture, numbers, provenance, on one page`, async () => {
    const { page, wrong, close } = await opened(browser, await report(`sheet-${name}`, ...words));
    await page.waitForFunction(() => document.querySelector(".handover img").src !== "");
    const sheet = await sheet_of(page);
    assert.deepEqual(sheet.size, [794, 1123]);
    assert.equal(sheet.beyond, 0, "text runs into the margins");
    const all = sheet.words.join(" ");
    for (const one of sheet_words) assert.ok(all.includes(one), `${one} in ${all}`);
    await page.evaluate(() => (document.documentElement.dataset.print = "handover"));
    assert.equal(pages_in(await page.pdf({ preferCSSPageSize: true })), 1);
    assert.deepEqual(wrong, []);
    await close();
  });
}

test("--format pdf: one page of the same drawing", (t) => {
  const out = join(folder, "handover.pdf");
  try {
    run("report", late, "--format", "pdf", "--choose", "error=backlash_a", "--out", out);
  } catch (error) {
    if (String(error.stderr).includes("built without PDF")) return t.skip("built without PDF");
    throw error;
  }
  const pdf = readFileSync(out);
  assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
  assert.throws(() => run("report", of_run("qc20-style-b5r"), "--format", "pdf", "--out", out), /expected one ballbar test/);
  assert.throws(() => run("report", late, "--format", "pdf", "--choose", "error=none-such", "--out", out), /expected one of these/);
});
