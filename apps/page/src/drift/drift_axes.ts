// Axes of a drift: their names, order and colours, the same in every picture.
import type { DriftPart, Num, ProbesPart } from "../report";
import { minutes } from "../drawing/theme";
import type { TimeCurve } from "./time_curves";
import { clamped } from "../drawing/text";
import { words } from "../drawing/units";

export interface DriftAxis {
  name: string;
  unit: string;
  time_min: readonly number[];
  values: readonly Num[];
  sigma?: readonly Num[];
  reference: number; // its row, where the drift is none by definition; -1: none
  main: boolean; // the drift itself; the rest tells how far to trust it, and is hidden at first
}

const places: ReadonlyMap<string, number> = new Map([
  ["x", 0],
  ["radial", 0],
  ["shift_a", 3],
  ["y", 1],
  ["shift_b", 4],
  ["z", 2],
  ["axial", 2],
  ["tilt_a", 0],
  ["tilt_b", 1],
]);

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
  const place = place_of(axis.name, k);
  const { time_min, values, sigma, main } = axis;
  const key = `${axis.name}_${axis.unit}`;
  return {
    key,
    label: clamped(words(axis.name), 60),
    time_min,
    values,
    sigma,
    colour: place,
    dash: place % 3,
    on: main,
  };
};
