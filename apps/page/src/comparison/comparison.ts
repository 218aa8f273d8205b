// Two drift series compared: where they agree, and whether their uncertainty explains the rest.
import { comparison_picture } from "./comparison_picture";
import { data_files, report_command } from "../drawing/command";
import type { Next, Section, TextTable } from "../picture";
import type { ComparedAxis, ComparePart, Num, Report } from "../report";
import { clamped, slug, unit_shown, words } from "../drawing/text";
import { decimals_for, minutes, shown, with_sigma } from "../drawing/theme";
import { whole_min } from "../drawing/axes";
import { all_said, named, said, type Sentence, t } from "../texts/texts";

const number = (axis: ComparedAxis, key: string): Num => {
  const value = axis[key];
  return typeof value === "number" ? value : null;
};

export const unit_of = (axis: ComparedAxis): string => {
  const key = Object.keys(axis.points[0] ?? {}).find((one) => one.startsWith("difference_"));
  return key ? key.slice("difference_".length) : "um";
};

// Percent, of a share.
const percent = (share: Num, decimals = 2): string => (share === null ? "–" : shown(100 * share, decimals));

// A row of the table: what, and how it reads for an axis whose lengths are in `unit`, which is written so.
type Row = [(written: string) => string, (axis: ComparedAxis, unit: string) => string];

const length =
  (name: string): Row[1] =>
  (axis, unit) => {
    const value = number(axis, `${name}_${unit}`);
    return shown(value, decimals_for(number(axis, `rmse_${unit}`), null) - 1);
  };

const minutes_of = (axis: ComparedAxis, key: string): Num => {
  const time_s = number(axis, key);
  return time_s === null ? null : minutes(time_s);
};

const rows: readonly Row[] = [
  [() => t.verdict, (axis) => named(t.agreement, axis.agreement)],
  [() => t.comparison_within, (axis) => t.n_of_all({ n: shown(number(axis, "within_2_sigma")), all: shown(number(axis, "samples")) })],
  [() => t.comparison_mean_relative, (axis) => percent(number(axis, "mean_relative_deviation"))],
  [() => t.comparison_expected, (axis) => percent(number(axis, "expected_relative_deviation"))],
  [() => t.comparison_explained, (axis) => percent(number(axis, "explained_share"), 0)],
  [() => t.comparison_of_range, (axis) => percent(number(axis, "range_normalised_mean_deviation"))],
  [(unit) => t.comparison_rmse({ unit }), length("rmse")],
  [(unit) => t.comparison_largest({ unit }), length("max")],
  [() => t.comparison_largest_at, (axis) => shown(minutes_of(axis, "max_at_s"))],
  [(unit) => t.comparison_bias({ unit }), length("bias")],
  [(unit) => t.comparison_limits_low({ unit }), length("loa_low")],
  [(unit) => t.comparison_limits_high({ unit }), length("loa_high")],
  [() => t.comparison_correlation, (axis) => shown(number(axis, "correlation"), 4)],
  [() => t.comparison_lag, (axis) => with_sigma(minutes_of(axis, "lag_s"), minutes_of(axis, "lag_sigma_s"), 2)],
];

// One table, or one a unit.
const statistics_tables = (axes: readonly [string, ComparedAxis][]): TextTable[] => {
  const units = [...new Set(axes.map(([, axis]) => unit_of(axis)))];
  return units.map((unit) => {
    const of_unit = axes.filter(([, axis]) => unit_of(axis) === unit);
    const written = unit_shown(unit);
    return {
      title: units.length > 1 ? t.comparison_how_well_in({ unit: written }) : t.comparison_how_well,
      heading: ["", ...of_unit.map(([name]) => words(name))],
      rows: rows.map(([label, text]) => [label(written), ...of_unit.map(([, axis]) => text(axis, unit))]),
    };
  });
};

interface Source {
  source: string;
  share: number;
  [sigma: string]: unknown;
}

const budget_of = (axis: ComparedAxis): Source[] => (Array.isArray(axis["budget"]) ? (axis["budget"] as Source[]) : []);

// Root mean square over the samples of each source's standard deviation, and its share of the variance.
const budget_table = (axes: readonly [string, ComparedAxis][]): TextTable[] => {
  const sources = [...new Set(axes.flatMap(([, axis]) => budget_of(axis).map(({ source }) => source)))];
  if (sources.length === 0) return [];
  const cell = (source: string, axis: ComparedAxis): string => {
    const one = budget_of(axis).find((entry) => entry.source === source);
    if (!one) return "–";
    const sigma = one[`sigma_${unit_of(axis)}`];
    return `${shown(typeof sigma === "number" ? sigma : null, 3)} (${shown(100 * one.share, 0)} %)`;
  };
  return [
    {
      title: t.comparison_budget,
      heading: [
        t.comparison_source,
        ...axes.map(([name, axis]) => t.model_in_unit({ name: words(name), unit: unit_shown(unit_of(axis)) })),
      ],
      rows: sources.map((source) => [source, ...axes.map(([, axis]) => cell(source, axis))]),
    },
  ];
};

const verdict_of = (compare: ComparePart): Sentence => said(compare.conclusion, compare.conclusion_message);

const sentences_of = (compare: ComparePart): Sentence[] => [
  verdict_of(compare),
  t.comparison_series({ which: "A", name: compare.a }),
  t.comparison_series({ which: "B", name: compare.b }),
  t.comparison_explanation,
  ...all_said(compare.remarks, compare.remarks_message),
];

// Where all agree, the axis that moves most proves it best.
const most_moved = (axes: readonly [string, ComparedAxis][]): [string, ComparedAxis] | undefined => {
  const range = ([, axis]: [string, ComparedAxis]): number => {
    const values = axis.points.flatMap((point) => point[`a_${unit_of(axis)}`] ?? []);
    return Math.max(0, ...values) - Math.min(0, ...values);
  };
  return [...axes].sort((a, b) => range(b) - range(a))[0];
};

const next_of = (report: Report): Next => ({ label: t.drift_next, command: report_command(data_files(report).slice(0, 1)), action: { action: "find" } });

export const comparison_section = (report: Report): Section[] => {
  const { compare } = report;
  if (!compare) return [];
  const axes = Object.entries(compare.axes);
  const telling = axes.find(([, { agreement }]) => agreement === "disagrees") ?? most_moved(axes);
  const whole = whole_min(axes.map(([, axis]) => axis.points.map((point) => minutes(point.time_s))));
  return [
    {
      id: "comparison",
      heading: t.comparison,
      result: axes.map(([name, { agreement }]) => `${words(name)} ${named(t.agreement, agreement)}`).join(", "),
      // Of a drift with its own probes it is a check; another drift is what the reader asked for.
      says: report.drift && report.five_probe && axes.every(([, { agreement }]) => agreement !== "disagrees") ? 0 : 10,
      first: telling && {
        picture: `comparison-${slug(telling[0])}`,
        conclusion: () => ({ verdict: verdict_of(compare), concluded: compare.conclusion, next: next_of(report) }),
      },
      sentences: sentences_of(compare),
      tables: [...statistics_tables(axes), ...budget_table(axes)],
      pictures: axes.map(([name, axis], k) =>
        comparison_picture({ name, axis, k, unit: unit_of(axis), a: clamped(compare.a, 60), b: clamped(compare.b, 60), whole_min: whole }),
      ),
    },
  ];
};
