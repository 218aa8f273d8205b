// A picture of curves over time in one unit: a drift, temperatures, the speed.
import { curve, sigma_band, sigma_bars, type Uncertain } from "../drawing/curve";
import { decimated, first_at } from "../drawing/columns";
import type { Numbers, Picture, Range, State, Toggle } from "../picture";
import { kLeft_px, kRight_px, time_axis, value_axis } from "../drawing/axes";
import { grid_below } from "../drawing/parts";
import { reading_in } from "../drawing/hover";
import type { Num } from "../report";
import { base, curve_colour, dashes, legend, mark_of, toggle, tooltip } from "../drawing/theme";
import { unit_shown } from "../drawing/text";
import { t } from "../texts/texts";

const kMarked = 150; // points; of more the marks would hide the curve

export interface TimeCurve extends Pick<Toggle, "key" | "label" | "on" | "quiet" | "group"> { // key: the name of its column too
  time_min: readonly number[]; // rises
  values: readonly Num[];
  sigma?: readonly Num[];
  colour: number; // of the set of colours
  dash: number; // of the set of dashes
}

export interface TimeCurves extends Pick<Picture, "name" | "title" | "caption" | "height_px"> {
  quantity: string; // "drift"
  unit: string; // as files spell it
  curves: readonly TimeCurve[];
  whole_min: Range;
  step?: boolean; // a value holds until the next one
  started?: string; // wall clock of time 0
}

const toggle_of = ({ key, label, colour, dash, on, quiet, group }: TimeCurve): Toggle => ({
  quiet: quiet || undefined,
  group,
  ...toggle(key, label, colour, mark_of(dash), on),
});

// Four points for two pixels look like all of them.
const points_of = (one: TimeCurve, state: State): Uncertain[] => {
  const stretches = (state.look.width_px - kLeft_px - kRight_px) / 2;
  const points = decimated(one.time_min, one.values, state.window, stretches);
  return points.map(([x, value]) => [x, value, one.sigma?.[first_at(one.time_min, x)] ?? null]);
};

const series_of = (one: TimeCurve, state: State, step: boolean): Record<string, unknown>[] => {
  const points = points_of(one, state);
  const colour = curve_colour(one.colour, state.look.dark);
  const marked = !step && points.length <= kMarked;
  const line = curve(one.label, colour, dashes[one.dash % dashes.length] ?? "solid", marked ? 1.8 : 1.5, points, {
    ...(marked ? { showSymbol: true, showAllSymbol: true, symbol: "circle", symbolSize: 6 } : {}),
    ...(step ? { step: "end" } : {}),
    z: 2,
  });
  if (!one.sigma) return [line];
  return [marked ? sigma_bars(points, colour) : sigma_band(points, colour), line];
};

export const time_curves = ({ quantity, unit: file_unit, curves, whole_min, step = false, started, ...head }: TimeCurves): Picture => {
  const toggles = curves.map(toggle_of);
  const unit = unit_shown(file_unit);
  const visible = (state: State): TimeCurve[] => curves.filter((one) => !state.hidden.has(one.key));
  return {
    ...head,
    zoom: "time",
    toggles: () => toggles,
    draw: (state) => ({
      ...base(state.look),
      legend: legend(state, toggles),
      grid: { ...grid_below(state.look, visible(state)), outerBoundsMode: "none" },
      tooltip: { ...tooltip(state.look), trigger: "axis", formatter: reading_in(unit, started) },
      xAxis: time_axis(state.look, state.window ?? whole_min),
      yAxis: value_axis(state.look, t.model_in_unit({ name: quantity, unit })),
      series: visible(state).flatMap((one) => series_of(one, state, step)),
    }),
    numbers: (state) =>
      on_one_clock(
        visible(state).flatMap(({ key, time_min, values, sigma }) => [
          { name: key, time_min, values },
          ...(sigma ? [{ name: sigma_name(key, file_unit), time_min, values: sigma }] : []),
        ]),
      ),
  };
};

// "x_um" has the standard deviation "x_sigma_um".
const sigma_name = (name: string, unit: string): string =>
  name.endsWith(`_${unit}`) ? `${name.slice(0, -unit.length - 1)}_sigma_${unit}` : `${name}_sigma`;

// Columns on several clocks, brought onto one: at a time that a clock does not have, its columns have no value.

interface Timed {
  name: string;
  time_min: readonly number[]; // rises
  values: readonly Num[];
}

const union_of = (clocks: readonly (readonly number[])[]): readonly number[] => {
  if (clocks.length === 1) return clocks[0] as readonly number[];
  const all = Float64Array.from(clocks.flatMap((clock) => [...clock])).sort();
  return Array.from(all.filter((time, k) => k === 0 || time !== all[k - 1]));
};

const spread = (timed: Timed, clock: readonly number[]): readonly Num[] => {
  if (timed.time_min === clock) return timed.values;
  let next = 0;
  return clock.map((time) => {
    while (next < timed.time_min.length && (timed.time_min[next] as number) < time) next += 1;
    return timed.time_min[next] === time ? (timed.values[next] ?? null) : null;
  });
};

const on_one_clock = (columns: readonly Timed[]): Numbers => {
  const clock = union_of([...new Set(columns.map((column) => column.time_min))]);
  return {
    columns: [{ name: "time_min", values: clock }, ...columns.map((column) => ({ name: column.name, values: spread(column, clock) }))],
  };
};
