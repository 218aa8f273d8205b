// Files that belong together: a session with what it names, the ballbar tests of one drop, a series; and the models
// beside them.
import type { Held } from "./file_kinds";

export type GroupKind = "recordings" | "session" | "runs" | "series" | "report";

export interface Group {
  key: string;
  title: string; // as the files were named; to be shown as text only
  kind: GroupKind;
  data: readonly string[]; // words of a command
  files: readonly Held[];
  models: readonly Held[];
}

const folder_of = (path: string): string => path.slice(0, path.lastIndexOf("/") + 1);

// Paths in a list of files are relative to it, and all that stands in quotes may be one.
const named_by = (list: Held, all: readonly Held[]): Held[] => {
  const quoted = new Set([...list.head.matchAll(/"([^"\n]+)"|'([^'\n]+)'/g)].map(([, a, b]) => a ?? b ?? ""));
  const folder = folder_of(list.path);
  return all.filter((one) => one.path.startsWith(folder) && quoted.has(one.path.slice(folder.length)));
};

// The folder that all lie in; "": none.
const folder_of_all = (files: readonly Held[]): string => {
  const folders = new Set(files.map(({ path }) => folder_of(path)));
  return folders.size === 1 ? ([...folders][0] ?? "") : "";
};

const short = (name: string): string => name.slice(name.lastIndexOf("/") + 1);

const titled = (files: readonly Held[]): string => {
  const [first] = files;
  if (!first) return "";
  return files.length === 1 ? short(first.name) : `${short(first.name)} + ${files.length - 1}`;
};

export const groups_of = (held: readonly Held[]): Group[] => {
  const taken = new Set<Held>();
  const models = held.filter(({ kind }) => kind === "model" || kind === "trained");
  const groups: Group[] = [];
  const add = (kind: GroupKind, title: string, data: readonly string[], files: readonly Held[]): void => {
    for (const file of files) taken.add(file);
    const drop = (files[0]?.path.split("/")[0] ?? "") + "/";
    // Of the same folder first; the first is the one that is proposed.
    const folder = folder_of(files[0]?.path ?? "");
    const near = models.filter(({ path }) => path.startsWith(drop));
    const beside = near.filter(({ path }) => folder_of(path) === folder);
    const rest = near.filter((one) => !beside.includes(one));
    groups.push({ key: data.join("\n"), title, kind, data, files, models: [...beside, ...rest] });
  };
  const lists = (kind: "session" | "runs"): void => {
    for (const list of held.filter((one) => one.kind === kind && !taken.has(one))) {
      const named = named_by(list, held);
      const inner = named.filter((one) => one.kind === "session").flatMap((one) => named_by(one, held));
      const title = /^\s*title\s*=\s*"([^"\n]*)"/m.exec(list.head)?.[1];
      add(kind, title || list.name, [list.path], [...new Set([list, ...named, ...inner])]);
    }
  };
  lists("runs");
  lists("session");
  const free = (kind: Held["kind"]): Held[] => held.filter((one) => one.kind === kind && !taken.has(one));
  const drops = new Map<string, Held[]>();
  for (const one of free("recording")) {
    const drop = one.path.split("/")[0] ?? "";
    drops.set(drop, [...(drops.get(drop) ?? []), one]);
  }
  for (const files of drops.values()) add("recordings", titled(files), files.map(({ path }) => path), files);
  for (const one of free("series")) add("series", short(one.name), [one.path], [one]);
  for (const one of free("report")) add("report", short(one.name), [one.path], [one]);
  return groups;
};

// Ballbar tests in one folder are also a session: the drift from test to test.
export const folder_as_session = (group: Group): string =>
  group.kind === "recordings" && group.files.length > 1 ? folder_of_all(group.files).replace(/\/$/, "") : "";
