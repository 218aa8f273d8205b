// The errors of a machine: the circle and the ranked table on the first screen; what a choice and the switch draw is what
// the page's data say. The data are made up here, so that each number is known.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { drawn, figure, launched, opened, saved, unfold } from "./browser.mjs";
import { drawing, polar } from "./drawing.mjs";
import { data_of, page_with, with_errors } from "./machine_errors.mjs";
import { of_run, report } from "./reports.mjs";

const kPicture = "machine-errors";

let browser, page, wrong, paper, file, part, fit;
before(async () => {
  browser = await launched();
  file = with_errors("errors", await report("b5r", of_run("qc20-style-b5r", "00.b5r")));
  ({ fit, machine_errors: [part] } = data_of(file));
  ({ page, wrong } = await opened(browser, file, { viewport: { width: 1280, height: 800 } }));
  await drawn(page);
  paper = await browser.newPage();
});
after(() => browser.close());

const state = () =>
  page.evaluate((name) => {
    const { chosen, hidden } = window.ballbar.figures.get(name).state();
    return { error: chosen.error, hidden: [...hidden] };
  }, kPicture);

const table = (of = page) => of.locator(".ranked table:visible");
const all_rows = (of = page) => of.locator(".ranked").getByRole("button", { name: /^Show all/ }).click();
const row = (text) => table().locator("tbody tr", { hasText: text }).first();
const cells = async (one) => one.locator("td").allTextContents();
const marked = () => table().locator("tr[aria-current]").evaluateAll((rows) => rows.map((one) => one.cells[0].textContent));
const away = () => page.mouse.move(5, 5);

const about_circle = (k) => fit.recordings[part.recordings[k]].trace.deviation_um.map((value, i) => value - part.circle_um[k][i]);
const without = (error, k) => about_circle(k).map((value, i) => value - part.curves[error][k][i]);

// What the chart has drawn now: { name: [values of each curve of that name] }.
const series = () =>
  page.evaluate((name) => {
    const found = {};
    for (const one of window.ballbar.figures.get(name).chart().getOption().series) {
      if (one.type === "line") (found[one.name] ??= []).push(one.data.map(([value]) => value));
    }
    return found;
  }, kPicture);

const close_to = (found, expected, what) => {
  assert.equal(found.length, expected.length, what);
  found.forEach((value, i) => assert.ok(Math.abs(value - expected[i]) < 1e-5, `${what}, reading ${i}: ${value} for ${expected[i]}`));
};

const choose_none = async () => {
  await figure(page, kPicture).getByRole("combobox", { name: "Error" }).selectOption("");
  await drawn(page);
};

test("first screen: circle and table side by side, both whole", async () => {
  const box = (selector) => page.locator(selector).first().boundingBox();
  const [chart, made, first] = [await box(".side-by-side .chart"), await box(".side-by-side .table"), await box(".side-by-side figure")];
  assert.ok(chart.y + chart.height <= 800, `the circle ends at ${chart.y + chart.height}`);
  assert.ok(made.y + made.height <= 800);
  assert.ok(made.x >= first.x + first.width && Math.abs(made.y - first.y) < 20);
  for (const one of [".summary .table", ".ranked .table"]) {
    const { scrollWidth, clientWidth } = await page.locator(one).evaluate(({ scrollWidth, clientWidth }) => ({ scrollWidth, clientWidth }));
    assert.ok(scrollWidth <= clientWidth, `no column is hidden: ${scrollWidth} of ${clientWidth} px`);
  }
  assert.equal(await page.locator("main > section[id]").first().getAttribute("id"), "machine-errors");
  const [ccw, cw] = ["g_ccw_um", "g_cw_um"].map((key) => fit.iso230_4[key].toFixed(2));
  assert.deepEqual(await page.locator("main .verdict p").allTextContents(), [
    "Mill 7 · 2024-04-16 09:45 · 2000 mm/min",
    `Circular deviation G of XY by ISO 230-4: ${ccw} µm CCW, ${cw} µm CW.`,
    "Squareness is the largest error.",
  ]);
  assert.equal(await page.locator("main .why").textContent(), "Squareness: Square the axes.");
});

