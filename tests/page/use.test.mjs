// What a reader does with a page: the mouse, the keys, the switches, a stretch, the theme, paper, files.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { drawn, figure, launched, opened, saved, seen } from "./browser.mjs";
import { folder, hidden_effect, json_of, of_run, two_arcs } from "./reports.mjs";

const drift = json_of("drift", of_run("two-arcs-he2015"));

let browser, file, page, wrong;
before(async () => {
  browser = await launched();
  file = await two_arcs();
  ({ page, wrong } = await opened(browser, file));
});
after(() => browser.close());

const state = (name) =>
  page.evaluate((name) => {
    const one = window.ballbar.figures.get(name);
    const { chosen, hidden, window: part, stretch, heights } = one.state();
    return { chosen, hidden: [...hidden], window: part, stretch, heights };
  }, name);

// Where a point of the first plot is on the screen.
const at = async (name, x, y) => {
  const [left, top] = await page.evaluate(
    ([name, x, y]) => {
      const one = window.ballbar.figures.get(name);
      const box = one.element.querySelector(".chart").getBoundingClientRect();
      const [px, py] = one.chart().convertToPixel({ gridIndex: 0 }, [x, y]);
      return [box.left + px, box.top + py];
    },
    [name, x, y],
  );
  return [left, top];
};

// All text that the chart has drawn. The text under the mouse is drawn as well.
const texts = (name) =>
  page.evaluate(
    (name) =>
      window.ballbar.figures
        .get(name)
        .chart()
        .getZr()
        .storage.getDisplayList(true)
        .filter((one) => one.style?.text !== undefined && one.style.text !== null)
        .map((one) => String(one.style.text)),
    name,
  );

const chart = (name) => figure(page, name).locator(".chart");
const span = ([from, to]) => to - from;
const show_all = async (name) => {
  await page.evaluate((name) => window.ballbar.figures.get(name).see(null), name);
  await drawn(page);
};

test("hover: the values of the point, and those of that time in every picture over time", async () => {
  await seen(page, "temperatures");
  await seen(page, "drift");
  const point = drift.points[6];
  const [x, y] = await at("drift", point.time_s / 60, point.y_um);
  await page.mouse.move(x - 30, y - 10);
  await page.mouse.move(x, y);
  await drawn(page);
  const told = (await texts("drift")).join(" ");
  assert.match(told, new RegExp(`\\b${point.time_s / 60} min`));
  for (const axis of ["x", "y", "z"]) {
    const value = point[`${axis}_um`].toFixed(3).replace(".", "\\.");
    assert.match(told, new RegExp(`\\b${axis} +${value} ± ${point[`${axis}_sigma_um`].toFixed(3)} µm`));
  }
  const at_the_time = new RegExp(`^${point.time_s / 60} min`);
  const told_by = async (name) => (await texts(name)).some((text) => at_the_time.test(text));
  assert.ok(await told_by("temperatures"));
  await page.mouse.move(5, 5);
  await page.waitForFunction(() => [...window.ballbar.figures.values()].every((one) => !one.chart()?.getZr().storage.getDisplayList(true).some(({ style }) => / min\b.*\n/.test(style?.text ?? ""))));
});

test("hover on the circle: the angle and the deviation of the reading", async () => {
  await seen(page, "recording-circle");
  const place = await page.evaluate(() => {
    const one = window.ballbar.figures.get("recording-circle");
    const polar = one.chart().getModel().getComponent("polar", 0).coordinateSystem;
    const box = one.element.querySelector(".chart").getBoundingClientRect();
    const [x, y] = polar.dataToPoint([0, 180.36]);
    return [box.left + x, box.top + y];
  });
  await page.mouse.move(place[0] + 30, place[1]);
  await page.mouse.move(...place);
  await drawn(page);
  const rows = readFileSync(of_run("two-arcs-he2015", "00-c.csv"), "utf8").split("\n").filter((row) => /^\d/.test(row)).map((row) => row.split(",").map(Number));
  const told = (await texts("recording-circle")).join(" ");
  const angle = Number([...told.matchAll(/([\d.]+)°/g)].pop()?.[1]);
  assert.ok(Math.abs(angle - 180.36) < 1, told);
  // The reading nearest to the pointer, which is half a pixel beside it at most.
  const near = rows.filter((row) => Math.abs(row[1] - angle) < 0.4).map((row) => ((row[2] - 100) * 1000).toFixed(2));
  const value = /measured, CCW +(-?[\d.]+) µm/.exec(told)?.[1];
  assert.ok(near.includes(value), `${value} of ${near}`);
});

