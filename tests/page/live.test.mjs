// The page with the program in it, worked by hand: what is dropped, added, moved, taken back, saved and kept.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { at_rest, drop, dropped, idle, kLong, live, opened_file, rmse, saved } from "./live_page.mjs";
import { folder, json_of, of_run, program } from "./reports.mjs";

const candidates = (page) => page.waitForSelector(".live-candidates .plus", { timeout: kLong });
const sample = async (page, name) => {
  await page.getByRole("button", { name, exact: true }).click();
  await page.waitForSelector(".live-report main", { timeout: kLong });
};
// Of the page; sentences come and go.
const state = (page, selector) => page.waitForSelector(selector, { timeout: kLong });
const added = (page) => state(page, '.live-loop[data-revisions="2"] .live-fall[data-beside="before"]');
const taken_back = (page) => state(page, '.live-loop:not([data-revisions="2"])');
const told = (page) => page.textContent(".live-told");
// All that the loop says from now on; kept in the page, for each sentence may soon be replaced.
const listen = (page) =>
  page.evaluate(() => {
    const said = document.querySelector(".live-loop .said");
    window.said = [];
    new MutationObserver(() => window.said.push(said.textContent)).observe(said, { childList: true, characterData: true, subtree: true });
  });

test("a .b5r that is dropped: the ranked table, equal to the program's", async () => {
  const { page, wrong, close } = await live();
  const file = of_run("qc20-style-b5r", "00.b5r");
  await dropped(page, file);
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  const first = json_of("report", file).machine_errors[0].errors.filter(({ rank }) => rank === 1)[0];
  const row = await page.locator(".ranked tbody tr").first().innerText();
  assert.match(row, new RegExp(first.value.toFixed(3).replace(".", "\\.")));
  assert.deepEqual(wrong, []);
  await close();
});

test("a session with a model: its drift first, the loop below it; the sheet alone is one page with the options", async () => {
  const { page, wrong, close } = await live();
  await sample(page, "two-arcs-he2015");
  await page.waitForSelector('.first figure[data-picture="drift"] canvas', { timeout: kLong });
  assert.match(await page.textContent(".first .verdict"), /^Largest drift: y 31\.7\d+ ± 0\.0\d+ µm at 124 min; x 5\.08\d ± 0\.0\d+ µm at 124 min; z 4\.6/);
  await page.waitForSelector(".live-loop", { timeout: kLong });
  const top = (selector) => page.$eval(selector, (one) => one.getBoundingClientRect().top);
  assert.ok((await top(".first")) < (await top(".live-loop")));
  await page.waitForFunction(() => decodeURIComponent(document.querySelector(".handover img")?.src ?? "").includes("Largest drift"), null, { timeout: kLong });
  assert.match(decodeURIComponent(await page.$eval(".handover img", ({ src }) => src)), /model\.toml/);
  await page.evaluate(() => (document.documentElement.dataset.print = "handover"));
  const pdf = await page.pdf({ preferCSSPageSize: true });
  assert.equal((pdf.toString("latin1").match(/\/Type\s*\/Page\b/g) ?? []).length, 1);
  assert.deepEqual(wrong, []);
  await close();
});

