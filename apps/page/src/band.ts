// The band between two curves in as many stretches as a picture has pixels: of each stretch the least of the lower and
// the largest of the upper curve, so that the band never looks narrower than it is.
import { first_at } from "./decimate";
import type { Num } from "./report";

export interface Band {
  low: [number, Num][];
  above: [number, Num][]; // upper less lower, to be stacked on it
}

export const band_between = (
  x: readonly number[],
  low: readonly Num[],
  high: readonly Num[],
  window: readonly [number, number] | null,
  width_px: number,
): Band => {
  const begin = window ? Math.max(0, first_at(x, window[0]) - 1) : 0;
  const end = window ? Math.min(x.length, first_at(x, window[1]) + 2) : x.length;
  const step = Math.max(1, (end - begin) / Math.max(1, 2 * Math.floor(width_px)));
  const band: Band = { low: [], above: [] };
  for (let at = begin; at < end; at += step) {
    const from = Math.floor(at);
    const to = Math.min(end, Math.max(from + 1, Math.floor(at + step)));
    let least: Num = null;
    let largest: Num = null;
    for (let i = from; i < to; ++i) {
      const [one, other] = [low[i] ?? null, high[i] ?? null];
      if (one === null || other === null) continue;
      least = least === null ? one : Math.min(least, one);
      largest = largest === null ? other : Math.max(largest, other);
    }
    const place = x[from] ?? NaN;
    band.low.push([place, least]);
    band.above.push([place, least === null || largest === null ? null : largest - least]);
  }
  return band;
};
