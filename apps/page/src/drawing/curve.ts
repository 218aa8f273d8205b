// A line of a picture, as ECharts wants it: without symbols, without a change when the mouse is over it.
import type { Look } from "../picture";
import { colours } from "./theme";

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

// The mark of a series: a line at zero, all along x.
export const zero_line = (look: Look): Record<string, unknown> => ({
  silent: true,
  symbol: "none",
  label: { show: false },
  lineStyle: { color: colours(look.dark).faint, type: "solid", width: 1 },
  data: [{ yAxis: 0 }],
});