test("add, the error falls; undo, redo: as the program does it", async () => {
  const { page, wrong, close } = await live();
  await sample(page, "hidden-effect");
  await candidates(page);
  const copy = join(folder, "add");
  cpSync(of_run("hidden-effect", "01"), copy, { recursive: true });
  const [data, model] = [join(copy, "data.csv"), join(copy, "model.toml")];
  const before = json_of("check", data, "--model", model).rmse_um;
  assert.equal((await rmse(page)).toFixed(2), before.toFixed(2));
  assert.equal(await page.getAttribute(".live-candidates li bdi", "title"), "lagged_expansion(T_room_degC)");
  await listen(page);
  await page.locator(".live-candidates .plus").first().click();
  await added(page);
  execFileSync(program, ["add", "lagged_expansion(T_room_degC)", data, "--model", model], { stdio: "ignore" });
  const after = json_of("check", data, "--model", model).rmse_um;
  assert.equal((await rmse(page)).toFixed(3), after.toFixed(3));
  await state(page, '.live-loop[data-search="done"]');
  const said = await page.evaluate(() => window.said);
  assert.ok(said.some((one) => /The data support lagged_expansion\(T_room_degC\)/.test(one)), said.join("\n"));
  assert.ok(await page.$("#ledger"), "the ledger has a section");
  await page.keyboard.press("Control+z");
  await taken_back(page);
  assert.equal((await rmse(page)).toFixed(2), before.toFixed(2));
  await page.keyboard.press("Control+y");
  await state(page, '.live-loop[data-revisions="2"]');
  assert.equal((await rmse(page)).toFixed(3), after.toFixed(3));
  await at_rest(page);
  const kept = await saved(page, "Model (.toml)");
  // It begins with what is fitted, and has the ledger of `add`.
  assert.equal(json_of("check", data, "--model", kept).rmse_um.toFixed(6), after.toFixed(6));
  const changes = (path) => [...readFileSync(path, "utf8").matchAll(/^change = .*$/gm)].map(([line]) => line);
  assert.deepEqual(changes(kept), changes(model));
  assert.deepEqual(wrong, []);
  await close();
});

test("sliders: a gain scales at once, a time constant by the program; back to the optimum", async () => {
  const { page, wrong, close } = await live();
  await sample(page, "hidden-effect");
  await candidates(page);
  const optimum = await rmse(page);
  const [data, model] = [of_run("hidden-effect", "01", "data.csv"), of_run("hidden-effect", "01", "model.toml")];
  const fitted = json_of("check", data, "--model", model);
  const of = (parameters, name) => parameters.find((one) => one.name === name).value;
  // Of the program: with these values, and with the constant where it was, which --set leaves free.
  const expected_rmse = (parameter, value) => {
    const set = fitted.parameters
      .filter(({ name }) => name !== "constant_um")
      .flatMap((one) => ["--set", `${one.effect}.${one.name}=${one.name === parameter ? value : one.value}`]);
    const { series, parameters } = json_of("report", data, "--model", model, "--no-diagnosis", ...set).check.targets[0];
    const shift = of(fitted.parameters, "constant_um") - of(parameters, "constant_um");
    return Math.sqrt(series.residual_um.reduce((sum, one) => sum + (one - shift) ** 2, 0) / series.residual_um.length);
  };
  for (const parameter of ["gain_um_per_K", "time_constant_s"]) {
    const label = parameter === "gain_um_per_K" ? "gain" : "time constant";
    const slider = page.locator(`.slider:has(.name:text-is("${label}")) input`);
    await slider.focus();
    for (let k = 0; k < 12; ++k) await page.keyboard.press("ArrowRight");
    await at_rest(page);
    const value = Number(await slider.inputValue());
    const expected = expected_rmse(parameter, value);
    assert.ok(expected > optimum, `${expected} of ${parameter} = ${value}`);
    assert.equal((await rmse(page)).toFixed(2), expected.toFixed(2), parameter);
    assert.match(await slider.getAttribute("aria-valuetext"), /^[\d.]+ (µm\/K|s)$/);
    await page.getByRole("button", { name: "Back to the optimum" }).click();
    assert.equal(await rmse(page), optimum);
  }
  assert.deepEqual(wrong, []);
  await close();
});

test("a search is cancelled by Escape, and the page goes on", async () => {
  const { page, wrong, close } = await live();
  // As soon as the program is asked: on a busy machine the search could end before the key comes from here.
  await page.evaluate(() => {
    const what = document.querySelector(".live-work .what");
    const watching = new MutationObserver(() => {
      if (!what.textContent.startsWith("Searching")) return;
      watching.disconnect();
      document.body.dispatchEvent(new KeyboardEvent("keydown", { key: "Escape", bubbles: true }));
    });
    watching.observe(what, { childList: true, characterData: true, subtree: true });
  });
  await sample(page, "hidden-effect");
  await state(page, '.live-loop[data-search="stopped"]');
  await idle(page);
  assert.match(await page.textContent(".live-loop .said"), /Stopped/);
  assert.equal(await page.locator(".live-candidates .plus").count(), 0);
  // What is likeliest so far is seen for a moment.
  await page.evaluate(() => {
    window.seen = [];
    const said = document.querySelector(".live-loop .said");
    new MutationObserver(() => window.seen.push(said.textContent)).observe(said, { childList: true });
  });
  await page.getByRole("button", { name: "Find what is missing" }).click();
  await candidates(page);
  const seen = await page.evaluate(() => window.seen);
  assert.ok(seen.some((text) => /^So far most likely: .+\. The search goes on\.$/.test(text)), seen.join("\n"));
  assert.deepEqual(wrong, []);
  await close();
});

