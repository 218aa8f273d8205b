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

// The entries have to be taken while the event is handled; reading them can wait.
export const dropped_of = async (transfer: DataTransfer): Promise<Dropped[]> => {
  const entries = [...transfer.items].flatMap((item) => (item.kind === "file" ? [item.webkitGetAsEntry()] : []));
  const files = [...transfer.files];
  if (entries.length === 0 || entries.includes(null)) return files.map((file) => ({ name: file.name, file }));
  const all: Dropped[] = [];
  for (const entry of entries) if (entry) all.push(...(await all_of(entry, "")));
  return all;
};

export const chosen_of = (input: HTMLInputElement): Dropped[] =>
  [...(input.files ?? [])].map((file) => ({ name: file.webkitRelativePath || file.name, file }));

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