test("zoom: wheel, keys, drag, double click; all pictures over time go with it", async () => {
  await seen(page, "drift");
  await page.mouse.move(...(await at("drift", 60, 15)));
  const scroll = await page.evaluate(() => scrollY);
  await page.mouse.wheel(0, 120);
  await page.waitForFunction((before) => scrollY !== before, scroll); // it scrolls the page
  await drawn(page);
  assert.equal((await state("drift")).window, null, "the wheel alone does not zoom");
  await seen(page, "drift");
  const [x, y] = await at("drift", 60, 15);
  await page.mouse.move(x, y);
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, -240);
  await page.keyboard.up("Control");
  await page.waitForFunction(() => window.ballbar.figures.get("drift").state().window);
  await drawn(page);
  const near = (await state("drift")).window;
  assert.ok(near[0] < 60 && 60 < near[1]);
  assert.ok(Math.abs((await at("drift", 60, 15))[0] - x) < 1, "what is under the pointer stays there");
  await seen(page, "temperatures");
  assert.deepEqual((await state("temperatures")).window, near);
  await seen(page, "drift");

  await page.mouse.move(...(await at("drift", 60, 15)));
  await page.mouse.down();
  await page.mouse.move(x + 40, y, { steps: 4 });
  await page.mouse.up();
  await drawn(page);
  const moved = (await state("drift")).window;
  assert.ok(moved[0] < near[0] && Math.abs(span(moved) - span(near)) < 1e-9);
  assert.ok(Math.abs((await at("drift", 60, 15))[0] - x - 40) < 2, "it goes with the pointer");

  await figure(page, "drift").getByRole("button", { name: "Show all" }).click();
  await drawn(page);
  assert.equal((await state("drift")).window, null);

  await chart("drift").focus();
  await page.keyboard.press("+");
  await drawn(page);
  const closer = (await state("drift")).window;
  assert.ok(closer);
  await page.keyboard.press("ArrowRight");
  await drawn(page);
  const right = (await state("drift")).window;
  assert.ok(right[0] > closer[0] && Math.abs(span(right) - span(closer)) < 1e-9);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("-");
  await drawn(page);
  assert.equal((await state("drift")).window, null);
  await page.keyboard.press("+");
  await page.keyboard.press("0");
  await drawn(page);
  assert.equal((await state("drift")).window, null);

  await page.keyboard.press("+");
  await drawn(page);
  await page.mouse.dblclick(x, y);
  await drawn(page);
  assert.equal((await state("drift")).window, null);
});

test("zoom: a drag up or down takes a part of the heights, across and down a frame; Alt goes on, a double click shows all", async () => {
  const shown = await seen(page, "drift");
  const frames = () => page.evaluate(() => window.ballbar.figures.get("drift").chart().getZr().storage.getDisplayList(true).filter((one) => one.name === "main" && one.shape.height > 0).length);
  const drag = async ([x, y], by_x, by_y) => {
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + by_x, y + by_y, { steps: 4 });
    const framed = await frames();
    await page.mouse.up();
    await drawn(page);
    assert.equal(await frames(), 0);
    return framed > 0;
  };
  const start = await at("drift", 60, 15);
  assert.ok(await drag(start, 2, 90));
  const upright = await state("drift");
  assert.equal(upright.window, null);
  assert.ok(Math.abs(upright.heights.range[1] - 15) < 0.3 && upright.heights.range[0] < 13, JSON.stringify(upright.heights));
  const seen_at = await at("drift", 60, upright.heights.range[1]);
  assert.ok(seen_at[1] < start[1] - 10, "what was taken fills the plot");
  for (const key of ["ArrowLeft", "ArrowRight"]) await shown.locator(".chart").press(key);
  await drawn(page);
  assert.deepEqual((await state("drift")).heights, upright.heights, "all of the time is seen: there is nowhere to go");
  await drag(await at("drift", 60, 14), 0, 30);
  const moved = (await state("drift")).heights.range;
  assert.ok(moved[0] > upright.heights.range[0] && Math.abs(span(moved) - span(upright.heights.range)) < 1e-9, "a drag moves it");
  await page.keyboard.down("Alt");
  assert.ok(await drag(await at("drift", 60, (moved[0] + moved[1]) / 2), 120, 60));
  await page.keyboard.up("Alt");
  const both = await state("drift");
  assert.ok(Math.abs(both.window[0] - 60) < 1 && span(both.heights.range) < span(moved));
  const svg = await saved(page, "drift", "SVG");
  assert.doesNotMatch(readFileSync(svg.path, "utf8"), /NaN/);
  await page.mouse.dblclick(...start);
  await drawn(page);
  assert.deepEqual([(await state("drift")).window, (await state("drift")).heights], [null, null]);
  assert.ok(await shown.getByRole("button", { name: "Show all" }).isDisabled());
});

