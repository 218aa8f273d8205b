// The picture that every user of a ballbar knows: the deviation, magnified, on a circle.
import { nearest_reading, within_turn } from "./angles";
import { curve } from "./curve";
import { magnifications, radial_scale, type RadialScale } from "./magnification";
import type { Look, Picture, State, Toggle } from "./picture";
import { effects_of, fitted_at, kept_readings, picked, recording_numbers } from "./recording_curves";
import type { Group } from "./recording_groups";
import type { Num, Recording } from "./report";
import { round_option, type RoundCurve } from "./round";
import { plain } from "./text";
import { colours, curve_colour, dashes, legend, shown } from "./theme";

const kStretches = 720; // of a turn, four points each

export const direction_colour = (recording: Recording) => (dark: boolean): string =>
  curve_colour(recording.direction === "CW" ? 1 : 0, dark);

const trace_name = (recording: Recording): string => `measured, ${recording.direction ?? "circle"}`;

// What is drawn of the measured: the deviation from the nominal circle, or the residual from the fitted one.
const measured = (recording: Recording, centred: boolean): readonly Num[] =>
  (centred ? recording.trace?.residual_um : recording.trace?.deviation_um) ?? [];

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
    : [{ key: "fitted", label: "fitted circle and its centre", colour: (dark: boolean) => curve_colour(2, dark), mark: "dashed", on: true } as const]),
  { key: "extremes", label: "largest and least radius", colour: (dark) => curve_colour(3, dark), mark: "dot", on: true },
  ...effects_of(recordings).map((effect, k): Toggle => ({
    key: `effect ${effect}`,
    label: plain(effect, 60),
    colour: (dark) => curve_colour(4 + k, dark),
    mark: "dashed",
    on: false,
  })),
];

