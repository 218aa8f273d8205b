// The page's sections, in the order they are read.
import { batch_section } from "./batch/batch";
import { comparison_section } from "./comparison/comparison";
import { diagnosis_sections } from "./diagnosis/diagnosis";
import { drift_section } from "./drift/drift";
import { history_sections } from "./history/history";
import { ledger_section } from "./diagnosis/ledger";
import { machine_errors_section } from "./machine_errors/machine_errors";
import { mean_point_section } from "./mean_point/mean_point";
import { model_sections } from "./model/model";
import type { Section } from "./picture";
import { recordings_section } from "./recordings/recordings";
import type { Report } from "./report";

export const sections_of = (report: Report): Section[] => [
  ...history_sections(report),
  ...machine_errors_section(report),
  ...drift_section(report),
  ...comparison_section(report),
  ...recordings_section(report),
  ...model_sections(report),
  ...diagnosis_sections(report),
  ...ledger_section(report),
  ...batch_section(report),
  ...mean_point_section(report),
];
