// The verdict of a diagnosis in sentences of the page's language, of what the program found. In English they are the
// program's own. What was not used is said first, a slow drift without a cause last.
import { parameter_name, plain_name } from "../machine_errors/error_names";
import { end_name, place_name } from "../model/model_tables";
import { micrometres, plain } from "../drawing/text";
import type { Bound, Candidate, Checked, Diagnosed, Num } from "../report";
import { own_text } from "./diagnosis_tables";
import { rounded, shown } from "../drawing/theme";
import { english, language, named, said, type Sentence, sentence_text, t, together } from "../texts/texts";

const kMost_effects = 4; // effects in a sentence
const kMost_open = 2; // effects that are open, a sentence each
const kMost_likely = 2; // columns that may drive
const kOwn = 0.5; // P of a value of the model's own that is said

type Misfit = Checked["where"][number];

// As in the program's sentence.
const kSure_driver = 0.9; // P
const kSlow = 0.5; // P of a slow drift without a cause from which it is said
const kNothing = 0.5; // P of nothing: what is unexplained all the same is more than the stated sigma of the readings

const same = (a: Bound, b: Bound): boolean =>
  a.effect === b.effect && JSON.stringify(a.columns) === JSON.stringify(b.columns);

const columns_text = (columns: readonly string[]): string => {
  const all = columns.map((column) => plain(column, 60));
  const [last = "", ...before] = [...all].reverse();
  return before.length === 0 ? last : t.a_and_b({ a: before.reverse().join(", "), b: last });
};

// "4.8", "130"
const size_text = (size_um: number): string => (Math.abs(size_um) < 99.5 ? rounded(size_um, 2) : shown(size_um, 0));

const percent_text = (p: number): string => (p >= 0.995 ? t.sure_over : p < 0.005 ? t.sure_under : `${shown(100 * p, 0)} %`);

// "98 % sure"
const p_text = (p: Num): string => (p === null ? "–" : t.sure_text({ percent: percent_text(p) }));

// "2 h 11 min"
const duration_text = (time_s: number): string => {
  if (time_s < 60) return `${shown(time_s, 0)} s`;
  const [large, small, of] = time_s < 3600 ? (["min", "s", 60] as const) : (["h", "min", 3600] as const);
  const rest = Math.round((time_s % of) / (of / 60));
  return rest === 0 || rest === 60 ? `${Math.round(time_s / of)} ${large}` : `${Math.floor(time_s / of)} ${large} ${rest} ${small}`;
};

// ", time constant 2 h 11 min"
const time_text = (candidate: Candidate | undefined): string => {
  const time = candidate?.parameters.find(({ name, unit, sigma }) => unit === "s" && name.startsWith("time_constant") && sigma !== null);
  return time && time.value !== null ? t.diagnosis_time_constant({ name: parameter_name(time.name), duration: duration_text(time.value) }) : "";
};

const kWorth_it = 0.1; // share of the misfit above that of the readings from which a place is said, as in the program

// Where the model fails most; "": nowhere more than elsewhere.
export const place_sentence = ({ where, n }: Pick<Checked, "where" | "n">): string => {
  const above = (one: Misfit): number => (one.share ?? 0) - one.n / n;
  const worst = [...where].sort((a, b) => above(b) - above(a))[0];
  if (!worst || above(worst) < kWorth_it) return "";
  if (worst.what === "regime") return t.diagnosis_fails_most({ place: t.diagnosis_place_regime({ regime: end_name(worst.from) }) });
  const [from, to] = [end_name(worst.from), end_name(worst.to)];
  const range = from === to ? from : t.diagnosis_place_range({ from, to });
  return t.diagnosis_fails_most({ place: worst.what === "time" ? range : t.diagnosis_place_of({ what: plain(place_name(worst.what), 50), range }) });
};

// What was not used: columns, rows, readings, and jumps of the target.
const not_used_sentences = (found: Diagnosed): string[] => {
  const target = plain(found.target, 60);
  return [
    ...found.columns_not_searched.map(({ column, why, why_message }) =>
      t.diagnosis_says_column_not_searched({ column: plain(column, 60), why: sentence_text(said(why, why_message)) }),
    ),
    ...found.saturated.map(({ column, share }) =>
      t.diagnosis_says_saturated({ column: plain(column, 60), percent: percent_text(share ?? 0) }),
    ),
    ...(found.set_aside > 0 ? [t.diagnosis_says_set_aside({ n: found.set_aside })] : []),
    ...(found.level_jumps > 0 ? [t.diagnosis_says_jumps({ target, n: found.level_jumps, size: size_text(found.level_jump_um ?? 0) })] : []),
  ];
};

