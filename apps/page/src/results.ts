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

// Which effect a model of several targets lacks.
export interface DiagnosedTargets {
  targets: (Diagnosed | NotDiagnosed)[]; // of several targets, each as of one
}

// A target that could not be fitted.
export interface NotDiagnosed {
  target: string; // column
  not_diagnosed: string; // why
}

// The errors of a machine.
export interface RankedErrors {
  files: string[]; // of recordings
  plane: string; // XY, YZ, ZX
  nominal_length_mm: Num;
  recordings: DrivenRecording[];
  file?: TestFile; // what the only file states
  conclusion: string; // what it says in plain words
  verdict: string; // named, unexplained, nothing
  named: Bound[]; // errors that the test shows
  errors: MachineError[]; // by what mending them gains, then those of the circle
  one_by_one: AddedError[]; // the significant ones, each time that which leaves least
  circle_rms_um: Num; // that the circles alone leave
  circularity_um: Num; // largest less smallest reading about the fitted centre
  circularity_without_all_um: Num; // that remains once all significant errors are mended
  differences: string[]; // where ours and the instrument's values differ, and why
  residual_rms_um: Num; // that all errors leave
  repeatability_um: Num; // what of it is not the same in both directions; null: one direction
  noise: Noise; // of the readings
  left: LeftHarmonic | null; // a wave that no error explains; null: none
  left_text: string; // what the errors do not explain
  undetermined: string[]; // what the readings do not tell apart
  prior: PriorOfError[];
  tolerances: string[]; // pass or fail, a line each
  skipped: SkippedFile[]; // files that could not be read
  remarks: string[]; // of the readers
}

// A recording that the errors are from.
export interface DrivenRecording {
  direction: string; // CCW, CW
  arc_deg: Num;
  feed_mm_per_min: Num; // null: not known
  readings: number;
}

// What a file of an instrument states of its test.
export interface TestFile {
  test?: string; // its name
  machine?: string;
  operator?: string;
  comment?: string;
  ballbar?: string; // model of the instrument
  serial_number?: string; // of the ballbar
  last_calibrated?: string;
  calibrator_serial_number?: string;
  software?: string;
  software_version?: string;
  started_s?: number; // on the machine's clock, since 1970
  programmed_feed_mm_per_min?: Num;
}

// An error of the machine, ranked; or of the circle, which is not.
export interface MachineError {
  name: string; // squareness, backlash_a_pos, centre_a, ...
  value: Num;
  sigma: Num;
  unit: string; // um, um/m, ms
  as_instrument: InstrumentValue | null; // by the estimator of the instrument's software; null: it has no such error
  significant: boolean | null; // null, as all ranks: of the circle, which has none
  predicts_other_run: boolean | null; // whether its value from one run alone lowers what is left in the other
  individual_circularity_um: Num; // peak to peak of its own curve over all recordings
  share_percent: Num; // of the sum of these of all errors
  rank: number | null; // by what mending it gains, 1 the most; null: not significant, or the circularity stays
  stored: Num; // that the file has of it
  stored_is_same: boolean | null; // whether that is what the instrument's estimator says
  stored_rank: number | null;
  circularity_without_um: Num; // that remains if it is mended
  circularity_gain_um: Num; // circularity now less that
  circularity_gain_sigma_um: Num; // null: not asked for
  effect?: string; // as `ballbar effects` lists it
  stored_individual_circularity_um?: Num;
  p_value?: Num; // of noise that shows as much
  shape?: Num; // width of a spike, deg; pitch of a cyclic error, mm; null: none
  remedy?: string;
  in_the_model?: boolean; // with a model: whether it has this error
}

// An error as the software of the instrument has it.
export interface InstrumentValue {
  value: Num;
  individual_circularity_um: Num; // peak to peak of its own curve
  share_percent: Num; // of the sum of all it ranks
  rank: number | null; // 1: the largest circularity
}

// What is left once this error joins those before it.
export interface AddedError {
  effect: string;
  rms_um: Num;
}

// A wave that no error explains.
export interface LeftHarmonic {
  harmonic: number; // waves a turn
  recording: number; // in which it is largest
  peak_to_peak_um: Num;
  p_value: Num; // after the number of harmonics and recordings looked at
  in_both_directions: boolean;
}

// What an error is held to be before the readings speak.
export interface PriorOfError {
  name: string;
  value: Num;
  sigma: Num;
  unit: string;
  readings_alone: Num; // its value by the readings alone
  readings_alone_sigma: Num;
}

// A file that could not be read.
export interface SkippedFile {
  file: string;
  why: string; // a sentence with the file's name
}

// The errors of a machine from several planes or bars.
export interface RankedErrorsOfGroups {
  groups: MachineErrors[]; // of several planes or bars, each as the errors of one
  results_alone: StoredAlone[]; // files that store results without readings
  skipped: SkippedFile[]; // files that could not be read
  remarks: string[]; // of the readers
}

// The errors of a machine from recordings of one plane and one bar.
export interface MachineErrors {
  files: string[]; // of recordings
  plane: string; // XY, YZ, ZX
  nominal_length_mm: Num;
  recordings: DrivenRecording[];
  file?: TestFile; // what the only file states
  conclusion: string; // what it says in plain words
  verdict: string; // named, unexplained, nothing
  named: Bound[]; // errors that the test shows
  errors: MachineError[]; // by what mending them gains, then those of the circle
  one_by_one: AddedError[]; // the significant ones, each time that which leaves least
  circle_rms_um: Num; // that the circles alone leave
  circularity_um: Num; // largest less smallest reading about the fitted centre
  circularity_without_all_um: Num; // that remains once all significant errors are mended
  differences: string[]; // where ours and the instrument's values differ, and why
  residual_rms_um: Num; // that all errors leave
  repeatability_um: Num; // what of it is not the same in both directions; null: one direction
  noise: Noise; // of the readings
  left: LeftHarmonic | null; // a wave that no error explains; null: none
  left_text: string; // what the errors do not explain
  undetermined: string[]; // what the readings do not tell apart
  prior: PriorOfError[];
  tolerances: string[]; // pass or fail, a line each
}

// A file that stores results without readings.
export interface StoredAlone {
  file: string;
  stored: StoredValue[];
}

// A value that a file stores.
export interface StoredValue {
  parent: string; // run or analysis that it is of
  name: string; // as the file has it
  value: Num;
  unit: string;
}

// What a diagnosis says while it goes on.
export interface SoFar {
  posterior: Hypothesis[]; // the most probable first
}

// What may be missing.
export interface Hypothesis {
  label: string; // the effect with its columns
  p: Num; // probability
}

// What a run that is still measured says so far.
export interface Looked {
  hours: Num; // from the first row to the last
  values: number; // of the target
  verdict: string | null; // as of diagnose; null: not diagnosed
  p_nothing: Num; // probability that nothing is missing
  log_bayes_factor: Num; // ln of anything that is missing against nothing
  hypotheses: Hypothesis[]; // the most probable first
  outcome: string; // open, decided, undecidable
  why_stop: string; // empty: it may be decided yet
  fault: string; // why there is no diagnosis; empty: there is
}

// How a run that was followed came out.
export interface Followed {
  outcome: string; // open, decided, undecidable
  decided: string[]; // effects that are missing
  sentence: string; // what it says in plain words
  error: string; // how often it errs
  command: string; // to type next; empty: none
  hint: string; // what no command does; empty: nothing
}

