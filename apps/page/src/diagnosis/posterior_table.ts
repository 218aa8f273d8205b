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
  p: Num;
}

const three_digits = (value: Num): string => (value === null ? "–" : shown(Number(value.toPrecision(3))));

const own_text = ({ effect, parameter, unit, held, fitted, low, high }: Diagnosed["own"][number]): string => {
  const range = `${three_digits(fitted)} (${three_digits(low)} to ${three_digits(high)})${unit === "1" ? "" : ` ${unit}`}`;
  return `the ${parameter} of ${plain(effect, 60)} is not ${shown(held)}; it would be ${range}`;
};

const rows_of = (found: Diagnosed): Row[] => [
  ...found.effects
    .filter(({ p }, k) => k < kEffects && (p ?? 0) >= kLeast)
    .map(({ label, p }) => ({ what: `${plain(label, 60)} is missing`, p })),
  ...found.drivers.map(({ column, p }) => ({ what: `${plain(column, 60)} drives what is missing, in whatever form`, p })),
  ...found.own.map((own) => ({ what: own_text(own), p: own.p })),
  {
    what: `a slow curve without a cause is left${(found.discrepancy_um ?? 0) > 0 ? `, of ${three_digits(found.discrepancy_um)} µm` : ""}`,
    p: found.p_discrepancy,
  },
  { what: "nothing is missing", p: found.p_nothing },
];

export const posterior_table = (found: Diagnosed): TextTable => {
  const rows = rows_of(found);
  return {
    title: "P of each, from 0 to 1. Several may be true at once.",
    heading: ["what", "P"],
    rows: rows.map(({ what, p }) => [what, shown(p, 2)]),
    bars: { column: 0, shares: rows.map(({ p }) => p) },
  };
};
