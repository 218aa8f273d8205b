// The columns of a recording's trace, as they are drawn and as they are saved.
import { unwrapped_together } from "../drawing/angles";
import { decimated } from "../drawing/columns";
import type { Dash } from "../drawing/curve";
import type { Numbers, Toggle } from "../picture";
import type { Num, Recording } from "../report";
import { plain } from "../drawing/text";
import { curve_colour, toggle } from "../drawing/theme";
import { t } from "../texts/texts";

// Readings that a curve of this column needs, in their order: all, or of many the first, last and extremes of each
// stretch. Over the place in the order, because angles do not always rise.
export const kept_readings = (values: readonly Num[], stretches: number): number[] =>
  decimated(
    values.map((_, i) => i),
    values,
    null,
    stretches,
  ).map(([i]) => i);

export const picked = <T>(values: readonly T[], at: readonly number[]): T[] => at.map((i) => values[i] as T);

// What is drawn of the measured: the deviation from the nominal circle, or the residual from the fitted one.
export const measured = (recording: Recording, centred: boolean): readonly Num[] =>
  (centred ? recording.trace?.residual_um : recording.trace?.deviation_um) ?? [];

// Names of the effects that any of these has, in their order.
export const effects_of = (recordings: readonly Recording[]): string[] => [
  ...new Set(recordings.flatMap((recording) => recording.trace?.effects.map(({ effect }) => effect) ?? [])),
];

// Where the fitted circle would be drawn at any angle, first order in the centre: a cos t + b sin t + R - nominal.
export const fitted_at = (recording: Recording, angle_deg: number): Num => {
  const { centre_a_um: a, centre_b_um: b, radius_mm } = recording;
  if (typeof a !== "number" || typeof b !== "number" || typeof radius_mm !== "number") return null;
  const angle = (angle_deg * Math.PI) / 180;
  return a * Math.cos(angle) + b * Math.sin(angle) + (radius_mm - recording.nominal_length_mm) * 1000;
};

// One table for several recordings, one below the other: a column of its own for each curve of each, so that the
// statistics of a stretch do not mix directions. `of`: the end of a column's name, such as "_ccw".
export const stacked_numbers = (
  recordings: readonly Recording[],
  columns_of: (recording: Recording, of: string, k: number) => { name: string; values: readonly Num[] }[],
): Numbers => {
  const sizes = recordings.map(({ trace }) => trace?.deviation_um.length ?? 0);
  const rows = sizes.reduce((sum, size) => sum + size, 0);
  const columns: { name: string; values: Num[] }[] = [
    { name: "angle_deg", values: unwrapped_together(recordings.map(({ trace }) => trace?.angle_deg ?? [])).flat() },
  ];
  const each_once = new Set(recordings.map(({ direction }) => direction)).size === recordings.length;
  let before = 0;
  recordings.forEach((recording, k) => {
    const end = each_once ? (recording.direction ?? String(k + 1)).toLowerCase() : String(k + 1);
    const start = before;
    for (const { name, values } of columns_of(recording, recordings.length > 1 ? `_${end}` : "", k)) {
      columns.push({ name, values: Array.from({ length: rows }, (_, i) => values[i - start] ?? null) });
    }
    before += sizes[k] ?? 0;
  });
  return { columns };
};

export const recording_numbers = (recordings: readonly Recording[]): Numbers =>
  stacked_numbers(recordings, ({ trace }, of) =>
    trace
      ? [
          { name: `deviation${of}_um`, values: trace.deviation_um },
          { name: `fitted${of}_um`, values: trace.fitted_um },
          { name: `residual${of}_um`, values: trace.residual_um },
          ...trace.effects.map(({ effect, values_um }) => ({ name: `${plain(effect, 60)}${of}_um`, values: values_um })),
        ]
      : [],
  );

export const trace_name = ({ direction }: Recording): string => t.measured_of({ which: direction ?? t.recordings_circle });

export const dash_of = ({ direction }: Pick<Recording, "direction">): Dash => (direction === "CW" ? [7, 2] : "solid");

export const trace_toggles = (recordings: readonly Recording[]): Toggle[] =>
  recordings.map((one, k) =>
    toggle(`trace${k}`, trace_name(one), direction_colour(one), one.direction === "CW" ? "dashed" : "line"),
  );

export const effect_toggles = (recordings: readonly Recording[]): Toggle[] =>
  effects_of(recordings).map((effect, k) =>
    toggle(`effect ${effect}`, plain(effect, 60), (dark) => effect_colour(k, dark), "dashed", false),
  );

// Colours of recordings and of what a model adds to them.

export const direction_colour =
  (recording: Recording) =>
  (dark: boolean): string =>
    curve_colour(recording.direction === "CW" ? 1 : 0, dark);

// Of the k-th effect; away from those of the directions.
export const effect_colour = (k: number, dark: boolean): string => curve_colour([4, 6, 7, 3, 5][k % 5] ?? 4, dark);
