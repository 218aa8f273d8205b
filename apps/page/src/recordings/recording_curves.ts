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

// One table for one or two recordings: a column of its own for each curve, so that the statistics of a stretch do not
// mix directions.
export const recording_numbers = (recordings: readonly Recording[]): Numbers => {
  const traces = recordings.map((recording) => recording.trace);
  const rows = traces.reduce((sum, trace) => sum + (trace?.deviation_um.length ?? 0), 0);
  const columns: { name: string; values: Num[] }[] = [
    { name: "angle_deg", values: unwrapped_together(traces.map((trace) => trace?.angle_deg ?? [])).flat() },
  ];
  let before = 0;
  traces.forEach((trace, k) => {
    if (!trace) return;
    const of = recordings.length > 1 ? `_${(recordings[k]?.direction ?? String(k + 1)).toLowerCase()}` : "";
    const start = before;
    const column = (name: string, values: readonly Num[]): void => {
      columns.push({ name, values: Array.from({ length: rows }, (_, i) => values[i - start] ?? null) });
    };
    column(`deviation${of}_um`, trace.deviation_um);
    column(`fitted${of}_um`, trace.fitted_um);
    column(`residual${of}_um`, trace.residual_um);
    for (const { effect, values_um } of trace.effects) column(`${plain(effect, 60)}${of}_um`, values_um);
    before += trace.deviation_um.length;
  });
  return { columns };
};
