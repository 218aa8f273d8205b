// Every picture of every sample run is drawn, with each of its choices and each of its curves, in an ordinary window;
// nothing is written to the console, nothing is loaded, and axe-core finds no serious fault, on a light page and a dark.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launched, opened, seen, unfold } from "./browser.mjs";
import { long_series } from "./long_series.mjs";
import { with_errors } from "./machine_errors.mjs";
import { strange_log } from "./strange_log.mjs";
import { batch, folder, grown, hidden_effect, history, of_run, report, two_arcs } from "./reports.mjs";

const axe = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");

const recordings = ["recording-circle", "recording-unrolled"];
const all_tests = ["tests-circle", "tests-unrolled"];
const model = (target) => ["fit", "residual", "effects", "steps"].map((name) => `model-${target}-${name}`);
const diagnosis = ["with-without", "candidates", "fall", "coherence"];
const comparison = ["comparison-x", "comparison-y", "comparison-z"];

const cases = [
  ["two-arcs", two_arcs, ["drift", "five-probe", "five-probe-tilt", "speed", "temperatures", ...comparison, ...recordings, ...all_tests, ...model("y_um"), ...diagnosis.filter((one) => one !== "fall")]],
  ["spindle-rotation", (name) => report(name, of_run("spindle-rotation-huang2022")), ["drift", "speed", "temperatures", ...recordings, ...all_tests, "axial"]],
  ["b5r", (name) => report(name, of_run("qc20-style-b5r", "00.b5r"), "--diagnose"), ["machine-errors", "machine-errors-without", ...recordings, ...model("deviation_um").slice(0, 3)]],
  ["b5r-folder", (name) => report(name, of_run("qc20-style-b5r")), ["machine-errors", "machine-errors-without", "drift", ...recordings, ...all_tests]],
  [
    "errors",
    async (name) => with_errors(name, await report(`${name}-of`, of_run("qc20-style-b5r"))),
    ["machine-errors", "machine-errors-without", "drift", ...recordings, ...all_tests],
  ],
  ["five-probe", (name) => report(name, of_run("two-arcs-he2015", "five-probe.csv")), ["five-probe", "five-probe-tilt", "measured"]],
  ["hidden-effect", hidden_effect, ["measured", "speed", "temperatures", ...model("y_um"), ...diagnosis, "ledger"]],
  ["strange-log", strange_log, ["measured", "signals-x", "temperatures", ...model("z_um").slice(0, 2), ...diagnosis]],
  ["grown", grown, ["five-probe", "measured", "speed", "temperatures", ...model("ch1_um"), "ledger-forecasts"]],
  ["batch", batch, ["measured", "speed", "temperatures", "batch", "batch-range", "batch-weights"]],
  ["history", history, ["history-1", "history-2", "history-3"]],
  ["million-rows", (name) => report(name, long_series(join(folder, "million.csv"), 1e6)), ["measured", "temperatures"]],
  [
    "spindle-46h",
    (name) => report(name, of_run("spindle-46h", "measured.csv"), "--model", of_run("spindle-46h", "speed.toml"), "--target", "ch3_um"),
    ["five-probe", "measured", "speed", "temperatures", ...model("ch3_um"), ...diagnosis],
  ],
];

const in_the_dark = ["two-arcs", "errors", "hidden-effect", "batch"]; // all kinds of sections; colours are the only difference

let browser;
const pages = {};
before(async () => {
  for (const [name, make] of cases) {
    pages[name] = make(name);
    pages[name].catch(() => {}); // is thrown where it is awaited
  }
  browser = await launched();
});
after(() => browser.close());

