// The page's sections: in the order of their pictures, and in the order that a reader wants.
import { batch_section } from "./batch/batch";
import { change_section } from "./change/change";
import { comparison_section } from "./comparison/comparison";
import { diagnosis_sections } from "./diagnosis/diagnosis";
import { drift_section } from "./drift/drift";
import { fleet_sections } from "./fleet/fleet";
import { history_sections } from "./history/history";
import { ledger_section } from "./diagnosis/ledger";
import { machine_errors_section } from "./machine_errors/machine_errors";
import { mean_point_section } from "./mean_point/mean_point";
import { model_sections } from "./model/model";
import { test_table_sections } from "./history/test_table";
import type { Section } from "./picture";
import { recordings_section } from "./recordings/recordings";
import type { Report } from "./report";
import { signals_section } from "./drift/signals";

interface Kind {
  // The sections of the highest rank are on the first screen, and the details begin with them: first what a verdict
  // rests on, raw data last. What a section says of itself (`says`) is added.
  rank: number;
  of: (report: Report) => Section[];
}

const kinds: readonly Kind[] = [
  { rank: 120, of: test_table_sections },
  { rank: 60, of: history_sections },
  { rank: 62, of: fleet_sections },
  { rank: 110, of: change_section },
  { rank: 100, of: machine_errors_section },
  { rank: 95, of: drift_section },
  { rank: 10, of: signals_section },
  { rank: 45, of: comparison_section },
  { rank: 20, of: recordings_section },
  { rank: 70, of: model_sections },
  { rank: 80, of: diagnosis_sections },
  { rank: 65, of: ledger_section },
  { rank: 75, of: batch_section },
  { rank: 40, of: mean_point_section },
];

export const sections_of = (report: Report): Section[] => kinds.flatMap(({ of }) => of(report));

export interface Ranked {
  first: Section[]; // of one kind, each with something for the first screen; that with most to say comes first
  all: Section[]; // those of `first` too
}

export const ranked_sections = (report: Report): Ranked => {
  const ranked = kinds
    .flatMap(({ rank, of }) => of(report).map((section) => ({ section, kind: of, rank: rank + (section.says ?? 0) })))
    .sort((a, b) => b.rank - a.rank);
  const proved = ranked.filter(({ section }) => section.first !== undefined);
  return {
    first: proved.filter(({ kind }) => kind === proved[0]?.kind).map(({ section }) => section),
    all: ranked.map(({ section }) => section),
  };
};
