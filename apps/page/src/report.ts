// The data of a page: one JSON object, written by `ballbar report`. Keys that commands have too mean what they mean
// there; all are listed in results.ts, of which this is what the page calls them. `--plot` of other commands gives the
// parts that it draws.
import type * as results from "./results";

export type {
  BatchPart, Bound, CheckPart as Checked, Column, ComparedTests, DrawnCandidate as Candidate,
  DrawnMachine as FleetMachine, DrawnMeanPointState as MeanPointState, DrawnTest, FittedParameter as Parameter,
  HistoryGroup, HistoryQuantity, Hypotheses as HypothesesPart, Ledger as LedgerPart, LedgerRow,
  MachineError as MachineErrorRow, MachineErrorsPart, MeanPointPart, NextAction, Num, Plan, ProbesPart, QuantityDifference,
  ResultsAlone as StoredAlone, SignalGap, TestHead, TestRow,
} from "./results";

// Values of a key that are texts of a few.
type With<Type, Key extends keyof Type, Value> = Omit<Type, Key> & { [key in Key]: Value };

export type Recording = results.PageRecording & { direction?: "CCW" | "CW" };
export type Result = results.ResultRow & { judgement?: "pass" | "warning" | "fail" };
export type FitPart = Omit<results.FitPart, "recordings" | "results" | "pairs"> & {
  recordings: Recording[];
  results: { of: string; rows: Result[] }[];
  pairs?: [number, number][];
};

export type DriftPart = With<results.DriftOfTests, "points", (results.DriftPoint & Record<string, results.Num>)[]>;

export type ComparedAxis = With<results.ComparedAxis, "points", (results.ComparedSample & Record<string, results.Num>)[]> &
  Record<string, unknown>;
export type ComparePart = With<results.Comparison, "axes", Record<string, ComparedAxis>>;

// The wall clock of time 0, of all signals that know one; undefined: none, or several.
export const started_of = ({ signals }: Pick<Report, "signals">): string | undefined => {
  const known = new Set(signals.flatMap(({ started }) => started ?? []));
  return known.size === 1 ? [...known][0] : undefined;
};

export interface Diagnosed extends results.DiagnosisPart {
  verdict: "named" | "probable" | "driver" | "equivalent" | "unexplained" | "untestable" | "nothing";
  not_diagnosed?: string; // why; then nothing else is there
}

export interface Report extends Omit<results.Report, "fit" | "drift" | "compare" | "diagnose"> {
  fit?: FitPart;
  drift?: DriftPart;
  compare?: ComparePart;
  diagnose?: { targets: Diagnosed[] };
  mean_point?: results.MeanPointPart;
  history?: results.HistoryPart;
  fleet?: results.FleetPart;
  test_table?: results.TestRows;
}
