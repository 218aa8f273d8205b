// What may be missing, most probable first; one button adds it. A row that is looked at draws its curve.
import { button, element } from "../elements/elements";
import { ranked_candidates } from "../diagnosis/ranking";
import { with_sigma, decimals_for } from "../drawing/with_sigma";
import type { Candidate, Diagnosed } from "../report";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { t } from "../texts/texts";

const kFirst = 5; // the rest is opened if wanted

// A label that holds a comma within a column's name could not be typed.
const can_be_typed = ({ columns }: Candidate): boolean => Object.values(columns).every((column) => !column.includes(","));

export interface CandidateList {
  element: HTMLElement;
  show(found: Diagnosed): void;
  clear(): void;
}

export const candidate_list = (
  add: (candidate: Candidate) => void,
  look: (candidate: Candidate | null) => void,
): CandidateList => {
  const box = element("div", { class: "live-candidates" });

  const row_of = (candidate: Candidate, starred: boolean, rmse_um: number | null): HTMLElement => {
    const plus = button("+", t.live_add_title({ effect: plain(candidate.label, 80) }), () => add(candidate));
    plus.className = "plus";
    plus.setAttribute("aria-label", t.live_add_title({ effect: plain(candidate.label, 80) }));
    plus.disabled = !can_be_typed(candidate);
    const bar = element("span", { class: "p" });
    bar.style.setProperty("--share", String(Math.min(1, Math.max(0, candidate.p ?? 0))));
    const decimals = decimals_for(candidate.amplitude_um, candidate.amplitude_sigma_um);
    const name = element("bdi", {}, `${plain(candidate.label, 60)}${starred ? " *" : ""}`);
    const told = t.live_candidate({ p: shown(candidate.p, 2), amplitude: with_sigma(candidate.amplitude_um, candidate.amplitude_sigma_um, Math.min(3, decimals)), rmse: `${shown(rmse_um, 2)} → ${shown(candidate.rmse_after_um, 2)}` });
    const row = element("li", {}, plus, bar, name, element("span", { class: "figures" }, told));
    row.addEventListener("pointerenter", () => look(candidate));
    row.addEventListener("pointerleave", () => look(null));
    row.addEventListener("focusin", () => look(candidate));
    row.addEventListener("focusout", () => look(null));
    return row;
  };

  return {
    element: box,
    show(found) {
      const all = ranked_candidates(found);
      const rows = all.map(({ candidate, starred }) => row_of(candidate, starred, found.rmse_um));
      const first = element("ul", {}, ...rows.slice(0, kFirst));
      const rest = rows.slice(kFirst);
      box.replaceChildren(
        ...(rows.length > 0 ? [element("h3", {}, t.live_may_be_missing), first] : []),
        ...(rest.length > 0
          ? [element("details", {}, element("summary", {}, t.live_more_candidates({ count: rest.length })), element("ul", {}, ...rest))]
          : []),
      );
    },
    clear() {
      box.replaceChildren();
    },
  };
};
