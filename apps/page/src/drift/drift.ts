// The drift of the spindle over time.
import {
  axes_of_points, axes_of_probes, axis_curve, type DriftAxis, largest_of_each, largest_table, points_table,
} from "./drift_axes";
import { data_files, report_command } from "../drawing/command";
import type { First, Picture, Range, Section, TextTable } from "../picture";
import type { DriftPart, ProbesPart, Report } from "../report";
import { whole_of } from "./signals";
import { capital, words } from "../drawing/text";
import { minutes, shown } from "../drawing/theme";
import { time_curves } from "./time_curves";
import { english, type Sentence, t } from "../texts/texts";

const kOf_compared = -60; // of a drift that was opened to be compared: its comparison says more

const span_min = (axes: readonly DriftAxis[]): number => {
  const clock = axes[0]?.time_min ?? [];
  return clock.length > 0 ? (clock[clock.length - 1] as number) - (clock[0] as number) : 0;
};

const drift_sentences = (drift: DriftPart, axes: readonly DriftAxis[]): Sentence[] => [
  t.drift_method({
    method: words(drift.method),
    tests: drift.points.length,
    minutes: shown(span_min(axes)),
    reference: shown(minutes(drift.reference_s)),
  }),
  ...(drift.not_cancelled ? [english(drift.not_cancelled)] : []),
];

const probes_sentences = (probes: ProbesPart, axes: readonly DriftAxis[]): Sentence[] => [
  t.drift_probes_method({
    what: capital(probes.what),
    readings: probes.time_s.length,
    minutes: shown(span_min(axes)),
    reference: shown(minutes(probes.reference_s)),
  }),
  ...probes.remarks.map(english),
];

const drift_picture = (axes: readonly DriftAxis[], whole: Range): Picture =>
  time_curves({
    name: "drift",
    title: t.drift_picture_title,
    caption: t.drift_picture_caption,
    quantity: t.drift_axis_quantity,
    unit: "um",
    curves: axes.map(axis_curve),
    whole_min: whole,
    height_px: 380,
  });

const probe_pictures = (axes: readonly DriftAxis[], whole: Range): Picture[] => {
  const picture = (name: string, title: string, quantity: string, unit: string): Picture[] => {
    const curves = axes.filter((axis) => axis.unit === unit).map(axis_curve);
    const caption = t.drift_probes_caption;
    return curves.length > 0
      ? [time_curves({ name, title, caption, quantity, unit, curves, whole_min: whole, height_px: 320 })]
      : [];
  };
  return [
    ...picture("five-probe", t.drift_probes_title, t.drift_axis_quantity, "um"),
    ...picture("five-probe-tilt", t.drift_tilt_title, t.drift_tilt_quantity, "urad"),
  ];
};

const result_of = (axes: readonly DriftAxis[]): string => {
  const [largest] = largest_of_each(axes);
  return largest ? t.drift_result({ largest: largest.text, at: largest.at_text }) : "";
};

const first_of = (report: Report, axes: readonly DriftAxis[], picture: string): First => ({
  picture,
  conclusion: () => ({
    verdict: t.drift_verdict({ each: largest_of_each(axes).map(({ said }) => said).join("; ") }),
    next: {
      label: t.drift_next,
      command: report_command(data_files(report).slice(0, 1)),
    },
  }),
});

export const drift_section = (report: Report): Section[] => {
  const { drift, five_probe } = report;
  const points = drift ? axes_of_points(drift) : [];
  const probes = five_probe ? axes_of_probes(five_probe) : [];
  if (points.length + probes.length === 0) return [];

  const whole = whole_of(report);
  const main = points.length > 0 ? points : probes.filter(({ unit }) => unit === "um");
  const of_points = points.length > 0 ? [largest_table(t.drift_largest_title, points), points_table(points)] : [];
  const of_probes = probes.length > 0 ? [largest_table(t.drift_largest_probes_title, probes)] : [];
  // What belongs to the first picture stands beside it.
  const [[above, table = above], tables]: [TextTable[], TextTable[]] = points.length > 0 ? [of_points, of_probes] : [of_probes, []];
  const pictures = [...(points.length > 0 ? [drift_picture(points, whole)] : []), ...probe_pictures(probes, whole)];
  return [
    {
      id: "drift",
      heading: t.drift,
      result: result_of(main),
      says: report.compare && !drift ? kOf_compared : 0,
      ...(pictures[0] ? { first: first_of(report, main, pictures[0].name) } : {}),
      sentences: [
        ...(drift ? drift_sentences(drift, points) : []),
        ...(five_probe ? probes_sentences(five_probe, probes) : []),
      ],
      tables,
      pictures,
      ...(pictures[0] && above && table
        ? {
            companion: {
              picture: pictures[0].name,
              key: "",
              ...(table === above ? {} : { above }),
              notes: () => ({ table, sentences: [], lists: [], tables: [] }),
            },
          }
        : {}),
    },
  ];
};
