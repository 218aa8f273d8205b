// Results of the program: the keys of its `--json`. Written by tests/apps/result_keys from their lists of fields.

export type Num = number | null; // null: not known

// Which effect a model lacks.
export interface Diagnosed {
  target: string; // column that is explained
  rmse_um: Num; // that the model leaves
  floor_um: Num; // that no model could explain; null: not known
  floor_source: string; // what tells the floor
  n: number; // readings
  n_effective: Num; // independent readings that they are worth
  adequate: boolean; // whether the model leaves noise alone
  where: Misfit[]; // where it fails
  parameters: FittedParameter[];
  correlation: Num[][]; // of the parameters, row by row
  noise: Noise; // of the residual
  whiteness: Whiteness;
  sentences: string[]; // how far from the floor, where worst, what is left
  converged: boolean; // whether the fit came to an end
  remarks: string[];
  verdict: string; // named, probable, driver, equivalent, unexplained, untestable, nothing
  sentence: string; // what it says in plain words
  command: string; // to type next; empty: none
  named: Bound[]; // that are missing
  probable: Bound[]; // that are probably missing
  equivalent: Bound[][]; // sets, of each of which one may be missing, the likeliest first
  drivers: Driver[]; // from p = 0.5 on
  own: OwnValue[]; // values that the model holds and that may be others, from p = 0.05 on
  effects: EffectProbability[]; // from p = 0.01 on
  p_nothing: Num; // probability that nothing is missing
  p_discrepancy: Num; // probability of a slow curve without a cause
  discrepancy_um: Num; // its standard deviation
  candidates: Candidate[]; // the likeliest set, then others by probability
  stand_ins: StandIn[]; // effects added earlier that others explain better
  hidden_um: Num; // amplitude up to which an effect could hide in these data
  untestable: Untestable[]; // effects that these data cannot show
  not_searched: NotSearched[]; // effects with more choices of columns than were searched
  reasons: string[]; // why it is not named, or not all of it
  gains_by_run: GainByRun[]; // of several runs: gains that differ
  next_test: DecidingTest | null; // that would decide; null: nothing is open
}

// Some of the readings, and how the model fails there.
export interface Misfit {
  what: string; // what they have in common: regime, time, a column
  from: string; // as printed, with unit; a name: also in `to`
  to: string;
  n: number; // readings
  bias_um: Num; // mean residual
  bias_sigma_um: Num; // of that mean, the noise's memory included
  rmse_um: Num; // root of the mean square of the residual
  share: Num; // of the sum of squares of all readings
}

// A parameter of a model, fitted or held.
export interface FittedParameter {
  effect: string; // the effect with its columns, or constant
  name: string; // with its unit
  value: Num;
  sigma: Num; // null: held, on a bound, or not determined
  unit: string;
  state: string; // free, held, on lower bound, on upper bound, undetermined
}

// Noise of the readings: a white part, and one with a memory.
export interface Noise {
  white_um: Num; // standard deviation from reading to reading
  correlated_um: Num; // standard deviation of the part with a memory; 0: none
  correlation_time_s: Num; // in which its memory falls to 1/e
}

// Whether what the model leaves is noise alone.
export interface Whiteness {
  autocorrelation: Num[]; // of the residual, from lag 1 on
  periodogram_distance: Num; // of the cumulated periodogram of the whitened residual to that of white noise
  p: Num; // of a distance as large by chance
}

// An effect on columns of the data.
export interface Bound {
  effect: string; // as `ballbar effects` lists it
  columns: Record<string, string>; // by role
}

// A column that drives what is missing, whatever its form.
export interface Driver {
  column: string;
  p: Num; // probability
}

// A value that the model holds, and that may be another one.
export interface OwnValue {
  effect: string; // of the model, with its columns
  parameter: string;
  unit: string;
  held: Num; // as the model has it
  fitted: Num; // as the data have it
  low: Num; // of the interval of 95 %
  high: Num;
  p: Num; // probability that it is another one
}

// An effect, and the probability that it is missing.
export interface EffectProbability {
  effect: string; // as `ballbar effects` lists it
  columns: Record<string, string>; // by role
  p: Num; // probability
}

// An effect that may be missing, beside the rest of its likeliest set.
export interface Candidate {
  effect: string; // as `ballbar effects` lists it
  columns: Record<string, string>; // by role
  p: Num; // probability that it is missing
  likelihood_ratio: Num; // 2 ln of how much likelier the readings are with it than without
  amplitude_um: Num; // largest less smallest of what it adds
  amplitude_sigma_um: Num; // null: not determined
  rmse_after_um: Num; // that the model leaves with it
  held_out_before_um: Num; // error in cycles left out, without it
  held_out_after_um: Num; // error in cycles left out, with it
  p_same_gain: Num; // of gains as different from cycle to cycle, by chance
  beats_surrogates: boolean | null; // whether it does better than random curves of its kind; null: not tested
  in_best_set: boolean; // whether it is of the likeliest set
  minor: boolean; // whether it is too small to matter
  doubts: string[]; // why it is not named
  inseparable_from: string[]; // effects that these data do not tell from it
  parameters: CandidateParameter[];
}

// A parameter of a candidate.
export interface CandidateParameter {
  name: string; // with its unit
  value: Num;
  sigma: Num; // null: not determined
  low: Num; // of the interval of 95 %
  high: Num;
  unit: string;
}

// An effect added earlier that others explain better.
export interface StandIn {
  effect: string;
  by: string; // the others
  command: string; // that replaces it
}

// An effect that these data cannot show.
export interface Untestable {
  effect: string;
  why: string;
}

// An effect with more choices of columns than were searched.
export interface NotSearched {
  effect: string;
  choices_of_columns: number;
  searched: number; // of these
}

// A gain that is another one from run to run.
export interface GainByRun {
  effect: string; // with its columns
  parameter: string;
  unit: string;
  p: Num; // of gains as different, were it one gain
  runs: GainOfRun[]; // the gain in each
}

// A gain in one run.
export interface GainOfRun {
  gain: Num;
  sigma: Num;
}

// The test that would decide.
export interface DecidingTest {
  text: string; // what to do
  separation?: Num; // of recordings: d of the two that are hardest to tell
  command?: string; // of a series: that plans it
}

// A model fitted, and where it fails.
export interface Checked {
  target: string; // column that is explained
  rmse_um: Num; // that the model leaves
  floor_um: Num; // that no model could explain; null: not known
  floor_source: string; // what tells the floor
  n: number; // readings
  n_effective: Num; // independent readings that they are worth
  adequate: boolean; // whether the model leaves noise alone
  where: Misfit[]; // where it fails
  parameters: FittedParameter[];
  correlation: Num[][]; // of the parameters, row by row
  noise: Noise; // of the residual
  whiteness: Whiteness;
  sentences: string[]; // how far from the floor, where worst, what is left
  converged: boolean; // whether the fit came to an end
  remarks: string[];
}