test("the summary: ISO 230-4 of the test, its largest error, what mending leaves", async () => {
  const rows = await Promise.all((await page.locator(".summary tbody tr").all()).map(cells));
  const iso = Object.fromEntries(Object.entries(fit.iso230_4).map(([key, value]) => [key, typeof value === "number" ? value.toFixed(2) : ""]));
  assert.deepEqual(rows, [
    ["circular deviation G, CCW / CW", `${iso.g_ccw_um} / ${iso.g_cw_um}`],
    ["G, both directions (2005)", iso.bidirectional_2005_um],
    ["circularity of both runs, one centre", "4.62"],
    ["radial deviation F, CCW", `${iso.f_min_ccw_um} … ${iso.f_max_ccw_um}`],
    ["radial deviation F, CW", `${iso.f_min_cw_um} … ${iso.f_max_cw_um}`],
    ["hysteresis H (1996)", iso.h_um],
    ["largest error", "squareness"],
    ["circularity without it / all", "2.87 / 1.52"],
    ["squareness", "18.0 ± 1.5 µm/m"],
  ]);
});

test("the ranked table: what mending gains; what is not significant behind a button, the program's names on hover", async () => {
  assert.equal(await table().locator("tbody tr").count(), 3);
  await all_rows();
  const rows = await Promise.all((await table().locator("tbody tr").all()).map(cells));
  assert.deepEqual(rows, [
    ["squareness", "18.0 ± 1.5 µm/m", "1.75", "2.87"],
    ["backlash of X +", "1.40 ± 0.13 µm", "1.41 ± 0.20", "3.21"],
    ["backlash of X −", "-0.40 ± 0.13 µm", "", ""],
    ["straightness of Y", "-0.20 ± 0.30 µm", "not significant", "4.55"],
  ]);
  assert.equal(await row("backlash of X −").getAttribute("title"), "backlash_a_neg");
});

test("the page of the error that is chosen stands beside the circle", async () => {
  const leaf = page.locator(".leaf");
  await row("backlash of X +").click();
  await away();
  assert.deepEqual(
    [await leaf.locator("h3").textContent(), await leaf.locator("dt").allTextContents(), await leaf.locator("dd").allTextContents()],
    [
      "Backlash of X",
      ["Here", "Cause", "Looks like", "Confused with", "Distinguished by", "Remedy"],
      [
        "backlash of X +: 1.40 ± 0.13 µm, backlash of X −: -0.40 ± 0.13 µm; correcting it lowers the circularity from 4.62 to 3.21 µm.",
        "Cause of backlash_a.", "Form of backlash_a.", "reversal spike of X, centre drift", "Test of backlash_a.", "Remedy of backlash_a.",
      ],
    ],
  );
  await choose_none();
  assert.ok(await leaf.isHidden());
  await row("squareness").click();
  await away();
  await page.evaluate(() => document.activeElement.blur());
});

test("the circle is magnified by its slider, by the wheel and by keys; 0 gives it back", async () => {
  const made = figure(page, kPicture);
  const chart = made.locator(".chart");
  const times = async () => Number(/[\d.]+/.exec(await made.locator(".magnify output").textContent())[0]);
  const at_first = await times();
  const drawn_with = () => page.evaluate((name) => window.ballbar.figures.get(name).chart().getOption().radiusAxis[0].min, kPicture);
  const near = (value, expected) => assert.ok(Math.abs(value / expected - 1) < 0.06, `${value} for ${expected}`);
  const middle_um = await drawn_with();
  await made.getByRole("slider").focus();
  await page.keyboard.press("End");
  await drawn(page);
  assert.equal(await times(), 50000);
  assert.equal(await drawn_with(), (-1000 * fit.recordings[0].nominal_length_mm) / 50000);
  await made.getByRole("button", { name: "automatic" }).click();
  await drawn(page);
  assert.deepEqual([await times(), await drawn_with()], [at_first, middle_um]);
  // The wheel alone scrolls the page.
  await chart.hover();
  await page.evaluate(() => document.activeElement.blur());
  await page.mouse.wheel(0, -100);
  await drawn(page);
  assert.equal(await times(), at_first);
  await page.evaluate(() => scrollTo(0, 0));
  await chart.hover();
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, -100);
  await page.keyboard.up("Control");
  await page.waitForFunction(([name, was]) => window.ballbar.figures.get(name).state().chosen.magnification !== was, [kPicture, ""]);
  await drawn(page);
  near(await times(), at_first * Math.exp(0.3));
  await chart.focus();
  await page.keyboard.press("0");
  await page.keyboard.press("+");
  await drawn(page);
  near(await times(), 1.25 * at_first);
  await page.keyboard.press("0");
  await drawn(page);
  assert.equal(await times(), at_first);
  await page.evaluate(() => document.activeElement.blur());
  await away();
});

