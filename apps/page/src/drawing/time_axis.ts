// The axis of time that all pictures of a section have in common, so that they stand below one another.
import type { Look, Range } from "../picture";
import { axis } from "./theme";
import { t } from "../texts/texts";

// From the first to the last time of all clocks, with a little room for the marks at the ends.
export const whole_min = (clocks_min: readonly (readonly number[])[]): Range => {
  const ends = clocks_min.flatMap((clock) =>
    clock.length > 0 ? [clock[0] as number, clock[clock.length - 1] as number] : [],
  );
  const [from, to] = ends.length > 0 ? [Math.min(...ends), Math.max(...ends)] : [0, 1];
  const room = to > from ? (to - from) * 0.015 : 1;
  return [from - room, to + room];
};

export const time_axis = (look: Look, shown_min: Range): Record<string, unknown> => {
  const common = axis(look, t.time_axis, "x");
  return {
    ...common,
    min: shown_min[0],
    max: shown_min[1],
    splitLine: { show: false },
    // The ends of a window are no round numbers.
    axisLabel: { ...(common["axisLabel"] as Record<string, unknown>), showMinLabel: false, showMaxLabel: false },
  };
};

// The other axis, whose labels are as wide as the room beside the plot.
export const value_axis = (look: Look, name: string): Record<string, unknown> => ({
  ...axis(look, name, "y"),
  nameMoveOverlap: false,
});