// Over the readings as `fitted_um` has it, and on around the rest of the turn.
const fitted_curve = (recording: Recording): { angle_deg: number[]; value_um: Num[] } => {
  const angles = recording.trace?.angle_deg ?? [];
  const fitted = recording.trace?.fitted_um ?? [];
  const read = new Array<boolean>(180).fill(false);
  const points = kept_readings(fitted, kStretches / 4).map((i): [number, Num] => [within_turn(angles[i] ?? 0), fitted[i] ?? null]);
  for (const angle of angles) read[Math.floor(within_turn(angle) / 2) % 180] = true;
  read.forEach((has, k) => {
    if (!has) points.push([2 * k + 1, fitted_at(recording, 2 * k + 1)]);
  });
  points.sort((a, b) => a[0] - b[0]);
  if (points[0]) points.push(points[0]);
  return { angle_deg: points.map(([angle]) => angle), value_um: points.map(([, value]) => value) };
};

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
  const text = `centre ${shown(a, 1)}, ${shown(b, 1)} µm`;
  return [
    curve("fitted circle and its centre", colour, "solid", 1.2, [[scale.middle_um, 0], end], {
      coordinateSystem: "polar",
      silent: true,
      tooltip: { show: false },
      z: 5,
    }),
    mark("fitted circle and its centre", colour, {
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

const extreme_marks = (recording: Recording, centred: boolean, colour: string, alone: boolean, look: Look): Record<string, unknown>[] => {
  const angles = recording.trace?.angle_deg ?? [];
  const one = (at_deg: Num | undefined, value_um: Num | undefined, least: boolean): Record<string, unknown>[] => {
    if (typeof at_deg !== "number" || typeof value_um !== "number") return [];
    const i = nearest_reading(angles, at_deg);
    const radial = measured(recording, centred)[i];
    if (radial === undefined || radial === null) return [];
    const text = `${least ? "least" : "largest"} ${value_um > 0 ? "+" : ""}${shown(value_um, 2)}`;
    return [
      mark("largest and least radius", colour, {
        symbol: "triangle",
        symbolRotate: least ? 180 : 0,
        symbolSize: 10,
        data: [
          {
            value: [radial, within_turn(angles[i] ?? 0)],
            label: named(alone ? text : `${text}, ${recording.direction}`, colour, look, side_of(at_deg, least)),
          },
        ],
      }),
    ];
  };
  return [...one(recording.max_at_deg, recording.max_circular_um, false), ...one(recording.min_at_deg, recording.min_circular_um, true)];
};

const curves_of = (recordings: readonly Recording[], state: State, centred: boolean): RoundCurve[] => {
  const on = (key: string): boolean => !state.hidden.has(key);
  const { dark } = state.look;
  return recordings.flatMap((recording, k) => {
    const angles = recording.trace?.angle_deg ?? [];
    const drawn = (name: string, values: readonly Num[], style: Pick<RoundCurve, "colour" | "dash" | "width_px">): RoundCurve => {
      const kept = kept_readings(values, kStretches);
      return { name, angle_deg: picked(angles, kept), value_um: picked(values, kept), ...style };
    };
    const curves: RoundCurve[] = [];
    if (on("fitted") && !centred) {
      curves.push({ name: "fitted circle and its centre", colour: curve_colour(2, dark), dash: "dashed", width_px: 1.5, silent: true, ...fitted_curve(recording) });
    }
    if (on(`trace${k}`)) {
      const style = { colour: direction_colour(recording)(dark), dash: recording.direction === "CW" ? [7, 2] : "solid", width_px: 1.6 } as const;
      curves.push(drawn(trace_name(recording), measured(recording, centred), style));
    }
    effects_of(recordings).forEach((effect, e) => {
      const values = recording.trace?.effects.find((one) => one.effect === effect)?.values_um;
      if (!values || !on(`effect ${effect}`)) return;
      const dash = dashes[(1 + e + 2 * k) % dashes.length] ?? "dotted";
      curves.push(drawn(plain(effect, 60), values, { colour: curve_colour(4 + e, dark), dash, width_px: 2 }));
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
  const chosen_of = (chosen: State["chosen"]): readonly Recording[] =>
    (groups.find((group) => group.value === chosen["recording"]) ?? groups[0])?.of ?? [];
  return {
    name: "recording-circle",
    title: "Deviation on the circle",
    about:
      "Each reading of the bar less its nominal length, drawn outwards or inwards from the circle of the nominal length " +
      "(the dark ring) and magnified; the angle runs counter-clockwise from the plane's first axis. The fitted circle and " +
      "the way to its centre are drawn in the same magnification. About its own centre, the circle's shape alone is left. " +
      "What an effect of the model adds is drawn about the dark ring.",
    height_px: 560,
    zoom: "none",
    choices: [
      { key: "recording", label: "Recording", values: groups.map(({ value, label }) => ({ value, label })), initial: groups[0]?.value ?? "" },
      {
        key: "from",
        label: "Drawn from",
        values: [
          { value: "nominal", label: "the nominal circle, as measured" },
          { value: "fitted", label: "the fitted circle, about its own centre" },
        ],
        initial: "nominal",
      },
      {
        key: "magnification",
        label: "Magnification",
        values: [{ value: "", label: "automatic" }, ...magnifications.map((m) => ({ value: String(m), label: `${m} times` }))],
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
        ...(state.hidden.has("fitted") || centred || state.hidden.has(`trace${k}`) ? [] : centre_mark(recording, scale, curve_colour(2, dark), state.look)),
        ...(state.hidden.has("extremes") || state.hidden.has(`trace${k}`) ? [] : extreme_marks(recording, centred, alone ? curve_colour(3, dark) : direction_colour(recording)(dark), alone, state.look)),
      ]);
      return {
        ...round_option(state.look, scale, recordings[0]?.plane, curves, marks),
        legend: legend(state, toggles_of(recordings, centred)),
      };
    },
    numbers: ({ chosen }) => recording_numbers(chosen_of(chosen)),
  };
};
