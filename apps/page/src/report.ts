// The data of a page: one JSON object, written by `ballbar report`. Keys that commands have too mean what they mean
// there (`ballbar fit --json`, drift, compare, check, diagnose, ledger); the keys added for the page are the curves.
// `--plot` of other commands gives the parts that it draws.
// A number that is not known is null. Long columns are arrays of numbers, rounded to seven digits.
import type * as results from "./results";

export type Num = results.Num;

// Columns on one clock. Role as in a series file: "structure", "ambient", "speed", "measured" ...
export interface Column {
  name: string;
  role: string;
  unit: string;
  values: Num[];
}
export interface SeriesBlock {
  source: string; // the file, or "drift"
  time_s: number[];
  columns: Column[];
}

export interface Recording {
  file: string;
  index: number;
  kind: "circle" | "axial";
  readings: number;
  nominal_length_mm: number;
  // of a circle
  plane?: string;
  direction?: "CCW" | "CW";
  arc_deg?: number;
  feed_mm_per_min?: Num;
  centre_a_um?: Num;
  centre_b_um?: Num;
  radius_mm?: Num;
  circularity_um?: Num;
  rms_um?: Num;
  sigma_centre_a_um?: Num;
  sigma_centre_b_um?: Num;
  sigma_radius_um?: Num;
  sigma_circularity_um?: Num;
  max_circular_um?: Num;
  max_at_deg?: Num;
  min_circular_um?: Num;
  min_at_deg?: Num;
  discounted?: number[];
  stored?: Record<string, number>;
  // of an axial one
  length_mm?: Num;
  sigma_length_um?: Num;
  // for the page
  test: string; // "64 min", or the file
  time_s: Num; // of the test in its session
  label: string; // "64 min, XY CCW"
  trace?: {
    angle_deg: number[]; // circle
    time_s?: number[]; // axial
    deviation_um: number[]; // measured length less nominal
    residual_um: number[]; // reading less the fitted circle
    fitted_um: number[]; // deviation_um of the fitted circle at these angles
    effects: { effect: string; values_um: Num[] }[]; // what each effect of the model adds
  };
}
export interface Pair {
  file?: string;
  [key: string]: unknown;
}
export interface Result {
  // a row of the table of results, ours beside what the file stores
  label: string;
  decimals: number;
  ours: Num;
  stored: Num;
  limits?: [Num, Num]; // of the file, lower and upper; and what they say of ours
  judgement?: "pass" | "warning" | "fail";
}
export interface FitPart {
  recordings: Recording[];
  pairs?: [number, number][]; // CCW and CW of one test, as places in recordings
  iso230_4?: Pair;
  iso230_4_pairs?: Pair[];
  results: { of: string; rows: Result[] }[]; // tables, one a recording and one a pair
  stored_alone?: StoredAlone[]; // files without readings
  remarks: string[];
}
export interface StoredAlone {
  file: string;
  stored: { of: string; name: string; value: Num; unit: string }[];
}

// The errors of a machine from one test, ranked: the keys of `diagnose --json` of recordings, and what the page draws.
export interface MachineErrorRow {
  name: string; // "squareness", "backlash_a_pos", "centre_a"
  effect?: string; // whose curve is its own, as in `curves`; one of the circle has none and is not ranked
  value: Num;
  sigma: Num;
  unit: string;
  as_instrument?: { value: Num; rank: number | null } | null; // by the estimator of the instrument's software
  significant?: boolean | null;
  predicts_other_run: boolean | null;
  individual_circularity_um: Num; // this and what follows but `stored` are alike in all rows of an effect
  share_percent: Num;
  rank: number | null; // by what mending it gains; null: not significant, or the circularity stays
  stored: Num;
  stored_rank: number | null;
  circularity_without_um: Num;
  remedy?: string;
}
export interface MachineErrorsPart {
  files: string[];
  file?: Record<string, string | number>; // what the only file states: machine, operator, serial_number ...
  recordings: number[]; // places in fit.recordings
  errors: MachineErrorRow[];
  circularity_um: Num;
  undetermined: string[];
  prior: { name: string; sigma: Num; unit: string }[];
  conclusion: string;
  left_text: string; // what the errors do not explain
  tolerances: string[];
  // for the page, at the readings of each recording
  circle_um: Num[][]; // the fitted circle: centre and scale of all recordings together
  curves: Record<string, Num[][]>; // by effect: what it adds
}

