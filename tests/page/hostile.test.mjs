// Whatever stands in a file is shown as text: nothing of it is run, becomes an element or is fetched, in the page, under
// the mouse, in the drawings and in what a spreadsheet opens.
import assert from "node:assert/strict";
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { figure, launched, opened, saved, seen } from "./browser.mjs";
import { data_of, page_with, with_errors } from "./machine_errors.mjs";
import { folder, of_run, report, run } from "./reports.mjs";
import { address_of } from "./watched.mjs";

const image = "<img src=x onerror=alert(1)>";
const script = "</script><script>alert(2)</script>";
const rich = "{a|rich}";
const formula = "=1+cmd|' /C calc'!A0";
const turned = "\u202Egnp\u202C\u200F";
const long = "N".repeat(10_000);

// Rises and falls, with a little noise: enough for a model and a diagnosis.
const series = (columns, rows = 240) => {
  let state = 7;
  const noise = () => (state = (state * 16807) % 2147483647) / 2147483647 - 0.5;
  const lines = Array.from({ length: rows }, (_, i) => {
    const heat = 5 * Math.sin(i / 30) + 0.1 * noise();
    return [60 * i, ...columns.map((_, k) => (20 + heat * (k + 1) + (k % 2) * Math.cos(i / 9) + 0.2 * noise()).toFixed(3))].join(",");
  });
  return `time_s,${columns.join(",")}\n${lines.join("\n")}\n`;
};

// Of a ledger with forecasts.
const history_row = (revision, target) =>
  `[[history]]\nrevision = ${revision}\nchange = ${JSON.stringify(revision > 0 ? `+ ${image}${rich}${turned}${formula}${long}` : "start")}\n` +
  `target = ${JSON.stringify(target)}\ndata = [${JSON.stringify(image)}]\nparameters = 2\nrmse_um = ${3 - revision}.0\nforecast_um = ${4 - revision}.0\n` +
  `verdict = ${JSON.stringify(`${script}${rich}${turned}${long}`)}\n` +
  (revision > 0 ? 'still_needed = []\nno_longer_needed = []\neffects_before = """\n"""\n' : "");

const of_series = () => {
  const path = join(folder, `${image}${rich}.csv`);
  const [target, warm] = [`${script.replaceAll("/", "")}_um`, `${image}_degC`];
  writeFileSync(path, series([target, warm, `${rich}_degC`, `${turned}_degC`, `${formula}_um`, `${long}_degC`, "'&><b>_rpm", "--!>_K"]));
  const model = join(folder, "hostile.toml");
  writeFileSync(
    model,
    `format = "ballbar-model 1"\ntarget = ${JSON.stringify(target)}\n[[effect]]\nname = "expansion"\ntemperature = ${JSON.stringify(warm)}\n` +
      `[[effect]]\nname = "expression"\nformula = "k * t"\nk = { start = 0.0, unit = ${JSON.stringify(image)} }\n` +
      [0, 1].map((revision) => history_row(revision, target)).join(""),
  );
  return report("hostile-series", path, "--model", model);
};

const of_session = () => {
  const run = join(folder, `${rich}${turned}`);
  mkdirSync(run);
  for (const name of ["00-c.csv", "00-a.csv", "01-c.csv", "01-a.csv"]) cpSync(of_run("two-arcs-he2015", name), join(run, `${image}${name}`));
  writeFileSync(join(run, "signals.csv"), series([`${image}_degC`, `${rich}_A`, `${long}_rpm`], 20));
  const tests = [0, 1].map((k) => `[[test]]\nelapsed_s = ${480 * k}.0\nc_arc = "${image}0${k}-c.csv"\na_arc = "${image}0${k}-a.csv"\n`);
  writeFileSync(
    join(run, "session.toml"),
    `format = "ballbar-session 1"\nmethod = "two_arcs"\ntitle = ${JSON.stringify(`${script}\n${image} & ${rich} ${turned} "'\`\n\n${long}`)}\n` +
      `[bar]\nnominal_length_mm = 100.0\n${tests.join("")}[signals]\nfiles = ["signals.csv"]\n`,
  );
  return report("hostile-session", run);
};