test("zoom: of a recording against its angle, by itself", async () => {
  await seen(page, "recording-unrolled");
  await chart("recording-unrolled").focus();
  await page.keyboard.press("+");
  await drawn(page);
  assert.ok((await state("recording-unrolled")).window);
  assert.equal((await state("drift")).window, null);
  const [from, to] = (await state("recording-unrolled")).window;
  const angles = (await texts("recording-unrolled")).map(Number).filter((one) => one > 50);
  assert.ok(angles.length > 2 && angles.every((one) => one >= from && one <= to), `${angles} of ${from} to ${to}`);
  await page.keyboard.press("0");
});

test("switches: by mouse and by key; the numbers follow, the focus stays", async () => {
  await seen(page, "drift");
  const box = figure(page, "drift").getByRole("checkbox", { name: "y", exact: true });
  await box.click();
  await drawn(page);
  assert.deepEqual((await state("drift")).hidden.filter((key) => key === "y_um"), ["y_um"]);
  const file = await saved(page, "drift", "CSV");
  assert.doesNotMatch(readFileSync(file.path, "utf8"), /y_um/);
  await box.focus();
  await page.keyboard.press("Space");
  await drawn(page);
  assert.ok(await box.isChecked());
  assert.ok(await box.evaluate((one) => one === document.activeElement));
  assert.ok(!(await state("drift")).hidden.includes("y_um"));
});

test("switches: a double click on a name shows its curve alone, and all again", async () => {
  const legend = (await seen(page, "drift")).locator(".legend");
  const before = await state("drift");
  const all = await legend.locator("input").evaluateAll((boxes) => boxes.map(({ dataset }) => dataset.curve));
  assert.ok(all.length > 1);
  await legend.locator("label bdi").first().dblclick();
  await drawn(page);
  assert.deepEqual((await state("drift")).hidden.sort(), all.slice(1).sort());
  assert.equal(await legend.locator("input:checked").count(), 1);
  await legend.locator("label bdi").first().dblclick();
  assert.deepEqual((await state("drift")).hidden, []);
  await drawn(page);
  for (const key of before.hidden) await legend.locator(`input[data-curve="${key}"]`).click();
  await drawn(page);
});

test("choices: another recording is another caption, and other numbers", async () => {
  await seen(page, "recording-circle");
  await figure(page, "recording-circle").getByLabel("Recording").selectOption({ index: 1 });
  await drawn(page);
  const of_second = await saved(page, "recording-circle", "CSV");
  const first = readFileSync(of_run("two-arcs-he2015", "00-a.csv"), "utf8").split("\n").find((row) => /^\d/.test(row)).split(",").map(Number);
  const row = readFileSync(of_second.path, "utf8").split("\r\n")[1].split(",").map(Number);
  assert.ok(Math.abs(row[1] - (first[2] - 100) * 1000) < 1e-4, `${row} for ${first}`);
});