test("the whole table: by rank, what is not significant last, stored values beside", async () => {
  await unfold(page, "machine-errors");
  const whole = page.locator("#machine-errors .table:visible", { hasText: "All errors" });
  const rows = await Promise.all((await whole.locator("tbody tr").all()).map(cells));
  assert.deepEqual(rows, [
    ["squareness", "18.0 ± 1.5", "µm/m", "1.80", "35.3", "1", "17.7 (1)", "17.6 (1)", "yes", "2.87"],
    ["backlash of X +", "1.40 ± 0.13", "µm", "1.40", "27.5", "2", "–", "1.37 (2)", "yes", "3.21"],
    ["backlash of X −", "-0.40 ± 0.13", "µm", "", "", "", "–", "-0.41 (2)", "", ""],
    ["straightness of Y", "-0.20 ± 0.30", "µm", "1.90", "37.3", "not significant", "–", "–", "no", "4.55"],
  ]);
  const bars = await whole.locator("td.bar").evaluateAll((all) => all.map((one) => Number(one.style.getPropertyValue("--share"))));
  close_to(bars, [35.3 / 37.3, 27.5 / 37.3, 1], "bars");
});

test("below: what is left, remedies of the first, the prior, the set-up", async () => {
  await unfold(page, "machine-errors");
  const text = await page.locator("#machine-errors").innerText();
  for (const said of [
    "All of them together leave 0.58 µm rms; CCW and CW repeat to 0.44 µm. Unexplained is a wave of 6 a turn.",
    "pass: circularity 4.6 µm, tolerance 10 µm",
    "squareness: Square the axes.",
    "backlash of X: Adjust the backlash in the control.",
    "lateral play of X +: 0 ± 2.0 µm",
    "(backlash of Y + less backlash of Y −)/2: 0 ± 1.5 µm",
    "scale mismatch with straightness of Y, centre of X",
  ])
    assert.ok(text.includes(said), `${said} is not in ${text}`);
  assert.ok(!text.includes(part.conclusion), "of one test the conclusion is at the head of the page");
  const rows = page.locator("#machine-errors table", { hasText: "not ranked" }).locator("tbody tr");
  const [centre, scale] = await Promise.all((await rows.all()).map(cells));
  const { value } = part.errors.find(({ name }) => name === "centre_a");
  assert.deepEqual(centre, ["centre of X", `${value.toFixed(3)} ± 0.050`, "µm", "1.50"]);
  const stated = page.locator("#machine-errors table", { hasText: "What the file states" }).locator("tbody tr");
  assert.deepEqual(await Promise.all((await stated.all()).map(cells)), [["machine", "Mill 7"], ["operator", "N. N."], ["started", "2024-04-16 09:45"], ["programmed feed", "2000 mm/min"]]);
  assert.deepEqual(scale, ["global scale", "0.500 ± 0.040", "µm", "–"]);
});

// The dark ring has no name: it is the nominal circle, and no curve.
test("at first the largest error is drawn, without the switch", async () => {
  assert.deepEqual(await state(), { error: "squareness", hidden: ["without"] });
  const found = await series();
  assert.deepEqual(Object.keys(found).sort(), ["", "measured, CCW", "measured, CW", "squareness"]);
  for (const k of [0, 1]) {
    close_to(found.squareness[k], part.curves.squareness[k], "squareness");
    close_to(found[`measured, ${["CCW", "CW"][k]}`][0], about_circle(k), "measured");
  }
  assert.deepEqual(await marked(), ["squareness"]);
});

test("a click draws an error's curve, and keeps it; under the pointer it is shown for as long", async () => {
  await row("backlash of X −").click();
  await away();
  await drawn(page);
  assert.equal((await state()).error, "backlash_a");
  assert.deepEqual(await marked(), ["backlash of X +", "backlash of X −"]);
  const found = await series();
  for (const k of [0, 1]) close_to(found["backlash of X"][k], part.curves.backlash_a[k], "backlash");
  await page.evaluate(() => document.activeElement.blur());
  await row("straightness of Y").hover();
  await drawn(page);
  assert.equal((await state()).error, "straightness_b");
  await away();
  await drawn(page);
  assert.equal((await state()).error, "backlash_a");
});

