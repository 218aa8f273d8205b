// The picture that every user of a ballbar knows: the deviation, magnified, on a circle.
import { within_turn } from "../drawing/angles";
import { centre_mark, extreme_marks } from "./circle_marks";
import { magnifications, radial_scale } from "./magnification";
import type { Picture, State, Toggle } from "../picture";
import { effects_of, fitted_at, kept_readings, measured, picked, recording_numbers } from "./recording_curves";
import { direction_colour, effect_colour } from "./recording_colours";
import { chosen_group, group_choice, type Group } from "./recording_groups";
import type { Num, Recording } from "../report";
import { round_option, type RoundCurve } from "./round";
import { plain } from "../drawing/text";
import { colours, curve_colour, dashes, legend } from "../drawing/theme";
import { t } from "../texts/texts";

const kStretches = 720; // of a turn, four points each

const trace_name = (recording: Recording): string => 
  t.measured_of({ which: recording.direction ?? t.recordings_circle });

const toggles_of = (recordings: readonly Recording[], centred: boolean): Toggle[] => [
  ...recordings.map((recording, k): Toggle => ({
    key: `trace${k}`,
    label: trace_name(recording),
    colour: direction_colour(recording),
    mark: recording.direction === "CW" ? "dashed" : "line",
    on: true,
  })),
  ...(centred
    ? []
    : [
        {
          key: "fitted",
          label: t.recordings_fitted_and_centre,
          colour: (dark: boolean) => curve_colour(2, dark),
          mark: "dashed",
          on: true,
        } as const,
      ]),
  {
    key: "extremes",
    label: t.recordings_extremes,
    colour: (dark) => (recordings.length > 1 ? colours(dark).ink : curve_colour(3, dark)),
    mark: "dot",
    on: true,
  },
  ...effects_of(recordings).map((effect, k): Toggle => ({
    key: `effect ${effect}`,
    label: plain(effect, 60),
    colour: (dark) => effect_colour(k, dark),
    mark: "dashed",
    on: false,
  })),
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
    const angles = recording.trace?.angle_deg ?? [];
    const drawn = (
      name: string,
      values: readonly Num[],
      style: Pick<RoundCurve, "colour" | "dash" | "width_px">,
    ): RoundCurve => {
      const kept = kept_readings(values, kStretches);
      return { name, angle_deg: picked(angles, kept), value_um: picked(values, kept), ...style };
    };
    const curves: RoundCurve[] = [];
    if (on("fitted") && !centred) {
      curves.push({
        name: t.recordings_fitted_and_centre,
        colour: curve_colour(2, dark),
        dash: "dashed",
        width_px: 1.5,
        beside: true,
        ...fitted_curve(recording),
      });
    }
    if (on(`trace${k}`)) {
      const style = {
        colour: direction_colour(recording)(dark),
        dash: recording.direction === "CW" ? [7, 2] : "solid",
        width_px: 1.6,
      } as const;
      curves.push(drawn(trace_name(recording), measured(recording, centred), style));
    }
    effects_of(recordings).forEach((effect, e) => {
      const values = recording.trace?.effects.find((one) => one.effect === effect)?.values_um;
      if (!values || !on(`effect ${effect}`)) return;
      const dash = dashes[(1 + e + 2 * k) % dashes.length] ?? "dotted";
      curves.push(drawn(plain(effect, 60), values, { colour: effect_colour(e, dark), dash, width_px: 2 }));
    });
    return curves;
  });
};

// Also of what is switched off, so that the scale stays when a curve goes.
const extent_of = (recordings: readonly Recording[], centred: boolean): [number, number] => {
  let least = 0;
  let largest = 0;
  for (const recording of recordings) {
    for (const value of [...measured(recording, centred), ...(centred ? [] : fitted_curve(recording).value_um)]) {
      if (value === null) continue;
      least = Math.min(least, value);
      largest = Math.max(largest, value);
    }
  }
  return [least, largest];
};

export const circle_picture = (groups: readonly Group[]): Picture => {
  const chosen_of = (chosen: State["chosen"]): readonly Recording[] => chosen_group(groups, chosen["recording"]);
  return {
    name: "recording-circle",
    title: t.recordings_circle_title,
    caption: t.recordings_circle_caption,
    about: t.recordings_circle_about,
    height_px: 560,
    zoom: "none",
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
      {
        key: "magnification",
        label: t.recordings_magnification,
        values: [
          { value: "", label: t.recordings_automatic },
          ...magnifications.map((m) => ({ value: String(m), label: t.recordings_times({ times: m }) })),
        ],
        initial: "",
      },
    ],
    toggles: ({ chosen }) => toggles_of(chosen_of(chosen), chosen["from"] === "fitted"),
    draw: (state) => {
      const recordings = chosen_of(state.chosen);
      const centred = state.chosen["from"] === "fitted";
      const curves = curves_of(recordings, state, centred);
      const nominal_um = (recordings[0]?.nominal_length_mm ?? 100) * 1000;
      const [least_um, largest_um] = extent_of(recordings, centred);
      const scale = radial_scale(least_um, largest_um, nominal_um, Number(state.chosen["magnification"]) || null);
      const { dark } = state.look;
      const alone = recordings.length === 1;
      const marks = recordings.flatMap((recording, k) => [
        ...(state.hidden.has("fitted") || centred || state.hidden.has(`trace${k}`)
          ? []
          : centre_mark(recording, scale, curve_colour(2, dark), state.look)),
        ...(state.hidden.has("extremes") || state.hidden.has(`trace${k}`)
          ? []
          : extreme_marks(
              recording,
              centred,
              alone ? curve_colour(3, dark) : direction_colour(recording)(dark),
              alone,
              state.look,
            )),
      ]);
      return {
        ...round_option(state.look, scale, recordings[0]?.plane, curves, marks),
        legend: legend(state, toggles_of(recordings, centred)),
      };
    },
    numbers: ({ chosen }) => recording_numbers(chosen_of(chosen)),
  };
};
