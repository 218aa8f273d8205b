// The columns of a recording's trace, as they are drawn and as they are saved.
import { unwrapped_together } from "../drawing/angles";
import { decimated } from "../drawing/decimate";
import type { Numbers } from "../picture";
import type { Num, Recording } from "../report";
import { plain } from "../drawing/text";

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
  const t = (angle_deg * Math.PI) / 180;
  return a * Math.cos(t) + b * Math.sin(t) + (radius_mm - recording.nominal_length_mm) * 1000;
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
