// A step of a waterfall: the model at one revision, or as it would be with more effects.
import type { LedgerPart, LedgerRow, Num } from "../report";
import { t } from "../texts/texts";
import { shown } from "../drawing/theme";

// Null: not known.
export interface Step {
  label: string;
  short: string; // where there is little room
  rmse_um: Num;
  from_um: Num; // of the step before, where the two can be compared
  floor_um: Num;
  surrogate_fall: Num; // share of from_um that the best surrogate took off; null too where several effects were added
  held_out_um: Num;
  proposed: boolean; // not in the model
}

// What the best surrogate would have left.
export const surrogate_um = (step: Step): Num =>
  step.from_um === null || step.surrogate_fall === null ? null : step.from_um * (1 - step.surrogate_fall);

// What must be said beside every falling error.

// Of `effects` that come together. The best surrogate of one of them begins at what the others leave, of which the RMSE
// is not told.
export const no_evidence_of_several = (effects: number, best_surrogate_fall: Num): string =>
  t.diagnosis_no_evidence_of_several({
    effects,
    percent: best_surrogate_fall ? shown(100 * best_surrogate_fall, 0) : "",
  });

// "Not known: the floor; ..." of what no step has; none where all is known. surrogates_told: surrogates count too.
export const not_known = (steps: readonly Step[], with_surrogates = true): string[] => {
  const changed = steps.filter((step) => step.from_um !== null);
  const surrogates_known = changed.length === 0 || changed.some((step) => surrogate_um(step) !== null);
  const missing = [
    ...(steps.some((step) => step.floor_um !== null) ? [] : [t.diagnosis_the_floor]),
    ...(!with_surrogates || surrogates_known ? [] : [t.diagnosis_the_surrogate]),
    ...(steps.some((step) => step.held_out_um !== null) ? [] : [t.diagnosis_the_left_out]),
  ];
  return missing.length > 0 ? [t.diagnosis_not_known({ missing: missing.join("; ") })] : [];
};

// The revisions of a ledger as the steps of a waterfall.

const known = (value: Num | undefined): Num => value ?? null;

// The figures of two rows can be compared where both are of one target and of the same data.
export const revision_before = (rows: readonly LedgerRow[], at: number): LedgerRow | undefined => {
  const row = rows[at];
  const other = rows[at - 1];
  return row && other && other.target === row.target && String(other.data) === String(row.data) ? other : undefined;
};

// A surrogate stands in the place of one effect. Where several were added at once that is beside the others, so that
// its fall does not begin at the revision before.
const added = (row: LedgerRow): number => row.change.match(/(^|, )\+ /g)?.length ?? 0;

export const targets_of = (ledger: LedgerPart): string[] => [...new Set(ledger.rows.map((row) => row.target))];

export const ledger_steps = (ledger: LedgerPart, target: string): Step[] =>
  ledger.rows.flatMap((row, at) =>
    row.target !== target
      ? []
      : [
          {
            label: `${row.revision} ${row.change}`,
            short: String(row.revision),
            rmse_um: row.rmse_um,
            from_um: revision_before(ledger.rows, at)?.rmse_um ?? null,
            floor_um: row.rmse_um !== null && row.times_floor ? row.rmse_um / row.times_floor : null,
            surrogate_fall: added(row) > 1 ? null : known(row.best_surrogate_fall),
            held_out_um: row.held_out_um,
            proposed: false,
          },
        ],
  );
