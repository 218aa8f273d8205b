// The drift of the spindle over time, and what was recorded beside it.
import { axes_of_points, axes_of_probes, axis_curve, type DriftAxis } from "./drift_axes";
import { largest_table, points_table } from "./drift_tables";
import type { Picture, Range, Section, TextTable } from "../picture";
import type { DriftPart, ProbesPart, Report } from "../report";
import { measured_pictures, signal_pictures, signals_of } from "./signals";
import { capital } from "../drawing/text";
import { minutes, shown } from "../drawing/theme";
import { time_curves } from "./time_curves";
import { whole_min } from "../drawing/time_axis";
import { words } from "../drawing/units";

const span_min = (axes: readonly DriftAxis[]): number => {
  const clock = axes[0]?.time_min ?? [];
  return clock.length > 0 ? (clock[clock.length - 1] as number) - (clock[0] as number) : 0;
};

const drift_sentences = (drift: DriftPart, axes: readonly DriftAxis[]): string[] => [
  `Method: ${words(drift.method)}. ${drift.points.length} tests over ${shown(span_min(axes))} min; ` +
    `drift is the change since the test at ${shown(minutes(drift.reference_s))} min. ` +
    "Bars and ± are one standard deviation.",
  ...(drift.not_cancelled ? [drift.not_cancelled] : []),
];

const probes_sentences = (probes: ProbesPart, axes: readonly DriftAxis[]): string[] => [
  `${capital(probes.what)}: ${probes.time_s.length} readings over ${shown(span_min(axes))} min, ` +
    `as changes since ${shown(minutes(probes.reference_s))} min. ` +
    "The shaded width is one standard deviation to either side.",
  ...probes.remarks,
];

const drift_picture = (axes: readonly DriftAxis[], whole: Range): Picture =>
  time_curves({
    name: "drift",
    title: "Drift of the spindle",
    about: "The position of the spindle relative to the table, test by test, less that of the reference test.",
    quantity: "drift",
    unit: "um",
    curves: axes.map(axis_curve),
    whole_min: whole,
    height_px: 380,
  });

const probe_pictures = (axes: readonly DriftAxis[], whole: Range): Picture[] => {
  const picture = (name: string, title: string, quantity: string, unit: string): Picture[] => {
    const curves = axes.filter((axis) => axis.unit === unit).map(axis_curve);
    const about = "From the five probes on the bar, less the readings at the reference time.";
    return curves.length > 0
      ? [time_curves({ name, title, about, quantity, unit, curves, whole_min: whole, height_px: 320 })]
      : [];
  };
  return [
    ...picture("five-probe", "Drift by five probes", "drift", "um"),
    ...picture("five-probe-tilt", "Tilt by five probes", "tilt", "urad"),
  ];
};

export const drift_section = (report: Report): Section[] => {
  const { drift, five_probe } = report;
  const signals = signals_of(report);
  const points = drift ? axes_of_points(drift) : [];
  const probes = five_probe ? axes_of_probes(five_probe) : [];
  if (points.length + probes.length + signals.length === 0) return [];

  const clocks = new Set([...points, ...probes, ...signals].map(({ time_min }) => time_min));
  const whole = whole_min([...clocks]);
  const tables: TextTable[] = [
    ...(points.length > 0 ? [largest_table("Largest drift", points), points_table(points)] : []),
    ...(probes.length > 0 ? [largest_table("Largest drift by five probes", probes)] : []),
  ];
  return [
    {
      id: "drift",
      heading:
        drift || five_probe
          ? "Drift"
          : signals.some(({ column }) => column.role === "measured")
            ? "Measured"
            : "Signals",
      sentences: [
        ...(drift ? drift_sentences(drift, points) : []),
        ...(five_probe ? probes_sentences(five_probe, probes) : []),
      ],
      tables,
      pictures: [
        ...(points.length > 0 ? [drift_picture(points, whole)] : []),
        ...probe_pictures(probes, whole),
        ...measured_pictures(signals, whole),
        ...signal_pictures(signals, whole),
      ],
    },
  ];
};
