// One picture on the page with its controls. The page holds its state; every change redraws the picture.
import { effect, signal, untracked } from "@preact/signals-core";
import { type Brush, brush_of, type Brushed, canvas_of, type Chart, chart_in, link, px_at, take_brush, x_at, x_limits, y_at } from "./charts";
import { controls_of, within_slider } from "./controls";
import { listen_to_keys, listen_to_pointer, magnify_by, next_row, row_text, take_brushed } from "./input";
import { button, element, explained } from "../elements/elements";
import { can_copy, copy_png, save_csv, save_png, save_svg } from "./files";
import { numbers_table, stretch_panel } from "./numbers";
import type { EChartsCoreOption } from "echarts/core";
import type { Numbers, Picture, Range, State, Toggle } from "../picture";
import type { PageState, View } from "./view";
import { drawn, initial_state, stilled } from "./still";
import { t } from "../texts/texts";

const kPaper_px = 680; // the width between the margins of a sheet
const kPaper_pixels = 2; // of the canvas for one of the page, in print
const kLowest_px = 300;
const kLowest_in_window_px = 400;
const kBelow_px = 8;
const kCopied_ms = 2000;

// On a narrow screen a picture is hardly higher than wide: there the rest would be blank, or a curve all too steep.
// One that is to be seen whole is no higher than the window below its place on the page.
const height_at = ({ height_px, rows_of_text, in_window }: Picture, box: HTMLElement): number => {
  if (rows_of_text) return height_px;
  const width_px = box.clientWidth;
  const from_px = Math.min(innerHeight / 2, box.getBoundingClientRect().top + scrollY);
  const seen_px = in_window ? Math.max(kLowest_in_window_px, innerHeight - from_px - kBelow_px) : height_px;
  return Math.min(height_px, seen_px, Math.max(kLowest_px, width_px + 40));
};

// On the page some curves wait until they are wanted.
const off_at_first = ({ on, quiet }: Toggle): boolean => !on || quiet === true;

export interface Figure {
  readonly picture: Picture;
  readonly element: HTMLElement;
  state(): State;
  chart(): Chart | null; // null: not drawn yet
  whole(): Range | null; // the x axis without a window
  choose(key: string, value: string): void;
  turn(key: string, on: boolean): void; // a curve, on or off
  watch(changed: (state: State) => void): void; // at once, and with every change
  see(window: Range | null): void;
  select(stretch: Range | null): void;
  ask_stretch(): void; // the next drag selects one
  renew(): void; // its data have changed
  redraw(): void; // with the next frame, or once it is near the screen
  draw_now(): void;
  print(): void; // a drawing for paper is added
  printed(): void; // and taken away
  leave(): void; // the figure is removed from the page
}

