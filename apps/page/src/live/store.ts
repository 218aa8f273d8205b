// The state of the interactive model, as signals, and what follows from it. Actions write it (loop.ts), views show it
// (loop_view.ts).
import { computed, type ReadonlySignal, signal } from "@preact/signals-core";
import { next_action_of } from "../diagnosis/next_action";
import { verdict_of } from "../diagnosis/verdict";
import { verdict_of as verdict_of_check } from "../model/model";
import type { Candidate, Checked, Diagnosed, HypothesesPart, Report } from "../report";
import { plain_name } from "../machine_errors/error_names";
import { type Sentence, t } from "../texts/texts";
import type { Posterior } from "./candidates";
import type { Catalogue } from "./catalogue";
import { steps_kept, type Values } from "./history_of_steps";
import { type EffectChoice, type PlannedFiles, set_key, type Subject } from "./runs";
import { free_parameters, gains_of, key_of, settings_of, slid } from "./slid";

export const of_target = <T extends { target: string }>(targets: readonly T[] | undefined, target: string): T | undefined =>
  targets?.find((one) => one.target === target) ?? targets?.[0];

// A value that holds for one fit or one diagnosis; of another it is `none`.
interface While<Whole, Value> {
  now: ReadonlySignal<Value>;
  set(value: Value, of?: Whole): void; // of: the present one
}
const while_of = <Whole, Value>(whole: ReadonlySignal<Whole>, none: Value): While<Whole, Value> => {
  const stated = signal({ of: whole.peek(), value: none });
  return {
    now: computed(() => (stated.value.of === whole.value ? stated.value.value : none)),
    set(value, of = whole.peek()) {
      stated.value = { of, value };
    },
  };
};

// What was not done, or only tried, and may be done all the same.
export interface Refusal {
  sentence(): Sentence; // in the page's language
  effects: readonly string[];
  tried: boolean;
}

export type Search = "" | "running" | "done" | "stopped" | "failed";

export type Store = ReturnType<typeof store_of>;

export const store_of = (first: Subject, catalogue: Catalogue) => {
  const subject = signal(first);
  const report = signal<Report | null>(null);
  const fitted = computed((): Checked | null => of_target(report.value?.check?.targets, subject.value.target) ?? null);
  const found = computed((): Diagnosed | null => {
    const diagnosed = of_target(report.value?.diagnose?.targets, subject.value.target);
    return diagnosed && diagnosed.not_diagnosed === undefined ? diagnosed : null;
  });

  // Sliders: those that are away from the fit, and what the program computed with them there.
  const moved = while_of<Checked | null, Values>(fitted, new Map());
  const computed_there = while_of<Checked | null, Checked | null>(fitted, null);
  const free = computed(() => (fitted.value ? free_parameters(fitted.value, catalogue) : []));
  const gains = computed(() => (fitted.value ? gains_of(fitted.value, catalogue) : new Set<string>()));
  const values = computed(() => new Map(free.value.map((one) => [key_of(one), moved.now.value.get(key_of(one)) ?? one.value ?? 0])));
  const settings = computed(() => (fitted.value ? settings_of(fitted.value, free.value, values.value, gains.value) : []));
  const drawn = computed(() => {
    const base = settings.value.length > 0 ? (computed_there.now.value ?? fitted.value) : fitted.value;
    return base && slid(base, values.value, gains.value);
  });

  // The RMSE that each set of effects would leave, by set_key; in the table of candidates too.
  const promised = while_of<Diagnosed | null, ReadonlyMap<string, number>>(found, new Map());
  const report_shown = computed((): Report | null => {
    const [of, rmse_um] = [report.value, promised.now.value];
    if (!of?.diagnose || rmse_um.size === 0) return of;
    const with_rmse = (target: Diagnosed): Diagnosed => ({
      ...target,
      candidates: target.candidates.map((one) => ({ ...one, rmse_after_um: rmse_um.get(set_key([one.label])) ?? one.rmse_after_um })),
    });
    return { ...of, diagnose: { targets: of.diagnose.targets.map((target) => (target === found.value ? with_rmse(target) : target)) } };
  });

  // What a search has found so far: its likeliest effect; null: nothing is likelier than that nothing is missing.
  const posterior = signal<Posterior | null>(null);
  const likeliest = computed((): string | null => {
    const { posterior: all = [], p_nothing = 0 } = posterior.value ?? {};
    const [first] = [...all].sort((a, b) => b.p - a.p);
    return first && first.p > p_nothing ? first.label : null;
  });
  const search = signal<Search>("");

  const steps = steps_kept();
  const told = signal<(() => Sentence) | null>(null); // by the last step, in the page's language; null: the verdict is shown
  const revisions = computed(() => report.value?.ledger?.rows.filter(({ target }) => target === subject.value.target || subject.value.target === "").length ?? 0);
  return {
    subject, report, report_shown, fitted, found,
    moved, computed_there, free, settings, drawn, promised, posterior, search, steps, told, revisions,
    before: while_of<Checked | null, Checked | null>(fitted, null), // the last change
    candidate: while_of<Diagnosed | null, Candidate | null>(found, null), // that is looked at
    choices: while_of<Checked | null, readonly EffectChoice[] | null>(fitted, null), // what could be added
    next: computed(() => found.value && next_action_of(found.value)),
    refusal: while_of<Diagnosed | null, Refusal | null>(found, null),
    gap_s: signal(0), // the longest, where it is too long to be interpolated; 0: it is not asked for
    took_ms: signal(0), // the last search
    // The plan of the next test, or why there is none.
    plan: while_of<Diagnosed | null, PlannedFiles | (() => string) | null>(found, null),
    plan_hours: signal(12),
    planning: signal(false),
    unfolded: new Set<string>(),
    word: signal(""), // by which an effect is looked for
    // Two hypotheses: those that are asked for beside the candidates, the two that are chosen, and both as fitted.
    set_beside: while_of<Checked | null, { labels: readonly string[]; chosen: readonly string[] }>(fitted, { labels: [], chosen: [] }),
    both: while_of<Checked | null, HypothesesPart | null>(fitted, null),
    comparing: signal(false),
    busy: signal(0), // attempts at work, of which one may have begun within another
    trying: signal(false),
    can_undo: computed(() => steps.count() > 0 || revisions.value >= 2),
    sentence(): Sentence {
      if (told.value !== null) return told.value();
      if (search.value === "running" && likeliest.value !== null) return t.live_so_far({ effect: plain_name(likeliest.value, 80) });
      return !fitted.value ? "" : found.value ? verdict_of(found.value) : verdict_of_check(fitted.value);
    },
  };
};
