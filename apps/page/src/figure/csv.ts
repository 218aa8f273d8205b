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

const spelled: ReadonlyMap<string, string> = new Map(
  Object.entries({ "µ": "u", "μ": "u", "°": "deg", "−": "-", "–": "-", "±": "+-", "…": "...", "×": "x" }),
);

// A name in ASCII, which every program reads alike: letters without their accents, and others by their number, "U+6E29".
const ascii = (name: string): string =>
  Array.from(name.replace(/\s*→\s*/g, " to "), (letter) => spelled.get(letter) ?? letter.normalize("NFKD").replace(/[\u0300-\u036f]/g, ""))
    .join("")
    .replace(/[^\x00-\x7f]/gu, (letter) => `U+${(letter.codePointAt(0) ?? 0).toString(16).toUpperCase().padStart(4, "0")}`);

export const csv_of = (numbers: Numbers): string => {
  const lines = [numbers.columns.map((column) => field(ascii(column.name))).join(",")];
  const rows = rows_of(numbers);
  for (let row = 0; row < rows; ++row) lines.push(numbers.columns.map((column) => field(column.values[row])).join(","));
  return `${lines.join("\r\n")}\r\n`;
};
