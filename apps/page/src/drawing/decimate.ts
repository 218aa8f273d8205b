// As many points as a picture has pixels: of each stretch of neighbours the first, the least, the largest and the last,
// in their order. Drawn at that width, the curve looks as if all were there; extremes are never lost.
import type { Num } from "../report";

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