const of_recordings = () => {
  const text = readFileSync(of_run("qc20-style-b5r", "00.b5r"), "utf8").replace(/TEST_SPEC NAME="[^"]*"/, 'TEST_SPEC NAME="&lt;img src=x onerror=alert(1)&gt;{a|b}"');
  const paths = [`${image}.b5r`, `${rich}${turned}.b5r`].map((name) => join(folder, name));
  for (const path of paths) writeFileSync(path, text);
  return report("hostile-recordings", ...paths);
};

// No file gives such names to the errors of a machine; the page does not rely on that.
const of_errors = async () => {
  const file = with_errors("hostile-errors-named", await report("hostile-errors-plain", of_run("qc20-style-b5r", "00.b5r")), {
    squareness: image,
    straightness_b: `${rich}${turned}_${formula}`,
    backlash_a: `__proto___${long}`,
  });
  const data = data_of(file);
  const parts = data.machine_errors.flatMap((part) => {
    const errors = part.errors.map((row) => ({ ...row, unit: `${script}${long}`, remedy: row.effect && `${script}${turned}${long}` }));
    const said = { conclusion: `${image}${turned}`, left_text: `${script}${long}`, tolerances: [`${script}${turned}`], file: { machine: `${image}${long}`, [script]: rich, started_s: 1e99 }, undetermined: [image, long], prior: [{ name: script, sigma: 1, unit: image }] };
    return ["", long].map((more) => ({ ...part, ...said, errors, files: [`${script}${rich}${turned}${more}`] }));
  });
  return page_with("hostile-errors", file, { ...data, machine_errors: parts });
};

let browser;
before(async () => {
  browser = await launched();
});
after(() => browser.close());

// All text that a chart has drawn.
const texts = (page, name) =>
  page.evaluate(
    (name) =>
      window.ballbar.figures
        .get(name)
        .chart()
        .getZr()
        .storage.getDisplayList(true)
        .map((one) => one.style?.text)
        .filter((one) => one !== undefined && one !== null)
        .map(String),
    name,
  );

// The sheet for paper is an image of the page's own, which runs nothing; there is nothing to run in it all the same.
const elements = (page) =>
  page.evaluate(() => {
    const sheets = [...document.querySelectorAll("img")].filter(({ src }) => src === "" || src.startsWith("data:image/svg+xml;charset=utf-8,"));
    const found = [...document.querySelectorAll("img, iframe, object, embed, b, base, form, meta[http-equiv=refresh]")].filter((one) => !sheets.includes(one)).map((one) => one.outerHTML.slice(0, 100));
    for (const { src } of sheets) {
      const runs = /<(script|image|a|foreignObject)\b|<[^>]*\son\w+=/i.exec(decodeURIComponent(src.slice(src.indexOf(",") + 1)));
      if (runs) found.push(`sheet: ${runs[0].slice(0, 100)}`);
    }
    for (const one of document.querySelectorAll("*")) {
      if (sheets.includes(one)) continue;
      for (const { name, value } of one.attributes) {
        if (/^on|^srcdoc$/.test(name) || (/^(href|src|action)$/.test(name) && !value.startsWith("#"))) found.push(`${one.localName} ${name}=${value.slice(0, 100)}`);
      }
    }
    const scripts = document.querySelectorAll("script:not([type='application/json'])").length;
    return scripts === 1 ? found : [...found, `${scripts} scripts`];
  });

const cases = [
  ["series", of_series, [image, rich, formula]],
  ["session", of_session, [script, image, rich]],
  ["recordings", of_recordings, [image]],
  ["errors of a machine", of_errors, [image, script]],
];

