// Colours and the parts that drawings have in common. The colours of curves are those of Okabe and Ito, told apart by
// people with any kind of colour vision; curves differ in their dashes as well.
import type { EChartsCoreOption } from "echarts/core";
import type { Look, State, Toggle } from "../picture";
import { t, with_decimal_sign } from "../texts/texts";
import type { Num } from "../report";

export interface Colours {
  paper: string;
  ink: string;
  faint: string; // of axes and ticks
  grid: string;
}

export const colours = (dark: boolean): Colours =>
  dark
    ? { paper: "#14181d", ink: "#e8eaed", faint: "#9aa3ad", grid: "#2b323a" }
    : { paper: "#ffffff", ink: "#1b1f24", faint: "#5c6670", grid: "#e3e6e9" };

// Colour k of curves.
export const curve_colour = (k: number, dark: boolean): string => {
  const light_set = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#b07d00", "#2b8cbe", "#6b4c9a", "#7a5230"];
  const dark_set = ["#56b4e9", "#ff8f4d", "#2fcf9f", "#e79fc4", "#f0c048", "#8fd0f5", "#b79be0", "#c9a27e"];
  const set = dark ? dark_set : light_set;
  return set[k % set.length] ?? "#0072b2";
};

// Of the k-th curve in one colour.
export const dashes = ["solid", "dashed", "dotted", [8, 3, 2, 3], [12, 4]] as const;

export const mark_of = (dash: number): Toggle["mark"] =>
  dash % dashes.length === 0 ? "line" : dash % dashes.length === 2 ? "dotted" : "dashed";

// Regimes of a warm-up, as shades behind the curves.
export const regime_colour = (regime: string, dark: boolean): string => {
  const alpha = dark ? 0.22 : 0.16;
  switch (regime) {
    case "warming":
      return `rgba(213,94,0,${alpha})`;
    case "cooling":
      return `rgba(0,114,178,${alpha})`;
    case "steady":
      return `rgba(0,158,115,${alpha * 0.7})`;
    case "after a change of speed":
      return `rgba(204,121,167,${alpha * 1.4})`;
    default:
      return `rgba(128,128,128,${alpha * 0.7})`;
  }
};

export const font = "system-ui, -apple-system, 'Segoe UI', 'Liberation Sans', sans-serif";

// A value with as many digits as five significant ones need, never in powers of ten within reason.
export const digits = (value: number | null): string => {
  if (value === null) return "–";
  const size = Math.abs(value);
  if (size !== 0 && (size >= 1e7 || size < 1e-5)) return value.toExponential(3);
  return String(Number(value.toPrecision(5)));
};

// A value with the decimal sign of the language: for whoever reads, not for files.
export const shown = (value: number | null | undefined, decimals?: number): string => {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  return with_decimal_sign(decimals === undefined ? digits(value) : value.toFixed(decimals).replace(/^-(0(?:\.0*)?)$/, "$1"));
};

// With so many digits.
export const rounded = (value: number | null, digits: number): string =>
  shown(value === null ? null : Number(value.toPrecision(digits)));

// The same digits wherever the RMSE of a model stands: before a step, after it, and where it is promised.
export const rmse_shown = (value: number | null): string =>
  shown(value, value !== null && value > 0 ? Math.min(4, Math.max(2, 2 - Math.floor(Math.log10(value)))) : 2);

// A moment or a length of time: "124 min", "5 h 20 min", "81 d 16 h 15 min".
export const time_text = (time_min: number, decimals?: number): string => {
  if (Math.abs(time_min) < 180) return `${shown(time_min, decimals)} min`;
  const whole = Math.round(Math.abs(time_min));
  const days = whole >= 2880 ? Math.floor(whole / 1440) : 0;
  const [hours, rest] = [Math.floor((whole - 1440 * days) / 60), whole % 60];
  const parts = [...(days > 0 ? [`${days} d`] : []), ...(hours > 0 ? [`${hours} h`] : []), ...(rest > 0 ? [`${rest} min`] : [])];
  return (time_min < 0 ? "-" : "") + parts.join(" ");
};

// The same with the wall clock, where the clock of the data is known: "5 h 20 min (2026-03-09 11:20)".
export const time_and_clock = (time_min: number, started: string | undefined, decimals?: number): string => {
  const at = new Date(Date.parse(`${started}Z`) + 60_000 * time_min);
  const clock = Number.isNaN(at.getTime()) ? "" : ` (${at.toISOString().slice(0, 16).replace("T", " ")})`;
  return time_text(time_min, decimals) + clock;
};

// "4.62 to 5.13", of the least and the largest; one number where they read the same.
export const range_text = (values: readonly number[], decimals: number): string => {
  const [from, to] = [shown(Math.min(...values), decimals), shown(Math.max(...values), decimals)];
  return values.length === 0 ? "" : from === to ? from : t.several_from_to({ from, to });
};

export const base = (look: Look): EChartsCoreOption => ({
  animation: false,
  backgroundColor: look.still ? colours(look.dark).paper : "transparent",
  textStyle: { color: colours(look.dark).ink, fontFamily: font, fontSize: 13 },
});

// An axis of numbers named with its unit.
export const axis = (look: Look, name: string, place: "x" | "y"): Record<string, unknown> => {
  const c = colours(look.dark);
  return {
    type: "value",
    name,
    nameLocation: "middle",
    nameGap: place === "x" ? 28 : 48,
    nameTextStyle: { color: c.ink, fontSize: 13 },
    scale: true,
    axisLine: { show: true, onZero: false, lineStyle: { color: c.faint } },
    axisTick: { show: true, lineStyle: { color: c.faint } },
    axisLabel: { color: c.ink, hideOverlap: true, formatter: (at: number) => shown(at) },
    splitLine: { show: true, lineStyle: { color: c.grid } },
    minorSplitLine: { show: false },
  };
};

