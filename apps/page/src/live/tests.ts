// The ballbar tests among the files, as the program tells them: what they are looked at as, and what each may be compared
// with. Two tests of a plane are before and after; others
// are a table.
import { files_of } from "../drawing/command";
import { type Group, last_part } from "./files";
import type { TestHead } from "../report";
import type { Subject } from "./runs";
import { plain } from "../drawing/text";

export type Look = Pick<Subject, "data" | "compared" | "view">;

const day_of = ({ date }: TestHead): string => (date ?? "").slice(0, 10);

export const by_date = (tests: readonly TestHead[]): TestHead[] => [...tests].sort((a, b) => (a.date ?? "").localeCompare(b.date ?? ""));

const planes_of = (tests: readonly TestHead[]): string[] => [...new Set(tests.map(({ plane }) => plane))];

const once_a_plane = (tests: readonly TestHead[]): boolean => planes_of(tests).length === tests.length;

// A plane was tested on several days.
export const is_history = (tests: readonly TestHead[]): boolean =>
  planes_of(tests).some((plane) => new Set(tests.filter((one) => one.plane === plane && one.date !== null).map(day_of)).size > 1);

export const look_at = (tests: readonly TestHead[]): Partial<Look> => {
  const [first, second] = by_date(tests);
  if (first && second && tests.length === 2 && first.plane === second.plane) {
    return { data: files_of(first), compared: files_of(second), view: "" };
  }
  return tests.length > 1 ? { view: "table" } : {};
};

// What tests that came are to those that are looked at: after them, or before where they are older; another part of the
// same machine; or a matter of their own.
export type Relation = { kind: "pair"; before: readonly TestHead[]; after: readonly TestHead[] } | { kind: "together"; planes: string[] } | { kind: "apart" };

export const relation_of = (seen: readonly TestHead[], came: readonly TestHead[]): Relation => {
  const all = [...seen, ...came];
  if (seen.length === 0 || came.length === 0) return { kind: "apart" };
  const machines = new Set(all.map(({ machine }) => machine).filter((machine) => machine !== ""));
  if (once_a_plane(seen) && once_a_plane(came)) {
    const alike = planes_of(came).some((plane) => planes_of(seen).includes(plane));
    if (!alike) return machines.size > 1 ? { kind: "apart" } : { kind: "together", planes: planes_of(all) };
    const older = (by_date(came).at(-1)?.date ?? "") < (by_date(seen)[0]?.date ?? "") && came.every(({ date }) => date !== null);
    return older ? { kind: "pair", before: came, after: seen } : { kind: "pair", before: seen, after: came };
  }
  return machines.size < 2 && is_history(all) ? { kind: "together", planes: [] } : { kind: "apart" };
};

// How a list names a test: its file with the folder where names repeat, the day, the plane.
export const test_label = (test: TestHead, among: readonly TestHead[]): string => {
  const name = last_part(test.file);
  const repeats = among.filter(({ file }) => last_part(file) === name).length > 1;
  const shown = repeats ? test.file.split("/").slice(-2).join("/") : name;
  return plain([day_of(test), shown.toUpperCase().includes(test.plane) ? "" : test.plane, shown].filter((part) => part !== "").join(", "), 80);
};

// Of one that is looked at alone, what it may be compared with; of several the other drops.
export interface Other {
  words: readonly string[];
  label: string;
  older: boolean; // than what is looked at: then it is the one before
}

export const others_of = (subject: Subject, tests: ReadonlyMap<string, readonly TestHead[]>, groups: readonly Group[]): Other[] => {
  if (subject.group.kind !== "recordings" || subject.view !== "") return [];
  const all = [...tests.values()].flat();
  const looked_at = all.filter((test) => files_of(test).some((file) => subject.data.includes(file)));
  const [one] = looked_at;
  if (!one) return [];
  if (looked_at.length === 1) {
    return by_date(all)
      .filter((test) => test !== one && test.plane === one.plane)
      .map((test) => ({ words: files_of(test), label: test_label(test, all), older: test.date !== null && one.date !== null && test.date < one.date }));
  }
  return groups
    .filter(({ key, kind }) => kind === "recordings" && key !== subject.group.key && once_a_plane(looked_at))
    .filter(({ key }) => {
      const its = tests.get(key) ?? [];
      return once_a_plane(its) && its.some(({ plane }) => planes_of(looked_at).includes(plane));
    })
    .map(({ data, title }) => ({ words: data, label: plain(title, 60), older: false }));
};
