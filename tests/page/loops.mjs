// node loops.mjs [NAME...]: what a person does with the page, over many data, in Chromium; what was promised and what
// came. A NAME runs the loops whose name begins with it. One JSON line a step (to OUT, or loops.jsonl), a table at the
// end. Exit 1 where a step failed. Asserts no time: a busy machine is slow.
//
// BALLBAR_HTML  the page; CHROMIUM  the browser
// SAMPLE_RUNS   default ../../sample-runs; SETS, SHARED  folders of more data, left out where they are not given
// LIMIT_S       one loop at most, default 40, times the load of each processor, up to 4; ALL_S  all of them, default 900; KIND=buttons runs only loops of that step;
//               RESUME=1 keeps what OUT holds and runs what is not in it, or was given up
import { appendFileSync, existsSync, readFileSync, readdirSync, statSync, writeFileSync } from "node:fs";
import { availableParallelism, loadavg } from "node:os";
import { basename, join } from "node:path";
import { launched } from "./browser.mjs";
import { address_of } from "./watched.mjs";

const tool = process.env.BALLBAR_HTML;
if (!tool) throw new Error("expected BALLBAR_HTML in the environment: the page with the program in it");
const sample_runs = process.env.SAMPLE_RUNS ?? new URL("../../sample-runs", import.meta.url).pathname;
const { SETS: made, SHARED: shared } = process.env;
const limit_s = Number(process.env.LIMIT_S ?? 40);
const all_s = Number(process.env.ALL_S ?? 900);
const out = process.env.OUT ?? "loops.jsonl";

// The loops: a name, files, steps, and what is hidden where that is known.

const of_run = (...parts) => join(sample_runs, ...parts);
const below = (folder, like = /./) =>
  readdirSync(folder)
    .filter((name) => like.test(name) && statSync(join(folder, name)).isFile())
    .sort()
    .map((name) => join(folder, name));

const loops = [
  ["hidden-effect", [of_run("hidden-effect/01/data.csv"), of_run("hidden-effect/01/model.toml")], "plus undo redo plus save close"],
  ["hidden-effect-third", [of_run("hidden-effect/01/data.csv"), of_run("hidden-effect/01/model.toml")], "third plus buttons"],
  ["hidden-effect-sliders", [of_run("hidden-effect/01/data.csv"), of_run("hidden-effect/01/model.toml")], "slider plus slider undo"],
  ["hidden-effect-no-model", [of_run("hidden-effect/01/data.csv")], "plus plus act"],
  ["two-arcs", below(of_run("two-arcs-he2015"), /\.(csv|toml)$/), "plus plus keep undo"],
  ["two-arcs-third", below(of_run("two-arcs-he2015"), /\.(csv|toml)$/), "third plus undo undo"],
  ["two-arcs-no-model", below(of_run("two-arcs-he2015"), /\.csv$|session\.toml$/), "plus plus buttons"],
  ["two-arcs-plan", below(of_run("two-arcs-he2015"), /\.(csv|toml)$/), "plan"],
  ["spindle-46h-speed", [of_run("spindle-46h/measured.csv"), of_run("spindle-46h/speed.toml")], "plus"],
  ["spindle-46h-ch5", [of_run("spindle-46h/measured.csv"), of_run("spindle-46h/ch5.toml")], "plus undo"],
  ["compensation-lagged", [of_run("compensation/train.csv"), of_run("compensation/lagged.toml")], "plus undo"],
  ["compensation-model", [of_run("compensation/train.csv"), of_run("compensation/model.toml")], "plus third undo redo"],
  ["compensation-no-model", [of_run("compensation/train.csv")], "all plus"],
  ["foreign-warmup", [of_run("foreign-logs/warmup.csv")], "plus plus"],
  ["foreign-probes", [of_run("foreign-logs/probes.csv"), of_run("foreign-logs/control.csv")], "plus buttons"],
  ["spindle-rotation", below(of_run("spindle-rotation-huang2022"), /-[zr]\.csv$|signals\.csv$|session\.toml$/), "plus buttons"],
  ["qc20-six", below(of_run("qc20-style-b5r"), /\.b5r$/), "act buttons"],
  ["qc20-one", [of_run("qc20-style-b5r/03.b5r")], "act buttons"],
  ["machine-history", { folder: of_run("machine-history") }, "act buttons"],
  ["batches-b05", [of_run("batches-tan2024/b05.csv")], "plus plus"],
  ["batches-two", [of_run("batches-tan2024/b05.csv"), of_run("batches-tan2024/b14.csv")], "act buttons"],
  ["temperature-images", [of_run("temperature-images/series.csv")], "plus plus"],
].map(([name, files, steps]) => ({ name, files, steps: steps.split(" ") }));

