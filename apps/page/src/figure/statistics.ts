// What the numbers of a picture are within a stretch of its x axis.
import type { Numbers } from "../picture";

export interface Statistics {
  name: string;
  n: number;
  mean: number;
  deviation: number | null; // standard deviation, of n - 1
  least: number;
  largest: number;
  change: number; // last less first
}

// One entry a column of numbers with a value in the stretch. The first column is x; of standard deviations there is
// nothing to say.
export const statistics_within = (numbers: Numbers, stretch: readonly [number, number]): Statistics[] => {
  const x = numbers.columns[0]?.values ?? [];
  const inside: number[] = [];
  x.forEach((value, row) => {
    if (typeof value === "number" && value >= stretch[0] && value <= stretch[1]) inside.push(row);
  });
  return numbers.columns.slice(1).flatMap(({ name, values }) => {
    if (/(^|_)sigma(_|$)/.test(name)) return [];
    let n = 0;
    let mean = 0;
    let squares = 0; // of the differences from the mean, by Welford's recurrence
    let least = Infinity;
    let largest = -Infinity;
    let first: number | null = null;
    let last = 0;
    for (const row of inside) {
      const value = values[row];
      if (typeof value !== "number") continue;
      n += 1;
      const beside = value - mean;
      mean += beside / n;
      squares += beside * (value - mean);
      least = Math.min(least, value);
      largest = Math.max(largest, value);
      first ??= value;
      last = value;
    }
    if (n === 0 || first === null) return [];
    return [
      { name, n, mean, deviation: n > 1 ? Math.sqrt(squares / (n - 1)) : null, least, largest, change: last - first },
    ];
  });
};