const has_slow_drift = ({ discrepancy_um, p_discrepancy }: Diagnosed): boolean => (discrepancy_um ?? 0) > 0 && (p_discrepancy ?? 0) >= kSlow;

// " (like settling, time constant 1 h 20 min)"; the effects of time alone have a period or a time constant.
const like_text = ({ discrepancy_like: like, discrepancy_time_s }: Diagnosed): string => {
  if (like === "") return "";
  const effect = language === "en" ? plain(like, 60) : named(t.effects, like);
  const name = parameter_name(like.endsWith("_cycle") ? "period" : "time_constant");
  const duration = duration_text(discrepancy_time_s ?? 0);
  return t.diagnosis_says_like({ effect, time: (discrepancy_time_s ?? 0) > 0 ? t.diagnosis_time_constant({ name, duration }) : "" });
};

const slow_sentence = (found: Diagnosed): string =>
  t.diagnosis_says_slow({ target: plain(found.target, 60), size: size_text(found.discrepancy_um ?? 0), like: like_text(found) });

const likely_sentences = ({ drivers }: Diagnosed): string[] => {
  const likely = drivers.slice(0, kMost_likely).map(({ column, p }) => t.diagnosis_says_effect({ effect: plain(column, 60), size: "", p: percent_text(p ?? 0) }));
  return likely.length === 0 ? [] : [t.diagnosis_says_likely({ columns: likely.join(", ") })];
};

// No larger than what all explain together: another effect may cancel a part of it.
const said_um = ({ explained_um }: Diagnosed, amplitude_um: Num): number =>
  Math.min(amplitude_um ?? 0, (explained_um ?? 0) > 0 ? (explained_um ?? 0) : Infinity);

const size_of = (found: Diagnosed, amplitude_um: Num): string => {
  const size_um = said_um(found, amplitude_um);
  return size_um > 0 ? size_text(size_um) : "";
};

const known_of = ({ candidates, effects }: Diagnosed, bound: Bound): { candidate?: Candidate; label: string; p: Num } => {
  const candidate = candidates.find((one) => same(one, bound));
  const effect = effects.find((one) => same(one, bound));
  return { candidate, label: effect?.label ?? candidate?.label ?? bound.effect, p: effect?.p ?? candidate?.p ?? null };
};

const effect_text = (found: Diagnosed, bound: Bound): string => {
  const { candidate, label, p } = known_of(found, bound);
  const size = size_of(found, candidate?.amplitude_um ?? null);
  return t.diagnosis_says_effect({ effect: plain_name(label, 90), size, p: p_text(p) }) + time_text(candidate);
};

// The likeliest of a group, "X (65 %) or one of 3 more"; "": there is none.
const group_text = (found: Diagnosed, group: readonly Bound[] = []): string => {
  const [bound] = group;
  if (!bound) return "";
  const { label, p } = known_of(found, bound);
  const effect = t.diagnosis_says_effect({ effect: plain_name(label, 90), size: "", p: percent_text(p ?? 0) });
  return t.diagnosis_says_group({ effect, others: group.length - 1 });
};

const open_sentences = (found: Diagnosed, first: number): string[] =>
  found.equivalent.slice(first, kMost_open).map((group) => t.diagnosis_says_open({ group: group_text(found, group) }));

const effects_text = (found: Diagnosed, bounds: readonly Bound[]): string => {
  const first = bounds.slice(0, kMost_effects).map((bound) => effect_text(found, bound));
  return [...first, ...(bounds.length > kMost_effects ? [t.diagnosis_more({ more: bounds.length - kMost_effects })] : [])].join("; ");
};

const own_sentences = (found: Diagnosed): string[] =>
  (has_slow_drift(found) ? [] : found.own)
    .filter(({ p }) => (p ?? 0) >= kOwn)
    .map((own) => t.diagnosis_says_own({ own: own_text(own), p: p_text(own.p) }));

const driver_sentence = (found: Diagnosed): string => {
  const drivers = found.drivers.filter(({ p, is_clear }) => (p ?? 0) >= kSure_driver && is_clear);
  const names = drivers.map(({ column }) => column);
  const sizes = found.candidates
    .filter(({ in_best_set, columns }) => in_best_set && Object.values(columns).some((column) => names.includes(column)))
    .map(({ amplitude_um }) => said_um(found, amplitude_um));
  const size_um = Math.max(0, ...sizes);
  return t.diagnosis_says_driver({
    target: found.target,
    columns: columns_text(names),
    size: size_um > 0 ? size_text(size_um) : "",
    p: p_text(Math.min(...drivers.map(({ p }) => p ?? 0))),
    form: group_text(found, found.equivalent[0]),
  });
};

