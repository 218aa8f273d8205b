// What must be said beside every falling error.
import type { Step } from "./waterfall";
import { fake_um } from "./waterfall";

export const no_evidence =
  "A falling error alone is no evidence: what counts is that it falls below the line of the best fake, a random curve " +
  "as smooth that has no cause.";

// "Not known: the floor; ..." of what no step has; empty where all is known.
export const not_known = (steps: readonly Step[]): string => {
  const changed = steps.filter((step) => step.from_um !== null);
  const missing = [
    ...(steps.some((step) => step.floor_um !== null) ? [] : ["the floor"]),
    ...(changed.length === 0 || changed.some((step) => fake_um(step) !== null) ? [] : ["what a fake would have bought"]),
    ...(steps.some((step) => step.held_out_um !== null) ? [] : ["the error of what was left out"]),
  ];
  return missing.length > 0 ? ` Not known: ${missing.join("; ")}.` : "";
};
