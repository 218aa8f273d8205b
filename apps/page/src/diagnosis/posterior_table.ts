// What is probable: each effect, each column that drives something, each value that the model holds, a slow curve without
// a cause, and nothing. The P of effects need not add up to 1: two may be missing at once.
import type { TextTable } from "../picture";
import type { Diagnosed, Num } from "../report";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";

const kEffects = 8; // shown
const kLeast = 0.05; // P of an effect that is shown

interface Row {
  what: string;
  details: string;
  p: Num;
}

const three_digits = (value: Num): string => (value === null ? "–" : shown(Number(value.toPrecision(3))));

const rows_of = (found: Diagnosed): Row[] => [
  ...found.effects
    .filter(({ p }, k) => k < kEffects && (p ?? 0) >= kLeast)
    .map(({ label, p }) => ({ what: `${plain(label, 60)} is missing`, details: "", p })),
  ...found.drivers.map(({ column, p }) => ({ what: `${plain(column, 60)} drives what is missing, in whatever form`, details: "", p })),
  ...found.own.map((own) => ({
    what: `the ${own.parameter} of ${plain(own.effect, 60)} is not ${shown(own.held)}`,
    details: `it would be ${three_digits(own.fitted)} (${three_digits(own.low)} to ${three_digits(own.high)}) ${own.unit === "1" ? "" : own.unit}`.trim(),
    p: own.p,
  })),
  {
    what: "a slow curve without a cause is left",
    details: (found.discrepancy_um ?? 0) > 0 ? `of ${three_digits(found.discrepancy_um)} µm` : "",
    p: found.p_discrepancy,
  },
  { what: "nothing is missing", details: "", p: found.p_nothing },
];

export const posterior_table = (found: Diagnosed): TextTable => {
  const rows = rows_of(found);
  return {
    title: "P of each, 0 to 1. Several may be true at once.",
    heading: ["what", "which would be", "P"],
    rows: rows.map(({ what, details, p }) => [what, details, shown(p, 2)]),
    bars: { column: 2, shares: rows.map(({ p }) => p) },
  };
};
