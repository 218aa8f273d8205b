
import { is_log_word } from "./log_words";
import type { Report } from "../report";
import { t } from "../texts/texts";

// What a file is taken for before the program reads it: by its first lines, else by its ending.

export type Kind =
  | "recording"
  | "session"
  | "runs"
  | "model"
  | "trained" // a model of `train`
  | "series"
  | "report" // a page of `report`
  | "other"; // nothing that is opened by itself

export interface Held {
  path: string; // for the engine
  name: string; // as it was dropped
  bytes: number;
  kind: Kind;
  head: string; // its first letters
}

export const kHead_bytes = 65536;

// UTF-16 has a zero beside each ASCII letter.
export const head_of = async (file: Blob): Promise<string> => {
  const bytes = new Uint8Array(await file.slice(0, kHead_bytes).arrayBuffer());
  const [first = 1, second = 1] = bytes;
  const encoding = first === 0 || first === 0xfe ? "utf-16be" : second === 0 || second === 0xfe ? "utf-16le" : "utf-8";
  return new TextDecoder(encoding).decode(bytes);
};

const formats: readonly (readonly [RegExp, Kind])[] = [
  [/"ballbar-session \d/, "session"],
  [/"ballbar-runs \d/, "runs"],
  [/"ballbar-model \d/, "model"],
  [/"ballbar-log \d/, "recording"],
  [/"ballbar-series \d/, "series"],
  [/"ballbar-(machine|schedule|recipe)[a-z-]* \d/, "other"],
];

const stated = (head: string): Kind | undefined => {
  const format = /^[#\s]*"?format"?\s*[=:]\s*("[^"\n]{1,80}")/m.exec(head)?.[1];
  return format === undefined ? undefined : formats.find(([pattern]) => pattern.test(format))?.[1];
};

export const kind_of = (name: string, head: string): Kind => {
  const ending = /\.([A-Za-z0-9]+)$/.exec(name)?.[1]?.toLowerCase() ?? "";
  switch (ending) {
    case "b5r":
    case "zip": // of tests: the program reads what is inside
      return "recording";
    case "html":
    case "htm":
      return "report";
    case "toml":
      return stated(head) ?? (/^\s*(target\s*=|\[\[effect\]\])/m.test(head) ? "model" : "other");
    case "json":
      return /"ballbar-(batch-model|effect-regression) \d/.test(head) ? "trained" : "series";
    case "csv":
    case "txt":
    case "tsv":
    case "dat":
    case "asc":
    case "log":
    case "lvm":
    case "xlsx":
    case "mat":
      return stated(head) ?? "series";
    default:
      return /<BALLBAR|DYNAMIC_BALLBAR/.test(head) ? "recording" : (stated(head) ?? "other");
  }
};

// Files that were dropped or chosen, with their folders, and the paths they have for the engine.

export interface Dropped {
  name: string; // with its folders, as it was dropped; to be shown as text only
  file: Blob;
}

const file_of = (entry: FileSystemFileEntry): Promise<File> => new Promise((done, failed) => entry.file(done, failed));

// A folder is listed a hundred at a time, until nothing more comes.
const entries_of = async (folder: FileSystemDirectoryEntry): Promise<FileSystemEntry[]> => {
  const reader = folder.createReader();
  const all: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((done, failed) => reader.readEntries(done, failed));
    if (some.length === 0) return all;
    all.push(...some);
  }
};

const all_of = async (entry: FileSystemEntry, before: string): Promise<Dropped[]> => {
  const name = before + entry.name;
  if (entry.isFile) return [{ name, file: await file_of(entry as FileSystemFileEntry) }];
  const inside: Dropped[] = [];
  for (const one of await entries_of(entry as FileSystemDirectoryEntry)) inside.push(...(await all_of(one, `${name}/`)));
  return inside;
};

// What a system or a program hides beside data, as macOS does on every stick: ".DS_Store", "._00.b5r".
const is_hidden = ({ name }: Dropped): boolean => /(^|\/)\.[^./]/.test(name);

// Where nothing else was chosen they are meant.
const without_hidden = (all: Dropped[]): Dropped[] => (all.every(is_hidden) ? all : all.filter((one) => !is_hidden(one)));

// The entries have to be taken while the event is handled; reading them can wait.
export const dropped_of = async (transfer: DataTransfer): Promise<Dropped[]> => {
  const entries = [...transfer.items].flatMap((item) => (item.kind === "file" ? [item.webkitGetAsEntry()] : []));
  const files = [...transfer.files];
  if (entries.length === 0 || entries.includes(null)) return seen_of(files);
  const all: Dropped[] = [];
  for (const entry of entries) if (entry) all.push(...(await all_of(entry, "")));
  return without_hidden(all);
};

const seen_of = (files: Iterable<File>): Dropped[] =>
  without_hidden([...files].map((file) => ({ name: file.webkitRelativePath || file.name, file })));

export const chosen_of = (input: HTMLInputElement): Dropped[] => seen_of(input.files ?? []);

const kLongest = 120; // letters of a part of a path

// A part of a path that is a plain name whatever it was: no way up, no control characters, no half of a letter (Windows
// lets names have them, JSON does not).
const safe_part = (part: string): string => {
  const plain = part.replace(/[\p{Cs}\u0000-\u001f\u007f-\u009f\\]/gu, "_").trim();
  if (/^\.*$/.test(plain)) return "_";
  const letters = Array.from(plain);
  if (letters.length <= kLongest) return plain;
  const ending = /\.[A-Za-z0-9]{1,8}$/.exec(plain)?.[0] ?? "";
  return letters.slice(0, kLongest - ending.length).join("") + ending;
};

const numbered = (path: string, number: number): string => path.replace(/(\.[^./]*)?$/, (ending) => ` (${number})${ending}`);

// Below a folder, so that none begins with what a command would take for an option; each once.
export const safe_paths = (names: readonly string[], folder: string, taken: ReadonlySet<string>): string[] => {
  const used = new Set(taken);
  return names.map((name) => {
    const parts = name.split("/").filter((part) => part !== "");
    const path = `${folder}/${parts.map(safe_part).join("/") || "_"}`;
    let free = path;
    for (let number = 2; used.has(free); ++number) free = numbered(path, number);
    used.add(free);
    return free;
  });
};

// Files that belong together: a session with what it names, the ballbar tests of one drop, a series; and the models
// beside them.

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

export const last_part = (path: string): string => path.slice(path.lastIndexOf("/") + 1);

const titled = (files: readonly Held[]): string => {
  const [first] = files;
  if (!first) return "";
  const [folder, rest] = first.name.split("/", 2);
  if (folder && rest && files.every(({ name }) => name.startsWith(`${folder}/`))) return folder;
  return files.length === 1 ? last_part(first.name) : `${last_part(first.name)} + ${files.length - 1}`;
};

const kFewest_runs = 3;
const kNames = /[\p{L}][^,;\t|]*[,;\t|][^,;\t|]*[\p{L}]/u; // of two columns

// As logs of one device have their line of names.
const have_line_in_common = ([first, ...others]: readonly Held[]): boolean => {
  const lines = (first?.head.split(/\r\n?|\n/) ?? []).filter((line) => kNames.test(line));
  return lines.some((line) => others.every(({ head }) => head.includes(line)));
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
    const nearest = near.filter(({ path }) => folder_of(path) === folder);
    const rest = near.filter((one) => !nearest.includes(one));
    groups.push({ key: data.join("\n"), title, kind, data, files, models: [...nearest, ...rest] });
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
  // Logs of one folder with the same columns are runs too, all together; each is also opened by itself.
  const folders = new Map<string, Held[]>();
  for (const one of free("series")) folders.set(folder_of(one.path), [...(folders.get(folder_of(one.path)) ?? []), one]);
  for (const files of folders.values()) {
    const runs = [...files].sort((a, b) => a.path.localeCompare(b.path, "en", { numeric: true }));
    if (runs.length < kFewest_runs || !have_line_in_common(runs)) continue;
    add("runs", t.live_all_as_runs({ n: runs.length }), runs.map(({ path }) => path), runs);
    for (const file of runs) taken.delete(file);
  }
  for (const one of free("series")) add("series", last_part(one.name), [one.path], [one]);
  for (const one of free("report")) add("report", last_part(one.name), [one.path], [one]);
  return groups;
};

const is_archive = ({ kind, head }: Held): boolean => kind === "recording" && head.startsWith("PK");

// Whether a word of a command is the file, or lies in it.
export const is_within = (word: string, file: string): boolean => word === file || word.startsWith(`${file}/`);

// Ballbar tests in one folder, or in one archive, are also a session: the drift from test to test.
export const folder_as_session = ({ kind, files }: Group): string => {
  if (kind !== "recordings" || (files.length > 1 && files.some(is_archive))) return "";
  const [first] = files;
  return files.length > 1 ? folder_of_all(files).replace(/\/$/, "") : first && is_archive(first) ? first.path : "";
};

// A page that `report` wrote, or that was saved here: its data, and the files that it may carry.

export interface PageFile {
  path: string;
  base64: string;
}

// Nothing of the other page is run: it is read as text, never as a document of this one.
const block = (page: Document, id: string): unknown => {
  const text = page.getElementById(id)?.textContent;
  return text ? JSON.parse(text) : null;
};

const is_page_file = (one: unknown): one is PageFile =>
  typeof one === "object" && one !== null && "path" in one && "base64" in one && typeof one.path === "string" && typeof one.base64 === "string";

export interface ReportFile {
  report: Report;
  files: PageFile[];
  data: string[]; // words for DATA, among the files
  model: string; // "": none
  log: string[]; // how a log among them is read
}

const texts = (list: unknown): string[] => (Array.isArray(list) ? list.filter((one) => typeof one === "string") : []);

// Throws Error, with what is wrong.
export const read_report_file = (text: string): ReportFile => {
  const page = new DOMParser().parseFromString(text, "text/html");
  let report: unknown;
  let files: unknown;
  try {
    report = block(page, "report");
    files = block(page, "files");
  } catch {
    throw new Error(t.live_bad_page);
  }
  if (typeof report !== "object" || report === null || !("format" in report) || report.format !== "ballbar-report 1") {
    throw new Error(t.live_no_report);
  }
  const inside = (typeof files === "object" && files !== null ? files : {}) as Record<string, unknown>;
  return {
    report: report as Report,
    files: Array.isArray(inside["files"]) ? inside["files"].filter(is_page_file) : [],
    data: texts(inside["data"]),
    model: typeof inside["model"] === "string" ? inside["model"] : "",
    log: texts(inside["log"]).filter(is_log_word),
  };
};
