// What is drawn, read out and saved is what the other commands print and what the files hold. Drawings are measured in
// the saved SVG: the numbers at its axes tell what a pixel means, and a mark may be one pixel beside its place.
import assert from "node:assert/strict";
import { readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { launched, opened, figure, saved, seen } from "./browser.mjs";
import { axes, drawing, lines, marks, polar } from "./drawing.mjs";
import { folder, grown, grown_model, json_of, of_run, report, run as ballbar, two_arcs } from "./reports.mjs";
import { session } from "./session.mjs";

const run = of_run("two-arcs-he2015");
const drift = json_of("drift", run);
const checked = json_of("check", run, "--model", join(run, "model.toml"));

let browser, page, wrong, paper;
before(async () => {
  browser = await launched();
  ({ page, wrong } = await opened(browser, await two_arcs()));
  paper = await browser.newPage();
});
after(() => browser.close());

// Rows of numbers below a line of names; of a file of ours or of a page. Text stays text.
const table = (text) => {
  const [head, ...rows] = text
    .split(/\r?\n/)
    .filter((row) => row !== "" && !row.startsWith("#"))
    .map((row) => row.split(","));
  const read = (field) => (field === "" ? null : Number.isNaN(Number(field)) ? field : Number(field));
  return Object.fromEntries(head.map((name, k) => [name, rows.map((row) => read(row[k]))]));
};

const csv = async (name, of = page) => {
  await seen(of, name);
  const file = await saved(of, name, "CSV");
  assert.equal(file.name, `${name}.csv`);
  return table(readFileSync(file.path, "utf8"));
};

const svg = async (name, of = page) => {
  await seen(of, name);
  const file = await saved(of, name, "SVG");
  assert.equal(file.name, `${name}.svg`);
  return drawing(paper, file.path);
};

// As printed: the page's data have seven digits or more.
const close_to = (found, expected, what, off = 0) => {
  assert.equal(found.length, expected.length, `${what}: ${found.length} values for ${expected.length}`);
  expected.forEach((value, k) => {
    if (value === null || value === undefined) return assert.equal(found[k], null, `${what}, row ${k}`);
    const apart = Math.abs(found[k] - value);
    assert.ok(apart <= Math.max(off, 2e-6 * Math.abs(value), 2e-6), `${what}, row ${k}: ${found[k]} for ${value}`);
  });
};

const colour = (name, key, of = page) =>
  of.evaluate(
    ([name, key]) => {
      const { picture, state } = window.ballbar.figures.get(name);
      return picture.toggles(state()).find((one) => one.key === key).colour(false);
    },
    [name, key],
  );

const min = (points) => points.map((point) => point.time_s / 60);
const of = (points, key) => points.map((point) => point[key] ?? null);

// Points [x, y] that lie where they should, to a pixel of these axes.
const lie_at = (points, x, y, scale, what) => {
  close_to(points.map((point) => point[0]), x, `${what}, x`, scale.x.per_px);
  close_to(points.map((point) => point[1]), y, `${what}, y`, scale.y.per_px);
};

test("drift: marks and lines of the SVG are at the values of `drift --json`", async () => {
  const drawn = await svg("drift");
  const scale = axes(drawn);
  assert.ok(scale.y.per_px < 0.2, `${scale.y.per_px} um a pixel`); // else a pixel would tell nothing
  for (const axis of ["x", "y", "z"]) {
    const hue = await colour("drift", `${axis}_um`);
    lie_at(marks(drawn, scale, hue), min(drift.points), of(drift.points, `${axis}_um`), scale, axis);
    lie_at(lines(drawn, scale, hue)[0], min(drift.points), of(drift.points, `${axis}_um`), scale, `line of ${axis}`);
  }
});

test("drift: the canvas has each curve's colour at its points", async () => {
  await seen(page, "drift");
  const expected = ["x", "y", "z"].map((axis) => drift.points.map((point) => [point.time_s / 60, point[`${axis}_um`]]));
  const missing = await page.evaluate((expected) => {
    const one = window.ballbar.figures.get("drift");
    const toggles = one.picture.toggles(one.state());
    const canvas = one.element.querySelector(".canvas canvas");
    const scale = canvas.width / canvas.clientWidth;
    const copy = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
    Object.assign(copy.canvas, { width: canvas.width, height: canvas.height });
    copy.drawImage(canvas, 0, 0);
    const found = [];
    expected.forEach((points, k) => {
      const hue = toggles[k].colour(one.state().look.dark).match(/\w\w/g).map((part) => parseInt(part, 16));
      for (const point of points) {
        const [x, y] = one.chart().convertToPixel({ gridIndex: 0 }, point);
        const { data } = copy.getImageData(Math.round(scale * x) - 3, Math.round(scale * y) - 3, 7, 7);
        let near = 0;
        for (let i = 0; i < data.length; i += 4) if (hue.every((part, c) => Math.abs(data[i + c] - part) < 40)) ++near;
        if (near < 3) found.push(`${toggles[k].label} at ${point}`);
      }
    });
    return found;
  }, expected);
  // Three curves begin at 0, where the last one drawn is on top.
  assert.deepEqual(missing.filter((one) => !/ at 0,0$/.test(one)), []);
});

test("drift: keys read the values out", async () => {
  await seen(page, "drift");
  const chart = figure(page, "drift").locator(".chart");
  await chart.focus();
  const voice = page.locator("[aria-live]");
  for (const [k, point] of drift.points.entries()) {
    await page.keyboard.press(".");
    const said = await voice.textContent();
    const value = (name) => Number(new RegExp(`(?:^|, )${name} (-?[\\d.]+) (?:min|µm)`).exec(said)?.[1]);
    const five_digits = (expected) => 5e-5 * Math.abs(expected) + 1e-9;
    for (const [name, expected] of [["time", point.time_s / 60], ["x", point.x_um], ["y", point.y_um], ["z", point.z_um]]) {
      assert.ok(Math.abs(value(name) - expected) <= five_digits(expected), `${k}: ${said}: ${name} is ${expected}`);
    }
  }
  await page.keyboard.press(",");
  assert.match(await voice.textContent(), new RegExp(`^time ${drift.points[drift.points.length - 2].time_s / 60} min`));
});

test("drift: the CSV has the values of `drift --json`", async () => {
  const found = await csv("drift");
  close_to(found.time_min, min(drift.points), "time");
  for (const axis of ["x", "y", "z"]) {
    close_to(found[`${axis}_um`], of(drift.points, `${axis}_um`), axis);
    close_to(found[`${axis}_sigma_um`], of(drift.points, `${axis}_sigma_um`), `sigma of ${axis}`);
  }
  assert.deepEqual(Object.keys(found), ["time_min", "x_um", "x_sigma_um", "y_um", "y_sigma_um", "z_um", "z_sigma_um"]);
});

test("drift: the table of the page", async () => {
  const rows = await page.locator("table", { hasText: "Largest drift" }).first().locator("tbody tr").allTextContents();
  const largest = (axis) => drift.points.reduce((most, one) => (Math.abs(one[`${axis}_um`]) > Math.abs(most[`${axis}_um`]) ? one : most));
  ["x", "y", "z"].forEach((axis, k) => {
    const point = largest(axis);
    const digits = (value) => value.toFixed(3).replace(".", "\\.");
    assert.match(rows[k], new RegExp(`^${axis}, µm${digits(point[`${axis}_um`])} ± ${digits(point[`${axis}_sigma_um`])}${point.time_s / 60}`));
  });
});

test("drift: bars of one standard deviation", async () => {
  const noisy = session(join(folder, "noisy"), { tests: 4, readings: 400, sigma_um: 30 });
  const { points } = json_of("drift", noisy);
  const { page: one, close } = await opened(browser, await report("noisy", noisy));
  const drawn = await svg("drift", one);
  const scale = axes(drawn);
  const hue = await colour("drift", "y_um", one);
  const bars = drawn.paths.filter((path) => path.stroke === hue && path.points.length === 2);
  for (const point of points.filter((one) => one.y_sigma_um > 0)) {
    const x_at = (path) => Math.abs(scale.x.at(path.x) - point.time_s / 60) <= 2 * scale.x.per_px;
    const upright = bars.find((path) => x_at(path) && Math.abs(path.points[0][0] - path.points[1][0]) < 0.5);
    assert.ok(upright, `no bar at ${point.time_s} s`);
    const ends = upright.points.map(([, y]) => scale.y.at(y)).sort((a, b) => a - b);
    close_to(ends, [point.y_um - point.y_sigma_um, point.y_um + point.y_sigma_um], "ends of a bar", scale.y.per_px);
  }
  await close();
});

test("comparison: both series and their difference are those of `compare --json`", async () => {
  const { axes: compared } = json_of("compare", run);
  const { points } = compared.y;
  const found = await csv("comparison-y");
  for (const key of ["a_um", "b_um", "difference_um", "sigma_um"]) close_to(found[key], of(points, key), key);
  const drawn = await svg("comparison-y");
  const [upper, lower] = [axes(drawn, 0), axes(drawn, 1)];
  // The difference has marks of the same colour, below the axis.
  const of_a = marks(drawn, upper, await colour("comparison-y", "a")).filter(([, value]) => value > -2);
  lie_at(of_a, min(points), of(points, "a_um"), upper, "a");
  lie_at(lines(drawn, upper, await colour("comparison-y", "b"))[0], min(points), of(points, "b_um"), upper, "b");
  const [dashed] = lines(drawn, lower, await colour("comparison-y", "difference"));
  lie_at(dashed, min(points), of(points, "difference_um"), lower, "difference");
});

// Beside the ball x and y disagree, z agrees.
test("compare --plot: in one file all axes, their differences, the band of two sigma, the stretch of disagreement", async () => {
  const beside = ["compare", run, "--from-plane-1", "0"];
  const file = join(folder, "agreement.svg");
  ballbar(...beside, "--plot", file);
  const compared = Object.entries(json_of(...beside).axes);
  const drawn = await drawing(paper, file);
  assert.deepEqual(compared.map(([name, axis]) => [name, axis.deviation !== undefined]), [["x", true], ["y", true], ["z", false]]);
  const filled = (fill) => drawn.polygons.filter((one) => one.fill === fill);
  const [bands, stretches] = [filled("#5c6670"), filled("rgb(213,60,0)")];
  assert.equal(bands.length, 3);
  assert.equal(stretches.length, 4); // in both plots of x and of y
  for (const [k, [name, { points, deviation }]] of compared.entries()) {
    const [upper, lower] = [axes(drawn, 2 * k), axes(drawn, 2 * k + 1)];
    const hue = await colour(`comparison-${name}`, "a");
    // The difference has marks of the same colour, below the axis.
    const least = Math.min(...of(points, "a_um"), ...of(points, "b_um")) - upper.y.per_px;
    lie_at(marks(drawn, upper, hue).filter(([, value]) => value > least), min(points), of(points, "a_um"), upper, `a of ${name}`);
    lie_at(lines(drawn, upper, await colour(`comparison-${name}`, "b"))[0], min(points), of(points, "b_um"), upper, `b of ${name}`);
    lie_at(lines(drawn, lower, hue)[0], min(points), of(points, "difference_um"), lower, `difference of ${name}`);
    const sigma = points.map(({ sigma_um }) => 2 * sigma_um);
    const around = [...sigma, ...sigma.map((one) => -one).reverse()];
    const rim = bands[k].points.map(([x, y]) => [lower.x.at(x), lower.y.at(y)]);
    lie_at(rim, [...min(points), ...min(points).reverse()], around, lower, `band of ${name}`);
    if (!deviation) continue;
    for (const stretch of stretches.slice(2 * k, 2 * k + 2)) {
      const ends = stretch.points.map(([x]) => upper.x.at(x));
      close_to([Math.min(...ends), Math.max(...ends)], [deviation.from_s / 60, deviation.to_s / 60], `stretch of ${name}`, 1);
    }
  }
});

test("compare --plot: of 50 000 values the largest is drawn, in a small file", async () => {
  const [a, b, file] = ["a.csv", "b.csv", "many.svg"].map((name) => join(folder, name));
  const table = (value) => `time_s,x_um\n${Array.from({ length: 50_000 }, (_, i) => `${60 * i},${value(i)}`).join("\n")}\n`;
  writeFileSync(a, table((i) => (i === 12_345 ? 9 : i % 2 === 0 ? 1 : -1)));
  writeFileSync(b, table(() => 0.5));
  ballbar("compare", a, b, "--plot", file);
  const drawn = await drawing(paper, file);
  const scale = axes(drawn);
  // And the difference, far below.
  const of_a = lines(drawn, scale, await colour("comparison-x", "a")).filter((one) => one.length > 1000).flat();
  const [x, value] = of_a.reduce((most, one) => (one[1] > most[1] ? one : most));
  close_to([1440 * x], [12_345], "time of the largest, on an axis of days", 2 * 1440 * scale.x.per_px);
  close_to([value], [9 - 1], "the largest, as a change since the first", scale.y.per_px);
  assert.ok(statSync(file).size < 400_000, `${statSync(file).size} bytes`);
});

test("compensate --from-picture --plot: profiles, means, mean-value points and the best place of several states", async () => {
  const [data, file] = ["shaft.csv", "shaft.svg"].map((name) => join(folder, name));
  writeFileSync(data, "x_mm,T_cold_degC,T_warm_degC\n0,30,50\n40,28,41\n100,21,20\n");
  ballbar("compensate", "--from-picture", data, "--plot", file);
  const { states, best } = json_of("compensate", "--from-picture", data);
  const drawn = await drawing(paper, file);
  const scale = axes(drawn);
  for (const [k, [values, hue]] of [[[30, 28, 21], "#0072b2"], [[50, 41, 20], "#d55e00"]].entries()) {
    const { mean_degC, mean_points } = states[k];
    const [profile, mean] = lines(drawn, scale, hue);
    lie_at(profile, [0, 40, 100], values, scale, "profile");
    lie_at(mean, [0, 100], [mean_degC, mean_degC], scale, "mean");
    lie_at(marks(drawn, scale, hue), mean_points.map(({ x_mm }) => x_mm), mean_points.map(() => mean_degC), scale, "point");
  }
  const [upright] = drawn.paths.filter((one) => one.stroke === "#1b1f24" && one.points.length === 2 && one.points[0][0] === one.points[1][0]);
  close_to([scale.x.at(upright.x)], [best.x_mm], "best place", scale.x.per_px);
  assert.ok(drawn.texts.some(({ text }) => text === `best place, ${best.x_mm.toFixed(2)} mm`));
});

test("signals: CSV and SVG have the readings of signals.csv", async () => {
  const signals = table(readFileSync(join(run, "signals.csv"), "utf8"));
  const time = signals.time_s.map((one) => one / 60);
  const found = await csv("temperatures");
  close_to(found.time_min, time, "time");
  for (const name of ["T_bearing_degC", "T_housing_degC", "T_coolant_degC", "T_room_degC"]) close_to(found[name], signals[name], name);
  const drawn = await svg("temperatures");
  const scale = axes(drawn);
  lie_at(lines(drawn, scale, await colour("temperatures", "T_bearing_degC"))[0], time, signals.T_bearing_degC, scale, "T_bearing");
});

// The first recording of the session, as the instrument wrote it.
const readings = table(readFileSync(join(run, "00-c.csv"), "utf8"));
const deviation_um = readings.length_mm.map((one) => (one - 100) * 1000);

test("recording: unrolled, CSV and SVG have the readings of 00-c.csv", async () => {
  const found = await csv("recording-unrolled");
  close_to(found.angle_deg, readings.angle_deg, "angle", 1e-4);
  close_to(found.deviation_um, deviation_um, "deviation", 1e-4);
  const fitted = json_of("fit", join(run, "00-c.csv")).recordings[0];
  const rms = Math.sqrt(found.residual_um.reduce((sum, one) => sum + one * one, 0) / found.residual_um.length);
  assert.ok(Math.abs(rms - fitted.rms_um) < 1e-4, `rms ${rms} for ${fitted.rms_um}`);
  const drawn = await svg("recording-unrolled");
  const [upper, lower] = [axes(drawn, 0), axes(drawn, 1)];
  const hue = await colour("recording-unrolled", "trace0");
  lie_at(lines(drawn, upper, hue)[0], readings.angle_deg, deviation_um, upper, "measured");
  lie_at(lines(drawn, lower, hue)[1], readings.angle_deg, found.residual_um, lower, "residual");
});

test("recording: on the circle, the SVG has the readings of 00-c.csv", async () => {
  const drawn = await svg("recording-circle");
  const hue = await colour("recording-circle", "trace0");
  const { place } = polar(drawn);
  const trace = drawn.paths.filter((one) => one.stroke === hue && !one.legend).sort((a, b) => b.points.length - a.points.length)[0].points;
  assert.equal(trace.length, readings.angle_deg.length);
  trace.forEach(([x, y], k) => {
    const [px, py] = place(readings.angle_deg[k], deviation_um[k]);
    const beside = Math.hypot(x - px, y - py);
    assert.ok(beside < 1.5, `reading ${k} is drawn ${beside} pixels beside its place`);
  });
});

test("model: what is left has the RMSE of `check --json`", async () => {
  const found = await csv("model-y_um-fit");
  const measured = found.measured_um ?? found.y_um;
  close_to(measured, of(drift.points, "y_um"), "measured");
  const rms = Math.sqrt(found.residual_um.reduce((sum, one) => sum + one * one, 0) / found.residual_um.length);
  assert.ok(Math.abs(rms / checked.rmse_um - 1) < 1e-4, `${rms} for ${checked.rmse_um}`);
  const drawn = await svg("model-y_um-fit");
  const scale = axes(drawn);
  const points = marks(drawn, scale, await colour("model-y_um-fit", "measured"));
  lie_at(points, min(drift.points), of(drift.points, "y_um"), scale, "measured");
});

test("ledger of a grown model: curves, table and CSV are those of `ledger --json`", async () => {
  const { page: one, wrong: of_grown, close } = await opened(browser, await grown());
  const { rows } = json_of("ledger", "--model", grown_model);
  assert.ok(rows.length > 3 && rows[0].forecast_um > 0, "it has not grown");
  const drawn = await svg("ledger-forecasts", one);
  const scale = axes(drawn);
  const found = await csv("ledger-forecasts", one);
  for (const key of ["rmse_um", "forecast_um"]) {
    close_to(found[key], of(rows, key), key);
    const known = rows.filter((row) => row[key] !== null);
    const [line] = lines(drawn, scale, await colour("ledger-forecasts", key, one));
    lie_at(line, of(known, "revision"), of(known, key), scale, key);
  }
  const heading = await one.locator("#ledger th").allTextContents();
  const cells = await one.locator("#ledger tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
  const column = (name) => cells.map((row) => row[heading.indexOf(name)]);
  const written = (key) => rows.map((row) => (row[key] === null ? "–" : row[key].toFixed(3)));
  assert.deepEqual(column("forecasts, µm"), written("forecast_um"));
  assert.deepEqual(column("verdict"), of(rows, "verdict"));
  assert.ok(!heading.includes("threshold"), "a column of nothing");
  assert.ok(column("verdict").some((verdict) => verdict === "driver known" || verdict === "empirical"));
  const said = await figure(one, "ledger-forecasts").textContent();
  assert.ok(said.includes("A lower error is real only if the forecasts improve too."), said);
  assert.deepEqual(of_grown, []);
  await close();
});

test("console and network are quiet", () => assert.deepEqual(wrong, []));