if (shared) {
  const of_shared = (...parts) => join(shared, ...parts);
  loops.push(
    { name: "b5r-xy", files: [of_shared("ballbar-b5r/xy-360-50mm.b5r")], steps: ["act", "buttons"] },
    { name: "b5r-two", files: below(of_shared("ballbar-b5r"), /b5r$/), steps: ["act"] },
    { name: "spindle-24krpm", files: [of_shared("spindle-24krpm/set-02.csv")], steps: ["plus", "undo"] },
    ...["20200615", "20200730", "20200914"].map((day) => ({ name: `lathe-${day}`, files: [of_shared(`lathe-chamber/${day}.csv`)], steps: ["plus", "plus"] })),
    { name: "ace", files: [of_shared("ace/ACE_X.xlsx"), of_shared("ace/ACE_Y.xlsx")], steps: ["act"] },
  );
}
if (made) {
  const truth = JSON.parse(readFileSync(join(made, "sets.json"), "utf8"));
  const plans = ["plus plus", "plus undo redo", "third undo", "all plus", "plus slider", "plus plus keep"];
  for (const [k, [name, { hidden }]] of Object.entries(truth).entries()) {
    loops.push({ name: `set-${name}`, files: below(join(made, name)), steps: plans[k % plans.length].split(" "), hidden });
  }
}
const wanted = process.argv.slice(2);
const chosen = loops.filter(({ name, steps }) => (wanted.length === 0 || wanted.some((one) => name.startsWith(one))) && (!process.env.KIND || steps.includes(process.env.KIND)));

// Within the page.

const in_page = () => {
  const look = (selector) => document.querySelector(selector);
  const text = (selector) => look(selector)?.textContent?.trim() ?? "";
  const seen = (one) => one.isConnected && one.checkVisibility({ checkOpacity: true, checkVisibilityCSS: true }) && one.getClientRects().length > 0;
  const state = () => ({
    rmse: text(".live-fall .rmse"),
    beside: text(".live-fall .beside"),
    said: text(".live-loop .said"),
    refusal: text(".live-loop .refusal:not([hidden])"),
    told: text(".live-told"),
    revisions: look(".live-loop")?.dataset.revisions ?? "",
    effects: document.querySelectorAll(".live-model > li").length,
    search: look(".live-loop")?.dataset.search ?? "",
    waiting: look(".live-work")?.dataset.waiting ?? "",
    busy: look(".live-loop")?.hasAttribute("aria-busy") ?? false,
  });
  const probe = (window.probe = { log: [], changes: 0, calls: [], state, seen });
  let last = "";
  new MutationObserver((all) => {
    probe.changes += all.filter(({ target }) => !(target.nodeType === 1 ? target : target.parentElement)?.closest(".live-work")).length;
    const now = state();
    const key = JSON.stringify(now);
    if (key === last) return;
    last = key;
    probe.log.push({ at: performance.now(), ...now });
  }).observe(document, { subtree: true, childList: true, characterData: true, attributes: true });
  const hook = (of, name) => {
    const own = of?.[name];
    if (own) of[name] = function (...given) { probe.calls.push(name); return own.apply(this, given); };
  };
  hook(URL, "createObjectURL");
  hook(window, "print");
  hook(navigator.clipboard, "writeText");
  hook(document, "execCommand");
  hook(Element.prototype, "scrollIntoView");
  hook(Element.prototype, "requestFullscreen");
  window.print = () => probe.calls.push("print");
  // Canvases as they are, to see whether a button repaints one of them otherwise.
  probe.drawn = () => [...document.querySelectorAll("canvas")].filter(seen).map((one) => { try { return one.toDataURL().length; } catch { return 0; } }).join();
  probe.candidates = () =>
    [...document.querySelectorAll(".live-candidates .plus")].map((plus) => ({
      label: plus.getAttribute("aria-label") ?? plus.textContent,
      row: (plus.closest("li") ?? plus.parentElement).textContent.trim(),
      can: !plus.disabled,
    }));
  probe.press = (one) => {
    const at = performance.now();
    probe.log.length = 0;
    one.click();
    return at;
  };
  const commands = "fit|drift|compare|import|errors|history|report|effects|could|check|diagnose|plan|add|undo|ledger|train|predict|compensate|simulate";
  const shell = new RegExp(`\\bterminals?\\b|command.line|Kommandozeile|\\bballbar (${commands})\\b|(^|\\s)--[a-z][a-z-]+`, "i");
  probe.terminal = () => [...new Set(document.body.innerText.split("\n").filter((line) => shell.test(line) && !/^software version/i.test(line.trim())).map((line) => line.trim().slice(0, 160)))];
  probe.hover = () => [...new Set([...document.querySelectorAll("[title]")].filter((one) => seen(one) && shell.test(one.title)).map((one) => one.title.slice(0, 100)))];
  probe.headline = () => [...document.querySelectorAll(".verdict")].filter(seen).map((one) => one.innerText.trim()).join(" | ").slice(0, 700);
};

