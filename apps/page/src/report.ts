// The data of a page: one JSON object, written by `ballbar report`. Keys that commands have too mean what they mean
// there; all are listed in results.ts, of which this is what the page calls them. `--plot` of other commands gives the
// parts that it draws.
import type * as results from "./results";

export type Num = results.Num;
export type Column = results.Column;
export type SeriesBlock = results.SeriesBlock;

// Values of a key that are texts of a few.
type With<Type, Key extends keyof Type, Value> = Omit<Type, Key> & { [key in Key]: Value };

export type Recording = results.PageRecording & { direction?: "CCW" | "CW" };
export type Result = results.ResultRow & { judgement?: "pass" | "warning" | "fail" };
export type FitPart = Omit<results.FitPart, "recordings" | "results" | "pairs"> & {
  recordings: Recording[];
  results: { of: string; rows: Result[] }[];
  pairs?: [number, number][];
};
export type StoredAlone = results.ResultsAlone;

export type MachineErrorRow = results.MachineError;
export type MachineErrorsPart = results.MachineErrorsPart;

export type TestHead = results.TestHead;
export type QuantityDifference = results.QuantityDifference;
export type ComparedTests = results.ComparedTests;
export type DrawnTest = results.DrawnTest;

export type DriftPart = With<results.DriftOfTests, "points", (results.DriftPoint & Record<string, Num>)[]>;
export type ProbesPart = results.ProbesPart;

export type ComparedAxis = With<results.ComparedAxis, "points", (results.ComparedSample & Record<string, Num>)[]> &
  Record<string, unknown>;
export type ComparePart = With<results.Comparison, "axes", Record<string, ComparedAxis>>;

export type Parameter = results.FittedParameter;
export type Checked = results.CheckPart;

export type Plan = results.Plan;

export type Bound = results.Bound;
export type Candidate = results.DrawnCandidate;
export interface Diagnosed extends results.DiagnosisPart {
  verdict: "named" | "probable" | "driver" | "equivalent" | "unexplained" | "untestable" | "nothing";
  not_diagnosed?: string; // why; then nothing else is there
}

export type HypothesesPart = results.Hypotheses;

export type LedgerRow = results.LedgerRow;
export type LedgerPart = results.Ledger;
export type BatchPart = results.BatchPart;
export type MeanPointState = results.DrawnMeanPointState;
export type MeanPointPart = results.MeanPointPart;

export type HistoryQuantity = results.HistoryQuantity;
export type HistoryGroup = results.HistoryGroup;
export type HistoryPart = results.HistoryPart;
export type FleetMachine = results.DrawnMachine;
export type FleetPart = results.FleetPart;

export interface Report extends Omit<results.Report, "fit" | "drift" | "compare" | "diagnose"> {
  fit?: FitPart;
  drift?: DriftPart;
  compare?: ComparePart;
  diagnose?: { targets: Diagnosed[] };
  mean_point?: MeanPointPart;
  history?: HistoryPart;
  fleet?: FleetPart;
}