// Tooltips are drawn, not written as HTML: what a file says is text.
export const tooltip = (look: Look): Record<string, unknown> => ({
  renderMode: "richText",
  confine: true,
  backgroundColor: colours(look.dark).paper,
  borderColor: colours(look.dark).faint,
  textStyle: { color: colours(look.dark).ink, fontSize: 12, fontFamily: font },
});

// Wide: less, as on a phone, and labels are shortened or fewer.
export const kNarrow_px = 480;

// The marks of a legend; without these ECharts puts a dot on every line.
const icons: Record<Toggle["mark"], string | undefined> = {
  line: "path://M0,0h24v2h-24z",
  dashed: "path://M0,0h6v2h-6zM9,0h6v2h-6zM18,0h6v2h-6z",
  dotted: "path://M0,0h3v2h-3zM7,0h3v2h-3zM14,0h3v2h-3zM21,0h3v2h-3z",
  dot: undefined, // the symbol that the points have
  band: "roundRect",
  bar: "rect",
};

// What stands beside a still picture; on the page the toggles are the legend.
export const legend = (state: State, toggles: readonly Toggle[]): Record<string, unknown> =>
  state.look.still
    ? {
        show: true,
        top: 4,
        textStyle: { color: colours(state.look.dark).ink },
        itemWidth: 20,
        itemHeight: 10,
        data: toggles.filter(({ key }) => !state.hidden.has(key)).map(({ label, mark }) => ({ name: label, icon: icons[mark] })),
      }
    : { show: false };

// A curve that can be switched off; `colour` as the k-th curve has it, or its own.
export const toggle = (
  key: string,
  label: string,
  colour: number | Toggle["colour"],
  mark: Toggle["mark"],
  on = true,
): Toggle => ({ key, label, colour: typeof colour === "number" ? (dark) => curve_colour(colour, dark) : colour, mark, on });

export const minutes = (seconds: number): number => seconds / 60;

// A value with its standard deviation, as the tables of ballbar print it: "12.01 ± 1.33".

export const with_sigma = (value: Num | undefined, sigma: Num | undefined, decimals: number): string =>
  typeof value !== "number"
    ? "–"
    : `${shown(value, decimals)} ± ${typeof sigma === "number" ? shown(sigma, decimals) : "?"}`;

// Decimals so that the standard deviation has two digits; without one, so that the value has four.
export const decimals_for = (value: Num | undefined, sigma: Num | undefined): number => {
  const by = (size: number, digits: number): number =>
    Math.min(9, Math.max(0, digits - 1 - Math.floor(Math.log10(size))));
  if (typeof sigma === "number" && sigma > 0 && Number.isFinite(sigma)) return by(sigma, 2);
  if (typeof value === "number" && value !== 0 && Number.isFinite(value)) return by(Math.abs(value), 4);
  return 2;
};

// Colours of a sequence from first to last: viridis (S. van der Walt and N. Smith, 2015), whose lightness rises evenly, so
// that the order is seen with any colour vision and in grey. The end that is too near to the paper is left out.

const kBar_px = 120;

const viridis = [
  [68, 1, 84],
  [72, 40, 120],
  [62, 73, 137],
  [49, 104, 142],
  [38, 130, 142],
  [31, 158, 137],
  [53, 183, 121],
  [110, 206, 88],
  [181, 222, 43],
  [253, 231, 37],
] as const;

// `place` from 0, the first, to 1, the last.
export const sequence_colour = (place: number, dark: boolean): string => {
  const lightness = dark ? 0.28 + 0.72 * place : 0.86 * place;
  const at = Math.min(Math.max(lightness, 0), 1) * (viridis.length - 1);
  const k = Math.min(Math.floor(at), viridis.length - 2);
  const [low, high] = [viridis[k], viridis[k + 1]];
  if (!low || !high) return "#31688e";
  const mixed = low.map((value, i) => Math.round(value + (at - k) * ((high[i] ?? value) - value)));
  return `rgb(${mixed.join(",")})`;
};

// A bar of the scale with what its ends mean, at the right edge of a drawing, from `top_px` down.
export const sequence_bar = (
  first: string,
  last: string,
  dark: boolean,
  ink: string,
  font: string,
  top_px: number,
): Record<string, unknown> => {
  // Names of files may be long: each has its half of the bar.
  const half = { width: kBar_px / 2 - 4, overflow: "truncate", ellipsis: "…" };
  const name = { y: 12, fill: ink, fontSize: 11, fontFamily: font, ...half };
  return {
    type: "group",
    right: 20,
    top: top_px,
    silent: true,
    children: [
      {
        type: "rect",
        shape: { x: 0, y: 0, width: kBar_px, height: 8 },
        style: {
          fill: {
            type: "linear",
            x: 0,
            y: 0,
            x2: 1,
            y2: 0,
            colorStops: Array.from({ length: 11 }, (_, k) => ({ offset: k / 10, color: sequence_colour(k / 10, dark) })),
          },
        },
      },
      { type: "text", style: { ...name, text: first, x: 0 } },
      { type: "text", style: { ...name, text: last, x: kBar_px, align: "right" } },
    ],
  };
};