// In the page: what is wrong with the picture as it is now, and with its choices and curves.
const faults = async (name) => {
  const figure = window.ballbar.figures.get(name);
  const { picture, element } = figure;
  const found = [];
  const frame = () => new Promise(requestAnimationFrame);

  const plots = () => {
    const all = [];
    const model = figure.chart().getModel();
    model.eachComponent("grid", (grid) => all.push(grid.coordinateSystem.getRect()));
    model.eachComponent("polar", ({ coordinateSystem: { cx, cy }, coordinateSystem: polar }) => {
      const radius = Math.max(...polar.getRadiusAxis().getExtent());
      all.push({ x: cx - radius, y: cy - radius, width: 2 * radius, height: 2 * radius });
    });
    return all;
  };
  // Of each plot the pixels, from all layers that there are.
  const copy = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
  const pixels = () => {
    const layers = [...element.querySelectorAll(".canvas canvas")];
    const scale = layers[0].width / layers[0].clientWidth;
    Object.assign(copy.canvas, { width: layers[0].width, height: layers[0].height });
    for (const layer of layers) copy.drawImage(layer, 0, 0);
    return plots().map(({ x, y, width, height }) => copy.getImageData(scale * x, scale * y, scale * width, scale * height).data);
  };
  // Those of no grey, as axes and grids are, until there are so many.
  const coloured = (data, enough) => {
    let count = 0;
    for (let k = 0; k < data.length && count < enough; k += 4) {
      const most = Math.max(data[k], data[k + 1], data[k + 2]);
      const least = Math.min(data[k], data[k + 1], data[k + 2]);
      if (data[k + 3] > 100 && most - least > 50) ++count;
    }
    return count;
  };
  const differing = (a, b) => {
    let count = 0;
    for (const [plot, data] of a.entries()) {
      if (data.length !== b[plot].length) return Infinity;
      const [all, others] = [new Uint32Array(data.buffer), new Uint32Array(b[plot].buffer)];
      for (let k = 0; k < all.length; ++k) {
        if (all[k] === others[k]) continue;
        for (let c = 4 * k; c < 4 * k + 4; ++c) if (Math.abs(data[c] - b[plot][c]) > 16) ++count;
      }
    }
    return count;
  };
  // A change is drawn with the next frame, and what is much in parts, a frame each; then the chart says so.
  let finished = false;
  figure.chart().on("finished", () => (finished = true));
  const drawn_after = async (change) => {
    finished = false;
    change();
    await frame();
    for (let k = 0; k < 60 && !finished; ++k) await frame();
    if (!finished) found.push("is not drawn, or for ever");
    return pixels();
  };
  const numbers_in = (data) => (data ?? []).flat(3).filter((one) => Number.isFinite(one?.value ?? one) || Array.isArray(one?.value)).length;

  const look = async (what, change) => {
    const drawn = await drawn_after(change);
    const state = figure.state();
    const option = picture.draw(state);
    const series = [option.series].flat();
    if (series.reduce((sum, one) => sum + numbers_in(one?.data), 0) === 0) found.push(`${what}: nothing to draw`);
    if (drawn.length === 0) found.push(`${what}: no plot`);
    drawn.forEach((plot, k) => coloured(plot, 20) < 20 && found.push(`${what}: plot ${k} is empty`));
    const { columns } = picture.numbers(state);
    const rows = columns.map(({ values }) => values.length);
    if (columns.length < 2 || Math.min(...rows) < 1) found.push(`${what}: no numbers`);
    if (new Set(rows).size > 1) found.push(`${what}: columns of ${rows} rows`);
    if (new Set(columns.map((column) => column.name)).size < columns.length) found.push(`${what}: columns of the same name`);
    return drawn;
  };

  let before = await look("at first", figure.redraw);
  const selects = [...element.querySelectorAll(".choice select")];
  const lists = (picture.choices ?? []).filter(({ slider }) => !slider).length;
  if (selects.length !== lists) found.push(`${selects.length} lists for ${lists} choices`);
  for (const [k, select] of selects.entries()) {
    const values = [...select.options].map((option) => option.value);
    const at_first = select.value;
    const sample = new Set([values[0], values[values.length >> 1], values[values.length - 1]]);
    sample.delete(at_first);
    for (const value of sample.size > 0 ? [...sample, at_first] : []) {
      before = await look(`${picture.choices[k].key} ${value}`, () => {
        select.value = value;
        select.dispatchEvent(new Event("change", { bubbles: true }));
      });
    }
  }

  const boxes = () => [...element.querySelectorAll(".legend input")];
  for (const k of new Set([0, boxes().length - 1])) {
    if (!boxes()[k]) continue;
    const name = boxes()[k].closest("label").textContent;
    const on = boxes()[k].checked;
    const between = await drawn_after(() => boxes()[k].click());
    if (boxes()[k].checked === on) found.push(`${name}: its box does not change`);
    if (differing(between, before) === 0) found.push(`${name}: switched, the picture is the same`);
    const after = await drawn_after(() => boxes()[k].click());
    if (differing(after, before) > 0) found.push(`${name}: switched twice, the picture is another`);
  }
  return found;
};

// Serious or critical faults, with where they are.
const axe_faults = async (page, rules) => {
  const { violations } = await page.evaluate(
    ([rules]) => axe.run(document, { resultTypes: ["violations"], ...(rules ? { runOnly: rules } : {}) }),
    [rules],
  );
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes.length} times, as ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`);
};

const looked_at = async (t, name, expected) => {
  const { page, wrong, close } = await opened(browser, await pages[name]);
  try {
    const found = await page.$$eval("figure[data-picture]", (all) => all.map((one) => one.dataset.picture));
    assert.deepEqual(found.sort(), [...expected].sort());
    for (const picture of expected) {
      await t.test(picture, async () => {
        await seen(page, picture);
        assert.deepEqual(await page.evaluate(faults, picture), []);
      });
    }
    await t.test("no wider than the window", async () => {
      for (const width of [400, 1100]) {
        await page.setViewportSize({ width, height: 900 });
        assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= width);
      }
    });
    await t.test("accessible", async () => {
      await unfold(page);
      await page.evaluate(axe);
      assert.deepEqual(await axe_faults(page), []);
      if (!in_the_dark.includes(name)) return;
      await page.getByRole("button", { name: "Dark", exact: true }).click();
      assert.deepEqual(await axe_faults(page, ["color-contrast", "link-in-text-block"]), []);
    });
    await t.test("console and network are quiet", () => assert.deepEqual(wrong, []));
  } finally {
    await close();
  }
};

// Two pages at a time: each waits for its frames.
test("pictures", { concurrency: 2 }, (t) =>
  Promise.all(cases.map(([name, , expected]) => t.test(name, { concurrency: 1 }, (t) => looked_at(t, name, expected)))),
);