test("added twice and taken back twice at once: once, and the page shows what the file says", async () => {
  const { page, wrong, close } = await live();
  await sample(page, "hidden-effect");
  const before = await rmse(page);
  const model = () =>
    page.evaluate(async () => new TextDecoder().decode(await window.ballbar.engine.get("hidden-effect/01/model.toml")));
  const first = await model();
  const settled = async (expected) => {
    await page.waitForFunction((more) => document.querySelectorAll(".live-model > li").length === more, expected, { timeout: kLong });
    await page.keyboard.press("Escape"); // the search of the new model
  };
  const effects = await page.locator(".live-model > li").count();
  await page.evaluate(() => {
    const add = { action: "add", effects: ["lagged_expansion(T_room_degC)"], labels: ["lagged_expansion(T_room_degC)"], parameters: [], promised_rmse_um: null };
    window.ballbar.doing(add)();
    window.ballbar.doing(add)();
  });
  await settled(effects + 1);
  assert.ok((await rmse(page)) < before);
  await page.keyboard.press("Control+z");
  await page.keyboard.press("Control+z");
  await settled(effects);
  assert.equal(await model(), first);
  assert.equal(await rmse(page), before);
  assert.deepEqual(wrong, []);
  await close();
});

test("a broken file is told where it is, and the rest is shown", async () => {
  const { page, wrong, close } = await live();
  const sound = readFileSync(of_run("qc20-style-b5r", "00.b5r"), "utf8");
  await drop(page, { "a.b5r": sound, "broken.b5r": sound.slice(0, 3000), "noise.bin": "\u0000\u0001what is this" });
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  const faults = await page.locator(".live-files .faulty").allInnerTexts();
  assert.equal(faults.length, 2, faults.join("\n"));
  assert.match(faults.find((one) => one.startsWith("broken.b5r")), /expected/);
  assert.deepEqual(wrong, []);
  await close();
});

test("hostile names are text, and stay below their folder", async () => {
  const { page, wrong, close } = await live();
  const text = readFileSync(of_run("qc20-style-b5r", "00.b5r"), "utf8");
  const names = ["<img src=x onerror=alert(1)>.b5r", "--out=x.b5r", "..\\..\\etc.b5r", "\u202Egnp.b5r", `${"N".repeat(3000)}.b5r`, "a\u0000b.b5r"];
  await drop(page, Object.fromEntries(names.map((name) => [name, text])));
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  assert.equal(await page.locator(".live-files li").count(), names.length);
  assert.equal(await page.locator(":not(.handover) > img").count(), 0);
  assert.equal(await told(page), "");
  assert.deepEqual(wrong, []);
  await close();
});

test("a folder with a session: two files of one name in different folders are both kept", async () => {
  const { page, wrong, close } = await live();
  const run = join(folder, "folder");
  mkdirSync(run);
  cpSync(of_run("two-arcs-he2015"), join(run, "one"), { recursive: true });
  cpSync(of_run("spindle-rotation-huang2022"), join(run, "two"), { recursive: true });
  await page.locator("input[webkitdirectory]").first().setInputFiles(run);
  await page.waitForSelector(".live-report main", { timeout: kLong });
  const groups = await page.locator(".live-shelf .groups button").allInnerTexts();
  assert.equal(groups.filter((one) => /SIMULATED/.test(one)).length, 2, groups.join("; "));
  assert.deepEqual(wrong, []);
  await close();
});

