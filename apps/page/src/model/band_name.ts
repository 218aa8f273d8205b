// Where a name fits into a band between two curves, so that names of bands that stand on each other cannot overlap.
export interface Place {
  x: number; // middle of the name
  y: number;
  height: number; // that is free there
}

const kTried = 40; // places along the band

// The place where a name `width` wide, in units of x, has the most height within the band. x rises.
export const place_for_name = (
  x: readonly number[],
  lower: readonly number[],
  upper: readonly number[],
  seen: readonly [number, number],
  width: number,
): Place | null => {
  let best: Place | null = null;
  const first = seen[0] + width / 2;
  const last = seen[1] - width / 2;
  let from = 0;
  for (let k = 0; k <= kTried && last > first; ++k) {
    const middle = first + (k * (last - first)) / kTried;
    while (from < x.length && (x[from] ?? 0) < middle - width / 2) ++from;
    let floor = -Infinity;
    let ceiling = Infinity;
    let points = 0;
    // One point beyond on either side, because the curve runs on to it.
    for (let i = Math.max(0, from - 1); i < x.length; ++i, ++points) {
      floor = Math.max(floor, lower[i] ?? 0);
      ceiling = Math.min(ceiling, upper[i] ?? 0);
      if ((x[i] ?? 0) > middle + width / 2) break;
    }
    const height = ceiling - floor;
    if (points > 0 && height > (best?.height ?? 0)) best = { x: middle, y: (floor + ceiling) / 2, height };
  }
  return best;
};