export interface DriftPoint {
  time_s: number;
  [key: string]: Num; // x_um, x_sigma_um, ... elongation_correction_um
}
export interface DriftPart {
  method: string;
  reference_s: number;
  points: DriftPoint[];
  not_cancelled?: string;
}

// Five probes: axes as columns, because there may be a million rows.
export interface ProbesPart {
  what: string;
  reference_s: number;
  time_s: number[];
  axes: { name: string; unit: string; values: Num[]; sigma: Num[] }[];
  remarks: string[];
}

export interface ComparedAxis {
  agreement: "agrees" | "disagrees" | "cannot tell";
  points: { time_s: number; [key: string]: Num }[]; // a_um, b_um, difference_um, sigma_um (or another unit)
  deviation?: { from_s: number; to_s: number; [key: string]: unknown };
  [key: string]: unknown;
}
export interface ComparePart {
  conclusion: string;
  a: string;
  b: string;
  axes: Record<string, ComparedAxis>;
  remarks: string[];
}

export interface Parameter {
  effect?: string;
  name: string;
  value: Num;
  sigma: Num;
  unit: string;
  state?: string;
}
export interface Checked extends results.Checked {
  // for the page
  level: "series" | "recording";
  floor_text: string;
  series: {
    time_s: number[];
    measured_um: Num[];
    predicted_um: Num[];
    residual_um: Num[];
    sigma_um?: Num[];
    contributions: { effect: string; values_um: Num[] }[];
    inputs: Column[]; // at the same rows: signals, or angle_deg, direction, recording; and "cycle"
    regimes: { regime: string; from_s: number; to_s: number }[]; // of the speed, where it is known
  };
  curve?: { time_s: number[]; predicted_um: Num[] }; // the model between the rows too, where signals go on there
  // What each effect answers to a step of its input from the least to the largest value in the data; of a
  // drift series only.
  steps: { effect: string; input: string; from: number; to: number; unit: string; time_s: number[]; response_um: Num[] }[];
}

export type Bound = results.Bound;
export interface Candidate extends results.Candidate {
  label: string; // for the page: "lagged_expansion(T_room_degC)"
  best_surrogate_fall: Num; // for the page: share of the RMSE beside the rest of its set
  curve_um: Num[]; // for the page: what it adds that the model cannot make itself, at the rows of the checked series
}
// What the check of the same target has is there alone.
type OfCheck = "where" | "parameters" | "correlation" | "noise" | "whiteness" | "sentences" | "remarks";
export interface Diagnosed extends Omit<results.Diagnosed, OfCheck | "candidates" | "effects" | "verdict"> {
  not_diagnosed?: string; // why; then nothing else is there
  verdict: "named" | "probable" | "driver" | "equivalent" | "unexplained" | "untestable" | "nothing";
  hint: string; // for the page: what no command does; empty: nothing
  effects: (results.EffectProbability & { label: string })[]; // label: for the page
  candidates: Candidate[];
  rmse_after_um: Num; // with the best set
  refit_um: Num[]; // for the page: by what the model's own parameters give way beside what is missing, same rows
  next_test_text: string; // as the terminal has it; empty: none is needed
  // Row: an effect that might be there; column: one that could be taken for it. |cos| between what survives of both
  // beside the model, the median over the shapes of the row, each with the shape of the column that is most like it;
  // above 0.95 they may be taken for each other. Not symmetric: one with more shapes imitates more.
  coherence: { effects: string[]; values: Num[][] } | null;
}

