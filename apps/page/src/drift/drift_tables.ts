// The drift in numbers: how far each axis went, and test by test.
import type { DriftAxis } from "./drift_axes";
import type { TextTable } from "../picture";
import type { Num } from "../report";
import { shown } from "../drawing/theme";
import { unit_shown, words } from "../drawing/units";
import { decimals_for, with_sigma } from "../drawing/with_sigma";
import { t } from "../texts/texts";

const number = (value: Num | undefined): value is number => typeof value === "number";

const text = (axis: DriftAxis, value: Num | undefined, row: number): string => {
  const sigma = axis.sigma?.[row];
  if (row === axis.reference && axis.sigma && value === 0 && !sigma) return t.drift_reference;
  const decimals = Math.min(3, decimals_for(value, sigma || axis.sigma?.find((one) => one) || null));
  return sigma === undefined ? shown(value, decimals) : with_sigma(value, sigma, decimals);
};

const label = (axis: DriftAxis): string => 
  t.model_in_unit({ name: words(axis.name), unit: unit_shown(axis.unit) });

export interface Largest {
  text: string; // "31.72 ± 0.01 µm in y"
  at_text: string; // "124 min"
}

// Of the drift itself, in all axes of one unit.
export const largest_of = (axes: readonly DriftAxis[]): Largest | null => {
  let found: { axis: DriftAxis; row: number; size: number } | null = null;
  for (const axis of axes.filter((one) => one.main)) {
    axis.values.forEach((value, row) => {
      if (number(value) && Math.abs(value) > (found?.size ?? -1)) found = { axis, row, size: Math.abs(value) };
    });
  }
  const largest = found as { axis: DriftAxis; row: number } | null;
  if (!largest) return null;
  const { axis, row } = largest;
  return {
    text: t.drift_in_axis({ value: text(axis, axis.values[row], row), unit: unit_shown(axis.unit), axis: words(axis.name) }),
    at_text: `${shown(axis.time_min[row])} min`,
  };
};

const largest_row = (axis: DriftAxis): string[] => {
  let at = -1;
  let least = Infinity;
  let most = -Infinity;
  let last = -1;
  axis.values.forEach((value, row) => {
    if (!number(value)) return;
    if (at < 0 || Math.abs(value) > Math.abs(axis.values[at] ?? 0)) at = row;
    least = Math.min(least, value);
    most = Math.max(most, value);
    last = row;
  });
  if (at < 0) return [label(axis), "–", "–", "–", "–"];
  const decimals = Math.min(3, decimals_for(axis.values[at], axis.sigma?.[at]));
  return [
    label(axis),
    text(axis, axis.values[at], at),
    shown(axis.time_min[at]),
    shown(most - least, decimals),
    text(axis, axis.values[last], last),
  ];
};

export const largest_table = (title: string, axes: readonly DriftAxis[]): TextTable => ({
  title,
  heading: [t.drift_axis, t.drift_largest, t.drift_at_min, t.drift_range, t.drift_at_end],
  rows: axes.filter((axis) => axis.main).map(largest_row),
});

export const points_table = (axes: readonly DriftAxis[]): TextTable => ({
  title: t.drift_points_title,
  heading: [t.time_axis, ...axes.map(label)],
  rows: (axes[0]?.time_min ?? []).map((time_min, row) => [
    shown(time_min),
    ...axes.map((axis) => text(axis, axis.values[row], row)),
  ]),
});
