// The axis of time that all pictures of a section have in common, so that they stand below one another.
import type { Look, Range } from "../picture";
import { axis, colours, kNarrow_px, shown } from "./theme";
import { t } from "../texts/texts";

// From the first to the last time of all clocks, with a little room for the marks at the ends.
export const whole_min = (clocks_min: readonly (readonly number[])[]): Range => {
  const ends = clocks_min.flatMap((clock) =>
    clock.length > 0 ? [clock[0] as number, clock[clock.length - 1] as number] : [],
  );
  const [from, to] = ends.length > 0 ? [Math.min(...ends), Math.max(...ends)] : [0, 1];
  const room = to > from ? (to - from) * 0.015 : 1;
  return [from - room, to + room];
};

export const time_axis = (look: Look, shown_min: Range): Record<string, unknown> => {
  const common = axis(look, t.time_axis, "x");
  const ends = {
    ...common,
    min: shown_min[0],
    max: shown_min[1],
    splitLine: { show: false },
    // The ends of a window are no round numbers.
    axisLabel: { ...(common["axisLabel"] as Record<string, unknown>), showMinLabel: false, showMaxLabel: false },
  };
  return in_time(ends, look, shown_min);
};

const kHour_min = 60;
const kDay_min = 1440;
const kSteps_h = [0.5, 1, 2, 3, 6, 12]; // between ticks
const kTicks = 8; // about
const kTicks_narrow = 4;

// An axis of minutes with its ticks and its name in the unit that suits: minutes up to three hours, hours up to four
// days, then days.
export const in_time = (made: Record<string, unknown>, look: Look, [from, to]: Range): Record<string, unknown> => {
  const span_min = to - from;
  if (!(span_min > 3 * kHour_min)) return { ...made, name: t.time_axis };
  const in_hours = span_min <= 4 * kDay_min;
  const unit_min = in_hours ? kHour_min : kDay_min;
  const wanted = span_min / unit_min / (look.width_px < kNarrow_px ? kTicks_narrow : kTicks);
  const step_min = unit_min * (in_hours ? (kSteps_h.find((one) => one >= wanted) ?? 24) : Math.max(1, round_up(wanted)));
  // The chart would begin with its ticks at the end of the axis, which is no round number.
  const first = Math.ceil(from / step_min);
  const customValues = Array.from({ length: Math.floor(to / step_min) - first + 1 }, (_, k) => (first + k) * step_min);
  const { showMinLabel: _first, showMaxLabel: _last, ...label } = (made["axisLabel"] ?? {}) as Record<string, unknown>;
  return {
    ...made,
    name: in_hours ? t.time_axis_h : t.time_axis_d,
    axisTick: { ...((made["axisTick"] ?? {}) as Record<string, unknown>), customValues },
    axisLabel: { ...label, customValues, formatter: (min: number) => shown(min / unit_min) },
  };
};

// The other axis, whose labels are as wide as the room beside the plot.
export const value_axis = (look: Look, name: string): Record<string, unknown> => ({
  ...axis(look, name, "y"),
  nameMoveOverlap: false,
});

// Two drawings one above the other that share the x axis: a curve, and below it what is left of it.

export interface TwoGrids {
  drawn: Record<string, unknown>; // grid, xAxis, yAxis, axisPointer
  width_px: number; // of the drawings
}

const kBetween_px = 26;
const kBottom_of_two_px = 48;

// From the first to the last of these; the last is seldom a round number, so it has no label.
export const time_limits = (times: readonly number[]): Record<string, unknown> => {
  const [first, last] = [times[0], times[times.length - 1]];
  return first !== undefined && last !== undefined && last > first ? { min: first, max: last } : {};
};

export const whole_of = (limits: Record<string, unknown>): Range => [Number(limits["min"] ?? 0), Number(limits["max"] ?? 0)];

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
  const room = look.height_px - top - kBottom_of_two_px - kBetween_px;
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

// Where the plot is in its picture: the same left and right edge in all pictures over time, and above it as much room
// as the legend of a still picture needs.

export const kLeft_px = 64;
export const kRight_px = 20;
export const kBottom_px = 46;

const kLetter_px = 7; // about, of the legend's font
const kMark_px = 46;

export const top_px = (look: Look, labels: readonly string[]): number => {
  if (!look.still) return 12;
  const room_px = Math.max(100, look.width_px - 40);
  let rows = 1;
  let used_px = 0;
  for (const label of labels) {
    const wide_px = kMark_px + kLetter_px * label.length;
    if (used_px > 0 && used_px + wide_px > room_px) {
      rows += 1;
      used_px = 0;
    }
    used_px += wide_px;
  }
  return 14 + 24 * rows;
};

// Round numbers for scales: 1, 2, 5, 10, 20 ...

// The least round number not below `value`, which is positive.
export const round_up = (value: number, steps: readonly number[] = [1, 2, 5]): number => {
  const decade = 10 ** Math.floor(Math.log10(value));
  for (const step of [...steps, 10]) if (step * decade >= value * (1 - 1e-9)) return clean(step * decade);
  return clean(10 * decade);
};

// The largest round number not above `value`, which is positive.
export const round_down = (value: number, steps: readonly number[] = [1, 2, 5]): number => {
  const decade = 10 ** Math.floor(Math.log10(value));
  for (const step of [...steps].reverse()) if (step * decade <= value * (1 + 1e-9)) return clean(step * decade);
  return clean(decade);
};

// 0.30000000000000004 is 0.3.
export const clean = (value: number): number => Number(value.toPrecision(12));
