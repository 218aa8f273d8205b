// The possibly missing effects, most probable first, each with a button that adds it. A selected row draws its curve.
import { button, details_of, element, kept_open } from "../elements/elements";
import { best_set, ranked_candidates } from "../diagnosis/ranking";
import { decimals_for, rmse_shown, shown, with_sigma } from "../drawing/theme";
import { can_be_typed, set_key } from "./runs";
import type { Candidate, Diagnosed, Num } from "../report";
import { plain } from "../drawing/text";
import { plain_name } from "../machine_errors/error_names";
import { t } from "../texts/texts";

const kFirst = 5; // the rest is opened if wanted

const can_be_added = ({ columns }: Candidate): boolean => can_be_typed(Object.values(columns));

interface Row {
  element: HTMLElement;
  effects: readonly string[];
}

// What is looked at first: the most probable, and the most probable set as one step, where it has several effects.
const set_labels = (found: Diagnosed): string[] => {
  const set = best_set(found);
  return set.length < 2 || !set.every(can_be_added) ? [] : set.map(({ label }) => label);
};
export const looked_at = (found: Diagnosed): string[][] => {
  const set = set_labels(found);
  return [...ranked_candidates(found).slice(0, kFirst).map(({ candidate }) => [candidate.label]), ...(set.length > 0 ? [set] : [])];
};

export interface CandidateList {
  element: HTMLElement;
  show(found: Diagnosed | null): void;
  promise(rmse_um: ReadonlyMap<string, number>): void; // what each would leave, by set_key
}

export const candidate_list = (
  unfolded: Set<string>,
  add: (effects: readonly string[]) => void,
  look: (candidate: Candidate | null) => void,
  opened: (effects: readonly (readonly string[])[]) => void, // beyond the first
): CandidateList => {
  const box = element("div", { class: "live-candidates" });
  let promises: { effects: readonly string[]; place: HTMLElement }[] = [];

  // The RMSE after adding effects, next to their "+".
  const promise_of = (effects: readonly string[]): HTMLElement => {
    const place = element("span", { class: "promise" }, "…");
    promises.push({ effects, place });
    return place;
  };

  const row_of = (candidate: Candidate, starred: boolean): Row => {
    const effects = [candidate.label];
    const plus = button("+", t.live_add_title({ effect: plain_name(candidate.label, 80) }), () => add(effects));
    plus.className = "plus";
    plus.setAttribute("aria-label", t.live_add_title({ effect: plain_name(candidate.label, 80) }));
    plus.disabled = !can_be_added(candidate);
    const bar = element("span", { class: "p" });
    bar.style.setProperty("--share", String(Math.min(1, Math.max(0, candidate.p ?? 0))));
    const decimals = decimals_for(candidate.amplitude_um, candidate.amplitude_sigma_um);
    const name = element("bdi", { title: plain(candidate.label, 200) }, `${plain_name(candidate.label, 60)}${starred ? " *" : ""}`);
    const figures = t.live_candidate({ p: shown(candidate.p, 2), amplitude: with_sigma(candidate.amplitude_um, candidate.amplitude_sigma_um, Math.min(3, decimals)) });
    const row = element("li", {}, plus, bar, name, element("span", { class: "figures" }, figures, ", ", promise_of(effects)));
    row.addEventListener("pointerenter", () => look(candidate));
    row.addEventListener("pointerleave", () => look(null));
    row.addEventListener("focusin", () => look(candidate));
    row.addEventListener("focusout", () => look(null));
    return { element: row, effects };
  };

  const set_of = (labels: readonly string[]): HTMLElement => {
    const plus = button(t.live_add_all, t.live_add_all_title({ effects: labels.map((label) => plain_name(label, 60)).join(", ") }), () => add(labels));
    plus.className = "plus-all";
    return element("p", { class: "all-of-these" }, plus, " ", promise_of(labels));
  };

  return {
    element: box,
    show(found) {
      promises = [];
      if (!found) return box.replaceChildren();
      const rows = ranked_candidates(found).map(({ candidate, starred }) => row_of(candidate, starred));
      const set = set_labels(found);
      const list = (some: readonly Row[]): HTMLElement => element("ul", {}, ...some.map((row) => row.element));
      const rest = rows.slice(kFirst);
      const more = kept_open(details_of("more", t.live_more_candidates({ count: rest.length }), list(rest)), "more", unfolded);
      more.addEventListener("toggle", () => opened(rest.map(({ effects }) => effects)), { once: true });
      box.replaceChildren(
        ...(rows.length > 0 ? [element("h3", {}, t.live_may_be_missing), list(rows.slice(0, kFirst))] : []),
        ...(set.length > 0 ? [set_of(set)] : []),
        ...(rest.length > 0 ? [more] : []),
      );
    },
    promise(rmse_um) {
      for (const { effects, place } of promises) {
        const known = rmse_um.get(set_key(effects));
        if (known === undefined) continue;
        place.textContent = t.live_promise({ rmse: rmse_shown(known) });
        place.dataset.rmse = rmse_shown(known);
      }
    },
  };
};

// The probability of each effect so far in the search, from JSON lines of the program.

const kBars = 6;

export interface Posterior {
  posterior: { label: string; p: number }[];
  p_nothing: number;
}

export const posterior_in = (line: string): Posterior | null => {
  if (!line.startsWith("{")) return null;
  try {
    const read = JSON.parse(line) as Partial<Posterior>;
    return Array.isArray(read.posterior) ? { posterior: read.posterior, p_nothing: Number(read.p_nothing ?? 0) } : null;
  } catch {
    return null; // half a line
  }
};

const bar_of = (label: string, p: number): HTMLElement => {
  const bar = element("span", { class: "p" });
  bar.style.setProperty("--share", String(Math.min(1, Math.max(0, p))));
  return element("li", {}, bar, element("bdi", { title: plain(label, 200) }, plain_name(label, 60)), element("span", { class: "number" }, shown(p, 2)));
};

export const posterior_bars = (): { element: HTMLElement; show(now: Posterior | null): void } => {
  const list = element("ul", { class: "live-posterior", "aria-label": t.live_posterior });
  return {
    element: list,
    show(now) {
      const most = [...(now?.posterior ?? [])].sort((a, b) => b.p - a.p).slice(0, kBars);
      list.replaceChildren(...(now ? [...most.map(({ label, p }) => bar_of(label, p)), bar_of(t.live_nothing_missing, now.p_nothing)] : []));
      list.hidden = now === null;
    },
  };
};

// The error now and before the last change.

export interface Fall {
  element: HTMLElement;
  show(of: { before: Num; now: Num; floor: Num; moved: boolean }): void;
}

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
      const most = Math.max(before ?? 0, value ?? 0) || 1;
      now.textContent = t.live_rmse({ value: rmse_shown(value) });
      comparison.textContent = [
        ...(before === null ? [] : [moved ? t.live_rmse_at_optimum({ value: rmse_shown(before) }) : t.live_rmse_before({ value: rmse_shown(before) })]),
        ...(floor === null ? [] : [t.live_floor({ value: rmse_shown(floor) })]),
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