export const figure_of = (picture: Picture, page: PageState): Figure => {
  const at_first = initial_state(picture, page.dark(), 0);
  const quiet = new Set(picture.toggles(at_first).filter(off_at_first).map(({ key }) => key));
  const state = page.states.get(picture.name) ?? signal<State>({ ...at_first, hidden: quiet });
  page.states.set(picture.name, state);
  let look = at_first.look; // as it is drawn
  const now = (): State => ({ ...state.peek(), window: window_now(), look });
  let chart: Chart | null = null;
  let whole: Range | null = null;
  let whole_for: State["chosen"] | null = null; // the choices that `whole` belongs to
  let near = false; // the screen
  let stale = true;
  let awaited = 0; // the frame in which it will be drawn
  let brushing: Brush = false; // what a drag draws now
  let selecting = false;
  let panel_open = state.peek().stretch !== null;
  let row: number | null = null; // under the cursor
  let known = new Set(picture.toggles(state.peek()).map((toggle) => toggle.key));
  let paper: HTMLCanvasElement | null = null;
  let numbers: { of: State; values: Numbers } | null = null;

  // The same numbers are asked for many times while a window or a stretch moves.
  const numbers_now = (): Numbers => {
    const of = now();
    if (numbers?.of.chosen !== of.chosen || numbers.of.hidden !== of.hidden) {
      numbers = { of, values: picture.numbers(of) };
    }
    return numbers.values;
  };

  const slid = picture.choices?.find(({ slider }) => slider); // magnified by wheel and keys too
  const box = element("div", {
    class: "chart",
    tabindex: "0",
    role: picture.zoom === "none" && !slid ? "img" : "application",
    "aria-label": `${picture.title}. ${picture.caption}`,
    "aria-describedby": [
      ...(picture.about ? [`${picture.name}-about`] : []),
      ...(picture.zoom === "none" && !slid ? [] : [`${picture.name}-keys`]),
    ].join(" "),
  });
  box.style.height = `${picture.height_px}px`;
  const canvas = element("div", { class: "canvas" });
  box.append(canvas);

  const watching: (() => void)[] = [];
  const change = (part: Partial<State>): void => {
    state.value = { ...state.peek(), ...part };
    figure.redraw();
  };

  const see = (window: Range | null): void => {
    if (!window && state.peek().heights) change({ heights: null });
    if (picture.zoom === "time") page.see_time(window);
    else if (picture.zoom === "own") change({ window });
  };

  const select = (stretch: Range | null, done = true): void => {
    if (done) {
      selecting = false;
      panel_open = stretch !== null;
    }
    change({ stretch });
  };

  const choose = (key: string, value: string): void => {
    const choice = picture.choices?.find((one) => one.key === key);
    const slid_to = choice?.slider && Number(value) >= choice.slider.least && Number(value) <= choice.slider.most;
    const offered = !choice || slid_to || choice.values.some((one) => one.value === value);
    const { chosen: before, hidden: off } = state.peek();
    if (!offered || before[key] === value) return;
    const chosen = { ...before, [key]: value };
    const toggles = picture.toggles({ chosen });
    // Curves that were not there before are on or off as they are at first.
    const hidden = new Set([
      ...off,
      ...toggles.filter((one) => !known.has(one.key) && off_at_first(one)).map((one) => one.key),
    ]);
    known = new Set([...known, ...toggles.map((toggle) => toggle.key)]);
    row = null;
    change({ chosen, hidden, heights: null });
  };

  const turn = (keys: readonly string[], on: boolean): void => {
    const hidden = new Set(state.peek().hidden);
    for (const key of keys) {
      if (on) hidden.delete(key);
      else hidden.add(key);
    }
    change({ hidden });
  };

  const controls = controls_of(picture, choose, turn);

  const panel = stretch_panel(
    (stretch) => select(stretch),
    () => see(state.peek().stretch),
  );
  const table = numbers_table(picture.title, numbers_now);
  const mode = button(
    t.figure_select,
    t.figure_select_title,
    () => {
      selecting = panel_open = !selecting;
      figure.redraw();
    },
  );
  const reset = button(t.figure_show_all, t.figure_show_all_title, () => see(null));
  const update_parts = (): void => {
    const { window, heights, stretch } = now();
    controls.update(now());
    reset.disabled = window === null && heights === null;
    mode.setAttribute("aria-pressed", String(selecting));
    box.classList.toggle("selecting", selecting);
    panel.update(stretch, panel_open, numbers_now);
    table.update();
  };

  const window_now = (): Range | null => (picture.zoom === "time" ? page.time_window() : state.peek().window);

  const draw_now = (): void => {
    cancelAnimationFrame(awaited);
    awaited = 0;
    const width_px = box.clientWidth;
    if (width_px === 0) return;
    stale = false;
    const height_px = height_at(picture, box);
    look = { dark: page.dark(), width_px, height_px, still: false };
    box.style.height = `${height_px}px`;
    chart ??= made_chart(width_px, height_px);
    if (chart.getWidth() !== width_px) chart.resize({ width: width_px, height: height_px });
    learn_whole();
    const option = drawn(picture, now());
    if (!window_now()) whole = whole_of(option);
    chart.clear(); // what is drawn depends on the state alone, not on what was drawn before
    chart.setOption(picture.zoom === "none" ? option : { ...option, ...brush_of(picture.name, page.dark()) }, { notMerge: true });
    brushing = false;
    update_parts();
  };

  const made_chart = (width_px: number, height_px: number): Chart => {
    const made = chart_in(canvas, width_px, height_px);
    if (picture.zoom === "time") link(made, "time");
    made.on("brushEnd", (brushed) => {
      if ((brushed as Brushed).brushId !== picture.name) return; // of a linked one
      take_brushed(view, brushed as Brushed);
      figure.redraw(); // without what the drag drew
    });
    return made;
  };

  const whole_of = (option: EChartsCoreOption): Range | null => (picture.zoom === "none" ? null : x_limits(option));
  // A picture first drawn in a window, or of another recording, has not shown all of its axis yet.
  const learn_whole = (): void => {
    const of = now();
    if (of.chosen === whole_for) return;
    whole_for = of.chosen;
    if (!of.window) return;
    const before = whole;
    whole = whole_of(picture.draw({ ...of, window: null, stretch: null }));
    const same = before !== null && whole !== null && before[0] === whole[0] && before[1] === whole[1];
    if (picture.zoom === "own" && !same) state.value = { ...state.peek(), window: null, stretch: null, heights: null };
  };

  const step = (by: number): void => {
    const all = numbers_now();
    row = next_row(all, window_now(), row, by);
    if (row === null) return;
    const x = all.columns[0]?.values[row];
    if (typeof x === "number" && chart && whole) {
      chart.dispatchAction({ type: "showTip", x: px_at(chart, x), y: 0.3 * look.height_px });
    }
    page.say(row_text(all, row));
  };

  const view: View = {
    box,
    whole: () => (picture.zoom === "time" ? page.time_whole() : picture.zoom === "own" ? whole : null),
    window: window_now,
    stretch: () => state.peek().stretch,
    selecting: () => selecting,
    x_at: (px) => (chart ? x_at(chart, px) : NaN),
    y_at: (axis, px) => (chart ? y_at(chart, axis, px) : NaN),
    plot_at: (x, y) => [0, 1, 2, 3].find((gridIndex) => chart?.containPixel({ gridIndex }, [x, y])) ?? null,
    heights: () => state.peek().heights,
    see,
    see_heights: (heights) => change({ heights }),
    select,
    brush(kind) {
      if (chart && kind !== brushing) take_brush(chart, kind);
      brushing = kind;
    },
  };
  listen_to_pointer(view);
  listen_to_keys(view, step);
  if (slid?.slider) {
    const { key, slider, initial } = slid;
    magnify_by(box, (factor) => choose(key, factor === null ? initial : within_slider(slider, slider.now(state.peek().chosen) * factor)));
  }

  const tools = element("div", { class: "tools" });
  if (picture.zoom !== "none") tools.append(mode, reset);
  tools.append(
    button("SVG", t.figure_svg_title, () => save_svg(picture, now())),
    button("PNG", t.figure_png_title, () => void save_png(picture, now())),
    button("CSV", t.figure_csv_title, () => save_csv(picture, now())),
  );
  if (can_copy()) {
    const copy = button(t.figure_copy, t.figure_copy_title, () =>
      void copy_png(picture, now()).then(
        () => {
          copy.textContent = t.figure_copied;
          page.say(t.figure_copied);
          setTimeout(() => (copy.textContent = t.figure_copy), kCopied_ms);
        },
        () => save_png(picture, now()), // it is not allowed
      ),
    );
    tools.append(copy);
  }
  const caption = element("p", { class: "caption" }, picture.caption);
  const heading = element("figcaption", {}, element("h3", {}, picture.title), caption);
  if (picture.about) {
    const { button: more, note } = explained(`${picture.name}-about`, picture.title, picture.about);
    caption.append(" ", more);
    heading.append(note);
  }
  const all = element("figure", { "data-picture": picture.name }, heading, tools, controls.element, box);
  const keys = (text: string): HTMLElement => element("p", { class: "hint", id: `${picture.name}-keys` }, text);
  if (picture.zoom !== "none") all.append(keys(t.figure_keys), panel.element);
  else if (slid) all.append(keys(t.figure_magnify_keys));
  all.append(table.element);

  const figure: Figure = {
    picture,
    element: all,
    state: now,
    chart: () => chart,
    whole: () => whole,
    choose,
    turn: (key, on) => turn([key], on),
    watch(changed) {
      const stop = effect(() => {
        const now = state.value;
        untracked(() => changed(now));
      });
      watching.push(stop);
    },
    see,
    select,
    ask_stretch() {
      selecting = true;
      box.scrollIntoView({ block: "nearest" });
      figure.redraw();
    },
    renew() {
      numbers = null;
      figure.redraw();
    },
    redraw() {
      stale = true;
      if (near && awaited === 0) awaited = requestAnimationFrame(draw_now);
    },
    draw_now,
    print() {
      const still = stilled(now(), false, kPaper_px, picture.height_px);
      paper = canvas_of(drawn(picture, still), kPaper_px, picture.height_px, kPaper_pixels);
      paper.className = "paper";
      box.append(paper);
    },
    printed() {
      paper?.remove();
      paper = null;
    },
    leave() {
      for (const stop of watching) stop();
      chart?.dispose();
      chart = null;
    },
  };
  new IntersectionObserver(
    (entries) => {
      near = entries[entries.length - 1]?.isIntersecting ?? false;
      if (near && stale) draw_now();
    },
    { rootMargin: "600px" },
  ).observe(all);
  new ResizeObserver(() => {
    if (chart && chart.getWidth() !== box.clientWidth) figure.redraw();
  }).observe(box);
  controls.update(now(), false);
  return figure;
};
