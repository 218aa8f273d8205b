// What the page says in each language: complete, in no other place than the texts, and on the page itself.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync, symlinkSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { drawn, figure, launched, opened, saved, seen } from "./browser.mjs";
import { data_of, page_with, with_errors } from "./machine_errors.mjs";
import { literals_in, literals_of, symbol } from "./literals.mjs";
import { folder, hidden_effect, history, json_of, of_run, report, two_arcs } from "./reports.mjs";
import { strange_diagnosis, strange_log } from "./strange_log.mjs";
import { expect_translated, source, texts, told } from "./texts.mjs";

const { en, de, zh, speak, said: said_of, explained_by } = texts();
const others = { de, zh };

const flat = (all) =>
  Object.entries(all).flatMap(([key, entry]) =>
    typeof entry === "object" ? Object.entries(entry).map(([name, one]) => [`${key}.${name}`, one]) : [[key, entry]],
  );

// Words that are the same in another language.
const same = new Set([
  ...["drift", "drift_axis_quantity", "model_parameter", "model_result", "page_language", "history_trend", "live_redo"],
  ...["quantities.trend", "quantities.radial", "quantities.axial", "recordings_axial", "effects.oval", "states.free"],
  ...["quantities.test", "places.quadrant", "diagnosis_revision", "roles.event", "errors_plus", "drift_in_axis", "live_save_drift", "quantities.sigma"],
]);

test("texts: a name or a place that only one language has stops the build", () => {
  const english = { plain: "one", counted: "{n} {n:test|tests}" };
  expect_translated(english, { counted: "{n} 个测试", plain: "一" }, "zh.toml");
  const faults = [
    [{ counted: "{n} Tests" }, "de.toml: expected a line for plain, as en.toml has it"],
    [{ ...english, more: "mehr" }, "de.toml: more is no text of en.toml"],
    [{ ...english, counted: "Tests" }, "de.toml: counted lacks the place {n} of en.toml"],
    [{ ...english, plain: "{one}" }, "de.toml: plain has a place {one} that en.toml does not have"],
  ];
  for (const [german, message] of faults) assert.throws(() => expect_translated(english, german, "de.toml"), { message });
});

