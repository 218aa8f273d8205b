// Which recordings are looked at together.
import type { Recording } from "../report";
import { plain } from "../drawing/text";

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
export const labels_of = (recordings: readonly Recording[]): string[] => {
  const labels = recordings.map((recording) => plain(recording.label, 60));
  return labels.map((label, k) =>
    labels.indexOf(label) === k && labels.lastIndexOf(label) === k ? label : `${label} (${k + 1})`,
  );
};

export const one_by_one = (recordings: readonly Recording[]): Group[] => {
  const labels = labels_of(recordings);
  return recordings.map((recording, k) => ({ value: String(k), label: labels[k] ?? "", of: [recording] }));
};

// The two directions of a test together first, because their difference shows play and lag; then each recording alone.
export const pairs_and_singles = (recordings: readonly Recording[]): Group[] => {
  const pairs = recordings.flatMap((recording, k): Group[] => {
    const next = recordings[k + 1];
    if (!next || !both(recording, next)) return [];
    const name = plain(recording.label, 60).replace(/[,\s]*(CCW|CW)$/, "");
    return [
      { value: `${k}+${k + 1}`, label: `${name}, ${recording.direction} and ${next.direction}`, of: [recording, next] },
    ];
  });
  return [...pairs, ...one_by_one(recordings)];
};

// Recordings of one kind, plane and direction: the same figure, test after test. In the order of their times.
export const repeated = (recordings: readonly Recording[], at_least: number): Group[] => {
  const groups = new Map<string, Recording[]>();
  for (const recording of recordings) {
    const { plane, direction, arc_deg } = recording;
    const key = is_circle(recording)
      ? `${plane ?? "?"} plane, ${direction ?? "?"}, ${(arc_deg ?? 360) > 359 ? "full turn" : `arc of ${Math.round(arc_deg ?? 0)}°`}`
      : "axial";
    groups.set(key, [...(groups.get(key) ?? []), recording]);
  }
  return [...groups]
    .filter(([, of]) => of.length >= at_least)
    .map(([key, of]) => ({
      value: plain(key, 60),
      label: plain(key, 60),
      of: [...of].sort((a, b) => (a.time_s ?? 0) - (b.time_s ?? 0)),
    }));
};
