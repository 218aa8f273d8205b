// Marks on a magnified circle: the way to the fitted centre, the largest and the least radius.
import { nearest_reading, within_turn } from "../drawing/angles";
import { curve } from "../drawing/curve";
import type { RadialScale } from "./magnification";
import type { Look } from "../picture";
import { measured } from "./recording_curves";
import type { Num, Recording } from "../report";
import { colours, kNarrow_px, shown } from "../drawing/theme";
import { t } from "../texts/texts";

const mark = (name: string, colour: string, more: Record<string, unknown>): Record<string, unknown> => ({
  type: "scatter",
  name,
  coordinateSystem: "polar",
  itemStyle: { color: colour, opacity: 1 },
  silent: true,
  tooltip: { show: false },
  z: 5,
  ...more,
});

const named = (text: string, colour: string, look: Look, position: string): Record<string, unknown> => ({
  show: true,
  position,
  formatter: text,
  color: colour,
  fontSize: 11,
  backgroundColor: colours(look.dark).paper,
  padding: [1, 3],
});

// The way from the middle of the nominal circle to the fitted centre, in the magnification of the deviations.
export const centre_mark = (
  recording: Recording,
  scale: RadialScale,
  colour: string,
  look: Look,
): Record<string, unknown>[] => {
  const { centre_a_um: a, centre_b_um: b } = recording;
  if (typeof a !== "number" || typeof b !== "number") return [];
  const end = [scale.middle_um + Math.hypot(a, b), within_turn((Math.atan2(b, a) * 180) / Math.PI)];
  if ((end[0] ?? 0) > scale.outside_um) return [];
  const text = t.recordings_centre({ a: shown(a, 1), b: shown(b, 1) });
  return [
    curve(t.recordings_fitted_and_centre, colour, "solid", 1.2, [[scale.middle_um, 0], end], {
      coordinateSystem: "polar",
      silent: true,
      tooltip: { show: false },
      z: 5,
    }),
    mark(t.recordings_fitted_and_centre, colour, {
      symbol: "diamond",
      symbolSize: 9,
      data: [{ value: end, label: named(text, colour, look, b > 0 ? "top" : "bottom") }],
    }),
  ];
};

// Beside a mark at this angle, outside the circle or inside.
const side_of = (at_deg: number, inside: boolean): string => {
  const across = Math.cos((at_deg * Math.PI) / 180) * (inside ? -1 : 1);
  const up = Math.sin((at_deg * Math.PI) / 180) * (inside ? -1 : 1);
  return Math.abs(across) > 0.4 ? (across > 0 ? "right" : "left") : up > 0 ? "top" : "bottom";
};

export const extreme_marks = (
  recording: Recording,
  centred: boolean,
  colour: string,
  alone: boolean,
  look: Look,
): Record<string, unknown>[] => {
  const angles = recording.trace?.angle_deg ?? [];
  const one = (at_deg: Num | undefined, value_um: Num | undefined, least: boolean): Record<string, unknown>[] => {
    if (typeof at_deg !== "number" || typeof value_um !== "number") return [];
    const i = nearest_reading(angles, at_deg);
    const radial = measured(recording, centred)[i];
    if (radial === undefined || radial === null) return [];
    const value = `${value_um > 0 ? "+" : ""}${shown(value_um, 2)}`;
    const text = least ? t.recordings_least({ value }) : t.recordings_largest({ value });
    const direction = recording.direction ?? "";
    return [
      mark(t.recordings_extremes, colour, {
        symbol: "triangle",
        symbolRotate: least ? 180 : 0,
        symbolSize: 10,
        data: [
          {
            value: [radial, within_turn(angles[i] ?? 0)],
            label: named(
              look.width_px < kNarrow_px ? value : alone ? text : t.recordings_of_direction({ text, direction }),
              colour,
              look,
              side_of(at_deg, least),
            ),
          },
        ],
      }),
    ];
  };
  return [
    ...one(recording.max_at_deg, recording.max_circular_um, false),
    ...one(recording.min_at_deg, recording.min_circular_um, true),
  ];
};