test("texts: their types are made through a link too", () => {
  const [link, types] = [join(folder, "linked.mjs"), join(folder, "types.ts")];
  symlinkSync(join(process.env.BALLBAR_PAGE_SOURCE, "catalogues.mjs"), link);
  execFileSync(process.execPath, [link, types]);
  assert.match(readFileSync(types, "utf8"), /^export interface Texts \{$/m);
});

test("texts: none empty, none left in English", () => {
  for (const [language, all] of Object.entries(others)) {
    const known = new Map(flat(all));
    const left = flat(en).filter(([key, entry]) => {
      const [ours, theirs] = [told(known.get(key)), told(entry)];
      assert.notEqual(ours.trim(), "", `${language}: ${key}`);
      const words = theirs.replace(/§\w+§/g, "");
      return ours === theirs && !symbol.test(words) && !same.has(key);
    });
    assert.deepEqual(left.map(([key]) => key), [], `${language}: as in English`);
  }
});

test("texts: each is said somewhere", () => {
  const code = readdirSync(source, { recursive: true })
    .filter((path) => path.endsWith(".ts") && !path.startsWith("texts/"))
    .map((path) => readFileSync(join(source, path), "utf8"))
    .join("\n");
  assert.deepEqual(Object.keys(en).filter((key) => key !== "decimal_sign" && !new RegExp(`\\bt\\.${key}\\b`).test(code)), []);
});

test("glossaries: every effect, verdict and error of the machine", () => {
  const base = (name) => name.split("_").filter((part) => !["a", "b", "pos", "neg", "fwd", "rev"].includes(part)).join("_");
  const missing = [];
  const expect = (glossary, name) => Object.hasOwn(en[glossary], name) || missing.push(`${glossary}: ${name}`);
  for (const { name } of json_of("effects")) expect("effects", base(name));
  for (const file of ["00.b5r", "03.b5r", "05.b5r"]) {
    for (const { errors } of json_of("report", of_run("qc20-style-b5r", file)).machine_errors ?? []) {
      for (const { name } of errors) expect("effects", base(name));
    }
  }
  const verdicts = /verdict: (("\w+"( \| )?)+);/.exec(readFileSync(join(source, "report.ts"), "utf8"))?.[1] ?? "";
  assert.ok(verdicts.split("|").length >= 7, verdicts);
  for (const [, verdict] of verdicts.matchAll(/"(\w+)"/g)) expect("verdicts", verdict);
  const drift = json_of("report", of_run("two-arcs-he2015"));
  for (const { columns } of drift.signals) for (const { role } of columns) expect("roles", role);
  assert.deepEqual(missing, []);
});

test("catalogue: what an effect is, and all that is said of an error of the machine, in every language", () => {
  const texts_of = json_of("effects").map(({ level, name, summary }) => [level, name, "summary", summary]);
  const [{ pages }] = json_of("report", of_run("qc20-style-b5r", "00.b5r")).machine_errors;
  assert.ok(pages.length >= 15, "every error of the catalogue has a page");
  for (const page of pages) {
    for (const key of ["summary", "cause", "signature", "separated_by", "remedy"]) texts_of.push(["recording", page.effect, key, page[key]]);
  }
  for (const language of Object.keys(others)) {
    speak(language);
    const left = texts_of.filter(([level, effect, key, text]) => text !== "" && typeof explained_by(level, effect, key, text, "XY") !== "string");
    assert.deepEqual(left, [], `${language}: not translated`);
  }
});

test("messages: places, plurals, lists, effects and numbers in each language", () => {
  const effects = (first, last) => [{ name: "enumeration", values: { 1: { effect: first }, 2: { effect: last } } }];
  const found = [
    { name: "test_beside", values: { effects: effects("settling", "expansion(T1_degC)"), n: "2" } },
    { name: "limits_pass", values: { n: "1" } },
    { name: "error_falls", values: { before_um: "3.1", after_um: "1.2" } },
    { name: "", values: { text: "T1.5_degC" } },
  ];
  const told_in = (language, messages) => {
    speak(language);
    return said_of("in English", messages);
  };
  assert.equal(
    told_in("de", found),
    `Prüfung und Amplitude gelten unter der Annahme, dass auch ${de.effects.settling} und ${de.effects.expansion} (T1_degC) fehlen. 1 gespeichertes Ergebnis liegt in den Grenzen der Datei Der Restfehler sinkt von 3,1 auf 1,2 µm. T1.5_degC`,
  );
  assert.equal(told_in("zh", found.slice(1, 3)), "1 个存储结果在文件规定的限值内剩余误差从 3.1 降至 1.2 µm。");
  assert.deepEqual(told_in("de", [{ name: "of_no_catalogue", values: {} }]), { before: "", english: "in English" });
  assert.deepEqual(told_in("de", undefined), { before: "", english: "in English" });
  assert.deepEqual(told_in("en", found), { before: "", english: "in English" });
});

// What is no text of the page: marks, styles, what only a program reads.
const meant = [
  /^drawing\/(command|theme)\.ts/,
  /^figure\/(files|still)\.ts/,
  /^handover\/drawing\.ts/,
  /^(boot|shell|worker)\.ts/,
  /^engine\.ts:\d+: (the engine gave no answer|no file 0)$/,
  /: (600 13px 0|12px 0|\(prefers-color-scheme: dark\)|first wide|ballbar (add|history) |⺀|←|→|≤ 0|≥ 0)$/,
];

test("code: what a reader sees comes from the texts alone", () => {
  const caught = (text) => literals_in(text).map((one) => one.text);
  assert.deepEqual(caught('element("p", {}, "none")'), ["none"]);
  assert.deepEqual(caught("const a = { title: many ? `${n} rows` : t.one };"), ["0 rows"]);
  assert.deepEqual(caught('axis(look, "residual", "y"); tell("Not found here");'), ["residual", "Not found here"]);
  assert.deepEqual(caught('curve(t.model, "solid", { type: "line", name: `trace${k}` }); if (a === "Some words") b();'), []);
  assert.deepEqual(literals_of(source).filter((one) => !meant.some((known) => known.test(one))), []);
});

// English that would be seen if a text were forgotten. Names of files and commands are not of a language.
const english = /\b(the|and|with|without|less|each|below|above|measured|recording|readings|deviation|residual|model of|drift of|largest|least|reference|error|errors|errors of|centre|about|show|save|select|time|angle|speed|none|all)\b/i;

// Of all elements that are seen and are in the page's language: text that has such words.
const foreign_texts = (page, pattern) =>
  page.evaluate((pattern) => {
    const found = [];
    for (const fold of document.querySelectorAll("details")) fold.open = true;
    const title = document.querySelector("h1").textContent; // of a file, which may stand elsewhere too
    const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walk.nextNode(); node; node = walk.nextNode()) {
      const holder = node.parentElement;
      if (holder.closest("[lang=en], script, style, noscript, bdi, h1, code, pre, option, .numbers")) continue;
      const text = node.textContent.replace(title, "").replace(/\w*_\w*(\([^)]*\))?|\S+\.(csv|toml|b5r)/g, "");
      if (new RegExp(pattern, "i").test(text)) found.push(text);
    }
    for (const one of document.querySelectorAll("[aria-label], [title]")) {
      for (const name of ["aria-label", "title"]) {
        const text = (one.getAttribute(name) ?? "").replace(/\w*_\w*/g, "");
        if (new RegExp(pattern, "i").test(text)) found.push(`${name}: ${text}`);
      }
    }
    return found;
  }, pattern.source);

