// What of a curve survives beside the model. Where an effect is added, the other effects of the model change their
// gains: most of a large curve may be taken back by them, and only the rest can stand for the residual. The rest is the
// curve less its least-squares fit by a constant and what each effect of the model adds; that their time constants and
// the like change too is left out.
import type { Num } from "./report";

const known = (value: Num | undefined): value is number => typeof value === "number";

const product = (a: readonly number[], b: readonly number[]): number => a.reduce((sum, value, i) => sum + value * (b[i] ?? 0), 0);

// a - factor b
const less = (a: readonly number[], factor: number, b: readonly number[]): number[] =>
  a.map((value, i) => value - factor * (b[i] ?? 0));

// Directions at right angles to each other, each of length 1. What is made of those before it adds none.
const directions = (columns: readonly (readonly number[])[]): number[][] => {
  const found: number[][] = [];
  for (const column of columns) {
    const size = product(column, column);
    // Twice, because rounding leaves a little of the others the first time.
    const rest = [...found, ...found].reduce((left: number[], one) => less(left, product(left, one), one), [...column]);
    const rest_size = product(rest, rest);
    if (rest_size > 1e-12 * size) found.push(rest.map((value) => value / Math.sqrt(rest_size)));
  }
  return found;
};

export const surviving = (curve: readonly Num[], contributions: readonly (readonly Num[])[]): Num[] => {
  const rows = curve.map((_, i) => i).filter((i) => known(curve[i]) && contributions.every((one) => known(one[i])));
  const at_rows = (values: readonly Num[]): number[] => rows.map((i) => values[i] ?? 0);
  const model = directions([rows.map(() => 1), ...contributions.map(at_rows)]);
  const rest = model.reduce((left, one) => less(left, product(left, one), one), at_rows(curve));
  const survived: Num[] = curve.map(() => null);
  rows.forEach((row, k) => (survived[row] = rest[k] ?? null));
  return survived;
};