test("keys: arrows choose, space takes the error off, and what is chosen stays when the focus goes", async () => {
  await row("squareness").focus();
  await drawn(page);
  assert.equal((await state()).error, "squareness");
  for (const error of ["backlash_a", "backlash_a", "straightness_b"]) {
    await page.keyboard.press("ArrowDown");
    await drawn(page);
    assert.equal((await state()).error, error);
  }
  await page.keyboard.press("Home");
  await page.keyboard.press(" ");
  await drawn(page);
  const found = await series();
  for (const k of [0, 1]) close_to(found["without it"][k], without("squareness", k), "without squareness");
  assert.ok(await figure(page, kPicture).getByRole("checkbox", { name: "without it" }).isChecked());
  await page.keyboard.press("ArrowDown");
  await drawn(page);
  for (const [k, values] of (await series())["without it"].entries()) close_to(values, without("backlash_a", k), "without backlash");
  await page.keyboard.press("End");
  await page.keyboard.press("Tab");
  await drawn(page);
  assert.equal((await state()).error, "straightness_b");
  // By its own switch.
  await figure(page, kPicture).getByRole("checkbox", { name: "without it" }).focus();
  await page.keyboard.press("Space");
  await drawn(page);
  assert.equal((await series())["without it"], undefined);
});

test("the list chooses too, and “none” draws the readings alone", async () => {
  await figure(page, kPicture).getByRole("combobox", { name: "Error" }).selectOption({ label: "straightness of Y" });
  await drawn(page);
  assert.deepEqual(await marked(), ["straightness of Y"]);
  assert.ok((await series())["straightness of Y"]);
  await choose_none();
  assert.deepEqual(Object.keys(await series()).sort(), ["", "measured, CCW", "measured, CW"]);
  assert.deepEqual(await marked(), []);
});

test("files: the drawing by the ruler, the numbers, the caption", async () => {
  await row("backlash of X +").click();
  await away();
  await figure(page, kPicture).getByRole("checkbox", { name: "without it" }).check();
  await drawn(page);
  const csv = await saved(page, kPicture, "CSV");
  const [head, ...rows] = readFileSync(csv.path, "utf8").trimEnd().split("\r\n").map((one) => one.split(","));
  assert.deepEqual(head, ["angle_deg", ...["ccw", "cw"].flatMap((way) => [`measured_${way}_um`, `backlash_a_${way}_um`, `without_${way}_um`])]);
  const n = part.curves.backlash_a[0].length;
  const column = (name, from, to) => rows.slice(from, to).map((one) => Number(one[head.indexOf(name)]));
  close_to(column("without_ccw_um", 0, n), without("backlash_a", 0), "without, CCW");
  close_to(column("without_cw_um", n), without("backlash_a", 1), "without, CW");
  close_to(column("backlash_a_cw_um", n), part.curves.backlash_a[1], "backlash, CW");

  const svg = await saved(page, kPicture, "SVG");
  const found = await drawing(paper, svg.path);
  const { place, per_px } = polar(found);
  assert.ok(per_px < 0.2, `${per_px} um a pixel`);
  const hue = await page.evaluate((name) => {
    const { picture, state } = window.ballbar.figures.get(name);
    return Object.fromEntries(picture.toggles(state()).map(({ key, colour }) => [key, colour(false)]));
  }, kPicture);
  const drawn_in = (colour) => found.paths.filter((one) => one.stroke === colour && !one.legend && one.points.length > 100).map((one) => one.points);
  for (const [key, values] of [["without", without("backlash_a", 0)], ["error", part.curves.backlash_a[0]], ["trace0", about_circle(0)]]) {
    const [line] = drawn_in(hue[key]);
    const angles = fit.recordings[part.recordings[0]].trace.angle_deg;
    // Readings less than a pixel apart are one point of the line.
    const places = angles.map((angle, i) => place(angle, values[i]));
    const nearest = (points, [x, y]) => Math.min(...points.map(([px, py]) => Math.hypot(x - px, y - py)));
    line.forEach((point, i) => assert.ok(nearest(places, point) < 1.2, `${key}: point ${i} is at no reading`));
    places.forEach((one, i) => assert.ok(nearest(line, one) < 1.7, `${key}: reading ${i} is not drawn`));
  }
  const said = found.texts.map(({ text }) => text);
  for (const text of ["Errors on the circle, backlash of X", "circularity 4.62 µm", "without backlash of X: 3.21 µm", "backlash of X", "without it"])
    assert.ok(said.includes(text), `${text} is not in ${said}`);
  await figure(page, kPicture).getByRole("checkbox", { name: "without it" }).uncheck();
});