for (const [what, make, shown] of cases) {
  test(`hostile text in ${what}`, async () => {
    const path = await make();
    const { page, wrong, close } = await opened(browser, path);
    const paper = await browser.newPage();
    const on_paper = [];
    paper.on("console", (message) => on_paper.push(message.text()));
    paper.on("dialog", (dialog) => on_paper.push(dialog.message()));
    paper.on("request", (request) => request.url().startsWith("file://") || on_paper.push(`loaded: ${request.url()}`));
    const names = await page.$$eval("figure[data-picture]", (all) => all.map((one) => one.dataset.picture));
    assert.ok(names.length > 1);
    for (const name of names) {
      await seen(page, name);
      const box = await figure(page, name).locator(".chart").boundingBox();
      // Under the mouse, at several places: on a curve or beside it.
      for (const part of [0.25, 0.5, 0.75]) {
        await page.mouse.move(box.x + part * box.width, box.y + 0.4 * box.height);
        const drawn = (await texts(page, name)).join("\n");
        assert.doesNotMatch(drawn, /[\u200B-\u200F\u202A-\u202E]/, `${name}: text may turn the direction of writing`);
        assert.ok(!/(^|\n)rich(\n|$)/.test(drawn), `${name}: ${rich} was read as markup`);
        assert.ok(!/N{400}/.test(drawn), `${name}: a name of 10 kB is drawn`);
      }
      await figure(page, name).locator(".chart").focus();
      await page.keyboard.press(".");
      await figure(page, name).getByText("The numbers behind this picture").click();

      const svg = await saved(page, name, "SVG");
      const text = readFileSync(svg.path, "utf8");
      assert.doesNotMatch(text, /<(img|script|foreignObject|b)\b/);
      await paper.goto(`file://${svg.path}`);
      assert.equal(await paper.evaluate(() => document.querySelectorAll("parsererror, script, image, a, foreignObject").length), 0, `${name}.svg`);
      assert.equal(await paper.evaluate(() => document.documentElement.localName), "svg");
      const csv = await saved(page, name, "CSV");
      assert.match(csv.name, /^[\w-]+\.csv$/);
      for (const row of readFileSync(csv.path, "utf8").split("\r\n")) {
        // A field that is not a number must not begin as a formula does.
        for (const field of row.split(/,(?=(?:[^"]*"[^"]*")*[^"]*$)/)) assert.ok(!/^"?[=+@\t-]/.test(field) || Number.isFinite(Number(field)), `${name}: ${field.slice(0, 80)}`);
      }
    }
    for (const one of await page.locator("details").all()) await one.evaluate((details) => (details.open = true));
    const text = await page.evaluate(() => document.body.textContent);
    for (const one of shown) assert.ok(text.includes(one), `${one} is not on the page`);
    assert.deepEqual(await elements(page), []);
    assert.ok((await page.evaluate(() => document.documentElement.scrollWidth)) <= 1100, "wider than the window");
    assert.ok(await page.evaluate(() => [...document.querySelectorAll("h1, h2, h3, figcaption, summary, nav")].every((one) => one.offsetHeight < 500)), "a heading fills the screen");
    assert.ok((await page.pdf({ format: "A4" })).length > 1000);
    assert.deepEqual(wrong, []);
    assert.deepEqual(on_paper, []);
    await close();
    await paper.close();
  });
}

test("hostile text in --plot", async () => {
  const path = (name) => join(folder, `${image}${rich}${turned}${name}`);
  const names = [`${script.replaceAll("/", "")}_um`, `${image}_um`, `${rich}${turned}_um`, `${long}_um`, "'&><b>_um"];
  for (const name of ["a.csv", "b.csv"]) writeFileSync(path(name), series(names, 20));
  writeFileSync(path("shaft.csv"), `x_mm,${script.replaceAll("/", "")}_degC,${rich}${turned}_degC,${long}_degC\n0,50,40,30\n99,20,21,22\n`);
  run("compare", path("a.csv"), path("b.csv"), "--plot", path("compare.svg"));
  run("compensate", "--from-picture", path("shaft.csv"), "--plot", path("meanpoint.svg"));
  const page = await browser.newPage();
  const asked = [];
  page.on("request", (request) => asked.push(request.url()));
  page.on("dialog", (dialog) => asked.push(dialog.message()));
  for (const name of ["compare.svg", "meanpoint.svg"]) {
    const text = readFileSync(path(name), "utf8");
    const url = address_of(path(name));
    assert.doesNotMatch(text, /<(img|script|foreignObject|b)\b|[\u200B-\u200F\u202A-\u202E]|N{400}|>rich</);
    await page.goto(url);
    assert.equal(await page.evaluate(() => document.querySelectorAll("parsererror, script, image, a, foreignObject").length), 0, name);
    const shown = await page.evaluate(() => document.documentElement.textContent);
    assert.ok(shown.includes("alert(2)"), `${name}: the name that is markup is not shown`);
    assert.deepEqual(asked.splice(0), [url]);
  }
  await page.close();
});
