// A step of a waterfall: the model at one revision, or as it would be with more effects.
import type { LedgerPart, LedgerRow, Num } from "../report";
import { t } from "../texts/texts";

// Null: not known.
export interface Step {
  label: string;
  short: string; // where there is little room
  rmse_um: Num;
  from_um: Num; // of the step before, where the two can be compared
  floor_um: Num;
  held_out_um: Num;
  proposed: boolean; // not in the model
}

// "Not known: the floor; ..." of what no step has; none where all is known.
export const not_known = (steps: readonly Step[]): string[] => {
  const missing = [
    ...(steps.some((step) => step.floor_um !== null) ? [] : [t.diagnosis_the_floor]),
    ...(steps.some((step) => step.held_out_um !== null) ? [] : [t.diagnosis_the_left_out]),
  ];
  return missing.length > 0 ? [t.diagnosis_not_known({ missing: missing.join("; ") })] : [];
};

// The revisions of a ledger as the steps of a waterfall.

// The figures of two rows can be compared where both are of one target and of the same data.
export const revision_before = (rows: readonly LedgerRow[], at: number): LedgerRow | undefined => {
  const row = rows[at];
  const other = rows[at - 1];
  return row && other && other.target === row.target && String(other.data) === String(row.data) ? other : undefined;
};

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
            held_out_um: row.held_out_um,
            proposed: false,
          },
        ],
  );
