// The table of candidates, with the figures that `ballbar diagnose` prints. A row that is hovered or focused chooses its
// curve in the picture of the candidates, where there is one.
import type { TextTable } from "../picture";
import { type Ranked, ranked_candidates } from "./ranking";
import type { Diagnosed, Num } from "../report";
import { rounded, shown, with_sigma } from "../drawing/theme";
import { t } from "../texts/texts";
import { typed_name } from "../machine_errors/error_names";
import { plain } from "../drawing/text";

// Two digits of the RMSE, at least hundredths.
const decimals_of = (rmse_um: Num): number =>
  rmse_um !== null && rmse_um > 0 ? Math.min(6, Math.max(2, 1 - Math.floor(Math.log10(rmse_um)))) : 2;

const kMost_numbers = 6; // numbers in a cell

// Numbers of the rows that look the same in these data, and how many more there are.
const inseparable_text = (one: Ranked, all: readonly Ranked[]): string => {
  const labels = one.candidate.inseparable_from;
  const rows = labels
    .map((label) => all.findIndex((other) => other.candidate.label === label) + 1)
    .filter((row) => row > 0)
    .sort((a, b) => a - b)
    .slice(0, kMost_numbers);
  const more = labels.length - rows.length;
  return [...rows.map(String), ...(more > 0 ? [t.diagnosis_more({ more })] : [])].join(", ") || "–";
};

export const candidate_table = (found: Diagnosed, left_out: string, picture: string | null): TextTable => {
  const ranked = ranked_candidates(found);
  const decimals = decimals_of(found.rmse_um);
  const star = ranked.some(({ starred }) => starred) ? [t.diagnosis_star] : [];
  return {
    title: t.diagnosis_candidates,
    about: [...star, t.diagnosis_columns({ left_out })].join(" "),
    heading: [
      t.diagnosis_no, t.diagnosis_one_candidate, t.diagnosis_amplitude, "P", "2 ln B", t.diagnosis_rmse,
      t.diagnosis_held_out, t.diagnosis_inseparable,
    ],
    rows: ranked.map((one, k) => {
      const c = one.candidate;
      return [
        `${k + 1}${one.starred ? "*" : ""}`,
        typed_name(c.label, 90),
        with_sigma(c.amplitude_um, c.amplitude_sigma_um, decimals),
        shown(c.p, 2),
        shown(c.likelihood_ratio, 0),
        shown(c.rmse_after_um, decimals + 1),
        // Of the others nothing is left out.
        c.in_best_set ? `${shown(c.held_out_before_um, decimals)} → ${shown(c.held_out_after_um, decimals)}` : "–",
        inseparable_text(one, ranked),
      ];
    }),
    bars: { column: 3, shares: ranked.map((one) => one.candidate.p) },
    choose: picture === null ? undefined : { picture, key: "candidate", values: ranked.map((one) => one.key) },
  };
};

// What is probable: each effect, each column that drives something, each value that the model holds, a slow curve without
// a cause, and nothing. The P of effects need not add up to 1: two may be missing at once.

const kEffects = 8; // shown
const kLeast = 0.05; // P of an effect that is shown

const three_digits = (value: Num): string => rounded(value, 3);

const own_text = ({ effect, parameter, unit, held, fitted, low, high }: Diagnosed["own"][number]): string => {
  const range = `${three_digits(fitted)} (${t.several_from_to({ from: three_digits(low), to: three_digits(high) })})${unit === "1" ? "" : ` ${unit}`}`;
  return t.diagnosis_own({ parameter, effect: plain(effect, 60), held: shown(held), range });
};

const rows_of = (found: Diagnosed): { what: string; p: Num }[] => [
  ...found.effects
    .filter(({ p }, k) => k < kEffects && (p ?? 0) >= kLeast)
    .map(({ label, p }) => ({ what: t.diagnosis_is_missing({ effect: typed_name(label, 90) }), p })),
  ...found.drivers.map(({ column, p, is_clear }) => {
    const said = { column: plain(column, 60) };
    return { what: is_clear ? t.diagnosis_drives(said) : t.diagnosis_may_drive(said), p };
  }),
  ...found.own.map((own) => ({ what: own_text(own), p: own.p })),
  {
    what: (found.discrepancy_um ?? 0) > 0 ? t.diagnosis_slow_of({ size: three_digits(found.discrepancy_um) }) : t.diagnosis_slow,
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