let browser, pages;
before(async () => {
  browser = await launched();
  pages = {
    errors: await report("errors", of_run("qc20-style-b5r", "00.b5r")),
    drift: await two_arcs(),
    hidden: await hidden_effect(),
    history: await history(),
    strange: await strange_log(),
  };
});
after(() => browser.close());

for (const [locale, lang] of [["de-DE", "de"], ["zh-CN", "zh-Hans"]]) {
  test(`page: ${locale} says nothing in English that is not marked`, async () => {
    for (const [name, file] of Object.entries(pages)) {
      const { page, wrong, close } = await opened(browser, file, { locale });
      assert.equal(await page.getAttribute("html", "lang"), lang, name);
      assert.deepEqual(await foreign_texts(page, english), [], `${name} in ${locale}`);
      assert.deepEqual(wrong, []);
      await close();
    }
  });
}

test("page: a sentence of the program that the page does not have is marked as English", async () => {
  const { page, wrong, close } = await opened(browser, with_errors("made-up", pages.errors), { locale: "de-DE" });
  assert.ok((await page.locator("#machine-errors [lang=en]", { hasText: "All of them together leave 0.58" }).count()) > 0);
  assert.deepEqual(wrong, []);
  await close();
});

test("numbers: the decimal sign of the language in table, axis and hover; a saved table keeps the point", async () => {
  const { page, close } = await opened(browser, pages.drift, { locale: "de-DE" });
  const box = await seen(page, "drift");
  const section = page.locator("section#drift > details");
  if (!(await section.evaluate((one) => one.open))) await section.locator("> summary").click();
  await drawn(page);
  assert.match(await page.locator(".first .summary table").textContent(), /31,725 ± 0,015/);
  const labels = await page.evaluate(() => {
    const { picture, state } = window.ballbar.figures.get("drift");
    const { yAxis, xAxis, tooltip } = picture.draw(state());
    const items = [{ seriesName: "y", marker: "", value: [1.5, 2.25, 0.125], axisValue: 1.5 }];
    return { y: yAxis.axisLabel.formatter(2.5), x: xAxis.axisLabel.formatter(0.25), hover: tooltip.formatter(items) };
  });
  assert.equal(labels.y, "2,5");
  assert.equal(labels.x, "0,25");
  assert.match(labels.hover, /1,5 min\ny {2}2,25 ± 0,1\d+ µm/);
  await page.evaluate(() => window.ballbar.figures.get("drift").element.querySelector(".chart").focus());
  await page.keyboard.press(".");
  assert.match(await page.locator("[aria-live]").first().textContent(), /^Zeit /);
  const file = await saved(page, "drift", "CSV");
  const [head, ...rows] = readFileSync(file.path, "utf8").trim().split("\r\n");
  assert.match(head, /^time_min,x_um,x_sigma_um/);
  for (const row of rows) assert.equal(row.split(",").length, head.split(",").length, row);
  assert.match(rows.join("\n"), /\d\.\d/);
  assert.ok(await box.count());
  await close();
});

