// The errors of a machine as the program finds them: the page has the numbers of `errors --json`, and curves that make
// its circularities.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { drawn, figure, launched, opened, unfold } from "./browser.mjs";
import { drawing } from "./drawing.mjs";
import { data_of } from "./machine_errors.mjs";
import { folder, json_of, of_run, report, run } from "./reports.mjs";

const kPicture = "machine-errors";

let browser, paper;
before(async () => {
  browser = await launched();
  paper = await browser.newPage();
});
after(() => browser.close());

const table = (of) => of.locator("#machine-errors .table:visible", { hasText: "All errors" });
const cells = async (one) => one.locator("td").allTextContents();

test("the numbers of `errors --json`, and curves that make its circularities", async () => {
  const path = of_run("qc20-style-b5r", "00.b5r");
  const found = json_of("errors", path);
  const own = await report("errors-own", path);
  const { machine_errors: [part, ...more], summary, fit } = data_of(own);
  assert.deepEqual(more, []);
  for (const key of ["errors", "circularity_um", "undetermined", "prior", "conclusion", "left_text"]) assert.deepEqual(part[key], found[key], key);
  assert.deepEqual(summary, [found.conclusion]);
  assert.deepEqual([part.files, part.recordings], [["00.b5r"], [0, 1]]);
  const range = (values) => values.flat().reduce((most, one) => Math.max(most, one), -Infinity) - values.flat().reduce((least, one) => Math.min(least, one), Infinity);
  // The fit takes readings together that are 0.4 deg apart.
  const near = (value, expected, what) => assert.ok(Math.abs(value - expected) < 0.1, `${what}: ${value} for ${expected}`);
  const about = part.recordings.map((place, k) => fit.recordings[place].trace.deviation_um.map((value, i) => value - part.circle_um[k][i]));
  near(range(about), found.circularity_um, "circularity");
  const ranked = found.errors.filter(({ effect }) => effect);
  assert.deepEqual(Object.keys(part.curves).sort(), [...new Set(ranked.map(({ effect }) => effect))].sort());
  for (const { effect, individual_circularity_um, circularity_without_um } of ranked) {
    near(range(part.curves[effect]), individual_circularity_um, `IC of ${effect}`);
    near(range(about.map((values, k) => values.map((value, i) => value - part.curves[effect][k][i]))), circularity_without_um, `without ${effect}`);
  }
  const { page: one, wrong, close } = await opened(browser, own);
  await drawn(one);
  await unfold(one, "machine-errors");
  const names = await table(one).locator("tbody tr").count();
  assert.equal(names, ranked.length);
  const [largest] = ranked;
  assert.equal(largest.rank, 1);
  const [name, value, , circularity, , rank] = await cells(table(one).locator("tbody tr").first());
  assert.deepEqual([name, circularity, rank], [largest.effect.replaceAll("_", " "), largest.individual_circularity_um.toFixed(2), "1"]);
  assert.ok(Math.abs(parseFloat(value) - largest.value) < largest.sigma / 5, value);
  assert.deepEqual(wrong, []);
  await close();
});

test("a picture of a chosen error without the page", async () => {
  const out = join(folder, "errors.svg");
  const printed = run("report", of_run("qc20-style-b5r", "00.b5r"), "--format", "svg", "--picture", kPicture, "--choose", "error=backlash_a", "--out", out);
  assert.equal(printed.toString(), `${out}  Errors on the circle\n`);
  const { texts } = await drawing(paper, out);
  assert.ok(texts.some(({ text }) => text === "Errors on the circle, backlash of X"));
});

// Readings of a log on two linear axes, in one direction.
const log_of = (name, readings) => {
  const path = join(folder, `${name}.csv`);
  const rows = Array.from({ length: readings }, (_, k) => {
    const angle = (360 * (k + 0.5)) / readings;
    return `${(0.02 * k).toFixed(2)},${angle.toFixed(4)},${(100 + 0.004 * Math.sin((angle * Math.PI) / 90) + 0.0002 * Math.sin(7.3 * k)).toFixed(6)}`;
  });
  const head = ['format = "ballbar-log 1"', 'kind = "circle"', 'motion = "linear_axes"', 'plane = "ZX"', 'moving_ball = "spindle"', "nominal_length_mm = 100.0", 'direction = "CCW"', "feed_mm_per_min = 1000.0"];
  writeFileSync(path, `${head.map((one) => `# ${one}\n`).join("")}time_s,angle_deg,length_mm\n${rows.join("\n")}\n`);
  return path;
};

test("logs of one direction each are tests; one with too few readings is a remark", async () => {
  const own = await report("errors-of-logs", log_of("first", 800), log_of("second", 900), log_of("few", 60));
  const { machine_errors: parts, fit, summary } = data_of(own);
  assert.deepEqual(parts.map(({ files, recordings }) => [files, recordings]), [[["first.csv"], [0]], [["second.csv"], [1]]]);
  assert.deepEqual(summary, []);
  assert.equal(fit.remarks.filter((one) => /few\.csv.*expected at least \d+ readings, found 60/.test(one)).length, 1, fit.remarks.join());
  assert.ok(!readFileSync(own, "utf8").includes(folder), "where the files lay is not told");
  const { page: one, wrong, close } = await opened(browser, own);
  await drawn(one);
  await unfold(one, "machine-errors");
  assert.equal((await cells(table(one).locator("tr", { hasText: "squareness" })))[7], "–", "nothing is predicted for another run");
  await figure(one, kPicture).getByRole("combobox", { name: "Test" }).selectOption({ label: "second.csv, ZX" });
  await drawn(one);
  assert.deepEqual(wrong, []);
  await close();
});
