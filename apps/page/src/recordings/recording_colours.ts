// Colours of recordings and of what a model adds to them.
import type { Recording } from "../report";
import { curve_colour } from "../drawing/theme";

export const direction_colour =
  (recording: Recording) =>
  (dark: boolean): string =>
    curve_colour(recording.direction === "CW" ? 1 : 0, dark);

// Of the k-th effect; away from those of the directions.
export const effect_colour = (k: number, dark: boolean): string => curve_colour([4, 6, 7, 3, 5][k % 5] ?? 4, dark);