const unexplained_sentences = (found: Diagnosed): string[] => {
  const { target, candidates, p_nothing, rmse_um, drivers } = found;
  if (has_slow_drift(found)) return [slow_sentence(found), t.diagnosis_says_log_more, ...likely_sentences(found)];
  if (found.level_jumps > 0) return [t.diagnosis_says_jumps_alone];
  if ((p_nothing ?? 0) >= kNothing) return [t.diagnosis_says_rest({ target })];
  const of_time = candidates.filter(({ in_best_set, columns }) => in_best_set && Object.keys(columns).length === 0);
  if (of_time.length > 0 && drivers.length === 0) {
    return [t.diagnosis_says_of_time({ target, effects: of_time.map((one) => effect_text(found, one)).join("; ") })];
  }
  const [first] = candidates;
  const best = first ? t.diagnosis_says_effect({ effect: plain_name(first.label, 90), size: "", p: percent_text(first.p ?? 0) }) : "";
  return [
    t.diagnosis_says_unexplained({ target, p: p_text(p_nothing === null ? null : 1 - p_nothing), rmse: size_text(rmse_um ?? 0) }),
    ...(drivers.length > 0 ? likely_sentences(found) : best === "" ? [] : [t.diagnosis_says_not_proven({ effect: best })]),
  ];
};

const in_the_language = (found: Diagnosed): string[] => {
  const { target, verdict, p_nothing, hidden_um } = found;
  const probable = found.probable.length > 0 ? [t.diagnosis_says_probable({ target, effects: effects_text(found, found.probable) })] : [];
  switch (verdict) {
    case "named": {
      const lacks = found.named.length > 0 ? [t.diagnosis_says_named({ target, effects: effects_text(found, found.named) })] : [];
      return [...lacks, ...own_sentences(found), ...probable, ...open_sentences(found, 0)];
    }
    case "probable":
      return [...probable, ...own_sentences(found), ...open_sentences(found, 0)];
    case "driver":
      return [driver_sentence(found), ...open_sentences(found, 1)];
    case "equivalent": {
      const p = p_text(p_nothing === null ? null : 1 - p_nothing); // of anything
      return [t.diagnosis_says_equivalent({ target, effects: effects_text(found, found.equivalent.flat()), p }), ...likely_sentences(found)];
    }
    case "unexplained":
      return unexplained_sentences(found);
    case "untestable":
      return [t.diagnosis_says_untestable];
    case "nothing":
      return [
        t.diagnosis_says_nothing({ target, p: p_text(p_nothing) }),
        ...((hidden_um ?? 0) > 0 ? [t.diagnosis_says_hidden({ size: size_text(hidden_um ?? 0) })] : []),
      ];
  }
};

export interface Said {
  before: readonly string[]; // what was not used, in sentences
  verdict: Sentence; // and all that follows
  also: string; // of that, about a slow drift: its size, or where it is the verdict, what to do; "": there is none
}

// checked: where the model fails, which is said too.
export const said_of = (found: Diagnosed, checked?: Checked | null): Said => {
  const before = not_used_sentences(found);
  const slow = has_slow_drift(found) ? slow_sentence(found) : "";
  const is_verdict = found.verdict === "unexplained";
  const also = slow === "" ? "" : is_verdict ? t.diagnosis_says_log_more : slow;
  if (language === "en") {
    const whole = micrometres(found.sentence);
    const first = before.map((one) => `${one} `).join("");
    return whole.startsWith(first) ? { before, verdict: english(whole.slice(first.length)), also } : { before: [], verdict: english(whole), also };
  }
  const place = checked && found.verdict !== "nothing" && found.verdict !== "untestable" ? place_sentence(checked) : "";
  const beside = slow === "" || is_verdict ? [] : [slow, t.diagnosis_says_log_more];
  return { before, verdict: together([...in_the_language(found), place, ...beside]), also };
};

// All of it in one paragraph, as on the terminal.
export const verdict_of = (found: Diagnosed, checked?: Checked | null): Sentence => {
  if (language === "en") return english(found.sentence);
  const { before, verdict } = said_of(found, checked);
  return together([...before, sentence_text(verdict)]);
};