const record = (line) => appendFileSync(out, `${JSON.stringify(line)}\n`);

// Numbers of a text, with the decimals that are printed.

const number_of = (text) => {
  const [found] = /-?\d+(?:[.,]\d+)?(?:e[-+]?\d+)?/.exec(text) ?? [];
  return found === undefined ? null : { text: found, value: Number(found.replace(",", ".")), decimals: /[.,](\d+)/.exec(found)?.[1].length ?? 0 };
};
const promised_in = (row) => {
  const found = [...row.matchAll(/(?:→|->|RMSE)\s*(-?[\d.,]+\d|\d)/g)].at(-1);
  return found ? number_of(found[1]) : null;
};
// To the last digit that both print.
const same = (a, b) => {
  const decimals = Math.min(a.decimals, b.decimals);
  const coarse = a.decimals < b.decimals ? a : b;
  const fine = coarse === a ? b : a;
  // Half a digit more, for what was rounded twice.
  return Math.abs(coarse.value - fine.value) <= 0.5 * 10 ** -decimals + (a.decimals === b.decimals ? -0.4 * 10 ** -decimals : 0.51 * 10 ** -fine.decimals);
};
const kind_of = (verdict) =>
  /Nothing further is missing/i.test(verdict) ? "nothing"
  : /data do not tell/i.test(verdict) ? "cannot tell"
  : /drives? (about .* um|a part) that/i.test(verdict) ? "a driver"
  : /, but the data say /i.test(verdict) ? "a held value is wrong"
  : /^Something|[.:] Something |depends on time alone/i.test(verdict) ? "something"
  : /missing from /i.test(verdict) ? "named"
  : /has no cause among these columns|beside its jumps/i.test(verdict) ? "something"
  : "other";
const refused_in = (said) => said.find((one) => /do not support|does not support|not kept|too few|cannot be resolved/i.test(one)) ?? "";

// One loop.

let failures = 0; // of all loops that are run
const fails = (loop, step, kind, what = "") => {
  ++failures;
  record({ loop, step, failure: kind, what: String(what).slice(0, 300) });
};

class GaveUp extends Error {}