test("reload: continue where it was, with the model as it was; delete", async () => {
  const { page, wrong, close } = await live();
  await sample(page, "hidden-effect");
  await candidates(page);
  await page.locator(".live-candidates .plus").first().click();
  await added(page);
  await at_rest(page);
  const was = await rmse(page);
  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  await page.getByRole("button", { name: /^Continue where you were: 2 files/ }).click();
  await page.waitForSelector(".live-fall .rmse:not(:empty)", { timeout: kLong });
  assert.equal(await rmse(page), was);
  await at_rest(page);
  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  await page.getByRole("button", { name: "Delete", exact: true }).click();
  await page.getByRole("button", { name: "Delete it", exact: true }).click(); // the added effect is in no file yet
  await state(page, ".live-told:not(:empty)");
  assert.match(await told(page), /Deleted/);
  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  assert.equal(await page.getByRole("button", { name: /^Continue/ }).count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

test("a report page with its files: saved, and live again where it is dropped", async () => {
  const { page, wrong, close } = await live();
  await sample(page, "hidden-effect");
  await candidates(page);
  const path = await saved(page, "Report page with the files (.html)");
  const alone = await opened_file(path);
  assert.ok(await alone.page.$("#model-y_um"), "it is a report of its own");
  assert.deepEqual(alone.wrong, []);
  await alone.close();
  await page.getByRole("button", { name: "Close", exact: true }).click();
  await dropped(page, path);
  await page.waitForSelector(".live-fall .rmse:not(:empty)", { timeout: kLong });
  await candidates(page);
  assert.deepEqual(wrong, []);
  await close();
});

test("the tour, by keyboard alone; Escape leaves it", async () => {
  const { page, wrong, close } = await live();
  await page.getByRole("button", { name: "A tour of one minute" }).focus();
  await page.keyboard.press("Enter");
  await page.waitForSelector(".live-tour", { timeout: kLong });
  for (let step = 1; step <= 5; ++step) {
    await state(page, `.live-tour[data-step="${step}"]`);
    assert.match(await page.textContent(".live-tour .note"), new RegExp(`^Step ${step} `));
    await page.keyboard.press("Enter");
  }
  await state(page, '.live-tour[data-step="6"]');
  assert.match(await page.textContent(".live-fall"), /before 1\.36 /);
  await page.keyboard.press("Escape");
  assert.equal(await page.locator(".live-tour").count(), 0);
  assert.deepEqual(wrong, []);
  await close();
});

const axe = readFileSync(new URL("node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
const faults = async (page) => {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
  return violations.filter(({ impact }) => ["serious", "critical"].includes(impact)).map(({ id, nodes }) => `${id}: ${nodes.map(({ html }) => html.slice(0, 120)).join(" | ")}`);
};

for (const colorScheme of ["light", "dark"]) {
  test(`no serious fault for who reads otherwise, ${colorScheme}`, async () => {
    const { page, wrong, close } = await live({ colorScheme });
    assert.deepEqual(await faults(page), []);
    await sample(page, "hidden-effect");
    await candidates(page);
    assert.deepEqual(await faults(page), []);
    await page.locator(".live-candidates .plus").first().click();
    await added(page);
    await page.locator(".slider input").first().focus();
    await page.keyboard.press("ArrowRight");
    await at_rest(page);
    assert.deepEqual(await faults(page), []);
    assert.deepEqual(wrong, []);
    await close();
  });
}

test("a phone: nothing runs out of the page", async () => {
  const { page, wrong, close } = await live({ viewport: { width: 390, height: 844 } });
  const wide = () => page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  assert.equal(await wide(), 0);
  for (const name of ["hidden-effect", "qc20-style-b5r", "two-arcs-he2015"]) {
    await sample(page, name);
    await at_rest(page);
    assert.equal(await wide(), 0, name);
    await page.getByRole("button", { name: "Close", exact: true }).click();
    await page.waitForSelector(".samples button:visible");
  }
  assert.deepEqual(wrong, []);
  await close();
});

test("by keyboard alone: choose, add, slide, undo, save", async () => {
  const { page, wrong, close } = await live();
  const to = async (what) => {
    for (let k = 0; k < 200; ++k) {
      await page.keyboard.press("Tab");
      const now = await page.evaluate(() => `${document.activeElement.getAttribute("aria-label") ?? ""}|${document.activeElement.textContent}`);
      if (what.test(now)) return;
    }
    assert.fail(`no stop of the tabulator is ${what}`);
  };
  await to(/hidden-effect$/);
  await page.keyboard.press("Enter");
  await candidates(page);
  await to(/^Add delayed expansion \(T_room_degC\) to the model/);
  const outline = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
  assert.notEqual(outline, "none", "the focus is seen");
  await page.keyboard.press("Enter");
  await added(page);
  await at_rest(page);
  assert.equal(await page.evaluate(() => document.activeElement.textContent), "Undo", "the focus went on");
  const after = await rmse(page);
  await to(/delayed expansion \(T_room_degC\): gain/);
  for (let k = 0; k < 20; ++k) await page.keyboard.press("ArrowLeft");
  assert.ok((await rmse(page)) > after);
  // First what the slider did, then the effect.
  for (let k = 0; k < 25 && (await page.$('.live-loop[data-revisions="2"]')); ++k) {
    await page.keyboard.press("Control+z");
    await page.waitForTimeout(300);
  }
  await taken_back(page);
  assert.doesNotMatch(await page.textContent(".live-model"), /\(T_room/);
  await at_rest(page);
  await page.evaluate(() => document.activeElement.blur());
  await to(/\|Save/);
  await page.keyboard.press("Enter");
  await to(/Model \(\.toml\)/);
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("Enter")]);
  assert.equal(download.suggestedFilename(), "model.toml");
  assert.deepEqual(wrong, []);
  await close();
});

test("a file that will not fit is not loaded, and it is said", async () => {
  const { page, wrong, close } = await live();
  await page.evaluate(() => {
    const piece = new Blob([new Uint8Array(1 << 20)]);
    const transfer = new DataTransfer();
    transfer.items.add(new File(Array.from({ length: 1100 }, () => piece), "huge.csv"));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: transfer, bubbles: true, cancelable: true }));
  });
  await page.waitForSelector(".live-files .faulty", { timeout: kLong });
  assert.match(await page.innerText(".live-files .faulty"), /huge\.csv[^]*was not loaded: about [\d.]+ MB/);
  await dropped(page, of_run("qc20-style-b5r", "00.b5r"));
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  assert.deepEqual(wrong, []);
  await close();
});

test("a million rows", async () => {
  const { page, wrong, close } = await live();
  const rows = ["time_s,T_room_degC,y_um"];
  for (let i = 0; i < 1_000_000; ++i) rows.push(`${i},${(20 + 2 * Math.sin(i / 9e4)).toFixed(2)},${(3 * Math.sin(i / 9e4 - 0.5) + ((i * 7919) % 101) / 500).toFixed(3)}`);
  const path = join(folder, "million.csv");
  writeFileSync(path, rows.join("\n"));
  await page.locator("input[type=file]:not([webkitdirectory])").first().setInputFiles(path);
  await page.waitForSelector(".live-report main", { timeout: kLong });
  assert.match(await page.innerText(".verdict"), /by 6\.2 µm, from -3 to 3\.2/); // from the first of the rows to the last
  await page.getByRole("button", { name: "Find the cause of the drift" }).click();
  await state(page, '.live-loop[data-search="running"]');
  await page.keyboard.press("Escape");
  await state(page, '.live-loop[data-search="stopped"]');
  await idle(page);
  assert.match(await page.textContent(".live-loop .said"), /Stopped/);
  assert.deepEqual(wrong, []);
  await close();
});

test("in another language, with what was done as it was", async () => {
  const { page, wrong, close } = await live();
  await page.getByRole("combobox", { name: "Language" }).selectOption("de");
  assert.match(await page.innerText(".drop .here"), /hier ablegen/);
  await sample(page, "hidden-effect");
  await candidates(page);
  await page.locator(".live-candidates .plus").first().click();
  await added(page);
  assert.match(await page.textContent(".live-fall"), /vorher/);
  await at_rest(page);
  assert.match(await page.textContent(".live-fall .rmse"), /^RMSE 0,431 µm$/);
  await page.evaluate(() => window.ballbar.figures.get("live-fit").see([100, 200]));
  await page.click(".live-effects > summary");
  await page.fill(".live-effects input", "Reibung");
  const effects_found = () => page.$$eval(".live-effects li", (all) => all.map(({ dataset }) => dataset.effect).sort());
  const found = await effects_found();
  assert.ok(found.includes("speed_heating"));
  await page.locator(".page-tools select").selectOption("zh");
  await state(page, '.live-loop[lang="zh"] .live-fall[data-beside]');
  assert.match(await page.textContent(".live-fall"), /噪声/);
  const window_now = () => page.evaluate(() => window.ballbar.figures.get("live-fit").state().window);
  assert.deepEqual((await window_now())?.map(Math.round), [100, 200], "the picture shows what it showed");
  assert.equal(await page.inputValue(".live-effects input"), "Reibung", "a word that was typed stays");
  assert.ok(await page.locator(".live-effects").evaluate((one) => one.open));
  assert.deepEqual(await effects_found(), found);
  assert.ok((await page.$$eval(".live-model .effect bdi", (all) => all.map(({ title }) => title))).includes("lagged_expansion(T_room_degC)"));
  const gain = page.locator(".live-model input[type=range]").nth(1);
  await gain.evaluate((one) => {
    one.value = String(1.1 * Number(one.value));
    one.dispatchEvent(new Event("input", { bubbles: true }));
  });
  const [value, error] = [await gain.inputValue(), await page.textContent(".live-fall .rmse")];
  await page.locator(".page-tools select").selectOption("en");
  await state(page, '.live-loop[lang="en"] .live-fall[data-beside]');
  assert.equal(await gain.inputValue(), value, "the slider stays where it was moved");
  assert.equal(await page.textContent(".live-fall .rmse"), error);
  assert.equal(await page.locator(".live-model .track.moved").count(), 1);
  for (const name of ["Undo", "Undo"]) await page.getByRole("button", { name }).click();
  await taken_back(page);
  await at_rest(page);
  assert.match(await page.textContent(".live-fall"), /RMSE 1\.36/);
  assert.deepEqual(wrong, []);
  await close();
});

// The page as it is, with something done before its script runs.
const live_after = async (script) => {
  const { page, wrong, close } = await live();
  await page.addInitScript(script);
  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  return { page, wrong, close };
};

test("where the browser keeps nothing: it is said, and all else works", async () => {
  const { page, wrong, close } = await live_after(() => {
    Object.defineProperty(window, "indexedDB", { get: () => ({ open: () => { throw new DOMException("no", "SecurityError"); } }) });
  });
  assert.match(await page.innerText(".live-start"), /This browser keeps nothing here/);
  await dropped(page, of_run("qc20-style-b5r", "00.b5r"));
  await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
  assert.deepEqual(wrong, []);
  await close();
});

for (const [why, said] of [["RangeError: WebAssembly.Memory(): could not allocate memory", /ran out of this tab's memory/], ["RuntimeError: unreachable", /failed and was started anew/]]) {
  test(`the program gives up (${why.split(":")[0]}): it is said, and it goes on with the files`, async () => {
    const { page, wrong, close } = await live_after(`{
      const Own = window.Worker;
      let failed = false;
      window.Worker = class extends Own {
        postMessage(data, give) {
          if (data.kind === "call" && data.call.call === "report" && !failed) {
            failed = true;
            this.onmessage({ data: { id: data.id, kind: "failed", why: ${JSON.stringify(why)} } });
          } else super.postMessage(data, give);
        }
      };
    }`);
    await dropped(page, of_run("qc20-style-b5r", "00.b5r"), of_run("two-arcs-he2015", "signals.csv"));
    await state(page, ".live-told:not(:empty)");
    assert.match(await told(page), said);
    await page.locator(".live-shelf .groups button", { hasText: "00.b5r" }).click();
    await page.waitForSelector('figure[data-picture="machine-errors"]', { timeout: kLong });
    assert.equal(await told(page), "");
    assert.deepEqual(wrong, []);
    await close();
  });
}
