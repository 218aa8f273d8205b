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
import { time_curves, type TimeCurves } from "./time_curves";
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

type Head = Omit<TimeCurves, "curves" | "whole_min">;

const pictures_of = (points: readonly DriftAxis[], probes: readonly DriftAxis[], whole_min: Range): Picture[] => {
  const picture = (axes: readonly DriftAxis[], head: Head): Picture[] =>
    axes.length === 0 ? [] : [time_curves({ ...head, curves: axes.map(axis_curve), whole_min })];
  const in_unit = (unit: string): DriftAxis[] => probes.filter((axis) => axis.unit === unit);
  const [um, urad] = [{ quantity: t.drift_axis_quantity, unit: "um" }, { quantity: t.drift_tilt_quantity, unit: "urad" }];
  const of_probes = { caption: t.drift_probes_caption, height_px: 320 };
  return [
    ...picture(points, { name: "drift", title: t.drift_picture_title, caption: t.drift_picture_caption, height_px: 380, ...um }),
    ...picture(in_unit("um"), { name: "five-probe", title: t.drift_probes_title, ...of_probes, ...um }),
    ...picture(in_unit("urad"), { name: "five-probe-tilt", title: t.drift_tilt_title, ...of_probes, ...urad }),
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
    next: { label: t.drift_next, command: report_command(data_files(report).slice(0, 1)), action: { action: "find" } },
  }),
});

export const drift_section = (report: Report): Section[] => {
  const { drift, five_probe } = report;
  const points = drift ? axes_of_points(drift) : [];
  const probes = five_probe ? axes_of_probes(five_probe) : [];
  if (points.length + probes.length === 0) return [];
  const main = points.length > 0 ? points : probes.filter(({ unit }) => unit === "um");
  const of_points = points.length > 0 ? [largest_table(t.drift_largest_title, points), points_table(points)] : [];
  const of_probes = probes.length > 0 ? [largest_table(t.drift_largest_probes_title, probes)] : [];
  // What belongs to the first picture stands beside it.
  const [[above, table = above], tables]: [TextTable[], TextTable[]] = points.length > 0 ? [of_points, of_probes] : [of_probes, []];
  const pictures = pictures_of(points, probes, whole_of(report));
  return [
    {
      id: "drift",
      heading: t.drift,
      result: result_of(main),
      says: report.compare && !drift ? kOf_compared : 0,
      first: pictures[0] && first_of(report, main, pictures[0].name),
      sentences: [
        ...(drift ? drift_sentences(drift, points) : []),
        ...(five_probe ? probes_sentences(five_probe, probes) : []),
      ],
      tables,
      pictures,
      companion: pictures[0] && table && {
        picture: pictures[0].name,
        key: "",
        above: table === above ? undefined : above,
        notes: () => ({ table, sentences: [], lists: [], tables: [] }),
      },
    },
  ];
};
