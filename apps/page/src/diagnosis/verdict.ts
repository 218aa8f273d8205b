// The verdict of a diagnosis in one sentence of the page's language, of what the program found. In English it is the
// program's own.
import { parameter_name, plain_name } from "../machine_errors/error_names";
import { end_name, place_name } from "../model/model_tables";
import { plain } from "../drawing/text";
import type { Bound, Candidate, Checked, Diagnosed, Num } from "../report";
import { own_text } from "./diagnosis_tables";
import { rounded, shown } from "../drawing/theme";
import { english, language, type Sentence, t } from "../texts/texts";

const kMost_effects = 4; // effects in a sentence
const kOwn = 0.5; // P of a value of the model's own that is said

type Misfit = Checked["where"][number];

const kSure_driver = 0.9; // P, as in the program's sentence

const same = (a: Bound, b: Bound): boolean =>
  a.effect === b.effect && JSON.stringify(a.columns) === JSON.stringify(b.columns);

// "98 % sure"
const p_text = (p: Num): string => {
  if (p === null) return "–";
  const percent = p >= 0.995 ? t.sure_over : p < 0.005 ? t.sure_under : `${shown(100 * p, 0)} %`;
  return t.sure_text({ percent });
};

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

// No larger than what all explain together: another effect may cancel a part of it.
const effect_text = ({ candidates, effects, explained_um }: Diagnosed, bound: Bound): string => {
  const candidate = candidates.find((one) => same(one, bound));
  const effect = effects.find((one) => same(one, bound));
  const size_um = Math.min(candidate?.amplitude_um ?? 0, (explained_um ?? 0) > 0 ? (explained_um ?? 0) : Infinity);
  const size = size_um > 0 ? rounded(size_um, 2) : "";
  const label = effect?.label ?? candidate?.label ?? bound.effect;
  const p = p_text(effect?.p ?? candidate?.p ?? null);
  return t.diagnosis_says_effect({ effect: plain_name(label, 90), size, p }) + time_text(candidate);
};

const effects_text = (found: Diagnosed, bounds: readonly Bound[]): string => {
  const first = bounds.slice(0, kMost_effects).map((bound) => effect_text(found, bound));
  return [...first, ...(bounds.length > kMost_effects ? [t.diagnosis_more({ more: bounds.length - kMost_effects })] : [])].join("; ");
};

const own_sentences = (found: Diagnosed): string[] =>
  found.own
    .filter(({ p }) => (p ?? 0) >= kOwn)
    .map((own) => t.diagnosis_says_own({ own: own_text(own), p: p_text(own.p) }));

const in_the_language = (found: Diagnosed): string => {
  const { target, verdict, p_nothing } = found;
  const p = p_text(p_nothing === null ? null : 1 - p_nothing); // of anything
  switch (verdict) {
    case "named": {
      const lacks = found.named.length > 0 ? [t.diagnosis_says_named({ target, effects: effects_text(found, found.named) })] : [];
      return [...lacks, ...own_sentences(found)].join(" ");
    }
    case "probable": {
      const effects = effects_text(found, found.probable);
      return [...(effects === "" ? [] : [t.diagnosis_says_probable({ target, effects })]), ...own_sentences(found)].join(" ");
    }
    case "driver": {
      const sure = found.drivers.filter((one) => (one.p ?? 0) >= kSure_driver);
      const drivers = sure.length > 0 ? sure : found.drivers.slice(0, 1);
      const least = Math.min(...drivers.map((one) => one.p ?? 0));
      return t.diagnosis_says_driver({ target, column: drivers.map(({ column: name }) => name).join(", "), p: p_text(least) });
    }
    case "equivalent":
      return t.diagnosis_says_equivalent({ target, effects: effects_text(found, found.equivalent.flat()), p });
    case "unexplained": {
      const slow = (found.discrepancy_um ?? 0) > 0 ? rounded(found.discrepancy_um, 2) : "";
      return t.diagnosis_says_unexplained({ target, size: slow, p });
    }
    case "untestable":
      return t.diagnosis_says_untestable;
    case "nothing":
      return t.diagnosis_says_nothing({ target, p: p_text(p_nothing) });
  }
};

// checked: where the model fails, which is said too.
export const verdict_of = (found: Diagnosed, checked?: Checked | null): Sentence => {
  const own = language === "en" ? "" : in_the_language(found);
  if (own === "") return english(found.sentence);
  const place = checked && found.verdict !== "nothing" && found.verdict !== "untestable" ? place_sentence(checked) : "";
  return place === "" ? own : `${own} ${place}`;
};
