// The recordings that a model of recordings was fitted to, by the labels that they have elsewhere on the page.
import type { Choice } from "../picture";
import { is_circle, labels_of } from "./recording_groups";
import type { Num, Report } from "../report";
import type { Strand } from "../drawing/strands";
import { t } from "../texts/texts";

const kMost_together = 4; // recordings drawn over each other at first

// Recordings are numbered as they were read, from 0; only circles have a model.
export const recording_name = (report: Report, strands: readonly Strand[], recording: Num): string => {
  const circles = report.fit?.recordings.filter(is_circle) ?? [];
  const label = circles.length >= strands.length ? labels_of(circles)[recording ?? -1] : undefined;
  return label ?? t.recordings_numbered({ number: (recording ?? 0) + 1 });
};

export const recording_choice = (report: Report, strands: readonly Strand[], together: boolean): Choice[] => {
  if (strands.length < 2) return [];
  const each = strands.map(({ recording }) => ({
    value: String(recording),
    label: recording_name(report, strands, recording),
  }));
  const all = together ? [{ value: "", label: t.recordings_all }] : [];
  const initial = together && strands.length <= kMost_together ? "" : (each[0]?.value ?? "");
  return [{ key: "recording", label: t.recording, values: [...all, ...each], initial }];
};

export const chosen_strands = (strands: readonly Strand[], chosen: Readonly<Record<string, string>>): Strand[] =>
  strands.filter(({ recording }) => !chosen["recording"] || String(recording) === chosen["recording"]);