test("a stretch: by mouse, its statistics, by numbers, cleared by Escape", async () => {
  await seen(page, "drift");
  const [from, to] = [35, 62];
  const inside = drift.points.filter(({ time_s }) => time_s / 60 >= from && time_s / 60 <= to).map((point) => point.y_um);
  assert.ok(inside.length > 2);
  await page.mouse.move(...(await at("drift", from, 15)));
  await page.keyboard.down("Shift");
  await page.mouse.down();
  await page.mouse.move(...(await at("drift", to, 15)), { steps: 5 });
  await page.mouse.up();
  await page.keyboard.up("Shift");
  await drawn(page);
  const chosen = (await state("drift")).stretch;
  assert.ok(Math.abs(chosen[0] - from) < 0.5 && Math.abs(chosen[1] - to) < 0.5, `${chosen}`);
  const row = async () => (await figure(page, "drift").locator(".stretch tbody tr", { hasText: /^y/ }).locator("td").allTextContents()).map((one) => one.replace("−", "-"));
  const expected = (values) => {
    const mean = values.reduce((sum, one) => sum + one, 0) / values.length;
    const deviation = Math.sqrt(values.reduce((sum, one) => sum + (one - mean) ** 2, 0) / (values.length - 1));
    return [values.length, mean, deviation, Math.min(...values), Math.max(...values), values[values.length - 1] - values[0]];
  };
  const found = (await row()).slice(2).map(Number);
  expected(inside).forEach((value, k) => assert.ok(Math.abs(found[k] - value) <= 1e-4 * Math.abs(value), `${k}: ${found} for ${value}`));

  await figure(page, "drift").getByLabel("From", { exact: true }).fill("0");
  await figure(page, "drift").getByLabel("From", { exact: true }).press("Enter");
  await drawn(page);
  const more = drift.points.filter(({ time_s }) => time_s / 60 <= chosen[1]).length;
  assert.equal((await row())[2], String(more));

  await figure(page, "drift").getByRole("button", { name: "Zoom to it" }).click();
  await drawn(page);
  assert.deepEqual((await state("drift")).window, (await state("drift")).stretch);
  await chart("drift").focus();
  await page.keyboard.press("Escape");
  await page.keyboard.press("0");
  await drawn(page);
  assert.deepEqual(await state("drift").then((one) => [one.stretch, one.window]), [null, null]);
  assert.ok(await figure(page, "drift").locator(".stretch").isHidden());
});

test("a stretch without the shift key: the button, then a drag", async () => {
  await seen(page, "temperatures");
  const button = figure(page, "temperatures").getByRole("button", { name: "Select stretch" });
  await button.press("Enter");
  await drawn(page);
  assert.equal(await button.getAttribute("aria-pressed"), "true");
  await page.mouse.move(...(await at("temperatures", 20, 20)));
  await page.mouse.down();
  await page.mouse.move(...(await at("temperatures", 40, 20)), { steps: 3 });
  await page.mouse.up();
  await drawn(page);
  assert.ok((await state("temperatures")).stretch);
  assert.equal(await button.getAttribute("aria-pressed"), "false");
  await chart("temperatures").focus();
  await page.keyboard.press("Escape");
  await drawn(page);
});

test("fingers: two zoom about where they are, one moves it, and selects a stretch once the button says so", async () => {
  const { page: touched, wrong: of_touched, close } = await opened(browser, file, { hasTouch: true });
  await seen(touched, "temperatures");
  const state_now = () => touched.evaluate(() => {
    const { window: part, stretch } = window.ballbar.figures.get("temperatures").state();
    return { part, stretch };
  });
  const place = await touched.evaluate(() => {
    const one = window.ballbar.figures.get("temperatures");
    const box = one.element.querySelector(".chart").getBoundingClientRect();
    const [x, y] = one.chart().convertToPixel({ gridIndex: 0 }, [80, 25]);
    return { x: box.left + x, y: box.top + y };
  });
  const fingers = await touched.context().newCDPSession(touched);
  const go = async (...steps) => {
    for (const [k, by] of steps.entries()) {
      const touchPoints = by.map((dx, id) => ({ x: place.x + dx, y: place.y, id }));
      await fingers.send("Input.dispatchTouchEvent", { type: k === 0 ? "touchStart" : "touchMove", touchPoints });
      await drawn(touched);
    }
    await fingers.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    await drawn(touched);
  };
  await go([0], [30], [60]);
  assert.deepEqual(await state_now(), { part: null, stretch: null }, "there is nowhere to go");
  await go([-40, 40], [-60, 60], [-80, 80]);
  const { part } = await state_now();
  assert.ok(part[0] < 80 && 80 < part[1] && span(part) < 100, String(part));
  await go([0], [30], [60]);
  const { part: moved } = await state_now();
  assert.ok(moved[0] < part[0] && Math.abs(span(moved) - span(part)) < 1e-9, `${moved} of ${part}`);
  await figure(touched, "temperatures").getByRole("button", { name: "Select stretch" }).click();
  await drawn(touched);
  await go([0], [30], [60]);
  const { part: same, stretch } = await state_now();
  assert.ok(stretch && span(stretch) > 0, String(stretch));
  assert.deepEqual(same, moved);
  assert.deepEqual(of_touched, []);
  await close();
});

