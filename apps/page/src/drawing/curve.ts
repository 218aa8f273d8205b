// A line of a picture, as ECharts wants it: without symbols, without a change when the mouse is over it.
import type { CustomSeriesRenderItemAPI, CustomSeriesRenderItemParams } from "echarts";
import type { Look } from "../picture";
import { colours } from "./theme";
import type { Num } from "../report";

export type Dash = "solid" | "dashed" | "dotted" | readonly number[];
export type Point = readonly (number | null)[];

export const curve = (
  name: string,
  colour: string,
  dash: Dash,
  width_px: number,
  data: readonly Point[],
  more: Record<string, unknown> = {},
): Record<string, unknown> => ({
  type: "line",
  name,
  data,
  showSymbol: false,
  symbol: "none",
  connectNulls: false,
  lineStyle: { color: colour, type: dash, width: width_px, join: "round" },
  itemStyle: { color: colour },
  emphasis: { disabled: true },
  ...more,
});

// A line at zero by itself, whatever curves there are.
export const zero_series = (look: Look, more: Record<string, unknown> = {}): Record<string, unknown> => ({
  type: "line",
  name: "",
  data: [],
  silent: true,
  ...more,
  markLine: zero_line(look),
});

// The mark of a series: a line at zero, all along x.
export const zero_line = (look: Look): Record<string, unknown> => ({
  silent: true,
  symbol: "none",
  label: { show: false },
  lineStyle: { color: colours(look.dark).faint, type: "solid", width: 1 },
  data: [{ yAxis: 0 }],
});

// Straight lines across a picture, at places of one of its axes. No curve of its own, so that they are there whatever is
// switched off.
export const lines_across = (
  at: readonly ({ xAxis: number } | { yAxis: number })[],
  label: Record<string, unknown>,
  line: { color: string; type: "solid" | "dashed"; width: number },
): Record<string, unknown> => ({
  type: "line",
  name: "",
  data: [],
  silent: true,
  tooltip: { show: false },
  markLine: { symbol: "none", silent: true, label: { ...label, color: line.color }, lineStyle: line, data: at },
});

// One standard deviation to either side of a curve: bars where its points can be told apart, a band where not.

// [x, value, sigma]
export type Uncertain = readonly [number, Num, Num];

// [x, from, to]
type Reach = [number, number, number];

const known = (points: readonly Uncertain[]): Reach[] =>
  points.flatMap(([x, value, sigma]) => (value === null || sigma === null ? [] : [[x, value - sigma, value + sigma]]));

// Between the points where it is not known.
const stretches_of = (points: readonly Uncertain[]): Reach[][] => {
  const stretches: Reach[][] = [];
  let before = false;
  for (const point of points) {
    const reach = known([point]);
    if (before) stretches[stretches.length - 1]?.push(...reach);
    else if (reach.length > 0) stretches.push(reach);
    before = reach.length > 0;
  }
  return stretches;
};

const kCap_px = 4;

const common = (colour: string): Record<string, unknown> => ({
  type: "custom",
  name: "",
  zlevel: 0, // stated: else a drag of the brush would draw it without one
  itemStyle: { color: colour },
  silent: true,
  clip: true,
  tooltip: { show: false },
});

export const sigma_bars = (points: readonly Uncertain[], colour: string): Record<string, unknown> => ({
  ...common(colour),
  z: 3,
  data: known(points),
  encode: { x: 0, y: [1, 2] },
  renderItem: (_: CustomSeriesRenderItemParams, api: CustomSeriesRenderItemAPI) => {
    const [x = 0, from = 0] = api.coord([api.value(0), api.value(1)]);
    const [, to = 0] = api.coord([api.value(0), api.value(2)]);
    // Shorter than the point's own mark: there is nothing to see.
    if (Math.abs(from - to) < 1) return { type: "group", children: [] };
    const style = { stroke: colour, lineWidth: 1.5 };
    const line = (x1: number, y1: number, x2: number, y2: number): unknown => ({
      type: "line",
      shape: { x1, y1, x2, y2 },
      style,
    });
    const children = [
      line(x, from, x, to),
      line(x - kCap_px, from, x + kCap_px, from),
      line(x - kCap_px, to, x + kCap_px, to),
    ];
    return { type: "group", children };
  },
});

// One item of data: how far all of it reaches.
export const sigma_band = (points: readonly Uncertain[], colour: string): Record<string, unknown> => {
  const ends = known(points);
  const least = ends.reduce((sofar, [, low]) => Math.min(sofar, low), Infinity);
  const most = ends.reduce((sofar, [, , high]) => Math.max(sofar, high), -Infinity);
  const first = ends[0]?.[0];
  const last = ends[ends.length - 1]?.[0];
  return {
    ...common(colour),
    z: 1,
    data: ends.length > 0 ? [[first, last, least, most]] : [],
    encode: { x: [0, 1], y: [2, 3] },
    renderItem: (_: CustomSeriesRenderItemParams, api: CustomSeriesRenderItemAPI) => {
      const children = stretches_of(points).map((stretch) => {
        const upper = stretch.map(([x, , high]) => api.coord([x, high]));
        const lower = stretch.map(([x, low]) => api.coord([x, low])).reverse();
        return { type: "polygon", shape: { points: [...upper, ...lower] }, style: { fill: colour, opacity: 0.18 } };
      });
      return { type: "group", children };
    },
  };
};
