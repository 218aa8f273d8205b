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
