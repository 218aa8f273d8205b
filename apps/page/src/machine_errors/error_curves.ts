// One test's readings about the fitted circle, what an error adds to them, and what they would be without it.
import type { MachineErrorsPart, Num, Recording, Report } from "../report";

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

const less = (a: readonly Num[], b: readonly Num[]): Num[] =>
  a.map((value, i) => {
    const other = b[i] ?? null;
    return value === null || other === null ? null : value - other;
  });

// Of the k-th recording: each reading less the circle that is fitted to all of them.
export const about_circle = ({ part, recordings }: ErrorTest, k: number): Num[] =>
  less(recordings[k]?.trace?.deviation_um ?? [], part.circle_um[k] ?? []);

// What an error adds to the k-th recording; undefined: it was not looked for in this test.
export const error_curve = ({ part }: ErrorTest, error: string, k: number): readonly Num[] | undefined =>
  Object.hasOwn(part.curves, error) ? part.curves[error]?.[k] : undefined;

// As the circle would be if the error were mended.
export const without_error = (test: ErrorTest, error: string, k: number): Num[] => {
  const measured = about_circle(test, k);
  const curve = error_curve(test, error, k);
  return curve ? less(measured, curve) : measured;
};

// Of all that may be drawn, so that the scale is the same for each error, with it and without.
export const extent_of_test = (test: ErrorTest): [number, number] => {
  let least = 0;
  let largest = 0;
  const hold = (values: readonly Num[]): void => {
    for (const value of values) {
      if (value === null) continue;
      least = Math.min(least, value);
      largest = Math.max(largest, value);
    }
  };
  test.recordings.forEach((_, k) => {
    hold(about_circle(test, k));
    for (const error of Object.keys(test.part.curves)) {
      hold(error_curve(test, error, k) ?? []);
      hold(without_error(test, error, k));
    }
  });
  return [least, largest];
};
