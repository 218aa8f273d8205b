// The verdict of a diagnosis in one sentence of the page's language, of what the program found. In English it is the
// program's own.
import { typed_name } from "../machine_errors/error_names";
import type { Bound, Diagnosed, Num } from "../report";
import { own_text } from "./diagnosis_tables";
import { rounded, shown } from "../drawing/theme";
import { english, language, type Sentence, t } from "../texts/texts";

const kMost_effects = 4; // effects in a sentence
const kOwn = 0.5; // P of a value of the model's own that is said

const kSure_driver = 0.9; // P, as in the program's sentence

const same = (a: Bound, b: Bound): boolean =>
  a.effect === b.effect && JSON.stringify(a.columns) === JSON.stringify(b.columns);

const p_text = (p: Num): string => shown(p, 2);

const effect_text = ({ candidates, effects }: Diagnosed, bound: Bound): string => {
  const candidate = candidates.find((one) => same(one, bound));
  const effect = effects.find((one) => same(one, bound));
  const size_um = candidate?.amplitude_um ?? 0;
  const size = size_um > 0 ? rounded(size_um, 2) : "";
  const label = effect?.label ?? candidate?.label ?? bound.effect;
  return t.diagnosis_says_effect({ effect: typed_name(label, 90), size, p: p_text(effect?.p ?? candidate?.p ?? null) });
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

export const verdict_of = (found: Diagnosed): Sentence => {
  const own = language === "en" ? "" : in_the_language(found);
  return own === "" ? english(found.sentence) : own;
};
