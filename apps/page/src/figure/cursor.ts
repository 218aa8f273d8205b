// Reads a picture's numbers out point by point.
import type { Numbers, State } from "../picture";
import type { Num } from "../report";
import { shown } from "../drawing/theme";
import { split_name, words } from "../drawing/units";

const said = (name: string, value: Num | string): string => {
  const { quantity, unit } = split_name(name);
  const text = typeof value === "string" ? value : shown(value);
  return [words(quantity), text, unit].filter((part) => part !== "").join(" ");
};

// "time 64 min, x 4.4 µm, ..."; what is not known is left out.
export const row_said = (numbers: Numbers, row: number): string =>
  numbers.columns
    .flatMap(({ name, values }) => {
      const value = values[row] ?? null;
      return value === null ? [] : [said(name, value)];
    })
    .join(", ");

// The row `by` points after `row`, among those in the window; of very many points not every one.
export const next_row = (numbers: Numbers, window: State["window"], row: number | null, by: number): number | null => {
  const x = numbers.columns[0]?.values ?? [];
  const seen: number[] = [];
  x.forEach((value, index) => {
    if (!window || typeof value !== "number" || (value >= window[0] && value <= window[1])) seen.push(index);
  });
  if (seen.length === 0) return null;
  const step = Math.ceil(seen.length / 500);
  const place = row === null ? -1 : seen.indexOf(row);
  if (place < 0) return (by > 0 ? seen[0] : seen[seen.length - 1]) ?? null;
  return seen[Math.min(seen.length - 1, Math.max(0, place + by * step))] ?? null;
};
