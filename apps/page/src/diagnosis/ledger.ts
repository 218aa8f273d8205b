// The story of a model: one row a revision, what it changed, what it bought, and whether the data demanded it.
import { ledger_steps, not_known, targets_of } from "./steps";
import { forecast_curves, has_forecasts } from "./forecast_curves";
import type { Picture, Section, TextTable } from "../picture";
import type { LedgerPart, Report } from "../report";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { waterfall } from "./waterfall";
import { named, said, t } from "../texts/texts";

// Figures that only some ledgers have, and what the title says of them: none that no row has, for they only take room.
interface Figure {
  key: "likelihood_ratio" | "threshold" | "forecast_um" | "discrepancy_um";
  name: () => string;
  decimals: number;
  about?: () => string;
}
const figures: Figure[] = [
  { key: "likelihood_ratio", name: () => "2 ln B", decimals: 1, about: () => t.diagnosis_likelihood_about },
  { key: "threshold", name: () => t.diagnosis_counts_from, decimals: 1 },
  { key: "forecast_um", name: () => t.diagnosis_forecasts, decimals: 3, about: () => t.diagnosis_forecasts_about },
  { key: "discrepancy_um", name: () => t.diagnosis_slow_curve, decimals: 3, about: () => t.diagnosis_slow_curve_about },
];

const table_of = ({ rows }: LedgerPart, several: boolean): TextTable => {
  const present = figures.filter(({ key }) => rows.some((row) => typeof row[key] === "number"));
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
      ...present.map(({ key, decimals }) => shown(row[key], decimals)),
      named(t.verdicts, row.verdict),
    ]),
  };
};

const falls = (ledger: LedgerPart, target: string, name: string): Picture => {
  const steps = ledger_steps(ledger, target);
  return waterfall({
    name,
    title: t.diagnosis_error_title({ target: plain(target, 60) }),
    caption: t.diagnosis_falling,
    about: [t.diagnosis_no_evidence, ...not_known(steps)].join(" "),
    steps,
  });
};

// The falls, and the forecasts of a grown model, which say more than its falls where nothing was tested.
const pictures_of = (ledger: LedgerPart, target: string, number: string): Picture[] => {
  const rows = ledger.rows.filter((row) => row.target === target);
  const forecasts = has_forecasts(rows);
  const tested = rows.some((row) => typeof row.likelihood_ratio === "number");
  return [
    ...(forecasts && !tested ? [] : [falls(ledger, target, `ledger${number}`)]),
    ...(forecasts ? [forecast_curves(ledger, target, `ledger-forecasts${number}`)] : []),
  ];
};

const result_of = ({ rows }: LedgerPart): string => {
  const [first, last] = [rows[0], rows.at(-1)];
  const same = first && last && first.target === last.target;
  const fall = same ? t.diagnosis_revisions_fall({ fall: `${shown(first.rmse_um, 3)} → ${shown(last.rmse_um, 3)}` }) : "";
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
      sentences: ledger.rows.map((row) => said(row.sentence, row.message)),
      tables: [table_of(ledger, several)],
      pictures: targets.flatMap((target, k) => pictures_of(ledger, target, several ? `-${k + 1}` : "")),
    },
  ];
};
