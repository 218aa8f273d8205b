// Columns of numbers, row by row; a row that lacks in one lacks in what is made of it.
import type { Num } from "../report";

export const sum = (columns: readonly (readonly Num[])[]): Num[] =>
  (columns[0] ?? []).map((_, i) =>
    columns.reduce((total: Num, column) => {
      const value = column[i] ?? null;
      return total === null || value === null ? null : total + value;
    }, 0),
  );

export const difference = (a: readonly Num[], b: readonly Num[]): Num[] =>
  a.map((value, i) => {
    const other = b[i] ?? null;
    return value === null || other === null ? null : value - other;
  });
