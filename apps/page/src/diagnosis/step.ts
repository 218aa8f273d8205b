// A step of a waterfall: the model at one revision, or as it would be with more effects.
import type { Num } from "../report";

// Null: not known.
export interface Step {
  label: string;
  short: string; // where there is little room
  rmse_um: Num;
  from_um: Num; // of the step before, where the two can be compared
  floor_um: Num;
  surrogate_fall: Num; // share of from_um that the best surrogate took off; null too where several effects were added
  held_out_um: Num;
  proposed: boolean; // not in the model
}

// What the best surrogate would have left.
export const surrogate_um = (step: Step): Num =>
  step.from_um === null || step.surrogate_fall === null ? null : step.from_um * (1 - step.surrogate_fall);