// A model of several targets fitted, and where it fails.
export interface CheckedTargets {
  targets: Checked[]; // of several targets, each as of one
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

// What data could show of several targets.
export interface PreflightTargets {
  targets: Preflight[]; // of several targets, each as of one
}

// What data could show, before any residual.
export interface Preflight {
  target: string; // column that is explained
  n: number; // readings
  noise_source: string; // where the noise is from
  effects: Detectability[]; // of the catalogue
}

// What data could show of an effect.
export interface Detectability {
  effect: string; // as `ballbar effects` lists it
  testability: string; // testable, input missing, input constant, absorbed by the model, in the model, other motion
  columns: string[]; // that suit it best
  bindings: number; // choices of columns that the data offer
  surviving_share?: Num; // what of it the model cannot make
  detectable_um?: Num; // range from which it is seen
  identifiable_um?: Num; // range from which it is named
  inseparable_from?: string[]; // effects that these data do not tell from it
  why?: string; // it is not testable
}

// The catalogue, or an effect of it.
export interface Effects {
  effects: Effect[]; // of the whole catalogue
}

// An effect of the catalogue.
export interface Effect {
  name: string;
  level: string; // series, recording
  summary: string; // in a line
  cause: string;
  formula: string; // in the letters of the parameters
  signature: string; // how it looks in a residual
  confused_with: string[]; // other effects
  becomes: string; // another one at the edge of its shapes; empty: none
  separated_by: string; // the test that tells them apart
  remedy: string; // in the workshop
  validity: string;
  source: string;
  time_only: boolean; // whether it needs nothing but time
  inputs: EffectInput[]; // that it reads
  parameters: EffectParameter[];
}

// What an effect reads.
export interface EffectInput {
  role: string;
  units: string[]; // accepted
  meaning: string;
}

// A parameter of an effect.
export interface EffectParameter {
  name: string; // with its unit
  unit: string; // 1: none
  kind: string; // gain, shape
  start: Num;
  lower: Num; // bound; null: none
  upper: Num; // bound; null: none
  held: boolean; // whether a model that does not name it keeps it at its start
  meaning: string;
}

// The run of the machine that would decide what is missing.
export interface Plan {
  sentence: string; // what it says in plain words
  verdict: string; // of the data at hand
  decided: boolean; // whether they decide it
  tests: ExpectedTest[]; // runs that were weighed, the best first
  schedule: Schedule | null; // of the best one; null: none is proposed
  inseparable: string[][]; // sets of effects that no run tells apart
  sensors: SensorToAdd[]; // that are lacking
  curves: ExpectedCurve[]; // what may be missing, the most probable first
}

// A run that was weighed.
export interface ExpectedTest {
  test: string; // random speeds, ...
  hours: Num;
  p_right: Num; // that all that is missing is named and nothing else
  p_right_sigma: Num;
  p_part: Num; // that some of it is named that is not named now, and nothing else
  p_wrong: Num; // that another effect is named
  truths: number; // cases that were simulated
}

// A run of the machine.
export interface Schedule {
  reading_s: Num; // from reading to reading
  dwells: Dwell[]; // one after the other
}

// A part of a run in which nothing changes.
export interface Dwell {
  duration_min: Num;
  speed_rpm: Num;
  load: Num; // times the load that the data had at this speed
  room_K: Num; // warmer than in the data
  coolant_K: Num; // warmer than in the data
}

// A sensor that would help.
export interface SensorToAdd {
  place: string;
  p_right: Num; // of the best run, with it
}

// What may be missing.
export interface ExpectedCurve {
  effects: string;
  p: Num; // of it now
}

// A model before and after effects are added.
export interface Tried {
  target: string; // column that is explained
  data: string[]; // files, as they were named
  before: Figures; // how well the model does without them
  after: Figures; // how well it does with them
  likelihood_ratio: Num; // 2 ln B of the change, of errors of axes chi^2
  threshold: Num; // from which that counts
  best_surrogate_fall: Num; // share by which the best of 200 surrogates lowers the RMSE
  verdict: string; // supported, time only, not supported
  effects: AddedEffect[]; // that were added
  earlier: EarlierEffect[]; // effects of the model, tested anew
  sentence: string; // what it says in plain words
}

// How well a model does.
export interface Figures {
  parameters: number; // free ones
  rmse_um: Num; // of the fit to all rows
  times_floor: Num; // RMSE over the floor; null: not known
  held_out_um: Num; // RMSE of cycles (recordings) left out; null: not known
}

// An effect that was added for a test.
export interface AddedEffect {
  effect: string; // as `ballbar effects` lists it
  columns: Record<string, string>; // by role
  amplitude_um: Num; // largest less smallest of what it adds
  amplitude_sigma_um: Num; // null: not determined
  likelihood_ratio: Num; // 2 ln of how much likelier the readings are with it than without
  threshold: Num; // from which that counts
  best_surrogate_fall: Num; // share by which the best surrogate lowers the RMSE; null: not tested
  p_same_gain: Num; // of gains as different from cycle to cycle, by chance
  time_only: boolean; // whether it needs nothing but time
  doubts: string[]; // why it is not supported
  parameters: CandidateParameter[];
}

// An effect of the model, tested by leaving it out.
export interface EarlierEffect {
  effect: string; // with its columns
  likelihood_ratio: Num; // 2 ln B
  parameters: number; // free ones
  p_drop: Num; // that it is not needed
  needed: boolean;
}

// New revisions of a model.
export interface Added {
  rows: LedgerRow[]; // of the ledger
  revisions: Tried[]; // before and after each
  growth?: GrowthStep[]; // of a model that grew by effects that predict
  sentence?: string; // what that growth says
  stopped?: Stopped; // with --auto: why nothing more was added
  written: string | null; // file; null: nothing was added, or no file is named
  text?: string; // of the new model, where it has no file
}

// A revision of a model: what it changed, and what that bought.
export interface LedgerRow {
  revision: number; // 0: the model as it started
  change: string; // + what was added, - what was taken out; start
  parameters: number; // free ones
  rmse_um: Num; // of the fit to all rows
  times_floor: Num; // RMSE over the floor; null: not known
  held_out_um: Num; // RMSE of cycles (recordings) left out; null: not known
  verdict: string; // start, named, supported, time only, not supported, driver known, empirical
  target: string; // which the figures are of
  data: string[]; // files, as they were named
  likelihood_ratio: Num; // 2 ln B of the change, of errors of axes chi^2
  threshold: Num; // from which that counts
  best_surrogate_fall: Num; // share by which the best of 200 surrogates lowers the RMSE
  forecast_um: Num; // RMSE of rows forecast from earlier ones alone
  surrogate_forecast_um: Num; // the same with surrogates instead of effects
  discrepancy_um: Num; // standard deviation of the slow curve that is left
  still_needed: string[]; // earlier effects, tested anew
  no_longer_needed: string[];
  sentence: string; // what it says in plain words
}

// A model that grows by effects that predict, with so many of them.
export interface GrowthStep {
  effects: number; // how many
  added: string | null; // the last of them; null: none, or not kept
  kept: boolean; // whether it is in the model
  rmse_um: Num; // of the rows it is fitted to
  surrogate_um: Num; // the same with as many surrogates
  forecast_um: Num; // RMSE of forecasts; null: too few rows
  forecast_mean_um: Num; // their mean absolute error
  surrogate_forecast_um: Num; // RMSE with surrogates
  discrepancy_um: Num; // standard deviation of what is left
  p_none: Num; // that no effect was needed before it joined
}

// Why nothing more was added.
export interface Stopped {
  verdict: string; // of the last diagnosis
  text: string;
}

// The story of a model.
export interface Ledger {
  rows: LedgerRow[]; // a row a revision
}

// A revision that was taken back.
export interface Undone {
  model: string; // file
  revision: number; // that it is now; 0: as it started
  undone: string; // what was taken back
  text?: string; // of the model, where it has no file
}

// An effect put into data, and whether it is seen.
export interface Injected {
  target: string; // column that it is added to
  effect: string; // as `ballbar effects` lists it
  columns: Record<string, string>; // by role
  shapes: Record<string, Num>; // of the effect
  amplitude_um: Num; // largest less smallest of what was added
  d: Num; // of that, beside the noise of the model's residual
  detectable_um: Num; // amplitude of d = 5
  identifiable_um: Num; // amplitude of d = 7.5
  without: Sighting; // as measured
  with: Sighting; // with it
  answer: string; // what it says in plain words
  smallest: SmallestSeen; // amplitude that is seen
}

// What a diagnosis makes of an effect that is there.
export interface Sighting {
  verdict: string; // of the diagnosis
  seen: string; // named, probable, in the reported set, driver, candidate, unexplained, not seen
}

// From which amplitude on an effect is seen.
export interface SmallestSeen {
  not_seen_um: Num; // the largest that was tried and not seen
  seen_um: Num; // the smallest that was seen; null: none
  diagnoses: number; // that were made
}

// The circles of recordings.
export interface Fitted {
  recordings: FittedRecording[]; // a row a recording
  results_alone?: ResultsAlone[]; // files that store results without readings
  iso230_4?: FittedPair; // of the only pair of CCW and CW: the numbers of ISO 230-4
  iso230_4_pairs?: PairOfFile[]; // of several pairs, each with its file
}

// The circle of a recording, or the length of an axial one.
export interface FittedRecording {
  file: string;
  index: number; // within the file
  kind: string; // circle, axial
  readings: number;
  nominal_length_mm: number;
  length_mm?: Num; // of an axial one
  sigma_length_um?: Num;
  plane?: string; // XY, YZ, ZX; this and what follows of a circle
  direction?: string; // CCW, CW
  arc_deg?: Num;
  model?: string; // length_equation, polar
  centre_a_um?: Num;
  centre_b_um?: Num;
  radius_mm?: Num;
  circularity_um?: Num; // largest less smallest deviation
  feed_mm_per_min?: Num; // where it is known
  rms_um: Num; // of the residual
  sigma_centre_a_um?: Num;
  sigma_centre_b_um?: Num;
  sigma_radius_um?: Num;
  sigma_circularity_um?: Num;
  correlation_a_b?: Num;
  correlation_a_radius?: Num;
  correlation_b_radius?: Num;
  sigma_reading_um?: Num;
  autocorrelation?: Num; // of the residual
  effective_readings?: Num; // independent readings that they are worth
  max_circular_um?: Num; // the largest deviation
  max_at_deg?: Num;
  min_circular_um?: Num; // the smallest
  min_at_deg?: Num;
  converged?: boolean; // whether the fit came to an end
  discounted?: number[]; // readings, with --robust
  stored?: Record<string, Num>; // what the file stores of these
}

// A file that stores results without readings.
export interface ResultsAlone {
  file: string;
  stored: ValueAlone[];
}

// A value that a file stores.
export interface ValueAlone {
  of: string; // run, with its direction, or analysis
  name: string; // as the file has it
  value: Num;
  unit: string;
}

// The numbers of ISO 230-4 of both directions.
export interface FittedPair {
  [key: string]: unknown; // g_ccw_um, g_cw_um, bidirectional_2005_um, d_um, h_um, ...
  stored?: Record<string, Num>; // what the file stores of these
  remarks?: string[];
}

// The numbers of ISO 230-4 of one of several pairs.
export interface PairOfFile {
  file: string; // of its first
  [key: string]: unknown; // g_ccw_um, g_cw_um, bidirectional_2005_um, d_um, h_um, ...
  stored?: Record<string, Num>; // what the file stores of these
  remarks?: string[];
}

// The drift of the spindle.
export interface Drift {
  method: string; // spindle_rotation, two_arcs, circles; of five probes five_probe
  reference_s: number; // time of the test that drift is taken to
  points: DriftPoint[]; // a row a test
  positions: Position[]; // the same before the reference is taken off
  not_cancelled: string; // what of the set-up remains
  skipped?: SkippedFile[]; // files that could not be read
}

// What a test says of the drift, as far as its method tells it.
export interface DriftPoint {
  time_s: number; // of the test
  x_um?: Num;
  y_um?: Num;
  z_um?: Num;
  radial_um?: Num;
  axial_um?: Num;
  shift_a_um?: Num; // of the radial one, in the frame that turns
  shift_b_um?: Num;
  radius_change_um?: Num; // of the circle, or the path about C
  radius_change_a_um?: Num; // of the path about A
  x_sigma_um?: Num;
  y_sigma_um?: Num;
  z_sigma_um?: Num;
  radial_sigma_um?: Num;
  axial_sigma_um?: Num;
  shift_a_sigma_um?: Num;
  shift_b_sigma_um?: Num;
  radius_change_sigma_um?: Num;
  radius_change_a_sigma_um?: Num;
  elongation_correction_um?: Num; // taken off the radial test
  correlation_y_z?: Num; // of the test's own y and z
}

// Where a test found the ball of the spindle, errors of the set-up included.
export interface Position {
  time_s: number; // of the test
  x_um?: Num; // from the point where the axes meet
  x_sigma_um?: Num;
  y_um?: Num;
  y_sigma_um?: Num;
  z_um?: Num;
  z_sigma_um?: Num;
  centre_a_um?: Num; // of the circle
  centre_a_sigma_um?: Num;
  centre_b_um?: Num;
  centre_b_sigma_um?: Num;
  length_mm?: Num; // axial
  radius_mm: Num;
  converged: boolean; // whether the fit came to an end
  discounted: number; // readings, with --robust
}

// The drift of the spindle from five probes.
export interface DriftOfProbes {
  method: string; // five_probe
  reference_s: number; // time that drift is taken to
  points: SeriesRow[]; // a row a time, AXIS_um or AXIS_urad with sigma
  ranges: Record<string, AxisRange>; // by axis
  steps: SpeedStep[]; // changes of the speed
  remarks: string[];
}

// A row of a series.
export interface SeriesRow {
  time_s: number;
  [key: string]: unknown; // a key a column
}

// Largest less smallest of an axis over a stretch of time.
export interface AxisRange {
  [key: `first_60_min_${string}`]: Num;
  [key: `first_60_min_sigma_${string}`]: Num;
  [key: `after_60_min_${string}`]: Num;
  [key: `after_60_min_sigma_${string}`]: Num;
  [key: `total_${string}`]: Num;
  [key: `total_sigma_${string}`]: Num;
  [key: `first_to_last_${string}`]: Num; // the last less the first
  [key: `first_to_last_sigma_${string}`]: Num;
}

// A stretch of one speed.
export interface SpeedStep {
  from_s: Num;
  to_s: Num;
  speed_rpm: Num;
  ranges: Record<string, AxisRange>; // by axis
}

// How two drifts agree.
export interface Comparison {
  conclusion: string; // what it says in plain words
  a: string; // name of the first
  b: string; // name of the second
  reference_s: number; // time that both are taken to
  samples: number; // common times
  left_out: number; // times of one alone
  axes: Record<string, ComparedAxis>; // by name: rmse, bias, correlation, chi^2 and the series of the difference
  remarks: string[];
}

// How two drifts agree along an axis.
export interface ComparedAxis {
  agreement: string; // agrees, disagrees, cannot tell
  mean_relative_deviation: Num; // null: the second does not move
  expected_relative_deviation: Num; // by the stated sigmas
  explained_share: Num; // of the first by the second
  range_normalised_mean_deviation: Num;
  [key: `rmse_${string}`]: Num; // of the differences
  [key: `max_${string}`]: Num; // the largest difference
  max_at_s: Num; // where it is
  [key: `bias_${string}`]: Num; // mean difference
  [key: `loa_low_${string}`]: Num; // limits of agreement
  [key: `loa_high_${string}`]: Num;
  within_2_sigma: number; // samples that agree
  samples: number; // with a known sigma, the reference left out
  correlation: Num;
  lag_s: Num; // null: none within a quarter of the common time, or no bend
  lag_sigma_s: Num;
  deviation?: Deviation; // where some sample is beyond 2 sigma
  structure: DifferenceStructure | null; // what of it is an offset, a gain, a lag and a drift; null: too few samples
  budget: UncertaintyShare[]; // where the uncertainty is from
  points: ComparedSample[]; // a row a sample
}

// The worst stretch beyond 2 sigma.
export interface Deviation {
  from_s: number;
  to_s: number;
  to_the_end: boolean;
  [key: `largest_${string}`]: Num; // the worst difference there
  [key: `sigma_${string}`]: Num; // of that one
  at_s: Num; // where it is
}

// What of a difference is an offset, a gain, a lag and a drift.
export interface DifferenceStructure {
  stands_out: boolean; // one of the four is named, or all together stand out
  parts: DifferenceParts; // each with the other three free
  alone: DifferenceParts; // each with the other three none
  sufficient_alone: string[]; // those which alone explain all that the four explain
  limit_of_part: Num; // the chance below which a part is named
  together: ChiSquare; // of the four; the limit is that of `alone`, too
  whole: ChiSquare; // of the whole difference, with the zero's error in common
  noise: string; // stated, widened, from rows
  widened_by?: Num; // of widened noise
  [key: `noise_${string}`]: Num; // of noise from rows: sigma of a difference
}

// The parts of a difference; null: it cannot be told.
export interface DifferenceParts {
  offset: DifferencePart | null;
  gain: DifferencePart | null;
  lag: DifferencePart | null; // positive: the first is late
  drift: DifferencePart | null;
}

// A part of a difference: offset, gain, lag or drift.
export interface DifferencePart {
  [key: `value_${string}`]: Num; // a gain has no unit: 1 is none
  [key: `sigma_${string}`]: Num;
  chance: Num; // of as much where nothing is wrong
  named: boolean; // whether that is below the limit
}

// Squares of a difference in units of its scatter, summed up.
export interface ChiSquare {
  chi2: Num;
  freedom: number; // degrees of it
  chance?: Num; // of as much where nothing is wrong
  limit?: Num; // below which that counts
}

// A source of uncertainty.
export interface UncertaintyShare {
  source: string;
  [key: `sigma_${string}`]: Num; // null: not known
  share: Num; // of the variance
}

// Both drifts at a common time.
export interface ComparedSample {
  time_s: number;
  [key: `a_${string}`]: Num;
  [key: `b_${string}`]: Num;
  [key: `difference_${string}`]: Num; // b less a
  [key: `sigma_${string}`]: Num; // null: not known
}

// The errors of many ballbar tests.
export interface Errors {
  tests: MachineTest[]; // a row a test
  remarks: string[]; // of the readers
  skipped: SkippedTest[]; // files that could not be read
}

// A test of a machine.
export interface MachineTest {
  file: string;
  machine: string; // empty: not stated
  bar: string; // its serial number; empty: not stated
  date: string | null; // null: not stated
  plane: string; // XY, YZ, ZX
  nominal_length_mm: Num;
  feed_mm_per_min: Num; // null: not stated
  start_deg: Num; // of the readings, counter-clockwise
  arc_deg: Num;
  stored: boolean; // values of the file, without readings
  errors: TestQuantity[];
}

// An error, or a quantity, of a test.
export interface TestQuantity {
  name: string;
  value: Num;
  sigma: Num; // null: not known
  unit: string;
  significant: boolean; // whether the test shows it
  rank: number | null; // by what mending it gains, 1 the most; null: none
  of_set_up: boolean; // it says nothing of the machine
}

// A file that has no test of its own.
export interface SkippedTest {
  file: string;
  sentence: string; // with the file's name
  copy_of: string | null; // file of whose test it is one; null: none
}

// Machines over their tests.
export interface History {
  machines: MachineHistory[]; // what needs something first
  bar_changes: BarChange[];
  judged: number; // questions
  found: number; // of these answered with yes
  false_discovery_rate: Num; // share of those by chance
  without_date: string[]; // files of tests that are in nothing
  geometry?: MachineGeometry; // squareness and scales, of one machine
  remarks: string[]; // of the readers
  skipped: SkippedTest[]; // files that could not be read
}

// A machine, and what it needs.
export interface MachineHistory {
  machine: string; // as its tests state it, else the folder that was given
  tests: number; // how many
  first: string | null; // date
  last: string | null;
  need: string; // beyond, expected, finding, nothing
  reason: string; // why it stands where it does
  findings: Finding[]; // the clearest first
  tolerances: ToleranceOutlook[];
  series: QuantityHistory[]; // every one of one machine, of several those with findings and tolerances
  groups: TestGroup[]; // of tests that can be compared
}

// What was found of a machine.
export interface Finding {
  kind: string; // step, replaced_part, instrument, trend, season
  from: string; // date; the tests between which it steps, else the first and the last
  to: string;
  axis: string | null; // where it is one
  p_value: Num; // of the clearest quantity
  q_value: Num;
  sentence: string; // what was found
  remedy: string; // what to do
  quantities: FindingQuantity[]; // the clearest first
}

// A quantity that has part in a finding.
export interface FindingQuantity {
  quantity: string;
  plane: string; // XY, YZ, ZX
  unit: string;
  size: Num; // after less before, a year, or half from trough to peak
  sigma: Num; // of the size
  p_value: Num;
  q_value: Num; // corrected for all questions
}

// A tolerance, and when it is met.
export interface ToleranceOutlook {
  quantity: string;
  plane: string; // XY, YZ, ZX
  unit: string;
  level: Num; // of the curve at the last test
  sigma: Num; // of the level
  lower: Num; // null: none
  upper: Num;
  outlook: string; // beyond, expected, no_trend, not_within_10_years
  met: string | null; // date; null: not known
  earliest: string | null;
  latest: string | null;
  last_test_alone: boolean; // the last test is beyond, the level is not
}

// A quantity of a machine over its tests.
export interface QuantityHistory {
  quantity: string;
  plane: string; // XY, YZ, ZX
  unit: string;
  level: Num; // of the curve at the last test
  sigma: Num; // of the level
  group: number; // place in groups
  scatter: Num; // about the curve
  dates: string[];
  values: Num[]; // of tests of a day the mean
  sigmas: Num[]; // of the fits; null: not known
  fitted: Num[];
  significant: boolean; // the last value
  trend?: Trend; // through the values since the last step
}

// A straight line over time.
export interface Trend {
  rate_per_year: Num;
  sigma_per_year: Num;
  p_value: Num; // of a rate as far from 0 by chance
  scatter: Num; // from test to test beyond the sigmas
  tests: number; // how many
}

// Tests that can be compared.
export interface TestGroup {
  plane: string; // XY, YZ, ZX
  length_mm: Num;
  feed_mm_per_min: Num; // null: not stated
  start_deg: Num;
  arc_deg: Num;
  tests: number; // how many
}

// A change of the bar that machines are tested with.
export interface BarChange {
  from: string; // serial number
  to: string;
  machines: string[];
  step_um_per_m: Num; // mean step of the scales
  sigma_um_per_m: Num;
}

// Squareness and scales of a machine.
export interface MachineGeometry {
  within_a_day: boolean; // whether all tests are
  out_of_square_um_per_m: PlaneSquareness[]; // a row a plane
  scales_um_per_m: AxisScale[]; // a row an axis
  agreement: AgreementOfTests; // of the tests
}

// How far a plane is out of square.
export interface PlaneSquareness {
  plane: string;
  value: Num; // um/m
  sigma: Num;
  p_value: Num; // of tests that differ as much by chance
  files: string[]; // that it is from
}

// The scale of an axis.
export interface AxisScale {
  axis: string; // X, Y, Z
  value: Num; // um/m
  sigma: Num;
  planes: number; // that it is measured in
}

// Whether tests of several planes agree.
export interface AgreementOfTests {
  chi2: Num;
  degrees: number; // of freedom; 0: nothing to compare
  p_value: Num;
  scatter_um_per_m: Num; // of each scale beyond its sigma, where they disagree
  pulls: ScalePull[]; // a row a scale and test
}

// The scale of an axis in one test.
export interface ScalePull {
  file: string;
  plane: string;
  axis: string; // X, Y, Z
  value: Num; // um/m
  sigma: Num;
  pull: Num; // what is left over its sigma; null: only this test tells the axis
}

// Machines over their tests, what needs something first.
export interface Ranking {
  machines: MachineHistory[]; // what needs something first
  bar_changes: BarChange[];
  judged: number; // questions
  found: number; // of these answered with yes
  false_discovery_rate: Num; // share of those by chance
  without_date: string[]; // files of tests that are in nothing
}

// What a log was taken for.
export interface Imported {
  file: string;
  shape: string; // how the values stand
  time: string; // where the time is
  started?: string; // wall clock of time 0
  rows: number; // how many
  first_row_line: number;
  columns: LogColumn[]; // of the log, that of the time left out
  remarks: string[]; // what looks broken, what was mended
  faults: ColumnFault[]; // of columns
}

// A column of a log, and what it was taken for.
export interface LogColumn {
  source: string; // its header in the log
  found_unit?: string; // as the log writes it
  left_out?: string; // why it is not in the series; then nothing else is there
  name?: string; // in the series
  unit?: string;
  role?: string;
  why?: string; // what tells the role
  gaps?: number; // cells without a value
}

// What looks wrong with a column.
export interface ColumnFault {
  column: string; // empty: the time
  what: string;
}

// Logs made one series.
export interface Merged {
  rows: number; // how many
  columns: number; // how many
  parts: MergedPart[]; // the logs
}

// A log, and how its clock was set.
export interface MergedPart {
  file: string;
  moved_s: Num; // what was added to its times
  by_date_s?: Num; // by the dates alone
  lag_s?: Num; // by what both logs show
  lag_sigma_s?: Num;
  correlation?: Num;
  compared?: string[]; // columns of the first log and of this one
}

// What was simulated.
export interface Simulated {
  method: string; // of the session; series: of a series
  rows?: number; // of a series
  tests?: number; // of a session
  seed: number; // of the noise
  folder: string; // that was written
  files: string[]; // in it
  truth: string; // file of the truth, beside the folder
}

// A plant that was simulated.
export interface SimulatedFleet {
  machines: number; // how many
  months: number; // how many
  seed: number; // of all that is drawn
  folder: string; // that was written
  files: number; // how many
  truth: string; // file of the truth, beside the folder
}

// A regression on temperatures over batches.
export interface Trained {
  target: string; // column that is predicted
  batches: number; // how many
  held_out_um: Num; // RMSE on what was left out
  half_width_um: Num; // of the interval of 95 %
  methods: TrainedMethod[]; // that were compared
  effects?: ComparedModel; // with --model: a model of effects in the same contest
  remarks: string[];
}

// A method of regression.
export interface TrainedMethod {
  method: string; // pcr, ridge
  components: number;
  penalty_K2: Num; // of ridge
  held_out_um: Num; // RMSE of batches left out
  worst_um: Num; // of the worst of them
  worst_batch: string;
  rmse_um: Num; // of all batches, trained on
  taken: boolean; // whether it is written
}

// A model of effects in the same contest.
export interface ComparedModel {
  model: string; // file
  held_out_um: Num; // RMSE of batches left out
  worst_um: Num; // of the worst of them
  worst_batch: string;
  rmse_um: Num; // of all batches, trained on
}

// A regression on the effects of the catalogue.
export interface TrainedOnEffects {
  target: string; // column that is predicted
  rows: number; // trained on
  runs: number;
  dictionary: string[]; // kinds of effects
  terms: number; // how many
  prior_variance: Num; // of the gains
  length_s: Num; // memory of what no column drives; 0: none
  sigma_um: Num; // standard deviation of that
  interval_scale: Num; // by which the interval is widened
  rmse_um: Num; // on the rows that it was trained on
  forecasts: Forecasts | null; // null: too few rows
  drivers: DriverStability[]; // columns, and the um that each moves
  range_um: Num; // of what is predicted
  not_needed: string[]; // columns without which nothing changes
  interchangeable: string[][]; // sets of columns, of which any will do
  cancelling: CancellingColumns[]; // pairs of columns
  methods: TrainedMethod[]; // of a list of runs: in the same contest
  remarks: string[];
  sentence: string; // what it says in plain words
}

// Rows that the training did not have, predicted.
export interface Forecasts {
  count: number; // of origins, or of runs left out
  error_um: Num; // mean of the absolute error
  rmse_um: Num;
  held_um: Num; // RMSE where the last value, or the mean, is held; of runs 0 um
  within_share: Num; // within the interval of 95 %
  predicted: boolean; // whether that is better than chance
}

// A column that drives what is predicted.
export interface DriverStability {
  column: string;
  role: string; // as of a series
  share_um: Num; // of the range of what is predicted
  low_um: Num; // least of refits without a part each
  high_um: Num; // largest of them
  stable: boolean;
  flips: boolean; // its sign does
}

// Two columns that nearly cancel: neither is a cause by itself.
export interface CancellingColumns {
  columns: string[];
  range_um: Num[]; // of each
  sum_um: Num; // range of both together
}

// Batches to train on for a job.
export interface Selected {
  target: string; // column that is predicted
  room_degC: Num; // as the job begins
  taken: string; // the choice that is written
  ranked: RankedBatch[]; // batches by the temperature of their rooms
  choices: BatchChoice[]; // with what came of each
  held_out: HeldOutBatches[]; // by number of batches
  random: RandomBatches | null; // choices to compare with; null: none
  remarks: string[];
}

// A batch, and how like the job it is.
export interface RankedBatch {
  batch: string;
  room_apart_K: Num; // temperature of the room as it begins
  distance: Num; // how unlike it is
  weight: Num;
  components: number; // of the regression up to it
  modelling_rmse_um: Num; // of the batches up to this rank
  predicted_rmse_um: Num; // of the job by these; null: not measured
}

// A way to choose batches.
export interface BatchChoice {
  choice: string; // paper, held_out, weights, all
  batches: Num; // as many as these alike
  method: string; // pcr, ridge
  components: number;
  penalty_K2: Num; // of ridge
  predicted_rmse_um: Num; // of the job; null: not measured
}

// Error of batches like the job by so many batches.
export interface HeldOutBatches {
  batches: number; // how many
  rmse_um: Num;
}

// Random choices of as many batches as are taken.
export interface RandomBatches {
  batches: number; // in each
  share_worse: Num; // than what is taken
  predicted_rmse_um: Num[]; // of the job, rising
}

// A model's series.
export interface Predicted {
  time_s: Num[]; // of each row
  [key: string]: unknown; // TARGET_model_um, the target, TARGET_residual_um, and what each effect adds
}

// A target predicted by a regression.
export interface PredictedTarget {
  time_s: Num[]; // of each row
  [key: string]: unknown; // TARGET_model_um, the target, TARGET_residual_um, and what each effect adds
  goes_on?: boolean; // by effects: from the end of training, or an earlier prediction
  holds_training?: boolean; // by effects: whether it begins with the training rows
  drivers?: DriverShare[]; // by effects: the largest share first
  error: PredictionError | null; // null: the target is not measured
  broken?: string[]; // by temperatures: sensors that look so
  warnings: string[];
}

// How much of what is predicted goes with a column.
export interface DriverShare {
  column: string;
  role: string; // as of a series
  share_um: Num; // of the range of what is predicted
}

// Measured less predicted, of rows that are new.
export interface PredictionError {
  rows: number; // how many
  mean_um: Num; // mean of the absolute error
  rmse_um: Num;
  within_share: Num; // within the interval of 95 %
}

// A compensation replayed over what was recorded.
export interface Replayed {
  rows: number; // of signals
  in_sample: boolean | null; // whether it was fitted to these data; null: not known here
  axes: Record<string, ReplayedAxis>; // by letter
}

// An axis before and after it is compensated.
export interface ReplayedAxis {
  target: string; // column that is compensated
  values: number; // since the first, which is left out
  rms_before_um: Num;
  rms_after_um: Num;
  reduction_percent: Num;
  reduction_sigma_percent: Num;
  stretch: number; // values over which what is left stays alike
  largest_before_um: Num;
  largest_after_um: Num;
  rows_held: Record<string, number>; // by why
  most_held_by?: string; // column
  rows_limited: number; // by the limits
}

// Data sets in which effects may be hidden.
export interface BlindMade {
  folder: string; // of the sets
  sets: number; // how many
  answers: string; // file
  sha256: string; // of the answers
}

// A further run of the machine of a set.
export interface BlindRun {
  run: string; // file
  number: number;
  rows: number; // how many
  hours: Num;
}

// A blind challenge, scored.
export interface BlindScore {
  sets: ScoredSet[];
  scores: Scores;
}

// A set, its answer and what was said of it.
export interface ScoredSet {
  set: string;
  kind: string; // nothing, one, two, outside, inseparable, spindle
  truth: string;
  hidden: Bound[]; // effects; no columns: on any
  match: Bound[]; // of a spindle: each of them is right
  d: Num[]; // of each hidden signal
  amplitude_um: Num[]; // largest less smallest of each
  verdict: string;
  named: Bound[];
  reported: Bound[]; // any of these
  outcome: string; // right, in the set, missed, wrong
}

// How often diagnoses of hidden effects are right.
export interface Scores {
  false_calls: Share; // wrong, of sets with nothing
  right: Share; // of all
  wrong: Share; // of all
  in_set: Share; // right or in the set, of effects that are there
  false_names: Share; // wrong, of what no effect explains
}

// So many of so many, with the interval of 95 % of their share.
export interface Share {
  count: number;
  of: number;
  low: Num;
  high: Num;
}

// Where one sensor of temperature tells the elongation of a spindle.
export interface MeanPoints {
  conclusion: string; // what it says in plain words
  expansion_ppm_per_K: Num; // of the spindle
  start_degC: Num; // at which the elongation is 0; null: not given
  best?: BestPoint; // of several states
  states: MeanPointState[];
}

// One place for all states.
export interface BestPoint {
  x_mm: number;
  rms_um: Num; // of what a sensor there tells wrong
  misplaced_um_per_mm: Num; // largest for each mm that the sensor is off
}

// Temperatures along a spindle, and their mean-value points.
export interface MeanPointState {
  name: string; // the picture's file or the table's column
  length_mm: Num;
  mean_degC: number; // along the spindle
  sigma_mean_degC: Num; // null: not known
  elongation_um?: Num; // since the start
  sigma_elongation_um?: Num;
  mean_points: MeanPoint[]; // the flattest first
  error_at_best_um?: Num; // of a sensor at the best place
  picture?: PictureOfTemperature; // of a picture
}

// A place at which the temperature is its mean.
export interface MeanPoint {
  x_mm: number;
  sigma_mm: Num; // null: not known
  slope_degC_per_mm: Num;
  sigma_slope_degC_per_mm: Num; // null: not known
  misplaced_um_per_mm: Num; // for each mm that the sensor is off
}

// How a picture became temperatures along a spindle.
export interface PictureOfTemperature {
  region: number[]; // x, y, width, height, pixels
  pixels_used: number;
  pixels_off_scale: number;
  pixels_contrasting: number;
  pixels_at_edges: number;
  pixels_at_cold_end: number; // of the scale
  pixels_at_hot_end: number;
  saturated_cold: boolean; // whether the scale ends too early
  saturated_hot: boolean;
  columns: number; // of pixels
  empty_columns: number;
  scale_banded: boolean;
  scale_step_degC: Num; // to which temperatures are known
  three_areas: ThreeAreas;
}

// A hot, a middle and a cold area of a picture, by thresholds of its colours.
export interface ThreeAreas {
  mean_degC: number; // by the three areas
  otsu_mean_degC: Num; // the same by Otsu's thresholds alone
  hot_pixels: number;
  middle_pixels: number;
  cold_pixels: number;
  hot_share: Num;
  middle_share: Num;
  cold_share: Num;
  red_otsu: number; // threshold
  red_triangle: number;
  blue_otsu: number;
  blue_triangle: number;
}

// Temperature along a spindle, and where it is its mean, as it is drawn.
export interface MeanPointPart {
  conclusion: string;
  best?: BestPlace; // one place for all states
  states: DrawnMeanPointState[];
}

// One place for all states.
export interface BestPlace {
  x_mm: number;
}

// Temperature along a spindle, and where it is its mean.
export interface DrawnMeanPointState {
  name: string; // the picture's file or the table's column
  mean_degC: number;
  mean_points: MeanPlace[];
  x_mm: number[]; // rising
  degC: Num[];
}

// A place at which the temperature is its mean.
export interface MeanPlace {
  x_mm: number;
}

// The data of a page.
export interface Report {
  format: string; // ballbar-report 1
  title: string;
  made_by: string; // ballbar 0.1.0
  made_on: string; // date
  files: string[]; // that it is made of
  summary: string[]; // the conclusions, whole sentences, first to be read
  signals: SeriesBlock[]; // temperatures, speed and the like, each file on its own clock
  fit?: FitPart; // of recordings
  machine_errors?: MachineErrorsPart[]; // one a test
  skipped?: SkippedFile[]; // files that cannot be read, by their names
  drift?: DriftOfTests; // of a session
  five_probe?: ProbesPart;
  compare?: Comparison; // of two drifts
  check?: CheckParts; // how it fits
  diagnose?: DiagnosisParts; // what it lacks
  ledger?: Ledger; // of the model
  batch?: BatchPart; // with a model of train
}

// Columns on one clock.
export interface SeriesBlock {
  source: string; // the file
  time_s: number[];
  columns: Column[];
}

// A column on the clock of its series.
export interface Column {
  name: string; // with its unit
  role: string; // as in a series file: structure, ambient, speed, measured, ...
  unit: string;
  values: Num[];
}

// Recordings and their circles.
export interface FitPart {
  recordings: PageRecording[];
  results: ResultTable[]; // tables, one a recording and one a pair
  remarks: string[];
  pairs: number[][]; // CCW and CW of one test, as places in recordings
  stored_alone?: ResultsAlone[]; // files without readings
  iso230_4?: FittedPair; // of the only pair of CCW and CW: the numbers of ISO 230-4
  iso230_4_pairs?: PairOfFile[]; // of several pairs, each with its file
}

// A recording with its curves.
export interface PageRecording {
  file: string;
  index: number; // within the file
  kind: string; // circle, axial
  readings: number;
  nominal_length_mm: number;
  length_mm?: Num; // of an axial one
  sigma_length_um?: Num;
  plane?: string; // XY, YZ, ZX; this and what follows of a circle
  direction?: string; // CCW, CW
  arc_deg?: Num;
  model?: string; // length_equation, polar
  centre_a_um?: Num;
  centre_b_um?: Num;
  radius_mm?: Num;
  circularity_um?: Num; // largest less smallest deviation
  feed_mm_per_min?: Num; // where it is known
  rms_um: Num; // of the residual
  sigma_centre_a_um?: Num;
  sigma_centre_b_um?: Num;
  sigma_radius_um?: Num;
  sigma_circularity_um?: Num;
  correlation_a_b?: Num;
  correlation_a_radius?: Num;
  correlation_b_radius?: Num;
  sigma_reading_um?: Num;
  autocorrelation?: Num; // of the residual
  effective_readings?: Num; // independent readings that they are worth
  max_circular_um?: Num; // the largest deviation
  max_at_deg?: Num;
  min_circular_um?: Num; // the smallest
  min_at_deg?: Num;
  converged?: boolean; // whether the fit came to an end
  discounted?: number[]; // readings, with --robust
  stored?: Record<string, Num>; // what the file stores of these
  time_s: Num; // of the test in its session; null: of none
  test: string; // 64 min, or the file
  label: string; // 64 min, XY CCW
  trace: Trace;
}

// The readings of a recording, and what was fitted.
export interface Trace {
  angle_deg: number[]; // of a circle
  deviation_um: number[]; // measured length less nominal
  residual_um: number[]; // reading less what was fitted
  fitted_um: number[]; // deviation of what was fitted, at the same readings
  effects: EffectCurve[]; // what each effect of a model adds
  time_s?: number[]; // of an axial one
}

// What an effect adds.
export interface EffectCurve {
  effect: string; // with its columns
  values_um: Num[];
}

// The results of a recording or a pair.
export interface ResultTable {
  of: string;
  rows: ResultRow[];
}

// A result, ours beside what the file stores.
export interface ResultRow {
  label: string;
  decimals: number; // to show
  ours: Num;
  stored: Num;
  limits?: Num[]; // of the file, lower and upper
  judgement?: string; // of ours by these
}

// The errors of a machine from one test, with their curves.
export interface MachineErrorsPart {
  files: string[];
  plane: string; // XY, YZ, ZX
  nominal_length_mm: Num;
  recordings: number[]; // places in the recordings of the page
  file?: TestFile; // what the only file states
  conclusion: string; // what it says in plain words
  verdict: string; // named, unexplained, nothing
  named: Bound[]; // errors that the test shows
  errors: MachineError[]; // by what mending them gains, then those of the circle
  one_by_one: AddedError[]; // the significant ones, each time that which leaves least
  circle_rms_um: Num; // that the circles alone leave
  circularity_um: Num; // largest less smallest reading about the fitted centre
  circularity_without_all_um: Num; // that remains once all significant errors are mended
  differences: string[]; // where ours and the instrument's values differ, and why
  residual_rms_um: Num; // that all errors leave
  repeatability_um: Num; // what of it is not the same in both directions; null: one direction
  noise: Noise; // of the readings
  left: LeftHarmonic | null; // a wave that no error explains; null: none
  left_text: string; // what the errors do not explain
  undetermined: string[]; // what the readings do not tell apart
  prior: PriorOfError[];
  tolerances: string[]; // pass or fail, a line each
  circle_um: Num[][]; // at the readings of each recording: centre and scale of all together
  curves: Record<string, Num[][]>; // by effect: what it adds
}

// The drift of the spindle from tests.
export interface DriftOfTests {
  method: string; // spindle_rotation, two_arcs, circles; of five probes five_probe
  reference_s: number; // time of the test that drift is taken to
  points: DriftPoint[]; // a row a test
  positions: Position[]; // the same before the reference is taken off
  not_cancelled: string; // what of the set-up remains
}

// Five probes: axes as columns, because there may be a million rows.
export interface ProbesPart {
  what: string; // the file
  reference_s: number;
  time_s: number[];
  axes: ProbesAxis[];
  remarks: string[];
}

// An axis as five probes have it.
export interface ProbesAxis {
  name: string;
  unit: string;
  values: Num[];
  sigma: Num[];
}

// A model fitted to each target.
export interface CheckParts {
  targets: CheckPart[];
}

// A model fitted, with its curves.
export interface CheckPart {
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
  level: string; // series, recording
  floor_text: string;
  series: CheckedSeries;
  curve?: ModelCurve; // the model between the rows too, where signals go on there
  steps: EffectStep[]; // of a drift series only
}

// The rows of a fit.
export interface CheckedSeries {
  time_s: number[];
  measured_um: Num[];
  predicted_um: Num[];
  residual_um: Num[];
  sigma_um?: Num[]; // where readings state it
  contributions: EffectCurve[]; // of each effect
  inputs: Column[]; // at the same rows: signals, or angle_deg, direction, recording; and cycle
  regimes: RegimeStretch[]; // of the speed, where it is known
}

// A stretch of time with one regime of the speed.
export interface RegimeStretch {
  regime: string;
  from_s: number;
  to_s: number;
}

// A model over time.
export interface ModelCurve {
  time_s: number[];
  predicted_um: Num[];
}

// What an effect answers to a step of its input from the least to the largest value in the data.
export interface EffectStep {
  effect: string;
  input: string;
  from: number;
  to: number;
  unit: string;
  time_s: number[];
  response_um: Num[];
}

// What a model of each target lacks.
export interface DiagnosisParts {
  targets: (DiagnosisPart | NotDiagnosed)[];
}

// Which effect a model lacks, with curves; what the check has is there alone.
export interface DiagnosisPart {
  target: string; // column that is explained
  rmse_um: Num; // that the model leaves
  floor_um: Num; // that no model could explain; null: not known
  floor_source: string; // what tells the floor
  n: number; // readings
  n_effective: Num; // independent readings that they are worth
  adequate: boolean; // whether the model leaves noise alone
  converged: boolean; // whether the fit came to an end
  verdict: string; // named, probable, driver, equivalent, unexplained, untestable, nothing
  sentence: string; // what it says in plain words
  command: string; // to type next; empty: none
  named: Bound[]; // that are missing
  probable: Bound[]; // that are probably missing
  equivalent: Bound[][]; // sets, of each of which one may be missing, the likeliest first
  drivers: Driver[]; // from p = 0.5 on
  own: OwnValue[]; // values that the model holds and that may be others, from p = 0.05 on
  effects: LabelledEffect[]; // from p = 0.01 on
  p_nothing: Num; // probability that nothing is missing
  p_discrepancy: Num; // probability of a slow curve without a cause
  discrepancy_um: Num; // its standard deviation
  candidates: DrawnCandidate[]; // the likeliest set, then others by probability
  stand_ins: StandIn[]; // effects added earlier that others explain better
  hidden_um: Num; // amplitude up to which an effect could hide in these data
  untestable: Untestable[]; // effects that these data cannot show
  not_searched: NotSearched[]; // effects with more choices of columns than were searched
  reasons: string[]; // why it is not named, or not all of it
  gains_by_run: GainByRun[]; // of several runs: gains that differ
  next_test: DecidingTest | null; // that would decide; null: nothing is open
  rmse_after_um: Num; // with the best set
  next_test_text: string; // as the terminal has it; empty: none is needed
  hint: string; // what no command does; empty: nothing
  refit_um: Num[]; // by what the model's own parameters give way beside what is missing, at the same rows
  coherence: Coherence | null; // null: nothing to compare
}

// An effect, and the probability that it is missing, with its label.
export interface LabelledEffect {
  effect: string; // as `ballbar effects` lists it
  columns: Record<string, string>; // by role
  p: Num; // probability
  label: string;
}

// An effect that may be missing, with its curve.
export interface DrawnCandidate {
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
  label: string; // lagged_expansion(T_room_degC)
  best_surrogate_fall: Num; // share of the RMSE beside the rest of its set
  curve_um: Num[]; // what it adds that the model cannot make itself, at the rows of the checked series
}

// Which effect (column) could be taken for one that might be there (row): above 0.95 it may be.
export interface Coherence {
  effects: string[];
  values: Num[][];
}

// A regression over batches, and what it predicts for the job.
export interface BatchPart {
  target: string;
  method: string; // pcr, 7 components
  batches: WeighedBatch[];
  time_s: number[];
  predicted_um: Num[];
  half_width_um: Num[]; // of the interval of 95 %
  measured_um?: Num[];
  T2_of_largest: Num[]; // share of the largest trained on
  Q_of_largest: Num[];
  broken: string[]; // sensors that look so
  warnings: string[];
}

// A batch that a regression was trained on.
export interface WeighedBatch {
  name: string;
  weight: number;
}

// What of a page changes with the model.
export interface ModelPart {
  files: string[]; // that the page is made of
  summary: string[]; // the conclusions
  fit?: FitPart; // of recordings, with what each effect adds
  check?: CheckParts; // how it fits
  diagnose?: DiagnosisParts; // what it lacks
  ledger?: Ledger; // of the model
}

// A model with values held.
export interface HeldPart {
  check: CheckParts; // how it fits
}

// A new revision of a model.
export interface RevisedPart {
  sentence: string; // what it says in plain words
  supported: boolean; // whether the data support it
  ledger: Ledger;
}

// The data of a page of a machine over its tests.
export interface HistoryReport {
  format: string; // ballbar-report 1
  title: string;
  made_by: string; // ballbar 0.1.0
  made_on: string; // date
  files: string[]; // that it is made of
  summary: string[]; // the conclusions, whole sentences, first to be read
  signals: SeriesBlock[]; // temperatures, speed and the like, each file on its own clock
  history: HistoryPart;
}

// A machine over its tests, as it is drawn.
export interface HistoryPart {
  groups: HistoryGroup[];
  geometry: string[]; // sentences
  geometry_rows: string[][]; // what, um/m, from
  skipped: string[]; // sentences
}

// Tests that can be compared.
export interface HistoryGroup {
  label: string; // XY, 100 mm, 1000 mm/min, 360 deg
  first: string; // quantity to look at first
  quantities: HistoryQuantity[];
  heading: string[]; // of the table
  rows: string[][];
}

// A quantity over the tests with a date.
export interface HistoryQuantity {
  name: string;
  unit: string;
  year: number[]; // 2025.5
  values: Num[];
  sigmas: Num[];
  trend?: CurveOverYears;
  marks?: number[]; // years in which it steps
  lower?: number; // tolerance
  upper?: number;
}

// A curve with half of the interval that holds 68 %.
export interface CurveOverYears {
  year: number[]; // 2025.5
  values: Num[];
  sigmas: Num[];
}

// The data of a page of many machines.
export interface FleetReport {
  format: string; // ballbar-report 1
  title: string;
  made_by: string; // ballbar 0.1.0
  made_on: string; // date
  files: string[]; // that it is made of
  summary: string[]; // the conclusions, whole sentences, first to be read
  signals: SeriesBlock[]; // temperatures, speed and the like, each file on its own clock
  fleet: FleetPart;
}

// Many machines over their tests, as they are drawn.
export interface FleetPart {
  heading: string[]; // of the ranking
  rows: string[][];
  machines: DrawnMachine[]; // that need something
}

// A machine that needs something, as it is drawn.
export interface DrawnMachine {
  label: string; // its name
  reason: string; // why it is called
  findings: string[]; // what was found and what to do
  first: string; // quantity to look at first
  quantities: HistoryQuantity[]; // with the curve that was found
}

// The files that a page was made of, inside it.
export interface CarriedFiles {
  files: CarriedFile[];
  data: string[]; // the words for DATA
  model?: string; // where there is one
}

// A file inside a page.
export interface CarriedFile {
  path: string; // below the common folder of all
  base64: string; // its bytes
}

