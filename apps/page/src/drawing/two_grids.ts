// Two drawings one above the other that share the x axis: a curve, and below it what is left of it.
import type { Look } from "../picture";
import { axis, colours, kNarrow_px } from "./theme";

export interface TwoGrids {
  drawn: Record<string, unknown>; // grid, xAxis, yAxis, axisPointer
  width_px: number; // of the drawings
}

const kLeft_px = 64;
const kRight_px = 20;
const kBetween_px = 26;
const kBottom_px = 48;

// From the first to the last of these; the last is seldom a round number, so it has no label.
export const time_limits = (times: readonly number[]): Record<string, unknown> => {
  const [first, last] = [times[0], times[times.length - 1]];
  return first !== undefined && last !== undefined && last > first ? { min: first, max: last } : {};
};

// An x axis. The ends of a window are no round numbers and so have no label; without a window `all` has the limits,
// whose ends have none either unless they come with the interval of the ticks.
export const x_axis = (
  look: Look,
  name: string,
  window: readonly [number, number] | null,
  all: Record<string, unknown> = {},
): Record<string, unknown> => {
  const common = axis(look, name, "x");
  const round = !("max" in all) || "interval" in all;
  const label = {
    ...(common["axisLabel"] as Record<string, unknown>),
    ...(window
      ? { showMinLabel: false, showMaxLabel: false }
      : round
        ? {}
        : { showMinLabel: all["min"] === 0, showMaxLabel: false }),
  };
  const step = all["interval"];
  const fewer = typeof step === "number" && look.width_px < kNarrow_px ? { interval: 3 * step } : {};
  return { ...common, ...(window ? { min: window[0], max: window[1] } : { ...all, ...fewer }), axisLabel: label };
};

export const two_grids = (
  look: Look,
  x: Record<string, unknown>,
  above: string,
  below: string,
  share_below = 0.32,
): TwoGrids => {
  const top = look.still ? 64 : 14;
  const room = look.height_px - top - kBottom_px - kBetween_px;
  const height_below = Math.round(room * share_below);
  const height_above = room - height_below;
  const sides = { left: kLeft_px, right: kRight_px };
  const c = colours(look.dark);
  return {
    drawn: {
      grid: [
        { ...sides, top, height: height_above },
        { ...sides, top: top + height_above + kBetween_px, height: height_below },
      ],
      xAxis: [
        { ...x, gridIndex: 0, name: "", axisLabel: { show: false } },
        { ...x, gridIndex: 1, axisPointer: { label: { show: false } } },
      ],
      yAxis: [
        { ...axis(look, above, "y"), gridIndex: 0 },
        { ...axis(look, below, "y"), gridIndex: 1, splitNumber: 3 },
      ],
      axisPointer: { link: [{ xAxisIndex: "all" }], lineStyle: { color: c.faint } },
    },
    width_px: Math.max(100, look.width_px - kLeft_px - kRight_px),
  };
};
