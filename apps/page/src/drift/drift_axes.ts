// Axes of a drift: their names, order and colours, the same in every picture.
import type { DriftPart, Num, ProbesPart } from "../report";
import { decimals_for, minutes, shown, time_text, with_sigma } from "../drawing/theme";
import type { TimeCurve } from "./time_curves";
import { clamped, unit_shown, words } from "../drawing/text";
import { extent } from "../drawing/columns";
import type { TextTable } from "../picture";
import { t } from "../texts/texts";

export interface DriftAxis {
  name: string;
  unit: string;
  time_min: readonly number[];
  values: readonly Num[];
  sigma?: readonly Num[];
  reference: number; // its row, where the drift is none by definition; -1: none
  main: boolean; // the drift itself; the rest tells how far to trust it, and is hidden at first
}

const places = new Map(Object.entries({ x: 0, radial: 0, shift_a: 3, y: 1, shift_b: 4, z: 2, axial: 2, tilt_a: 0, tilt_b: 1 }));

export const place_of = (name: string, k: number): number => places.get(name) ?? k + 3;

// "radius_change_sigma_um" belongs to the axis radius_change.
export const axes_of_points = (drift: DriftPart): DriftAxis[] => {
  const keys = [...new Set(drift.points.flatMap((point) => Object.keys(point)))];
  const time_min = drift.points.map((point) => minutes(point.time_s));
  const reference = drift.points.findIndex((point) => point.time_s === drift.reference_s);
  return keys.flatMap((key) => {
    const [, name, unit] = /^(.+)_(um|urad)$/.exec(key) ?? [];
    if (name === undefined || unit === undefined || name.endsWith("_sigma")) return [];
    const sigma_key = `${name}_sigma_${unit}`;
    const sigma = keys.includes(sigma_key) ? { sigma: drift.points.map((point) => point[sigma_key] ?? null) } : {};
    const main = ["x", "y", "z", "radial", "axial"].includes(name);
    const values = drift.points.map((point) => point[key] ?? null);
    return [{ name, unit, time_min, values, ...sigma, reference, main }];
  });
};

export const axes_of_probes = (probes: ProbesPart): DriftAxis[] => {
  const time_min = probes.time_s.map(minutes);
  const reference = probes.time_s.indexOf(probes.reference_s);
  return probes.axes.map((axis) => ({ ...axis, time_min, reference, main: true }));
};

export const axis_curve = (axis: DriftAxis, k: number): TimeCurve => {
  const { name, unit, time_min, values, sigma, main } = axis;
  const place = place_of(name, k);
  const label = clamped(words(name), 60);
  return { key: `${name}_${unit}`, label, time_min, values, sigma, colour: place, dash: place % 3, on: main };
};

// The drift in numbers: how far each axis went, and test by test.

const number = (value: Num | undefined): value is number => typeof value === "number";

const text = (axis: DriftAxis, value: Num | undefined, row: number): string => {
  const sigma = axis.sigma?.[row];
  if (row === axis.reference && axis.sigma && value === 0 && !sigma) return t.drift_reference;
  const decimals = Math.min(3, decimals_for(value, sigma || axis.sigma?.find((one) => one) || null));
  return sigma === undefined ? shown(value, decimals) : with_sigma(value, sigma, decimals);
};

const label = (axis: DriftAxis): string => 
  t.model_in_unit({ name: words(axis.name), unit: unit_shown(axis.unit) });

// The row where it is farthest off; -1: nowhere is it known.
const largest_at = ({ values }: DriftAxis): number => {
  let at = -1;
  values.forEach((value, row) => {
    if (number(value) && (at < 0 || Math.abs(value) > Math.abs(values[at] ?? 0))) at = row;
  });
  return at;
};

interface Largest {
  text: string; // "31.72 ± 0.01 µm in y"
  at_text: string; // "124 min"
  said: string; // "y 31.72 ± 0.01 µm at 124 min"
}

// Where each axis of the drift itself is farthest off, the one that is most first.
export const largest_of_each = (axes: readonly DriftAxis[]): Largest[] =>
  axes
    .filter((axis) => axis.main)
    .map((axis) => ({ axis, row: largest_at(axis) }))
    .filter(({ row }) => row >= 0)
    .sort((a, b) => Math.abs(b.axis.values[b.row] ?? 0) - Math.abs(a.axis.values[a.row] ?? 0))
    .map(({ axis, row }) => {
      const found = { value: text(axis, axis.values[row], row), unit: unit_shown(axis.unit), axis: words(axis.name) };
      const at_text = time_text(axis.time_min[row] ?? 0);
      return { text: t.drift_in_axis(found), at_text, said: t.drift_at({ ...found, at: at_text }) };
    });

const largest_row = (axis: DriftAxis): string[] => {
  const at = largest_at(axis);
  const last = axis.values.map(number).lastIndexOf(true);
  const [least, largest] = extent([axis.values]);
  if (at < 0) return [label(axis), "–", "–", "–", "–"];
  const decimals = Math.min(3, decimals_for(axis.values[at], axis.sigma?.[at]));
  return [
    label(axis),
    text(axis, axis.values[at], at),
    shown(axis.time_min[at]),
    shown(largest - least, decimals),
    text(axis, axis.values[last], last),
  ];
};

export const largest_table = (title: string, axes: readonly DriftAxis[]): TextTable => ({
  title,
  heading: [t.drift_axis, t.drift_largest, t.drift_at_min, t.drift_range, t.drift_at_end],
  rows: axes.filter((axis) => axis.main).map(largest_row),
});

const kRows = 14;

export const points_table = (axes: readonly DriftAxis[]): TextTable => ({
  at_first: kRows,
  title: t.drift_points_title,
  heading: [t.time_axis, ...axes.map(label)],
  rows: (axes[0]?.time_min ?? []).map((time_min, row) => [
    shown(time_min),
    ...axes.map((axis) => text(axis, axis.values[row], row)),
  ]),
});
