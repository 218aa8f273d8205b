// Mouse, pen and fingers on a chart: where all is seen, or with Alt held, a drag zooms, upright too where it goes up or
// down; else it moves; two fingers or the wheel zoom, a double click shows all, a drag with shift selects a stretch. The
// wheel alone scrolls the page until the chart has the focus.
import type { Heights, Numbers, Range, State } from "../picture";
import type { Brushed } from "./charts";
import type { View } from "./view";
import type { Num } from "../report";
import { shown } from "../drawing/theme";
import { split_name, words } from "../drawing/text";

interface Drag {
  from_px: number; // where it began, from the left of the box
  from: number; // the same on the x axis
  from_y_px: number; // from the top
  window: Range | null; // then
  heights: Heights | null;
  spread_px: number; // two fingers, then; 0: one
}

const kLeast_px = 8; // of a drag that zooms
const kUpright_px = 24; // of one that zooms the heights: a hand is not steady

const wheel_factor = ({ deltaMode, deltaY }: WheelEvent): number =>
  Math.exp(-Math.max(-200, Math.min(200, deltaY * (deltaMode === 1 ? 16 : 1))) * 0.003);

const is_held = ({ ctrlKey, metaKey }: WheelEvent): boolean => ctrlKey || metaKey;

// With Ctrl held, or alone once the picture has the focus; else it is the page's, as it is where `zoom` does nothing.
const zooming_wheel = (box: HTMLElement, zoom: (event: WheelEvent) => boolean): void =>
  box.addEventListener(
    "wheel",
    (event) => {
      if ((is_held(event) || document.activeElement === box) && zoom(event)) event.preventDefault();
    },
    { passive: false },
  );

// What a drag drew: a stretch, or what is to be seen of either axis.
export const take_brushed = (view: View, { areas }: Brushed): void => {
  const [across, upright] = areas[0]?.range ?? [];
  if (typeof across === "number" && typeof upright === "number") view.select([view.x_at(across), view.x_at(upright)], true);
  if (typeof across !== "object" || typeof upright !== "object") return;
  const [[left, right], [top, bottom]] = [across, upright];
  const axis = view.plot_at((left + right) / 2, (top + bottom) / 2) ?? 0;
  const window: Range = [view.x_at(left), view.x_at(right)];
  if (bottom - top > kUpright_px) view.see_heights({ axis, range: [view.y_at(axis, bottom), view.y_at(axis, top)] });
  if (right - left > kLeast_px) view.see(window);
};

export const listen_to_pointer = (view: View): void => {
  const { box } = view;
  const down = new Map<number, number>(); // pointers that move it, from the left of the box
  let drag: Drag | null = null;

  const x_px = (event: MouseEvent): number => event.clientX - box.getBoundingClientRect().left;
  const y_px = (event: MouseEvent): number => event.clientY - box.getBoundingClientRect().top;
  const middle = (): number => [...down.values()].reduce((sum, px) => sum + px, 0) / Math.max(1, down.size);
  const spread = (): number => (down.size > 1 ? Math.max(20, Math.max(...down.values()) - Math.min(...down.values())) : 0);

  const begin = (event: MouseEvent): void => {
    drag = { from_px: middle(), from: view.x_at(middle()), from_y_px: y_px(event), window: view.window(), heights: view.heights(), spread_px: spread() };
  };

  box.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !view.whole() || view.plot_at(x_px(event), y_px(event)) === null) return;
    const moves = ((view.window() || view.heights()) && !event.altKey) || event.pointerType === "touch";
    const brush = event.shiftKey || view.selecting() ? "lineX" : moves ? false : "rect";
    view.brush(brush);
    if (brush) return;
    down.set(event.pointerId, x_px(event));
    box.setPointerCapture(event.pointerId);
    begin(event);
  });

  box.addEventListener("pointermove", (event) => {
    const whole = view.whole();
    if (!whole || !drag || !down.has(event.pointerId)) return;
    down.set(event.pointerId, x_px(event));
    if (drag.spread_px > 0) return view.see(zoomed(drag.window, whole, drag.from, spread() / drag.spread_px));
    // Per pixel as it was when the drag began, for the axis moves under the pointer.
    const plot_px = (view.x_at(1) - view.x_at(0)) * (drag.from_px - middle());
    if (drag.window) view.see(panned(drag.window, whole, plot_px));
    if (!drag.heights) return;
    const { axis, range } = drag.heights;
    const by = (view.y_at(axis, 1) - view.y_at(axis, 0)) * (drag.from_y_px - y_px(event));
    view.see_heights({ axis, range: [range[0] + by, range[1] + by] });
  });

  const end = (event: PointerEvent): void => {
    if (!down.delete(event.pointerId)) return;
    drag = null;
    if (down.size > 0) begin(event);
  };
  box.addEventListener("pointerup", end);
  box.addEventListener("pointercancel", end);

  box.addEventListener("dblclick", () => view.see(null));

  zooming_wheel(box, (event) => {
    const whole = view.whole();
    if (!whole || view.plot_at(x_px(event), y_px(event)) === null) return false;
    // All is seen already: a focused chart gives the wheel back to the page.
    if (!view.window() && event.deltaY > 0 && !is_held(event)) return false;
    view.see(zoomed(view.window(), whole, view.x_at(x_px(event)), wheel_factor(event)));
    return true;
  });
};

