// What is probable: each effect, each column that drives something, each value that the model holds, a slow curve without
// a cause, and nothing. The P of effects need not add up to 1: two may be missing at once.
import type { TextTable } from "../picture";
import type { Diagnosed, Num } from "../report";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { t } from "../texts/texts";
import { typed_name } from "../machine_errors/error_names";

const kEffects = 8; // shown
const kLeast = 0.05; // P of an effect that is shown

interface Row {
  what: string;
  p: Num;
}

const three_digits = (value: Num): string => (value === null ? "–" : shown(Number(value.toPrecision(3))));

export const own_text = ({ effect, parameter, unit, held, fitted, low, high }: Diagnosed["own"][number]): string => {
  const range = `${three_digits(fitted)} (${t.several_from_to({ from: three_digits(low), to: three_digits(high) })})${unit === "1" ? "" : ` ${unit}`}`;
  return t.diagnosis_own({ parameter, effect: plain(effect, 60), held: shown(held), range });
};

const rows_of = (found: Diagnosed): Row[] => [
  ...found.effects
    .filter(({ p }, k) => k < kEffects && (p ?? 0) >= kLeast)
    .map(({ label, p }) => ({ what: t.diagnosis_is_missing({ effect: typed_name(label, 90) }), p })),
  ...found.drivers.map(({ column, p }) => ({ what: t.diagnosis_drives({ column: plain(column, 60) }), p })),
  ...found.own.map((own) => ({ what: own_text(own), p: own.p })),
  {
    what: t.diagnosis_slow({ size: (found.discrepancy_um ?? 0) > 0 ? three_digits(found.discrepancy_um) : "" }),
    p: found.p_discrepancy,
  },
  { what: t.diagnosis_nothing, p: found.p_nothing },
];

export const posterior_table = (found: Diagnosed): TextTable => {
  const rows = rows_of(found);
  return {
    title: t.diagnosis_posterior_title,
    heading: [t.diagnosis_what, "P"],
    rows: rows.map(({ what, p }) => [what, shown(p, 2)]),
    bars: { column: 0, shares: rows.map(({ p }) => p) },
  };
};