export interface LedgerRow {
  revision: number;
  change: string;
  target: string;
  data?: string[]; // files, as they were named
  parameters: number;
  rmse_um: Num;
  times_floor: Num;
  held_out_um: Num;
  likelihood_ratio?: Num;
  threshold?: Num; // from which that counts
  best_surrogate_fall?: Num;
  forecast_um?: Num; // RMSE of rows forecast from earlier ones alone
  surrogate_forecast_um?: Num; // the same with a surrogate in the place of the effect
  discrepancy_um?: Num; // standard deviation of the slow curve that is left
  verdict: string; // "named", "driver known", "empirical" ...
  sentence: string;
}
export interface LedgerPart {
  rows: LedgerRow[];
}

// A regression over batches (`ballbar train`), and what it predicts for the job.
export interface BatchPart {
  target: string;
  method: string; // "pcr, 7 components"
  batches: { name: string; weight: number }[];
  time_s: number[];
  predicted_um: Num[];
  half_width_um: Num[]; // of the 95 % interval
  measured_um?: Num[];
  T2_of_largest: Num[];
  Q_of_largest: Num[];
  broken: string[];
  warnings: string[];
}

// Temperature along a spindle, and where it is its mean (`ballbar meanpoint`).
export interface MeanPointState {
  name: string; // the picture's file or the table's column
  mean_degC: number;
  mean_points: { x_mm: number }[];
  x_mm: number[]; // rising
  degC: Num[];
}
export interface MeanPointPart {
  conclusion: string;
  best?: { x_mm: number }; // one place for all states
  states: MeanPointState[];
}

// A machine over its tests (`ballbar history --out`, .html).
export interface HistoryQuantity {
  name: string;
  unit: string;
  year: number[]; // 2025.5; of the tests with a date, rising
  values: Num[];
  sigmas: Num[];
  trend?: { year: number[]; values: Num[]; sigmas: Num[] }; // half of the interval that holds 68 %
  lower?: number; // tolerance
  upper?: number;
  marks?: number[]; // years in which it steps
}
export interface HistoryGroup {
  label: string; // "XY, 100 mm, 1000 mm/min, 360 deg"
  first: string; // quantity to look at first
  quantities: HistoryQuantity[];
  heading: string[]; // of the table
  rows: string[][];
}
export interface HistoryPart {
  groups: HistoryGroup[];
  geometry: string[]; // sentences
  geometry_rows: string[][]; // what, um/m, from
  skipped: string[];
}

// Many machines over their tests: fleet_page() of apps/history.
export interface FleetMachine {
  label: string; // its name
  reason: string; // why it is called
  findings: string[]; // whole sentences: what was found and what to do
  first: string; // quantity to look at first
  quantities: HistoryQuantity[]; // the trend is the curve that was found
}
export interface FleetPart {
  heading: string[]; // of the ranking
  rows: string[][];
  machines: FleetMachine[]; // those that need something
}

export interface Report {
  format: "ballbar-report 1";
  title: string;
  made_by: string; // "ballbar 0.1.0"
  made_on: string; // "2026-11-22"
  files: string[];
  summary: string[]; // the conclusions, whole sentences, first to be read
  skipped?: { file: string; why: string }[]; // files that cannot be read, by their names
  fit?: FitPart;
  machine_errors?: MachineErrorsPart[]; // one a test
  drift?: DriftPart;
  five_probe?: ProbesPart;
  compare?: ComparePart;
  signals: SeriesBlock[]; // temperatures, speed and the like, each file on its own clock
  check?: { targets: Checked[] };
  diagnose?: { targets: Diagnosed[] };
  ledger?: LedgerPart;
  batch?: BatchPart;
  mean_point?: MeanPointPart;
  history?: HistoryPart;
  fleet?: FleetPart;
}