test("several tests: a list chooses one, and the table is its own", async () => {
  const folder_file = with_errors("errors-of-a-folder", await report("b5r-folder", of_run("qc20-style-b5r")));
  const { machine_errors: parts, fit } = data_of(folder_file);
  assert.ok(parts.length > 2);
  const { page: many, wrong, close } = await opened(browser, folder_file);
  await drawn(many);
  await unfold(many, "machine-errors");
  const value = (k) => parts[k].errors.find(({ name }) => name === "centre_a").value.toFixed(3);
  const set_up = () => many.locator("#machine-errors table:visible", { hasText: "not ranked" }).innerText();
  assert.equal(await table(many).count(), 1);
  // The worst is that of the largest G. Each has a row, and its numbers of ISO 230-4.
  assert.equal(await many.locator(".first .summary tbody tr").count(), parts.length);
  const larger = ({ g_ccw_um, g_cw_um }) => Math.max(g_ccw_um, g_cw_um);
  const g = fit.iso230_4_pairs.reduce((most, one) => (larger(one) > larger(most) ? one : most));
  const worst = fit.iso230_4_pairs.indexOf(g);
  assert.match(await many.locator(".verdict").innerText(), new RegExp(`is the worst of ${parts.length} tests: circular deviation G ${g.g_ccw_um.toFixed(2)} µm CCW`));
  assert.ok((await set_up()).includes(value(worst)));
  await figure(many, kPicture).getByRole("combobox", { name: "Test" }).selectOption({ index: 2 });
  await drawn(many);
  assert.equal(await table(many).count(), 1);
  assert.ok((await set_up()).includes(value(2)));
  // Rows that are made later choose as well.
  await many.locator(".ranked button:visible").click();
  await table(many).locator("tbody tr", { hasText: "straightness of Y" }).click();
  await drawn(many);
  const curve = await many.evaluate((name) => window.ballbar.figures.get(name).chart().getOption().series.find((one) => one.name === "straightness of Y").data.length, kPicture);
  assert.equal(curve, fit.recordings[parts[2].recordings[0]].readings);
  const [chart, made] = [await many.locator(".first .side-by-side .chart").boundingBox(), await table(many).boundingBox()];
  assert.ok(chart.y + chart.height <= 900 && made.x > chart.x);
  assert.ok((await many.pdf({ format: "A4" })).length > 1000);
  assert.deepEqual(wrong, []);
  await close();
});

test("on a narrow screen the table is below the circle", async () => {
  const { page: narrow, close } = await opened(browser, file, { viewport: { width: 400, height: 800 } });
  await drawn(narrow);
  const [chart, made] = [await narrow.locator(".side-by-side .chart").boundingBox(), await table(narrow).boundingBox()];
  assert.ok(made.y >= chart.y + chart.height);
  assert.ok(chart.y + chart.height <= 900, `the circle ends at ${chart.y + chart.height}`);
  assert.ok((await narrow.evaluate(() => document.documentElement.scrollWidth)) <= 400);
  await close();
});

test("a test of one direction, and values that are not known", async () => {
  const data = data_of(file);
  const one = data.machine_errors[0];
  const errors = one.errors.map((row) => ({ ...row, sigma: null, predicts_other_run: null, significant: null, rank: null, share_percent: null, circularity_without_um: null, circularity_gain_um: null }));
  const curves = Object.fromEntries(Object.entries(one.curves).map(([name, [first]]) => [name, [first.map((value, i) => (i % 7 ? value : null))]]));
  const alone = { ...one, errors, curves, recordings: one.recordings.slice(0, 1), circle_um: one.circle_um.slice(0, 1), repeatability_um: null, left_text: "", file: undefined, tolerances: [], prior: [], undetermined: [] };
  const { page: few, wrong, close } = await opened(browser, page_with("errors-of-one", file, { ...data, machine_errors: [alone] }));
  await drawn(few);
  await unfold(few, "machine-errors");
  await all_rows(few);
  await few.mouse.move(5, 5); // off the row that came in the place of the button
  await drawn(few);
  assert.deepEqual(await cells(few.locator("#machine-errors .table", { hasText: "All errors" }).locator("tbody tr", { hasText: "squareness" })), ["squareness", "18.04 ± ?", "µm/m", "1.80", "–", "not significant", "17.7 (1)", "17.63 (1)", "–", "–"]);
  const chosen = await few.evaluate((name) => window.ballbar.figures.get(name).state().chosen.error, kPicture);
  assert.equal(chosen, "", "what is not significant is not drawn at first");
  await table(few).locator("tr.chooses", { hasText: "squareness" }).click();
  await drawn(few);
  assert.doesNotMatch(await few.locator("#machine-errors").innerText(), /NaN|undefined|null|Remedies|prior|Tolerances|states/);
  assert.deepEqual(wrong, []);
  await close();
});

test("console and network are quiet", () => assert.deepEqual(wrong, []));
