// The part of the x axis that is seen. Pure arithmetic; `all` is the whole axis.
import type { Range } from "../picture";

// Within the whole axis; all of it is no window at all, so that a picture drawn without one looks the same.
export const within = (window: Range, all: Range): Range | null => {
  const width = Math.max(window[1] - window[0], (all[1] - all[0]) * 1e-6);
  if (!(width < (all[1] - all[0]) * 0.999)) return null;
  const from = Math.min(Math.max(window[0], all[0]), all[1] - width);
  return [from, from + width];
};

// Closer by the factor, or farther where it is below one; the point `at` stays where it is.
export const zoomed = (window: Range | null, all: Range, at: number, factor: number): Range | null => {
  const [from, to] = window ?? all;
  return within([at - (at - from) / factor, at + (to - at) / factor], all);
};

export const panned = (window: Range | null, all: Range, by: number): Range | null =>
  window && within([window[0] + by, window[1] + by], all);

export const ordered = (a: number, b: number): Range => (a <= b ? [a, b] : [b, a]);
