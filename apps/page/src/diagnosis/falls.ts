// What must be said beside every falling error.
import type { Num } from "../report";
import { surrogate_um, type Step } from "./step";

export const falling = "The error from step to step; a fall alone is no evidence.";

export const no_evidence =
  "What counts is that it falls below the line of the best surrogate, a random curve as smooth that has no cause.";

// Of `effects` that come together. The best surrogate of one of them begins at what the others leave, of which the RMSE
// is not told.
export const no_evidence_of_several = (effects: number, best_surrogate_fall: Num): string => {
  const up_to = best_surrogate_fall
    ? `: it took up to ${(100 * best_surrogate_fall).toFixed(0)} % off the RMSE that they leave`
    : "";
  return (
    "A random curve as smooth that has no cause lowers it too. Such a surrogate " +
    `stood in the place of one of the ${effects} effects, beside the others${up_to}. How low that is is not known, and ` +
    "no line is drawn."
  );
};

// " Not known: the floor; ..." of what no step has; empty where all is known. surrogates_told: surrogates count too.
export const not_known = (steps: readonly Step[], surrogates_told = true): string => {
  const changed = steps.filter((step) => step.from_um !== null);
  const surrogates_known = changed.length === 0 || changed.some((step) => surrogate_um(step) !== null);
  const missing = [
    ...(steps.some((step) => step.floor_um !== null) ? [] : ["the floor"]),
    ...(!surrogates_told || surrogates_known ? [] : ["what a surrogate would have bought"]),
    ...(steps.some((step) => step.held_out_um !== null) ? [] : ["the error of what was left out"]),
  ];
  return missing.length > 0 ? ` Not known: ${missing.join("; ")}.` : "";
};
