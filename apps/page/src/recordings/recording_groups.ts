// Which recordings are looked at together.
import type { Choice } from "../picture";
import type { FitPart, Num, Recording, Report } from "../report";
import { plain } from "../drawing/text";
import { t } from "../texts/texts";
import type { Strand } from "../drawing/strands";

export interface Group {
  value: string; // of a choice
  label: string;
  of: readonly Recording[];
}

export const is_circle = (recording: Recording): boolean => recording.kind === "circle" && !!recording.trace;
export const is_axial = (recording: Recording): boolean =>
  recording.kind === "axial" && (recording.trace?.time_s?.length ?? 0) > 0;

const both = (a: Recording, b: Recording): boolean =>
  a.test === b.test && a.file === b.file && a.plane === b.plane && a.direction !== b.direction;

// Labels from files may be long and may be the same; those of a list must differ.
export const once_each = (labels: readonly string[]): string[] =>
  labels.map((label, k) =>
    labels.indexOf(label) === k && labels.lastIndexOf(label) === k ? label : `${label} (${k + 1})`,
  );

export const labels_of = (recordings: readonly Recording[]): string[] =>
  once_each(recordings.map((recording) => plain(recording.label, 60)));

export const one_by_one = (recordings: readonly Recording[]): Group[] => {
  const labels = labels_of(recordings);
  return recordings.map((recording, k) => ({ value: String(k), label: labels[k] ?? "", of: [recording] }));
};

// Both directions of a test: as the program paired them, else by what is next to each other in a file.
export const pairs_of = ({ recordings, pairs }: FitPart): [Recording, Recording][] =>
  pairs
    ? pairs.flatMap(([i, j]): [Recording, Recording][] => {
        const [a, b] = [recordings[i], recordings[j]];
        return a && b && is_circle(a) && is_circle(b) ? [[a, b]] : [];
      })
    : recordings.filter(is_circle).flatMap((a, k, circles): [Recording, Recording][] => {
        const b = circles[k + 1];
        return b && both(a, b) ? [[a, b]] : [];
      });

const name_of_pair = (a: Recording, b: Recording): string => {
  const [name, other] = [a, b].map(({ label }) => plain(label, 60).replace(/[,\s]*(CCW|CW)$/, ""));
  return name === other
    ? t.recordings_both_ways({ name: name ?? "", a: a.direction ?? "", b: b.direction ?? "" })
    : t.a_and_b({ a: plain(a.label, 60), b: plain(b.label, 60) });
};

// The two directions of a test together first, because their difference shows play and lag; then each recording alone.
export const pairs_and_singles = (
  recordings: readonly Recording[],
  pairs: readonly [Recording, Recording][],
): Group[] => {
  const names = once_each(pairs.map(([a, b]) => name_of_pair(a, b)));
  const both_ways = pairs.map(
    (pair, k): Group => ({
      value: pair.map((one) => recordings.indexOf(one)).join("+"),
      label: names[k] ?? "",
      of: pair,
    }),
  );
  return [...both_ways, ...one_by_one(recordings)];
};

const figure_of = (recording: Recording): string => {
  const { plane, direction, arc_deg } = recording;
  if (!is_circle(recording)) return t.recordings_axial;
  const arc = (arc_deg ?? 360) > 359 ? t.recordings_full_turn : t.recordings_arc_of({ arc_deg: Math.round(arc_deg ?? 0) });
  return t.recordings_repeated({ plane: plane ?? "?", direction: direction ?? "?", arc });
};

// Recordings of one kind, plane and direction: the same figure, test after test. In the order of their times.
export const repeated = (recordings: readonly Recording[], at_least: number): Group[] => {
  const groups = new Map<string, Recording[]>();
  for (const recording of recordings) {
    const key = figure_of(recording);
    groups.set(key, [...(groups.get(key) ?? []), recording]);
  }
  return [...groups]
    .filter(([, of]) => of.length >= at_least)
    .map(([key, of], k) => ({
      value: String(k),
      label: plain(key, 60),
      of: [...of].sort((a, b) => (a.time_s ?? 0) - (b.time_s ?? 0)),
    }));
};

// One of the groups, the first one first.
export const group_choice = (groups: readonly Group[], key: string, label: string): Choice => ({
  key,
  label,
  values: groups.map((group) => ({ value: group.value, label: group.label })),
  initial: groups[0]?.value ?? "",
});

export const chosen_group = (groups: readonly Group[], value: string | undefined): readonly Recording[] =>
  (groups.find((group) => group.value === value) ?? groups[0])?.of ?? [];

// The recordings that a model of recordings was fitted to, by the labels that they have elsewhere on the page.

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
