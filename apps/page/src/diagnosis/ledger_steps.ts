// The revisions of a ledger as the steps of a waterfall.
import type { LedgerPart, LedgerRow, Num } from "../report";
import type { Step } from "./step";

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
