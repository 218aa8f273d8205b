// What may be missing, most probable first; one button adds it. A row that is looked at draws its curve.
import { button, element } from "../elements/elements";
import { ranked_candidates } from "../diagnosis/ranking";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import type { Candidate, Diagnosed, Num } from "../report";
import { plain } from "../drawing/text";
import { plain_name } from "../machine_errors/error_names";
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
    const plus = button("+", t.live_add_title({ effect: plain_name(candidate.label, 80) }), () => add(candidate));
    plus.className = "plus";
    plus.setAttribute("aria-label", t.live_add_title({ effect: plain_name(candidate.label, 80) }));
    plus.disabled = !can_be_typed(candidate);
    const bar = element("span", { class: "p" });
    bar.style.setProperty("--share", String(Math.min(1, Math.max(0, candidate.p ?? 0))));
    const decimals = decimals_for(candidate.amplitude_um, candidate.amplitude_sigma_um);
    const name = element("bdi", { title: plain(candidate.label, 200) }, `${plain_name(candidate.label, 60)}${starred ? " *" : ""}`);
    const figures = t.live_candidate({ p: shown(candidate.p, 2), amplitude: with_sigma(candidate.amplitude_um, candidate.amplitude_sigma_um, Math.min(3, decimals)), rmse: `${shown(rmse_um, 2)} → ${shown(candidate.rmse_after_um, 2)}` });
    const row = element("li", {}, plus, bar, name, element("span", { class: "figures" }, figures));
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

// How probable each effect is as far as the search has come. The program tells it in lines of JSON.

const kBars = 6;

interface Posterior {
  posterior: { label: string; p: number }[];
  p_nothing: number;
}

const posterior_in = (line: string): Posterior | null => {
  if (!line.startsWith("{")) return null;
  try {
    const read = JSON.parse(line) as Partial<Posterior>;
    return Array.isArray(read.posterior) ? { posterior: read.posterior, p_nothing: Number(read.p_nothing ?? 0) } : null;
  } catch {
    return null; // half a line
  }
};

export const bar_of = (label: string, p: number): HTMLElement => {
  const bar = element("span", { class: "p" });
  bar.style.setProperty("--share", String(Math.min(1, Math.max(0, p))));
  return element("li", {}, bar, element("bdi", { title: plain(label, 200) }, plain_name(label, 60)), element("span", { class: "number" }, shown(p, 2)));
};

export interface PosteriorBars {
  element: HTMLElement;
  tell(line: string): void;
  clear(): void;
}

export const posterior_bars = (): PosteriorBars => {
  const list = element("ul", { class: "live-posterior", "aria-label": t.live_posterior });
  list.hidden = true;
  return {
    element: list,
    tell(line) {
      const now = posterior_in(line);
      if (!now) return;
      const most = [...now.posterior].sort((a, b) => b.p - a.p).slice(0, kBars);
      list.replaceChildren(...most.map(({ label, p }) => bar_of(label, p)), bar_of(t.live_nothing_missing, now.p_nothing));
      list.hidden = false;
    },
    clear() {
      list.hidden = true;
      list.replaceChildren();
    },
  };
};

// How large the error is now, and was before the last change.

export interface Fall {
  element: HTMLElement;
  show(of: { before: Num; now: Num; floor: Num; moved: boolean }): void;
}

const decimals_of = (value: Num): number => (value !== null && value > 0 ? Math.min(4, Math.max(2, 2 - Math.floor(Math.log10(value)))) : 2);

export const fall_shown = (): Fall => {
  const now = element("strong", { class: "rmse" });
  const comparison = element("span", { class: "beside" });
  const bar_before = element("span", { class: "bar before" });
  const bar_now = element("span", { class: "bar now" });
  const mark = element("span", { class: "bar floor" });
  const all = element("div", { class: "live-fall" }, now, comparison, element("div", { class: "bars", "aria-hidden": "true" }, bar_before, bar_now, mark));
  return {
    element: all,
    show({ before, now: value, floor, moved }) {
      const decimals = decimals_of(value);
      const most = Math.max(before ?? 0, value ?? 0) || 1;
      now.textContent = t.live_rmse({ value: shown(value, decimals) });
      comparison.textContent = [
        ...(before === null ? [] : [moved ? t.live_rmse_at_optimum({ value: shown(before, decimals) }) : t.live_rmse_before({ value: shown(before, decimals) })]),
        ...(floor === null ? [] : [t.live_floor({ value: shown(floor, decimals) })]),
      ].join(", ");
      bar_before.hidden = before === null;
      mark.hidden = floor === null;
      all.dataset.beside = before === null ? "nothing" : moved ? "optimum" : "before";
      bar_before.style.setProperty("--share", String((before ?? 0) / most));
      bar_now.style.setProperty("--share", String((value ?? 0) / most));
      mark.style.setProperty("--share", String(Math.min(1, (floor ?? 0) / most)));
    },
  };
};
