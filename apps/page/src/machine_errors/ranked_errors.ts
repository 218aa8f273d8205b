// The rows of a test in the order they are read: by rank, then what is not significant by the size of its curve.
import type { MachineErrorRow, MachineErrorsPart } from "../report";

export interface RankedError {
  effect: string;
  first: MachineErrorRow; // what all rows have alike is read from it
  rows: readonly MachineErrorRow[];
}

const kUnranked = 1e9;

const compared = ({ first: a }: RankedError, { first: b }: RankedError): number =>
  (a.rank ?? kUnranked) - (b.rank ?? kUnranked) ||
  (b.individual_circularity_um ?? 0) - (a.individual_circularity_um ?? 0);

export const ranked_errors = ({ errors }: MachineErrorsPart): RankedError[] => {
  const by_effect = new Map<string, RankedError>();
  for (const row of errors) {
    if (row.effect === undefined) continue;
    const { first = row, rows = [] } = by_effect.get(row.effect) ?? {};
    by_effect.set(row.effect, { effect: row.effect, first, rows: [...rows, row] });
  }
  return [...by_effect.values()].sort(compared);
};

// Of the circle: where the test was set up, and scale.
export const circle_rows = ({ errors }: MachineErrorsPart): MachineErrorRow[] =>
  errors.filter(({ effect }) => effect === undefined);
