// The tables of a diagnosis, cell for cell as `ballbar diagnose` prints them. A row that is hovered or focused chooses
// its curve in the picture of the candidates.
import type { TextTable } from "./picture";
import { ranked_candidates, ranked_companions, type Ranked } from "./ranking";
import type { Diagnosed, Num } from "./report";
import { plain } from "./text";
import { shown } from "./theme";
import { with_sigma } from "./with_sigma";

// Two digits of the RMSE, at least hundredths.
export const decimals_of = (rmse_um: Num): number =>
  rmse_um !== null && rmse_um > 0 ? Math.min(6, Math.max(2, 1 - Math.floor(Math.log10(rmse_um)))) : 2;

const change = (before: Num, after: Num, decimals: number): string =>
  `${shown(before, decimals)} → ${shown(after, decimals)}`;

const chance_text = (p: Num): string =>
  p === null ? "–" : p < 0.0005 ? "< 0.1 %" : `${(100 * p).toFixed(1)} %`;

const fakes_text = (beats: boolean | null): string => (beats === null ? "not tested" : beats ? "yes" : "no");

// Numbers of the rows that look the same in these data, and how many more do that have no row.
const not_told_from = (one: Ranked, all: readonly Ranked[]): string => {
  const labels = one.candidate.inseparable_from;
  const rows = labels.map((label) => all.findIndex((other) => other.candidate.label === label) + 1);
  const told = rows.filter((row) => row > 0).map(String);
  const more = rows.length - told.length;
  return [...told, ...(more > 0 ? [`${more} more`] : [])].join(", ") || "–";
};

export const candidate_table = (found: Diagnosed, left_out: string, picture: string): TextTable => {
  const ranked = ranked_candidates(found);
  const decimals = decimals_of(found.rmse_um);
  return {
    title:
      "Candidates. * the best set, each beside the others. RMSE with it; held out: " +
      `${left_out} left out, before and after. Evidence: 2 ln of the likelihood ratio; needed: what 1 % of searches ` +
      "find by chance.",
    heading: [
      "candidate", "amplitude, µm", "RMSE, µm", "held out, µm", "evidence", "needed", "by chance", "beats fakes",
      "not told from",
    ],
    rows: ranked.map((one) => {
      const c = one.candidate;
      return [
        one.name,
        with_sigma(c.amplitude_um, c.amplitude_sigma_um, decimals),
        shown(c.rmse_after_um, decimals + 1),
        change(c.held_out_before_um, c.held_out_after_um, decimals),
        shown(c.evidence, 0),
        shown(c.evidence_needed, 0),
        chance_text(c.p_search),
        fakes_text(c.beats_fakes),
        not_told_from(one, ranked),
      ];
    }),
    choose: { picture, key: "candidate", values: ranked.map((one) => one.key) },
  };
};

export const companion_table = (found: Diagnosed, picture: string): TextTable => {
  const ranked = ranked_companions(found);
  const decimals = decimals_of(found.rmse_um);
  return {
    title: "It goes with. Each alone beside the model; that it goes with something is no proof of a cause.",
    heading: ["effect", "amplitude, µm", "RMSE, µm", "held out, µm"],
    rows: ranked.map(({ candidate: c }) => [
      plain(c.label, 60),
      with_sigma(c.amplitude_um, c.amplitude_sigma_um, decimals),
      change(found.rmse_um, c.rmse_after_um, decimals),
      change(c.held_out_before_um, c.held_out_after_um, decimals),
    ]),
    choose: { picture, key: "candidate", values: ranked.map((one) => one.key) },
  };
};
