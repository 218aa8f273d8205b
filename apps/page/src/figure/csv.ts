// Numbers as a CSV file (RFC 4180).
import type { Numbers } from "../picture";
import type { Num } from "../report";

// A text that a spreadsheet would take for a formula is preceded by an apostrophe, which makes it text; numbers stay.
const field = (value: Num | string | undefined): string => {
  if (value === null || value === undefined) return "";
  if (typeof value === "number") return Number.isFinite(value) ? String(value) : "";
  const text = /^[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

export const rows_of = (numbers: Numbers): number =>
  Math.max(0, ...numbers.columns.map((column) => column.values.length));

export const csv_of = (numbers: Numbers): string => {
  const lines = [numbers.columns.map((column) => field(column.name)).join(",")];
  const rows = rows_of(numbers);
  for (let row = 0; row < rows; ++row) lines.push(numbers.columns.map((column) => field(column.values[row])).join(","));
  return `${lines.join("\r\n")}\r\n`;
};
