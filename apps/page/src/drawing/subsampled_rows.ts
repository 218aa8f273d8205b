// Rows of a cloud of points that are drawn: evenly chosen ones, and the extremes, so that no outlier is lost.
import type { Num } from "../report";

const kStretches = 200; // whose extremes are kept

export const subsampled_rows = (rows: readonly number[], values: readonly Num[], most: number): number[] => {
  if (rows.length <= most) return [...rows];
  const step = rows.length / (most - 2 * kStretches);
  const kept = new Set<number>();
  for (let at = 0; at < rows.length; at += step) kept.add(Math.floor(at));
  for (let s = 0; s < kStretches; ++s) {
    let least = -1;
    let largest = -1;
    const to = Math.floor(((s + 1) * rows.length) / kStretches);
    for (let i = Math.floor((s * rows.length) / kStretches); i < to; ++i) {
      const value = values[rows[i] ?? -1] ?? null;
      if (value === null) continue;
      if (least < 0 || value < (values[rows[least] ?? -1] ?? 0)) least = i;
      if (largest < 0 || value > (values[rows[largest] ?? -1] ?? 0)) largest = i;
    }
    if (least >= 0) kept.add(least).add(largest);
  }
  return [...kept].sort((a, b) => a - b).map((i) => rows[i] as number);
};
