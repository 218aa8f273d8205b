// What must be said beside every falling error.
import type { Num } from "../report";
import { surrogate_um, type Step } from "./step";
import { t } from "../texts/texts";
import { shown } from "../drawing/theme";

// Of `effects` that come together. The best surrogate of one of them begins at what the others leave, of which the RMSE
// is not told.
export const no_evidence_of_several = (effects: number, best_surrogate_fall: Num): string =>
  t.diagnosis_no_evidence_of_several({
    effects,
    percent: best_surrogate_fall ? shown(100 * best_surrogate_fall, 0) : "",
  });

// "Not known: the floor; ..." of what no step has; none where all is known. surrogates_told: surrogates count too.
export const not_known = (steps: readonly Step[], surrogates_told = true): string[] => {
  const changed = steps.filter((step) => step.from_um !== null);
  const surrogates_known = changed.length === 0 || changed.some((step) => surrogate_um(step) !== null);
  const missing = [
    ...(steps.some((step) => step.floor_um !== null) ? [] : [t.diagnosis_the_floor]),
    ...(!surrogates_told || surrogates_known ? [] : [t.diagnosis_the_surrogate]),
    ...(steps.some((step) => step.held_out_um !== null) ? [] : [t.diagnosis_the_left_out]),
  ];
  return missing.length > 0 ? [t.diagnosis_not_known({ missing: missing.join("; ") })] : [];
};
