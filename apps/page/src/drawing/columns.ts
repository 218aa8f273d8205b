// Columns of numbers, row by row; a row that lacks in one lacks in what is made of it.
import type { Num } from "../report";

export const sum = (columns: readonly (readonly Num[])[]): Num[] =>
  (columns[0] ?? []).map((_, i) =>
    columns.reduce((total: Num, column) => {
      const value = column[i] ?? null;
      return total === null || value === null ? null : total + value;
    }, 0),
  );

export const difference = (a: readonly Num[], b: readonly Num[]): Num[] =>
  a.map((value, i) => {
    const other = b[i] ?? null;
    return value === null || other === null ? null : value - other;
  });

// Least and largest of what is known in these columns, and of `from`.
export const extent = (
  columns: Iterable<Iterable<Num | undefined>>,
  [from, to]: readonly [number, number] = [Infinity, -Infinity],
): [number, number] => {
  let [least, largest] = [from, to];
  for (const values of columns) {
    for (const value of values) {
      if (value === null || value === undefined) continue;
      if (value < least) least = value;
      if (value > largest) largest = value;
    }
  }
  return [least, largest];
};

// As many points as a picture has pixels: of each stretch of neighbours the first, the least, the largest and the last,
// in their order. Drawn at that width, the curve looks as if all were there; extremes are never lost.

// First index whose x is not below `value`; x rises.
export const first_at = (x: readonly number[], value: number): number => {
  let low = 0;
  let high = x.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if ((x[middle] ?? 0) < value) low = middle + 1;
    else high = middle;
  }
  return low;
};

// Points [x, y] within the window and one beyond it on either side. x rises. A gap (null) stays a gap.
export const decimated = (
  x: readonly number[],
  y: readonly Num[],
  window: readonly [number, number] | null,
  width_px: number,
): [number, Num][] => {
  const n = Math.min(x.length, y.length);
  const begin = window ? Math.max(0, first_at(x, window[0]) - 1) : 0;
  const end = window ? Math.min(n, first_at(x, window[1]) + 2) : n;
  const points: [number, Num][] = [];
  const stretches = Math.max(1, Math.floor(width_px));
  if (end - begin <= 4 * stretches) {
    for (let i = begin; i < end; ++i) points.push([x[i] ?? NaN, y[i] ?? null]);
    return points;
  }
  const step = (end - begin) / stretches;
  for (let s = 0; s < stretches; ++s) {
    const from = begin + Math.floor(s * step);
    const to = Math.min(end, begin + Math.floor((s + 1) * step));
    let least = -1;
    let largest = -1;
    let gap = -1;
    for (let i = from; i < to; ++i) {
      const value = y[i] ?? null;
      if (value === null) {
        gap = i;
        continue;
      }
      if (least < 0 || value < (y[least] as number)) least = i;
      if (largest < 0 || value > (y[largest] as number)) largest = i;
    }
    const kept = new Set([from, least, largest, gap, to - 1].filter((i) => i >= from && i < to));
    for (const i of [...kept].sort((a, b) => a - b)) points.push([x[i] ?? NaN, y[i] ?? null]);
  }
  return points;
};

// The trend in a cloud of points: the median and the quartiles of y in bins of x that hold equally many points. Where x
// has few values, as a speed has, each value is a bin.
export interface Quartiles {
  x: number; // median of the bin
  lower: number;
  median: number;
  upper: number;
  n: number;
}

export const kFewest_in_bin = 5;

const quantile = (sorted: readonly number[], share: number): number => {
  const at = share * (sorted.length - 1);
  const k = Math.floor(at);
  const low = sorted[k] ?? NaN;
  return low + (at - k) * ((sorted[k + 1] ?? low) - low);
};

type Pair = readonly [number, number];

const of_bin = (bin: readonly Pair[]): Quartiles => {
  const y = bin.map((pair) => pair[1]).sort((a, b) => a - b);
  const x = bin[bin.length >> 1]?.[0] ?? NaN;
  return { x, lower: quantile(y, 0.25), median: quantile(y, 0.5), upper: quantile(y, 0.75), n: bin.length };
};

const bins_of = (pairs: readonly Pair[], bins: number): Pair[][] => {
  const by_value = new Map<number, Pair[]>();
  for (const pair of pairs) {
    const bin = by_value.get(pair[0]);
    if (bin) bin.push(pair);
    else if (by_value.size <= bins) by_value.set(pair[0], [pair]);
    if (by_value.size > bins) break;
  }
  if (by_value.size <= bins && pairs.length >= 2 * kFewest_in_bin * by_value.size) return [...by_value.values()];
  const each = Math.max(kFewest_in_bin, pairs.length / bins);
  const count = Math.floor(pairs.length / each);
  return Array.from({ length: count }, (_, k) =>
    pairs.slice(Math.round((k * pairs.length) / count), Math.round(((k + 1) * pairs.length) / count)),
  );
};

export const running_quartiles = (x: readonly number[], y: readonly number[], bins: number): Quartiles[] => {
  const pairs = x.map((value, i): Pair => [value, y[i] ?? NaN]).sort((a, b) => a[0] - b[0]);
  return bins_of(pairs, bins)
    .filter((bin) => bin.length >= kFewest_in_bin)
    .map(of_bin);
};

// Rows of a cloud of points that are drawn: evenly chosen ones, and the extremes, so that no outlier is lost.

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