test("the numbers behind a picture, as a table", async () => {
  await seen(page, "drift");
  await figure(page, "drift").getByText("The numbers behind this picture").click();
  const row = figure(page, "drift").locator("details.numbers tbody tr").nth(1);
  await row.waitFor(); // the table is made when it is opened
  const cells = await row.locator("td").allTextContents();
  assert.equal(Number(cells[0]), drift.points[1].time_s / 60);
  assert.ok(Math.abs(Number(cells[1]) - drift.points[1].x_um) < 1e-4);
});

test("a row of the table of recordings shows its recording", async () => {
  await seen(page, "recording-circle");
  await page.mouse.move(5, 5); // not over the table: a row that comes to lie under the mouse is chosen too
  const row = page.locator("#recordings tr.chooses").nth(3);
  await row.focus();
  await drawn(page);
  assert.equal((await state("recording-circle")).chosen.recording, "3");
});

test("theme: dark and back, kept, and drawn anew", async () => {
  await seen(page, "drift");
  const colour_of_x = () =>
    page.evaluate(() => window.ballbar.figures.get("drift").chart().getOption().series.find((one) => one.name === "x").itemStyle.color);
  const light = await colour_of_x();
  await page.getByRole("button", { name: "Dark", exact: true }).click();
  await drawn(page);
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  assert.notEqual(await colour_of_x(), light);
  await page.reload();
  await page.waitForSelector("html[data-ready]", { state: "attached" });
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
  await page.getByRole("button", { name: "Light", exact: true }).click();
  assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "light");
});

test("theme: as the system has it", async () => {
  const { page: dark, wrong: of_dark, close } = await opened(browser, file, { colorScheme: "dark" });
  assert.equal(await dark.evaluate(() => document.documentElement.dataset.theme), "dark");
  await dark.emulateMedia({ colorScheme: "light" });
  await dark.waitForFunction(() => document.documentElement.dataset.theme === "light");
  assert.deepEqual(of_dark, []);
  await close();
});

test("paper: every picture, in light colours, and the screen as before", async () => {
  const { page: dark, wrong: of_dark, close } = await opened(browser, file, { colorScheme: "dark" });
  await seen(dark, "drift");
  await dark.evaluate(() => {
    window.printed = null;
    addEventListener("beforeprint", () => {
      const pictures = [...document.querySelectorAll("figure[data-picture]")].map((one) => {
        const canvas = [...one.querySelectorAll("canvas")].pop();
        if (!canvas) return `${one.dataset.picture}: none`;
        const copy = document.createElement("canvas").getContext("2d", { willReadFrequently: true });
        Object.assign(copy.canvas, { width: canvas.width, height: canvas.height });
        copy.drawImage(canvas, 0, 0);
        const { data } = copy.getImageData(0, 0, canvas.width, canvas.height);
        let [ink, night] = [0, 0];
        for (let k = 0; k < data.length; k += 4) {
          if (data[k + 3] < 100) continue;
          if (Math.max(data[k], data[k + 1], data[k + 2]) - Math.min(data[k], data[k + 1], data[k + 2]) > 50) ++ink;
          if (data[k] === 0x14 && data[k + 1] === 0x18 && data[k + 2] === 0x1d) ++night;
        }
        return ink < 20 || night > 20 ? `${one.dataset.picture}: ${ink} coloured pixels, ${night} of a dark page` : "";
      });
      window.printed = { theme: document.documentElement.dataset.theme, wrong: pictures.filter((one) => one !== "") };
    });
  });
  const before = await dark.evaluate(() => document.querySelector('[data-picture="drift"] canvas').toDataURL());
  const pdf = await dark.pdf({ format: "A4" });
  assert.equal(pdf.subarray(0, 5).toString(), "%PDF-");
  assert.deepEqual(await dark.evaluate(() => window.printed.wrong), []);
  await drawn(dark);
  assert.equal(await dark.evaluate(() => document.querySelector('[data-picture="drift"] canvas').toDataURL()), before);
  assert.equal(await dark.evaluate(() => document.documentElement.dataset.theme), "dark");
  assert.deepEqual(of_dark, []);
  await close();
});

