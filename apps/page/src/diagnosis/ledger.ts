// The story of a model: one row a revision, what it changed, what it bought, and whether the data demanded it.
import { no_evidence, not_known } from "./falls";
import { ledger_steps, targets_of } from "./ledger_steps";
import type { Section, TextTable } from "../picture";
import type { LedgerPart, Report } from "../report";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { waterfall } from "./waterfall";

const table_of = (ledger: LedgerPart): TextTable => {
  const several = targets_of(ledger).length > 1;
  return {
    title:
      "Revisions. 2 ln B: 2 ln of how much more likely the readings are with the change, of errors of axes chi²; the fall " +
      "of the best surrogate is in the RMSE.",
    heading: [
      "revision", "change", ...(several ? ["target"] : []), "parameters", "RMSE, µm", "× floor", "left out, µm",
      "2 ln B", "counts from", "best surrogate's fall, %", "verdict",
    ],
    rows: ledger.rows.map((row) => [
      String(row.revision),
      row.change,
      ...(several ? [row.target] : []),
      String(row.parameters),
      shown(row.rmse_um, 3),
      shown(row.times_floor, 2),
      shown(row.held_out_um, 3),
      shown(row.likelihood_ratio, 1),
      shown(row.threshold, 1),
      shown(typeof row.best_surrogate_fall === "number" ? 100 * row.best_surrogate_fall : null, 0),
      row.verdict,
    ]),
  };
};

export const ledger_section = (report: Report): Section[] => {
  const { ledger } = report;
  if (!ledger || ledger.rows.length === 0) return [];
  const targets = targets_of(ledger);
  return [
    {
      id: "ledger",
      heading: "What each revision bought",
      sentences: ledger.rows.map((row) => row.sentence),
      tables: [table_of(ledger)],
      pictures: targets.map((target, k) => {
        const steps = ledger_steps(ledger, target);
        const rows = ledger.rows.filter((row) => row.target === target);
        const untold = rows.some((row, i) => typeof row.best_surrogate_fall === "number" && steps[i]?.surrogate_fall === null);
        const several = untold ? " Where several effects were added at once, the line of the surrogate is not known." : "";
        const number = targets.length > 1 ? `-${k + 1}` : "";
        return waterfall({
          name: `ledger${number}`,
          title: `Error of ${plain(target, 60)} from revision to revision`,
          about: `${no_evidence}${several}${not_known(steps, !untold)}`,
          steps,
        });
      }),
    },
  ];
};
