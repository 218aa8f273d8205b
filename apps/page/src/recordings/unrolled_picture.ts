// A recording against the angle: its deviation with the fitted circle, and below what the circle leaves.
import { unwrapped_together } from "../drawing/angles";
import { extent } from "../drawing/columns";
import { curve, type Dash, type Point, zero_line } from "../drawing/curve";
import { curves_base } from "../drawing/hover";
import type { Picture, State, Toggle } from "../picture";
import {
  dash_of, direction_colour, effect_colour, effect_toggles, effects_of, kept_readings, picked, recording_numbers,
  trace_name, trace_toggles,
} from "./recording_curves";
import { chosen_group, type Group, group_choice } from "./recording_groups";
import type { Num, Recording } from "../report";
import { plain } from "../drawing/text";
import { colours, curve_colour, dashes, shown, toggle } from "../drawing/theme";
import { two_grids, x_axis } from "../drawing/axes";
import { t } from "../texts/texts";

const toggles_of = (recordings: readonly Recording[]): Toggle[] => [
  ...trace_toggles(recordings),
  toggle("fitted", t.recordings_fitted_circle, 2, "dashed"),
  ...effect_toggles(recordings),
];

// Degrees: a turn in steps that people count in, an arc as it comes.
export const angle_limits = (angles: readonly number[]): Record<string, unknown> => {
  const [least, largest] = extent([angles]);
  if (!(largest - least > 180)) return {};
  return { min: Math.floor(least / 30 + 0.01) * 30, max: Math.ceil(largest / 30 - 0.01) * 30, interval: 30 };
};

const points_of = (angles: readonly number[], values: readonly Num[], stretches: number): Point[] => {
  const kept = kept_readings(values, stretches);
  const y = picked(values, kept);
  return picked(angles, kept).map((angle, i) => [angle, y[i] ?? null]);
};

export const unrolled_picture = (groups: readonly Group[]): Picture => {
  const chosen_of = (chosen: State["chosen"]): readonly Recording[] => chosen_group(groups, chosen["recording"]);
  return {
    name: "recording-unrolled",
    title: t.recordings_unrolled_title,
    caption: t.recordings_unrolled_caption,
    about: t.recordings_unrolled_about,
    height_px: 460,
    zoom: "own",
    choices: [group_choice(groups, "recording", t.recording)],
    toggles: ({ chosen }) => toggles_of(chosen_of(chosen)),
    draw: (state) => {
      const { look, window } = state;
      const recordings = chosen_of(state.chosen);
      const on = (key: string): boolean => !state.hidden.has(key);
      const angles = unwrapped_together(recordings.map((recording) => recording.trace?.angle_deg ?? []));
      const x = x_axis(look, t.angle_axis, window, angle_limits(angles.flat()));
      const grids = two_grids(look, x, t.deviation_axis, t.residual_axis, 0.4);
      const share = window ? Math.max(0.05, (window[1] - window[0]) / 360) : 1;
      const stretches = grids.width_px / share;
      const below = { xAxisIndex: 1, yAxisIndex: 1 };
      const c = colours(look.dark);
      const series = recordings.flatMap((recording, k) => {
        const { trace } = recording;
        const at = angles[k] ?? [];
        if (!trace) return [];
        const line = (
          name: string,
          values: readonly Num[],
          colour: string,
          dash: Dash,
          width: number,
          more: Record<string, unknown> = {},
        ): Record<string, unknown> => curve(name, colour, dash, width, points_of(at, values, stretches), more);
        const colour = direction_colour(recording)(look.dark);
        return [
          ...(on(`trace${k}`)
            ? [
                line(trace_name(recording), trace.deviation_um, colour, dash_of(recording), 1.4),
                line(trace_name(recording), trace.residual_um, colour, dash_of(recording), 1.2, {
                  ...below,
                  hover_name: t.residual_of({ which: recording.direction ?? t.recordings_circle }),
                }),
              ]
            : []),
          ...(on("fitted")
            ? [
                line(
                  t.recordings_fitted_circle,
                  trace.fitted_um,
                  curve_colour(2, look.dark),
                  recordings.length > 1 && k > 0 ? "dotted" : "dashed",
                  1.6,
                  recordings.length > 1 ? { hover_name: t.recordings_fitted_circle_of({ which: recording.direction ?? "" }) } : {},
                ),
              ]
            : []),
          ...effects_of(recordings).flatMap((effect, e) => {
            const values = trace.effects.find((one) => one.effect === effect)?.values_um;
            if (!values || !on(`effect ${effect}`)) return [];
            return [
              line(
                plain(effect, 60),
                values,
                effect_colour(e, look.dark),
                dashes[(1 + e + 2 * k) % dashes.length] ?? "dotted",
                1.8,
                below,
              ),
            ];
          }),
        ];
      });
      const zero = curve("", c.faint, "solid", 0, [], { ...below, silent: true, markLine: zero_line(look) });
      return {
        ...curves_base(state, toggles_of(recordings), { drawn: series, head: (angle) => `${shown(angle, 2)}°`, unit: "µm" }),
        ...grids.drawn,
        series: [...series, zero],
      };
    },
    numbers: ({ chosen }) => recording_numbers(chosen_of(chosen)),
  };
};
