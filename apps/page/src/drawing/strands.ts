// The rows of a checked series as they are drawn. A drift is one strand over time; recordings are one strand each over
// the angle, because the angle comes again and lines must not run from one recording to the next.
import { decimated } from "./columns";
import type { Numbers } from "../picture";
import type { Checked, Num } from "../report";
import { shown, time_and_clock } from "./theme";

export interface Strand {
  recording: Num; // null: a drift
  rows: readonly number[]; // in rising order of x
  x: readonly number[]; // minutes, or degrees
}

const values_of = (checked: Checked, name: string): readonly Num[] | undefined =>
  checked.series.inputs.find((column) => column.name === name)?.values;

export const strands_of = (checked: Checked): Strand[] => {
  const { time_s } = checked.series;
  if (checked.level === "series") {
    return [{ recording: null, rows: time_s.map((_, i) => i), x: time_s.map((t) => t / 60) }];
  }
  const angle_deg = values_of(checked, "angle_deg") ?? [];
  const recording = values_of(checked, "recording") ?? [];
  const rows_of = new Map<Num, number[]>();
  time_s.forEach((_, i) => {
    if (typeof angle_deg[i] !== "number") return;
    const which = recording[i] ?? 0;
    const rows = rows_of.get(which);
    if (rows) rows.push(i);
    else rows_of.set(which, [i]);
  });
  return [...rows_of].map(([which, rows]) => {
    const sorted = rows.sort((a, b) => (angle_deg[a] ?? 0) - (angle_deg[b] ?? 0));
    return { recording: which, rows: sorted, x: sorted.map((i) => angle_deg[i] ?? 0) };
  });
};

// Points of a column, with a gap between strands.
export const points_of = (
  strands: readonly Strand[],
  values: readonly Num[],
  window: readonly [number, number] | null,
  width_px: number,
): [number, Num][] =>
  strands.flatMap(({ rows, x }, k) => {
    const points = decimated(x, rows.map((i) => values[i] ?? null), window, width_px);
    const end = points.at(-1);
    return k + 1 < strands.length && end ? [...points, [end[0], null] as [number, Num]] : points;
  });

// Columns at the rows of strands, over time or over the angle.
export const strand_numbers = (
  { level }: Checked,
  strands: readonly Strand[],
  columns: readonly { name: string; values: readonly Num[] }[],
): Numbers => {
  const over_angle = level === "recording";
  const rows = over_angle ? strands.flatMap((strand) => strand.rows) : []; // of a drift they are all, in their order
  const recording = strands.flatMap((strand) => strand.rows.map(() => strand.recording));
  return {
    columns: [
      { name: over_angle ? "angle_deg" : "time_min", values: strands.flatMap(({ x }) => x) },
      ...(over_angle ? [{ name: "recording", values: recording }] : []),
      ...columns.map(({ name, values }) => ({ name, values: over_angle ? rows.map((row) => values[row] ?? null) : values })),
    ],
  };
};

// A place on the x axis, in words.
export const place_text =
  ({ level }: Checked, decimals: number, started?: string) =>
  (at: number): string =>
    level === "recording" ? `${shown(at, decimals)}°` : time_and_clock(at, started, decimals);