const driven = async (browser, { name, files, steps, hidden }) => {
  const context = await browser.newContext({ viewport: { width: 1400, height: 900 }, acceptDownloads: true });
  const page = await context.newPage();
  // Known to be long; and a machine that is shared is slow.
  const limit = Math.round(limit_s * (/plan|46h/.test(name) ? 2.5 : 1) * Math.min(4, Math.max(1, loadavg()[0] / availableParallelism())));
  const ends = performance.now() + limit * 1000;
  const thrown = [];
  const errors = [];
  const effects_outside = []; // downloads, dialogs, choosers
  page.on("pageerror", (error) => thrown.push(`${error?.stack ?? error}`.slice(0, 400)));
  page.on("console", (message) => ["error", "warning", "assert"].includes(message.type()) && errors.push(`${message.type()}: ${message.text()}`.slice(0, 300)));
  page.on("dialog", (dialog) => {
    effects_outside.push(`dialog: ${dialog.message()}`);
    dialog.accept().catch(() => {});
  });
  page.on("download", (download) => effects_outside.push(`download: ${download.suggestedFilename()}`));
  page.on("filechooser", () => effects_outside.push("files are chosen"));
  page.on("popup", (other) => { effects_outside.push("window"); other.close().catch(() => {}); });

  let step = "load";
  let of_step = {};
  const fail = (kind, what) => fails(name, step, kind, what);
  const left_ms = () => ends - performance.now();
  const spent = () => { if (left_ms() <= 0) throw new GaveUp(step); };
  const now = () => page.evaluate(() => window.probe.state());
  const quiet = async () => {
    let still = 0;
    for (let last = ""; still < 3; ) {
      spent();
      await page.waitForTimeout(120);
      const state = await now();
      const key = JSON.stringify(state);
      // Work that has no bar of its own would be missed: three looks alike.
      still = state.waiting !== "0" && state.waiting !== "" ? 0 : state.busy || state.search === "running" ? 0 : key === last ? still + 1 : 0;
      last = key;
    }
  };
  const watched_words = async () => {
    for (const line of await page.evaluate(() => window.probe.terminal())) if (!terminal_lines.has(line)) { terminal_lines.add(line); fail("terminal words", line); }
    for (const line of await page.evaluate(() => window.probe.hover())) hover_lines.add(line);
  };
  const terminal_lines = new Set();
  const hover_lines = new Set();
  const done = async (more = {}) => {
    await watched_words();
    for (const one of thrown.splice(0)) { (of_step.exceptions ??= []).push(one); fail("uncaught exception", one); }
    for (const one of errors.splice(0)) { (of_step.console ??= []).push(one); fail("console error", one); }
    const state = await now();
    record({ loop: name, step, ...of_step, ...more, verdict_kind: kind_of(state.said), said: state.said, told: state.told, rmse: state.rmse, revisions: state.revisions, load: loadavg()[0].toFixed(1), ...(effects_outside.length > 0 && { outside: effects_outside.splice(0) }) });
    of_step = {};
    return state;
  };

  const verdicts = []; // { kind, said, refused } after each step
  const judge = (state, refused) => {
    const kind = kind_of(state.said);
    const before = verdicts.at(-1);
    const [rmse, floor] = [number_of(state.rmse), number_of(/(?:noise|Rauschen|噪声)\D*([\d.,]+)/i.exec(state.beside)?.[1] ?? "")];
    const times_floor = rmse && floor && floor.value > 0 ? rmse.value / floor.value : null;
    if (refused && kind === "nothing" && before && before.kind !== "nothing") fail("refusal forgotten", `"${before.said}" then "${refused}" then "${state.said}"`);
    if (kind === "nothing" && times_floor > 2.5) fail("lacks nothing, far above the floor", `${times_floor.toFixed(1)} times: ${state.said}`);
    of_step.times_floor = times_floor === null ? null : Number(times_floor.toFixed(2));
    verdicts.push({ kind, said: state.said });
  };

  // By a click on the n-th candidate, or on one that says what it is.
  const change = async (what, choose) => {
    const before = await now();
    const rows = await page.evaluate(() => window.probe.candidates());
    const pick = choose(rows);
    if (!pick) { of_step.skipped = "no such candidate"; return done(); }
    // It comes a moment after the verdict; of one that is folded away when it is unfolded.
    const of_row = await page.evaluateHandle(({ selector, index }) => {
      const one = [...document.querySelectorAll(selector)][index];
      const folded = one.closest("details");
      if (folded) folded.open = true;
      return one.closest("li") ?? one.parentElement;
    }, pick.at);
    await page.waitForFunction((row) => !row.isConnected || row.querySelector(".promise[data-rmse]"), of_row, { timeout: 30_000 }).catch(() => undefined);
    await quiet();
    const promised = promised_in(await of_row.evaluate((row) => row.textContent.trim()));
    const began = await page.evaluate(({ selector, index }) => {
      const one = [...document.querySelectorAll(selector)][index];
      const folded = one.closest("details");
      if (folded) folded.open = true;
      return window.probe.press(one);
    }, pick.at);
    const stopped = { why: "" };
    try {
      await quiet();
    } catch (error) {
      stopped.why = error;
    }
    const log = await page.evaluate(() => window.probe.log);
    const first_fit = log.find(({ rmse, beside, effects }) => rmse !== "" && (rmse !== before.rmse || beside !== before.beside || effects !== before.effects));
    const searched = log.findLast(({ search, at }, k) => search === "done" && at >= (first_fit?.at ?? 0) && log[k - 1]?.search !== "done");
    const said = [...new Set(log.flatMap((one) => [one.said, one.refusal]))];
    const after = await now();
    const refused = refused_in(said);
    const kept = after.effects > before.effects || Number(after.revisions) > Number(before.revisions);
    const shown = number_of(first_fit?.rmse ?? "");
    const sentence = said.find((one) => /support/.test(one)) ?? "";
    Object.assign(of_step, {
      what, pressed: pick.label, row: pick.row.slice(0, 200), before: before.rmse, promised: promised?.text ?? null, shown: shown?.text ?? null, after: after.rmse,
      kept, refused: refused !== "", sentence: sentence.slice(0, 400), verdict_before: before.said.slice(0, 300),
      fit_ms: first_fit ? Math.round(first_fit.at - began) : null, verdict_ms: searched && first_fit ? Math.round(searched.at - first_fit.at) : null,
    });
    // Not kept: its error is in the sentence, "with it the model leaves 0.43 um".
    const came = shown ?? number_of(/leaves ([\d.,]+)/.exec(sentence)?.[1] ?? "");
    if (!promised) fail("nothing promised", pick.row);
    else if (!came) fail("nothing came", `${pick.label}: ${sentence || after.said || after.told}`);
    else if (!same(promised, came)) fail("promised is not shown", `${pick.label}: ${promised.text} promised, ${came.text} shown`);
    if (refused && kept) fail("not supported, and kept", refused);
    if (stopped.why) throw stopped.why;
    const was = number_of(before.rmse);
    if (promised && was && promised.value > was.value && !same(promised, was)) fail("candidate that raises the error", `${before.rmse} -> ${promised.text}`);
    if (!kept && refused === "") fail("neither kept nor refused", `${pick.label}: ${after.said} ${after.told}`);
    if (after.told) fail("message of failure", after.told);
    judge(after, refused);
    of_step.model_effects = after.effects;
    return done();
  };
  const plus = (n) => (rows) => (rows[n] ? { ...rows[n], at: { selector: ".live-candidates .plus", index: n } } : null);

  const buttons_of = (like) => page.evaluate((like) => [...document.querySelectorAll("button")].map((one, index) => ({ index, text: one.textContent.trim(), row: (one.closest("li") ?? one.parentElement).textContent.trim(), can: !one.disabled && window.probe.seen(one) })).filter(({ text, can }) => can && new RegExp(like, "i").test(text)), like);
  const press = async (like) => {
    const [one] = await buttons_of(like);
    if (!one) return false;
    await page.evaluate((index) => window.probe.press(document.querySelectorAll("button")[index]), one.index);
    return true;
  };

  let models = []; // { rmse } before and after the last change, for undo and redo
  const acts = {
    plus: () => change("first +", plus(0)),
    third: () => change("third +", (rows) => plus(2)(rows) ?? plus(rows.length - 1)(rows)),
    async all() {
      const [one] = await buttons_of("^(\\+ )?(add )?all of (these|them)");
      return change(one ? "all of these" : "first + (no \"all of these\")", one ? () => ({ label: one.text, row: one.row, at: { selector: "button", index: one.index } }) : plus(0));
    },
    async keep() {
      const before = await now();
      if (!(await press("all the same|anyway"))) { of_step.skipped = "no \"keep it all the same\""; return done(); }
      await quiet();
      const after = await now();
      if (after.effects <= before.effects) fail("kept all the same, and is not", after.said);
      judge(after, "");
      return done();
    },
    async act() {
      const pressed = await page.evaluate(() => {
        const one = [...document.querySelectorAll("button.act")].find((one) => window.probe.seen(one) && !one.disabled);
        if (!one) return null;
        const changes = window.probe.changes;
        window.probe.press(one);
        return { text: one.textContent, title: one.title, changes };
      });
      if (!pressed) { of_step.skipped = "no proposed step"; return done(); }
      of_step.pressed = pressed.text;
      await page.waitForTimeout(300);
      if (!/Plan/.test(pressed.text)) await quiet();
      const [{ told }, changes] = [await now(), await page.evaluate(() => window.probe.changes)];
      if (changes === pressed.changes && effects_outside.length === 0) fail("button without effect", pressed.text);
      if (told) fail("proposed step is not made", `"${pressed.text}": ${told}`);
      return done();
    },
    async undo() {
      const before = await now();
      const disabled = await page.evaluate(() => [...document.querySelectorAll(".live-loop button")].find((one) => /^Undo/.test(one.textContent))?.disabled ?? true);
      if (disabled) { of_step.skipped = "nothing to undo"; return done(); }
      await page.keyboard.press("Control+z");
      await quiet();
      const after = await now();
      models.push({ now: before.rmse, before: after.rmse });
      const expected = number_of(/(?:before|vorher)\D*([\d.,]+)/.exec(before.beside)?.[1] ?? "");
      const came = number_of(after.rmse);
      if (expected && came && !same(expected, came)) fail("undo leads elsewhere", `${expected.text} before, ${after.rmse} after Ctrl+Z`);
      judge(after, "");
      return done({ from: before.rmse, to: after.rmse });
    },
    async redo() {
      const was = models.at(-1);
      if (!was) { of_step.skipped = "nothing to redo"; return done(); }
      await page.keyboard.press("Control+y");
      await quiet();
      const after = await now();
      if (after.rmse !== was.now) fail("redo leads elsewhere", `${was.now} before, ${after.rmse} after Ctrl+Y`);
      judge(after, "");
      return done({ to: after.rmse });
    },
    async slider() {
      const input = page.locator(".slider input:not(:disabled)").first();
      if ((await input.count()) === 0) { of_step.skipped = "no slider"; return done(); }
      const [before, effects] = [await now(), await page.evaluate(() => document.querySelectorAll(".live-model > li").length)];
      await input.focus();
      await page.keyboard.press("End");
      await quiet();
      const moved = await now();
      if (moved.rmse === before.rmse) fail("slider without effect", before.rmse);
      for (let k = 0; k < 20; ++k) await page.keyboard.press("ArrowLeft");
      await quiet();
      await page.keyboard.press("Control+z");
      await quiet();
      const after = await now();
      if (after.effects < effects) fail("Ctrl+Z after a slider removes an effect", `${effects} effects, then ${after.effects}`);
      else if (after.rmse !== moved.rmse && after.rmse !== before.rmse) fail("Ctrl+Z after a slider does nothing", `${moved.rmse}, then ${after.rmse}`);
      await press("^Back to the optimum");
      await quiet();
      const back = await now();
      if (after.effects === effects && back.rmse !== before.rmse) fail("back to the optimum leads elsewhere", `${before.rmse}, then ${back.rmse}`);
      return done({ before: before.rmse, moved: moved.rmse, undone: after.rmse });
    },
    async save() {
      await page.evaluate(() => { const box = document.querySelector(".live-saves"); if (box) box.open = true; });
      const waited = page.waitForEvent("download", { timeout: 5000 }).catch(() => null);
      if (!(await press("^Model \\(\\.toml\\)"))) { of_step.skipped = "no model to save"; return done(); }
      const download = await waited;
      if (!download) { fail("nothing saved"); return done(); }
      const text = readFileSync(await download.path(), "utf8");
      // In the tables of the effects, before the ledger: values of its parameters.
      const tables = text.split(/^\[\[effect\]\]/m).slice(1).map((one) => one.split(/^\[/m)[0]);
      const bare = tables.filter((one) => !/^\s*[a-z_]+_?(um|s|per|K|gain)?\w*\s*=\s*(\{[^}]*\d|-?\d)/m.test(one));
      if (bare.length > 0) fail("saved model holds no fitted value", `${bare.length} of ${tables.length} effects`);
      return done({ effects: tables.length, without_values: bare.length });
    },
    async plan() {
      const box = page.locator(".live-plan");
      if (!(await box.isVisible().catch(() => false))) { of_step.skipped = "no plan"; return done(); }
      await page.evaluate(() => (document.querySelector(".live-plan").open = true));
      of_step.announced = (await page.innerText(".live-plan")).split("\n").slice(0, 3).join(" ").slice(0, 200);
      const began = performance.now();
      await press("^Plan it");
      await quiet();
      const answer = (await page.innerText(".live-plan")).slice(-500);
      of_step.plan_s = Math.round((performance.now() - began) / 1000);
      if (/TypeError|undefined|reading '/.test(answer)) fail("plan fails", answer);
      if (of_step.plan_s > 60) fail("plan takes above 60 s", of_step.plan_s);
      return done({ answer });
    },
    async close() {
      const before = await now();
      if (!(await press("^Close$"))) { of_step.skipped = "no Close"; return done(); }
      await page.waitForTimeout(500);
      const asked = effects_outside.some((one) => one.startsWith("dialog")) || (await page.locator("dialog[open], [role=alertdialog], .asked").count()) > 0;
      if (Number(before.revisions) > 1 && !asked) fail("closed without a question", `${before.revisions} revisions`);
      return done({ asked });
    },
    // Every kind of button that is to be seen, once or twice: does anything come of it?
    async buttons() {
      await page.evaluate(() => { for (const one of document.querySelectorAll("details")) one.open = true; });
      await page.waitForTimeout(400);
      await watched_words();
      const tried = new Map();
      const counts = { pressed: 0, dead: [] };
      const until = Math.min(ends, performance.now() + 30_000);
      while (performance.now() < until) {
        const all = await page.evaluate(() =>
          [...document.querySelectorAll("button, [role=button], select")].map((one, index) => ({
            index,
            key: `${one.className}|${(one.getAttribute("aria-label") ?? one.textContent).trim().replace(/[-\d.,]+/g, "#").slice(0, 60)}`,
            text: (one.getAttribute("aria-label") || one.textContent || one.tagName).trim().slice(0, 80),
            where: one.closest("figure")?.dataset.picture ?? one.closest("[id]")?.id ?? "",
            plus: one.matches(".plus"),
            can: !one.disabled && window.probe.seen(one) && one.tagName !== "SELECT",
          })));
        const next = all.find(({ key, text, can, plus }) => can && !plus && (tried.get(key) ?? 0) < 1 && !/^(Close|Delete|Undo|Redo)$/.test(text));
        if (!next) break;
        tried.set(next.key, (tried.get(next.key) ?? 0) + 1);
        await quiet().catch(() => {});
        const before = await page.evaluate((index) => {
          const one = document.querySelectorAll("button, [role=button], select")[index];
          if (!one || !window.probe.seen(one)) return null;
          one.scrollIntoView({ block: "center", behavior: "instant" });
          return new Promise((go) => setTimeout(() => {
            const { probe } = window;
            const was = { changes: probe.changes, calls: probe.calls.length, drawn: probe.drawn(), at: scrollY };
            one.click();
            go(was);
          }, 150));
        }, next.index);
        if (!before) continue;
        ++counts.pressed;
        let effect = false;
        for (let k = 0; k < 6 && !effect; ++k) {
          await page.waitForTimeout(120);
          effect = effects_outside.length > 0 || (await page.evaluate((was) => {
            const { probe } = window;
            return probe.changes !== was.changes || probe.calls.length !== was.calls || scrollY !== was.at || probe.state().waiting > 0 || probe.drawn() !== was.drawn;
          }, before));
        }
        const told = (await now()).told;
        if (!effect) { counts.dead.push(`${next.text} (${next.where})`); fail("button without effect", `${next.text} (${next.where})`); }
        if (/terminal|not saved|TypeError|bad_alloc/i.test(told)) fail("button that fails", `${next.text}: ${told}`);
        effects_outside.length = 0;
        if ((await now()).waiting !== "0") await page.keyboard.press("Escape");
        for (const one of thrown.splice(0)) { (of_step.exceptions ??= []).push(`${next.text}: ${one}`); fail("uncaught exception", `${next.text}: ${one}`); }
      }
      return done(counts);
    },
  };

  try {
    const url = address_of(tool);
    await page.addInitScript(in_page);
    await page.goto(url);
    await page.waitForSelector("html[data-ready]", { state: "attached" });
    await page.evaluate(() => window.ballbar?.engine?.ready);
    const began = performance.now();
    if (Array.isArray(files)) await page.locator("input[type=file]:not([webkitdirectory])").first().setInputFiles(files);
    else await page.locator("input[webkitdirectory]").first().setInputFiles(files.folder);
    while (!(await page.evaluate(() => document.querySelector(".live-report main, .live-files .faulty, .live-told:not(:empty)") !== null))) { spent(); await page.waitForTimeout(30); }
    of_step.load_ms = Math.round(performance.now() - began);
    await quiet();
    if (steps.some((one) => /plus|third|all/.test(one)) && (await page.evaluate(() => window.probe.candidates().length)) === 0 && (await now()).search !== "done") {
      const searching = performance.now();
      of_step.asked_for_the_search = await press("^Find what");
      await quiet();
      of_step.search_ms = Math.round(performance.now() - searching);
    }
    const headline = await page.evaluate(() => window.probe.headline());
    const state = await now();
    judge(state, "");
    if (state.told) fail("message of failure", state.told);
    if ((state.said === "" || /expected values of/.test(state.said)) && steps.some((one) => /plus|third|all/.test(one))) fail("no verdict", state.told || headline || (await page.evaluate(() => document.querySelector(".live-files .fault")?.textContent ?? "")));
    const rows = await page.evaluate(() => window.probe.candidates());
    const raising = rows.filter(({ row }) => { const [p, was] = [promised_in(row), number_of(state.rmse)]; return p && was && p.value > was.value && !same(p, was); });
    if (raising.length > 0) fail("candidates that raise the error are offered", raising.map(({ row }) => row.slice(0, 100)).join("; "));
    const refusals = await page.evaluate(() => [...document.querySelectorAll(".live-files .fault")].map((one) => one.textContent.slice(0, 200)));
    await done({ headline, ...(refusals.length > 0 && { refusals }), candidates: rows.length, first: rows[0]?.row.slice(0, 160), hidden });
    for (const one of steps) { step = one; await acts[one](); }
  } catch (error) {
    const why = error instanceof GaveUp ? `after ${limit} s in ${step}` : `${error?.message ?? error}`.slice(0, 300);
    fail(error instanceof GaveUp ? "given up" : "cannot be driven", why);
    for (const one of thrown) fail("uncaught exception", one);
    record({ loop: name, step, ...of_step, gave_up: why });
  }
  if (hover_lines.size > 0) record({ loop: name, step: "hover", lines: [...hover_lines].slice(0, 8) });
  await Promise.race([context.close(), new Promise((go) => setTimeout(go, 5000))]);
};

// All of them, and the table.

const quantile = (values, q) => (values.length === 0 ? NaN : [...values].sort((a, b) => a - b)[Math.min(values.length - 1, Math.floor(q * values.length))]);
const spoken = (lines, key) => {
  const of = lines.filter((line) => Number.isFinite(line[key]));
  const ms = of.map((line) => line[key]);
  const worst = [...of].sort((a, b) => b[key] - a[key]).slice(0, 3).map((line) => `${line.loop} ${(line[key] / 1000).toFixed(1)} s`);
  return `median ${(quantile(ms, 0.5) / 1000).toFixed(2)} s, 90 % ${(quantile(ms, 0.9) / 1000).toFixed(2)} s; slowest ${worst.join(", ")} (${ms.length})`;
};
const read = () => (existsSync(out) ? readFileSync(out, "utf8").trim().split("\n").filter((line) => line !== "").map((line) => JSON.parse(line)) : []);

// What was done before and not given up is not done again.
const kept = process.env.RESUME ? read() : [];
const left = new Set(kept.filter(({ gave_up }) => gave_up).map(({ loop }) => loop));
const done_before = new Set(kept.map(({ loop }) => loop).filter((loop) => !left.has(loop)));
writeFileSync(out, kept.filter(({ loop }) => done_before.has(loop)).map((line) => `${JSON.stringify(line)}\n`).join(""));
const began = performance.now();
let browser = await launched();
const not_run = [];
const to_do = chosen.filter(({ name }) => !done_before.has(name));
for (const [k, loop] of to_do.entries()) {
  if ((performance.now() - began) / 1000 > all_s) { not_run.push(loop.name); continue; }
  if (Array.isArray(loop.files) && !loop.files.every((one) => existsSync(one))) { not_run.push(`${loop.name} (no files)`); continue; }
  if (!browser.isConnected()) browser = await launched();
  const [at, before] = [performance.now(), failures];
  await driven(browser, loop);
  console.error(`${String(k + 1).padStart(2)} of ${to_do.length} ${loop.name}: ${failures - before} failures, ${((performance.now() - at) / 1000).toFixed(1)} s, load ${loadavg()[0].toFixed(1)}`);
}
await browser.close();

const records = read();
const kinds = new Map();
for (const line of records) if (line.failure) kinds.set(line.failure, [...(kinds.get(line.failure) ?? []), line]);
const added = records.filter((line) => line.what && line.pressed && line.kept !== undefined);
const unlike = added.filter(({ loop, step, pressed }) => records.some((line) => /^(promised is not shown|nothing promised|nothing came)$/.test(line.failure) && line.loop === loop && line.step === step && line.what.startsWith(pressed)));
const lines = [
  `${new Set(records.map(({ loop }) => loop)).size} loops, ${records.filter(({ failure, step }) => !failure && step !== "hover").length} steps, ${((performance.now() - began) / 60000).toFixed(1)} min, load ${loadavg()[0].toFixed(1)}${not_run.length > 0 ? `; not run: ${not_run.join(", ")}` : ""}`,
  `promised = shown: ${added.length - unlike.length} of ${added.length}`,
  ...["uncaught exception", "console error", "button without effect", "terminal words"].map((kind) => `${kind}: ${kinds.get(kind)?.length ?? 0}`),
  `dropped to first picture: ${spoken(records, "load_ms")}`,
  `"+" to new fit: ${spoken(records, "fit_ms")}`,
  `new fit to verdict: ${spoken(records, "verdict_ms")}`,
  "",
  ...[...kinds].sort(([, a], [, b]) => b.length - a.length).flatMap(([kind, all]) => {
    const of_loops = [...new Set(all.map(({ loop }) => loop))];
    return [`${String(all.length).padStart(4)}  ${kind}: ${of_loops.length} loops (${of_loops.slice(0, 6).join(", ")}${of_loops.length > 6 ? ", ..." : ""})`, `        ${all[0].what.replace(/\s+/g, " ").slice(0, 220)}`];
  }),
];
const answers = records.filter((line) => line.hidden && line.step === "load");
if (answers.length > 0) {
  lines.push("", "set: verdict (what is hidden)");
  for (const { loop, verdict_kind, said, hidden } of answers) lines.push(`  ${loop}: ${verdict_kind}: ${said.replace(/\s+/g, " ").slice(0, 150)} (${hidden.join("; ") || "nothing"})`);
}
console.log(lines.join("\n"));
process.exitCode = kinds.size > 0 ? 1 : 0;
