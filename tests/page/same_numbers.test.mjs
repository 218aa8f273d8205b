// The program and the engine in ballbar.html, on the same files: one answer. BALLBAR_ALL_SAME=1 does the long ones too,
// BALLBAR_EXTERNAL_DATA names a folder of measured data.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { started } from "./browsers.mjs";
import { folder, of_run, program } from "./reports.mjs";
import { as_values, differences } from "./same.mjs";
import { made_files, of_external, of_sample_runs } from "./same_runs.mjs";
import { put, put_below, ran, read, tool } from "./tool.mjs";

const external = process.env.BALLBAR_EXTERNAL_DATA;
const all = process.env.BALLBAR_ALL_SAME === "1";
const kShown = 5; // differences of a command
// Of fourteen values, differences of nearly equal ones and shapes that the data hardly tell: what the two mathematical
// libraries round otherwise comes out up to 1.2e-7 apart, a curve's points by their last of seven digits.
const kIllConditioned = /^(compare|diagnose|report) sample-runs\/two-arcs-he2015/;
const kOfIllConditioned = 1e-5;

const here = join(folder, "same");
let browser, tab;
before(async () => {
  browser = await started("chrome");
  tab = await browser.opened(tool);
  mkdirSync(here);
  symlinkSync(of_run(), join(here, "sample-runs"));
  await put_below(tab, "sample-runs", of_run());
  if (external) {
    symlinkSync(external, join(here, "external"));
    await put_below(tab, "external", external);
  }
  for (const [name, text] of Object.entries(made_files)) {
    writeFileSync(join(here, name), text);
    await put(tab, name, text);
  }
});
after(() => browser.close());

const answers = async ({ words, writes = [] }) => {
  const native = spawnSync(program, words, { cwd: here, maxBuffer: 1 << 29, encoding: "utf8", env: { ...process.env, TZ: "UTC", LC_ALL: "C.UTF-8" } });
  const page = await ran(tab, words);
  const values = (status, out, err, files) => ({ status, out: as_values(out), err: as_values(err), files: files.map(as_values) });
  return [
    values(native.status, native.stdout, native.stderr, writes.map((name) => readFileSync(join(here, name), "utf8"))),
    values(page.status, page.out, page.err, await Promise.all(writes.map((name) => read(tab, name)))),
  ];
};

test("numbers are told apart from 1e-9 on: of themselves, their list, their sigma, or one", () => {
  const found = (a, b) => [...differences(a, b)].length;
  assert.equal(found({ a: 1, b: "x" }, { a: 1 + 5e-10, b: "x" }), 0);
  assert.equal(found({ a: 1 }, { a: 1 + 2e-9 }), 1);
  assert.equal(found([1, 1e-3], [1, 1e-3 + 5e-10]), 0);
  assert.equal(found([1, 1e-3], [1, 1e-3 + 2e-9]), 1);
  assert.equal(found({ value: 1e-3, sigma: 1 }, { value: 1e-3 + 5e-10, sigma: 1 }), 0);
  assert.equal(found({ value: 1e-3 }, { value: 1e-3 + 5e-10 }), 1);
  assert.equal(found({ p_value: 0.3 }, { p_value: 0.3 + 5e-10 }), 0);
  assert.equal(found([0.1234567, 0.2345678], [0.1234568, 0.2345678]), 0);
  assert.equal(found([0.1234567, 0.2345678], [0.1234569, 0.2345678]), 1);
  const many = (last) => Array.from({ length: 100 }, (_, k) => (1000001 + 2 * k + last) / 1e6);
  assert.equal(found(many(0), many(1)), 1);
  assert.equal(found({ a: 1 }, { b: 1 }), 2);
  assert.equal(found({ a: null }, { a: 0 }), 1);
  assert.equal(found([1, 2], [1]), 1);
  assert.equal(found("a", "b"), 1);
  assert.equal(found(as_values("t 1.5 K\n"), as_values("t 1.6 K\n")), 1);
});

for (const one of [...of_sample_runs, ...(external ? of_external(external) : [])]) {
  test(one.words.join(" "), { skip: one.long && !all ? "long: BALLBAR_ALL_SAME=1" : false }, async () => {
    const [native, page] = await answers(one);
    const ill_conditioned = kIllConditioned.test(one.words.join(" "));
    const bearable = (line) =>
      ill_conditioned && (Number(/, (\S+) of it$/.exec(line)?.[1]) <= kOfIllConditioned || /curve_um: .* in the last of 7 digits$/.test(line));
    const found = [...differences(native, page)].filter((line) => !bearable(line));
    assert.equal(found.length, 0, `program and page, ${found.length} differences:\n  ${found.slice(0, kShown).join("\n  ")}`);
  });
}