// A picture that is magnified about its middle: by the wheel, by two fingers, and by + and -; 0 or a double click gives it
// back (null).
export const magnify_by = (box: HTMLElement, magnify: (factor: number | null) => void): void => {
  zooming_wheel(box, (event) => (magnify(wheel_factor(event)), true));
  box.addEventListener("dblclick", () => magnify(null));
  box.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "+" || event.key === "=") magnify(1.25);
    else if (event.key === "-" || event.key === "_") magnify(1 / 1.25);
    else if (event.key === "0" || event.key === "Home") magnify(null);
    else return;
    event.preventDefault();
  });
  const fingers = new Map<number, [number, number]>();
  let spread_px = 0;
  const spread = (): number => {
    const [a = [0, 0], b = [0, 0]] = [...fingers.values()];
    return Math.max(20, Math.hypot(a[0] - b[0], a[1] - b[1]));
  };
  box.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "touch") return;
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    spread_px = spread();
  });
  box.addEventListener("pointermove", (event) => {
    if (!fingers.has(event.pointerId)) return;
    fingers.set(event.pointerId, [event.clientX, event.clientY]);
    const factor = spread() / spread_px;
    if (fingers.size !== 2 || Math.abs(Math.log(factor)) < 0.08) return;
    magnify(factor);
    spread_px = spread();
  });
  for (const end of ["pointerup", "pointercancel"] as const) box.addEventListener(end, (event) => fingers.delete(event.pointerId));
};

// Keys on a focused chart. What they do is said in the hint below it.

export const listen_to_keys = (view: View, step: (by: number) => void): void => {
  view.box.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey) return;
    if (act(event.key, event.altKey)) event.preventDefault();
  });

  const act = (key: string, alt: boolean): boolean => {
    if (key === "," || (alt && key === "ArrowLeft")) return (step(-1), true);
    if (key === "." || (alt && key === "ArrowRight")) return (step(1), true);
    const whole = view.whole();
    if (!whole || alt) return false;
    const window = view.window();
    const [from, to] = window ?? whole;
    switch (key) {
      case "+":
      case "=":
        view.see(zoomed(window, whole, (from + to) / 2, 1.5));
        return true;
      case "-":
      case "_":
        view.see(zoomed(window, whole, (from + to) / 2, 1 / 1.5));
        return true;
      case "ArrowLeft":
        if (window) view.see(panned(window, whole, -(to - from) / 8)); // else there is nowhere to go
        return true;
      case "ArrowRight":
        if (window) view.see(panned(window, whole, (to - from) / 8));
        return true;
      case "Home":
      case "0":
        view.see(null);
        return true;
      case "Escape":
        view.select(null, true);
        return true;
      default:
        return false;
    }
  };
};

// Reads a picture's numbers out point by point.

const value_text = (name: string, value: Num | string): string => {
  const { quantity, unit } = split_name(name);
  const text = typeof value === "string" ? value : shown(value);
  return [words(quantity), text, unit].filter((part) => part !== "").join(" ");
};

// "time 64 min, x 4.4 µm, ..."; what is not known is left out.
export const row_text = (numbers: Numbers, row: number): string =>
  numbers.columns
    .flatMap(({ name, values }) => {
      const value = values[row] ?? null;
      return value === null ? [] : [value_text(name, value)];
    })
    .join(", ");

// The row `by` points after `row`, among those in the window; of very many points not every one.
export const next_row = (numbers: Numbers, window: State["window"], row: number | null, by: number): number | null => {
  const x = numbers.columns[0]?.values ?? [];
  const rows: number[] = [];
  x.forEach((value, index) => {
    if (!window || typeof value !== "number" || (value >= window[0] && value <= window[1])) rows.push(index);
  });
  if (rows.length === 0) return null;
  const step = Math.ceil(rows.length / 500);
  const place = row === null ? -1 : rows.indexOf(row);
  if (place < 0) return (by > 0 ? rows[0] : rows[rows.length - 1]) ?? null;
  return rows[Math.min(rows.length - 1, Math.max(0, place + by * step))] ?? null;
};

// The part of the x axis that is seen. Pure arithmetic; `all` is the whole axis.

// Within the whole axis; all of it is no window at all, so that a picture drawn without one looks the same.
export const within = (window: Range, all: Range): Range | null => {
  const width = Math.max(window[1] - window[0], (all[1] - all[0]) * 1e-6);
  if (!(width < (all[1] - all[0]) * 0.999)) return null;
  const from = Math.min(Math.max(window[0], all[0]), all[1] - width);
  return [from, from + width];
};

// Zooms in by the factor, or out if it is below 1, around the point `at`.
export const zoomed = (window: Range | null, all: Range, at: number, factor: number): Range | null => {
  const [from, to] = window ?? all;
  return within([at - (at - from) / factor, at + (to - at) / factor], all);
};

export const panned = (window: Range | null, all: Range, by: number): Range | null =>
  window && within([window[0] + by, window[1] + by], all);