test("choice: the page is written anew, with what was chosen, zoomed and unfolded", async () => {
  const { page, wrong, close } = await opened(browser, pages.errors, { locale: "en-US" });
  assert.equal(await page.getAttribute("html", "lang"), "en");
  await seen(page, "machine-errors");
  await page.evaluate(() => window.ballbar.figures.get("machine-errors").choose("error", "squareness"));
  await page.locator("section#recordings > details > summary").click();
  await page.getByLabel("Language").selectOption("Deutsch");
  await drawn(page);
  assert.equal(await page.getAttribute("html", "lang"), "de");
  assert.equal(await page.evaluate(() => window.ballbar.figures.get("machine-errors").state().chosen.error), "squareness");
  assert.ok(await page.locator("section#recordings > details").evaluate((one) => one.open));
  assert.match(await page.locator(".verdict").textContent(), /Die Behebung von Skalierungsdifferenz \(Eine Achse fährt weiter als die andere\) senkt die Kreisformabweichung von 5,6 auf 2,3 µm/);
  assert.equal(await figure(page, "machine-errors").count(), 1);
  await page.getByLabel("Sprache").selectOption("中文");
  assert.match(await page.locator(".verdict").textContent(), /修复比例不匹配（.*）后，圆度从 5\.6 µm 降至 2\.3 µm/);
  await page.getByLabel("语言").selectOption("English");
  assert.match(await page.locator(".verdict").textContent(), /Correcting scale mismatch .*lowers the circularity from 5\.6 to 2\.3 µm/);
  assert.deepEqual(wrong, []);
  await close();
});

const micrometres = (text) => text.replace(/(?<=[\d±] )um\b/g, "µm");
// Its paragraphs, each with what it is.
const conclusion = (page) => page.$$eval(".first .verdict p", (all) => all.map((one) => [one.className, one.textContent]));

test("diagnosis: what was not used is said first, as on the terminal; a slow drift without a cause last", async () => {
  const { sentence, columns_not_searched, saturated, set_aside, level_jumps } = strange_diagnosis();
  assert.deepEqual([columns_not_searched.length, saturated.length, set_aside, level_jumps], [1, 1, 2, 3]);
  const { page, wrong, close } = await opened(browser, pages.strange, { locale: "en-US" });
  const [, ...of_said] = /^(door was .*?\.) (T_wall_degC .*? These .*?\.) (2 readings .*?\.) (z_um jumps .*?\.) (.*?\)\.) .*(About ±.*?\.) Log /s.exec(micrometres(sentence));
  assert.equal(of_said.length, 6, sentence);
  assert.deepEqual(await conclusion(page), of_said.map((one, k) => [k < 4 ? "before" : k === 4 ? "" : "also", one]));
  assert.equal(await page.locator("section#diagnosis p", { hasText: micrometres(sentence) }).count(), 1);
  assert.deepEqual(wrong, []);
  await close();
});

const in_languages = {
  de: [
    ["before", "door wurde nicht berücksichtigt: sie hat Lücken."],
    ["before", "T_wall_degC steht bei 18 % der Zeilen am Ende des Messbereichs, wie bei einem Sensor in Sättigung. Diese Zeilen bleiben außer Betracht."],
    ["before", "2 Messwerte weit ab von den übrigen bleiben außer Betracht."],
    ["before", "z_um springt 3-mal, um 5 µm: Korrekturen der Steuerung oder des Tasters, keine Drift."],
    ["", "Dem Modell von z_um fehlt etwas von etwa 8,9 µm (über 99 % sicher)."],
    ["also", "Für etwa ±2,7 µm langsame Drift von z_um findet sich unter diesen Spalten keine Ursache."],
  ],
  zh: [
    ["before", "door 未被搜索：该列有缺口。"],
    ["before", "T_wall_degC 在 18 % 的数据行中处于量程终点，如同传感器饱和。这些行不予采用。"],
    ["before", "2 个远离其他读数的读数不予采用。"],
    ["before", "z_um 跳变 3 次，幅度 5 µm：是控制系统或测头的修正，不是漂移。"],
    ["", "z_um 的模型缺少约 8.9 µm 的成分（把握 超过 99 %）。"],
    ["also", "z_um 约 ±2.7 µm 的缓慢漂移在这些列中找不到原因。"],
  ],
};

for (const [language, expected] of Object.entries(in_languages)) {
  test(`diagnosis: the same in the language ${language}`, async () => {
    const { page, wrong, close } = await opened(browser, pages.strange, { locale: language });
    assert.deepEqual(await conclusion(page), expected);
    assert.equal(await page.locator(".first .verdict [lang=en]").count(), 0);
    assert.deepEqual(wrong, []);
    await close();
  });
}
