// The picture that every user of a ballbar knows: the deviation, magnified, on a circle.
import { nearest_reading, within_turn } from "../drawing/angles";
import { extent } from "../drawing/columns";
import { type RadialScale, round_curve, type RoundCurve, round_picture } from "./round";
import type { Look, Picture, State, Toggle } from "../picture";
import {
  dash_of, direction_colour, effect_colour, effect_toggles, effects_of, fitted_at, kept_readings, measured,
  recording_numbers, trace_name, trace_toggles,
} from "./recording_curves";
import { chosen_group, type Group, group_choice } from "./recording_groups";
import type { Num, Recording } from "../report";
import { plain } from "../drawing/text";
import { colours, curve_colour, dashes, kNarrow_px, shown, toggle } from "../drawing/theme";
import { t } from "../texts/texts";
import { curve } from "../drawing/curve";

const kStretches = 720; // of a turn, of the fitted circle four times fewer

const toggles_of = (recordings: readonly Recording[], centred: boolean): Toggle[] => [
  ...trace_toggles(recordings),
  ...(centred ? [] : [toggle("fitted", t.recordings_fitted_and_centre, 2, "dashed")]),
  toggle(
    "extremes",
    t.recordings_extremes,
    (dark) => (recordings.length > 1 ? colours(dark).ink : curve_colour(3, dark)),
    "dot",
  ),
  ...effect_toggles(recordings),
];

// Over the readings as `fitted_um` has it, and on around the rest of the turn.
const fitted_curve = (recording: Recording): { angle_deg: number[]; value_um: Num[] } => {
  const angles = recording.trace?.angle_deg ?? [];
  const fitted = recording.trace?.fitted_um ?? [];
  const read = new Array<boolean>(180).fill(false);
  const points = kept_readings(fitted, kStretches / 4).map((i): [number, Num] => [
    within_turn(angles[i] ?? 0),
    fitted[i] ?? null,
  ]);
  for (const angle of angles) read[Math.floor(within_turn(angle) / 2) % 180] = true;
  read.forEach((has, k) => {
    if (!has) points.push([2 * k + 1, fitted_at(recording, 2 * k + 1)]);
  });
  points.sort((a, b) => a[0] - b[0]);
  if (points[0]) points.push(points[0]);
  return { angle_deg: points.map(([angle]) => angle), value_um: points.map(([, value]) => value) };
};

const curves_of = (recordings: readonly Recording[], state: State, centred: boolean): RoundCurve[] => {
  const on = (key: string): boolean => !state.hidden.has(key);
  const { dark } = state.look;
  return recordings.flatMap((recording, k) => {
    const curves: RoundCurve[] = [];
    if (on("fitted") && !centred) {
      curves.push({
        name: t.recordings_fitted_and_centre,
        colour: curve_colour(2, dark),
        dash: "dashed",
        width_px: 1.5,
        no_readings: true,
        ...fitted_curve(recording),
      });
    }
    if (on(`trace${k}`)) {
      const style = { name: trace_name(recording), colour: direction_colour(recording)(dark), dash: dash_of(recording), width_px: 1.6 };
      curves.push(round_curve(recording, measured(recording, centred), style));
    }
    effects_of(recordings).forEach((effect, e) => {
      const values = recording.trace?.effects.find((one) => one.effect === effect)?.values_um;
      if (!values || !on(`effect ${effect}`)) return;
      const dash = dashes[(1 + e + 2 * k) % dashes.length] ?? "dotted";
      const style = { name: plain(effect, 60), colour: effect_colour(e, dark), dash, width_px: 2 };
      curves.push(round_curve(recording, values, style));
    });
    return curves;
  });
};

const extent_of = (recordings: readonly Recording[], centred: boolean): [number, number] =>
  extent(
    recordings.flatMap((one) => [measured(one, centred), ...(centred ? [] : [fitted_curve(one).value_um])]),
    [0, 0],
  );

export const circle_picture = (groups: readonly Group[]): Picture => {
  const chosen_of = (chosen: State["chosen"]): readonly Recording[] => chosen_group(groups, chosen["recording"]);
  return round_picture({
    name: "recording-circle",
    title: t.recordings_circle_title,
    caption: t.recordings_circle_caption,
    about: t.recordings_circle_about,
    height_px: 560,
    choices: [
      group_choice(groups, "recording", t.recording),
      {
        key: "from",
        label: t.recordings_drawn_from,
        values: [
          { value: "nominal", label: t.recordings_from_nominal },
          { value: "fitted", label: t.recordings_from_fitted },
        ],
        initial: "nominal",
      },
    ],
    scaled: (chosen) => ({ first: chosen_of(chosen)[0], extent_um: extent_of(chosen_of(chosen), chosen["from"] === "fitted") }),
    toggles: (chosen) => toggles_of(chosen_of(chosen), chosen["from"] === "fitted"),
    round: (state) => {
      const recordings = chosen_of(state.chosen);
      const centred = state.chosen["from"] === "fitted";
      const { dark } = state.look;
      const alone = recordings.length === 1;
      const marks = (scale: RadialScale): Record<string, unknown>[] =>
        recordings.flatMap((recording, k) => [
          ...(state.hidden.has("fitted") || centred || state.hidden.has(`trace${k}`)
            ? []
            : centre_mark(recording, scale, curve_colour(2, dark), state.look)),
          ...(state.hidden.has("extremes") || state.hidden.has(`trace${k}`)
            ? []
            : extreme_marks(recording, centred, alone ? curve_colour(3, dark) : direction_colour(recording)(dark), alone, state.look)),
        ]);
      return { curves: curves_of(recordings, state, centred), marks };
    },
    numbers: ({ chosen }) => recording_numbers(chosen_of(chosen)),
  });
};

// Marks on a magnified circle: the way to the fitted centre, the largest and the least radius.

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
const centre_mark = (recording: Recording, scale: RadialScale, colour: string, look: Look): Record<string, unknown>[] => {
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

const extreme_marks = (
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