test("files: SVG, PNG and CSV of every kind of picture", async () => {
  const lacking = await opened(browser, await hidden_effect());
  const of_drift = ["drift", "comparison-x", "recording-circle", "recording-unrolled", "tests-circle", "coherence"];
  for (const [shown, name] of [...of_drift.map((name) => [page, name]), [lacking.page, "fall"]]) {
    await seen(shown, name);
    const svg = await saved(shown, name, "SVG");
    assert.equal(svg.name, `${name}.svg`);
    const text = readFileSync(svg.path, "utf8");
    assert.match(text, /^<svg xmlns="http:\/\/www\.w3\.org\/2000\/svg" width="\d+" height="\d+"/);
    assert.doesNotMatch(text, /NaN|undefined|<script|href=/);
    const png = await saved(shown, name, "PNG");
    assert.equal(png.name, `${name}.png`);
    const bytes = readFileSync(png.path);
    assert.equal(bytes.subarray(1, 4).toString(), "PNG");
    const [, width, height] = /width="(\d+)" height="(\d+)"/.exec(text);
    assert.deepEqual([bytes.readUInt32BE(16), bytes.readUInt32BE(20)], [2 * width, 2 * height], "two pixels a unit of the drawing");
    const csv = await saved(shown, name, "CSV");
    assert.equal(csv.name, `${name}.csv`);
    const rows = readFileSync(csv.path, "utf8").trimEnd().split("\r\n");
    assert.ok(rows.length > 1);
    assert.doesNotMatch(rows.join("\n"), /NaN|undefined|\[object/);
  }
  assert.deepEqual(lacking.wrong, []);
  await lacking.close();
});

test("copy: the picture is an image on the clipboard; where that is not allowed, it is saved", async () => {
  const shown = await seen(page, "drift");
  const copy = shown.getByRole("button", { name: "Copy", exact: true });
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await copy.click();
  await shown.getByRole("button", { name: "✓ Copied", exact: true }).waitFor();
  assert.deepEqual(await page.evaluate(async () => (await navigator.clipboard.read()).flatMap(({ types }) => types)), ["image/png"]);
  await copy.waitFor();
  await page.evaluate(() => (navigator.clipboard.write = () => Promise.reject(new Error("not allowed"))));
  const [download] = await Promise.all([page.waitForEvent("download"), copy.click()]);
  assert.equal(download.suggestedFilename(), "drift.png");
  await page.evaluate(() => {
    window.ClipboardItem = class {
      constructor() {
        throw new TypeError("expected a Blob");
      }
    };
  });
  const [again] = await Promise.all([page.waitForEvent("download"), copy.click()]);
  assert.equal(again.suggestedFilename(), "drift.png");
});

test("of a narrow window: the tools are there, and the drawing is as wide as the window", async () => {
  const { page: narrow, wrong: of_narrow, close } = await opened(browser, file, { viewport: { width: 400, height: 800 }, hasTouch: true });
  await seen(narrow, "drift");
  assert.ok((await narrow.evaluate(() => document.documentElement.scrollWidth)) <= 400);
  const canvas = await figure(narrow, "drift").locator("canvas").first().boundingBox();
  assert.ok(canvas.width > 300 && canvas.width <= 400);
  await narrow.setViewportSize({ width: 700, height: 800 });
  await narrow.waitForFunction(() => document.querySelector('[data-picture="drift"] canvas').clientWidth > 500);
  assert.deepEqual(of_narrow, []);
  await close();
});

test("bytes: at most 2.5 MB without the data", () => {
  const text = readFileSync(file, "utf8");
  const data = /<script type="application\/json" id="report">(.*?)<\/script>/s.exec(text)[1];
  assert.ok(text.length - data.length < 2.5e6, `${text.length - data.length} bytes`);
});

test("console and network are quiet", () => assert.deepEqual(wrong, []));
