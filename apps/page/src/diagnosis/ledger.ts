// The story of a model: one row a revision, what it changed, what it bought, and whether the data demanded it.
import { ledger_steps, not_known, targets_of } from "./steps";
import { forecast_curves, has_forecasts } from "./forecast_curves";
import type { Picture, Section, TextTable } from "../picture";
import type { LedgerPart, LedgerRow, Num, Report } from "../report";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { waterfall } from "./waterfall";
import { english, named, t } from "../texts/texts";

// Figures that only some ledgers have, and what the title says of them: none that no row has, for they only take room.
interface Figure {
  key: "likelihood_ratio" | "threshold" | "best_surrogate_fall" | "forecast_um" | "surrogate_forecast_um" | "discrepancy_um";
  name: () => string;
  decimals: number;
  percent?: boolean; // of a share
  about?: () => string;
}
const figures: Figure[] = [
  {
    key: "likelihood_ratio",
    name: () => "2 ln B",
    decimals: 1,
    about: () => t.diagnosis_likelihood_about,
  },
  { key: "threshold", name: () => t.diagnosis_counts_from, decimals: 1 },
  {
    key: "best_surrogate_fall",
    name: () => t.diagnosis_surrogate_fall,
    decimals: 0,
    percent: true,
    about: () => t.diagnosis_surrogate_fall_about,
  },
  { key: "forecast_um", name: () => t.diagnosis_forecasts, decimals: 3, about: () => t.diagnosis_forecasts_about },
  {
    key: "surrogate_forecast_um",
    name: () => t.diagnosis_with_surrogate,
    decimals: 3,
    about: () => t.diagnosis_with_surrogate_about,
  },
  {
    key: "discrepancy_um",
    name: () => t.diagnosis_slow_curve,
    decimals: 3,
    about: () => t.diagnosis_slow_curve_about,
  },
];

const table_of = ({ rows }: LedgerPart, several: boolean): TextTable => {
  const present = figures.filter(({ key }) => rows.some((row) => typeof row[key] === "number"));
  const figure = (value: Num | undefined, percent = false): Num => (typeof value === "number" ? (percent ? 100 : 1) * value : null);
  return {
    title: t.diagnosis_revisions,
    about: present.flatMap(({ about }) => (about ? [about()] : [])).join(" "),
    heading: [
      t.diagnosis_revision, t.diagnosis_change, ...(several ? [t.diagnosis_target] : []), t.diagnosis_parameters,
      t.diagnosis_rmse, t.diagnosis_times_floor, t.diagnosis_left_out_um, ...present.map(({ name }) => name()),
      t.verdict,
    ],
    rows: rows.map((row) => [
      String(row.revision),
      row.change,
      ...(several ? [row.target] : []),
      String(row.parameters),
      shown(row.rmse_um, 3),
      shown(row.times_floor, 2),
      shown(row.held_out_um, 3),
      ...present.map(({ key, decimals, percent }) => shown(figure(row[key], percent), decimals)),
      named(t.verdicts, row.verdict),
    ]),
  };
};

const has_surrogate_falls = (rows: readonly LedgerRow[]): boolean =>
  rows.some((row) => typeof row.best_surrogate_fall === "number");

const falls = (ledger: LedgerPart, target: string, name: string): Picture => {
  const steps = ledger_steps(ledger, target);
  const rows = ledger.rows.filter((row) => row.target === target);
  const untold = rows.some((row, i) => typeof row.best_surrogate_fall === "number" && steps[i]?.surrogate_fall === null);
  const several = untold ? [t.diagnosis_several_added] : [];
  return waterfall({
    name,
    title: t.diagnosis_error_title({ target: plain(target, 60) }),
    caption: t.diagnosis_falling,
    about: [t.diagnosis_no_evidence, ...several, ...not_known(steps, !untold)].join(" "),
    steps,
  });
};

// The falls, and the forecasts of a grown model, whose surrogates stand beside these and not beside the falls.
const pictures_of = (ledger: LedgerPart, target: string, number: string): Picture[] => {
  const rows = ledger.rows.filter((row) => row.target === target);
  const forecasts = has_forecasts(rows);
  return [
    ...(forecasts && !has_surrogate_falls(rows) ? [] : [falls(ledger, target, `ledger${number}`)]),
    ...(forecasts ? [forecast_curves(ledger, target, `ledger-forecasts${number}`)] : []),
  ];
};

const result_of = ({ rows }: LedgerPart): string => {
  const [first, last] = [rows[0], rows.at(-1)];
  const same = first && last && first.target === last.target;
  const fall = same ? `${shown(first.rmse_um, 3)} → ${shown(last.rmse_um, 3)}` : "";
  return t.diagnosis_revisions_count({ rows: rows.length, fall });
};

export const ledger_section = (report: Report): Section[] => {
  const { ledger } = report;
  if (!ledger || ledger.rows.length === 0) return [];
  const targets = targets_of(ledger);
  const several = targets.length > 1;
  return [
    {
      id: "ledger",
      heading: t.diagnosis_ledger,
      result: result_of(ledger),
      sentences: ledger.rows.map((row) => english(row.sentence)),
      tables: [table_of(ledger, several)],
      pictures: targets.flatMap((target, k) => pictures_of(ledger, target, several ? `-${k + 1}` : "")),
    },
  ];
};
