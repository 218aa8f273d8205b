// One test's readings about the fitted circle, what an error adds to them, and what they would be without it.
import { difference, extent } from "../drawing/columns";
import type { MachineErrorRow, MachineErrorsPart, Num, Recording, Report } from "../report";

export interface ErrorTest {
  value: string; // of a choice
  part: MachineErrorsPart;
  recordings: readonly Recording[];
}

export const error_tests = ({ fit, machine_errors }: Report): ErrorTest[] =>
  (machine_errors ?? []).flatMap((part, k): ErrorTest[] => {
    const recordings = part.recordings.map((place) => fit?.recordings[place]);
    const all = recordings.filter((one) => one !== undefined && one.trace !== undefined);
    return all.length > 0 && all.length === recordings.length ? [{ value: String(k), part, recordings: all as Recording[] }] : [];
  });

// Of the k-th recording: each reading less the circle that is fitted to all of them.
export const about_circle = ({ part, recordings }: ErrorTest, k: number): Num[] =>
  difference(recordings[k]?.trace?.deviation_um ?? [], part.circle_um[k] ?? []);

// What an error adds to the k-th recording; undefined: it was not looked for in this test.
export const error_curve = ({ part }: ErrorTest, error: string, k: number): readonly Num[] | undefined =>
  Object.hasOwn(part.curves, error) ? part.curves[error]?.[k] : undefined;

// As the circle would be if the error were mended.
export const without_error = (test: ErrorTest, error: string, k: number): Num[] => {
  const measured = about_circle(test, k);
  const curve = error_curve(test, error, k);
  return curve ? difference(measured, curve) : measured;
};

const extents = new WeakMap<ErrorTest, [number, number]>(); // asked for with every stroke of a slider

// Of all that may be drawn, so that the scale is the same for each error, with it and without.
export const extent_of_test = (test: ErrorTest): [number, number] => {
  const known = extents.get(test);
  if (known) return known;
  const all = extent(
    test.recordings.flatMap((_, k) => [
      about_circle(test, k),
      ...Object.keys(test.part.curves).flatMap((error) => [error_curve(test, error, k) ?? [], without_error(test, error, k)]),
    ]),
    [0, 0],
  );
  extents.set(test, all);
  return all;
};

// The rows of a test in the order they are read: by rank, then what is significant without one, then what is not; each
// by the size of its curve.

export interface RankedError {
  effect: string;
  first: MachineErrorRow; // what all rows have alike is read from it
  rows: readonly MachineErrorRow[];
}

const kUnranked = 1e9;

const compared = ({ first: a }: RankedError, { first: b }: RankedError): number =>
  (a.rank ?? kUnranked) - (b.rank ?? kUnranked) ||
  Number(b.significant === true) - Number(a.significant === true) ||
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
