// New files: passes them to the engine under safe paths, and stores them in the browser; reports a file that does not
// fit and leaves it out.
import { type Dropped, head_of, type Held, is_within, kind_of, read_report_file, type ReportFile, safe_paths } from "./files";
import { bytes_of, type Engine, type Sample } from "../engine";
import { reason, type View, type Work } from "./runs";
import type { Stretch } from "./history_of_steps";
import { plain } from "../drawing/text";
import { size_spoken } from "./spoken";
import { t } from "../texts/texts";

const kNeed = 8; // memory for a file, in multiples of its size: three to read and draw it, more to fit a model
const kSmall = 1e6; // bytes that always fit

interface Incoming {
  path: string;
  name: string;
  file: Blob;
}

export interface Intake {
  held(): readonly Held[];
  faults(): Map<string, string>; // by path
  take(dropped: readonly Dropped[]): Promise<Held[]>;
  sample(sample: Sample): Promise<Held[]>;
  again(kept: Kept): Promise<void>; // what the browser kept
  // The files that a report page carries, and which words of a command they are.
  files_of_page(page: Held): Promise<{ read: ReportFile; held: Held[]; data: string[]; model: string }>;
  written(path: string): Promise<void>; // by the program: kept with the rest
  keeps(): boolean; // whether the browser keeps all of it, so that a reload loses nothing
  clear(): Promise<void>;
}

export const intake_of = (engine: Engine, work: Work, store: Store | null): Intake => {
  let held: Held[] = [];
  let drops = 0;
  const faults = new Map<string, string>();

  let keeping: Promise<void> = Promise.resolve(); // a large file takes seconds: it is shown before it is kept
  let kept_all = true;
  const keep = (path: string, name: string, file: Blob): void => {
    if (faults.has(path)) return;
    keeping = keeping
      .then(() => store?.put(path, name, file))
      .catch(() => {
        kept_all = false; // full: then a reload loses it
      });
  };
  const hold = async (path: string, name: string, file: Blob): Promise<Held> => {
    const head = await head_of(file);
    const one: Held = { path, name, bytes: file.size, kind: kind_of(name, head), head };
    held = [...held.filter((other) => other.path !== path), one];
    return one;
  };
  const fits = (file: Blob): { fits: boolean; left: number } => {
    if (file.size <= kSmall) return { fits: true, left: Infinity };
    const { used, most } = engine.memory();
    return { fits: kNeed * file.size <= most - used, left: most - used };
  };
  const put = async (path: string, name: string, file: Blob, share: (of_it: number) => void): Promise<Held> => {
    const without = (fault: string): Held => {
      const one: Held = { path, name, bytes: file.size, kind: "other", head: "" };
      held = [...held, one];
      faults.set(path, fault);
      return one;
    };
    if (file.size === 0) return without(t.live_empty);
    const { fits: room, left } = fits(file);
    if (!room) return without(t.live_too_big({ name: plain(name, 80), size: size_spoken(file.size), left: size_spoken(Math.max(0, left)) }));
    try {
      await engine.put(path, file, (bytes) => share(bytes / file.size));
      return await hold(path, name, file);
    } catch (error) {
      return without(reason(error)); // one that the browser may not read; the others come in
    }
  };
  const put_all = async (files: readonly Incoming[]): Promise<Held[]> => {
    const taken: Held[] = [];
    for (const [k, { path, name, file }] of files.entries()) {
      taken.push(await work.during(() => t.live_taking({ name: plain(name, 60), part: k + 1, whole: files.length }), (share) => put(path, name, file, share)));
    }
    return taken;
  };
  const take_in = async (files: readonly Incoming[]): Promise<Held[]> => {
    const taken = await put_all(files);
    for (const { path, name, file } of files) keep(path, name, file);
    return taken;
  };

  return {
    held: () => held,
    faults: () => faults,
    async take(dropped) {
      do ++drops;
      while (held.some(({ path }) => path.startsWith(`files-${drops}/`)));
      const paths = safe_paths(
        dropped.map(({ name }) => name),
        `files-${drops}`,
        new Set(held.map(({ path }) => path)),
      );
      const files = dropped.map(({ name, file }, k) => ({ path: paths[k] ?? "", name, file }));
      return take_in(files);
    },
    sample: async ({ name }) =>
      take_in((await engine.sample_files(name)).map(({ path, text }) => ({ path: `${name}/${path}`, name: path, file: new Blob([bytes_of(text)]) }))),
    async again({ files }) {
      await put_all(files);
    },
    async files_of_page(page) {
      const read = read_report_file(new TextDecoder().decode(await engine.get(page.path)));
      const folder = page.path.replace(/\.[^./]*$/, "");
      const paths = safe_paths(
        read.files.map(({ path }) => path),
        folder,
        new Set(held.map(({ path }) => path)),
      );
      const files = read.files.map(({ path, base64 }, k) => ({
        path: paths[k] ?? "",
        name: path,
        file: new Blob([bytes_of(atob(base64))]),
      }));
      const taken = await take_in(files);
      const put_as = new Map(read.files.map(({ path }, k) => [path, paths[k] ?? ""]));
      // A word may be a file, lie in an archive, or be a folder of these files. Without one of them nothing can be gone on
      // with.
      const word = (path: string): string | null => {
        const inside = path === "." ? "" : `${path.replace(/\/$/, "")}/`;
        const archive = read.files.find((one) => is_within(path, one.path));
        if (archive) return (put_as.get(archive.path) ?? "") + path.slice(archive.path.length);
        return read.files.some((one) => one.path.startsWith(inside)) ? `${folder}/${inside}`.replace(/\/$/, "") : null;
      };
      const words = read.data.map(word);
      const data = words.every((one) => one !== null) ? words : [];
      return { read, held: taken, data, model: put_as.get(read.model) ?? "" };
    },
    async written(path) {
      const file = new Blob([new Uint8Array(await engine.get(path))]);
      const name = held.find((one) => one.path === path)?.name ?? path;
      await hold(path, name, file);
      keep(path, name, file);
    },
    keeps: () => store !== null && kept_all,
    async clear() {
      await keeping;
      kept_all = true;
      for (const { path } of held) if (!faults.has(path)) await engine.remove(path).catch(() => undefined);
      held = [];
      faults.clear();
      await store?.clear().catch(() => undefined);
    },
  };
};

// The dropped files and the present model, stored in the browser until deleted, so that a crash or a reload loses
// nothing: a record a tab. Without storage, as in a private window, everything else works.

export interface KeptState {
  when: number; // ms since 1970
  title: string;
  data: readonly string[]; // words of a command
  model: string; // path; "": none
  target: string;
  log?: readonly string[]; // of a subject; a page before this had none
  targets?: readonly string[];
  unsaved?: boolean; // what is in no file that a person has
  saved_model?: string; // text of the model as it came in, or was saved: what an undo may come back to
  compared?: readonly string[];
  view?: View;
  tolerance_um?: number | null;
  left_out?: readonly Stretch[];
}

export interface Kept {
  record: string;
  own: boolean; // of this tab, before it was loaded again; else of one that is closed
  state: KeptState;
  files: { path: string; name: string; file: Blob }[];
}

export interface Store {
  put(path: string, name: string, file: Blob): Promise<void>;
  say(state: KeptState): Promise<void>;
  kept(): Promise<Kept | null>; // of this tab, else the last of a tab that is closed
  go_on(record: string): Promise<void>; // with that record as this tab's own
  clear(record?: string): Promise<void>; // this tab's own
}

const kName = "ballbar";
const kRecords = 5; // of closed tabs; older ones go
const kTries = 5; // for a record that the page before the reload may still hold
const kBetween_ms = 100;

const done = <T>(request: IDBRequest<T>): Promise<T> =>
  new Promise((fulfil, fail) => {
    request.onsuccess = () => fulfil(request.result);
    request.onerror = () => fail(request.error);
  });

const lock_of = (record: string): string => `${kName} ${record}`;

// Holds the record for as long as the tab lives. false: another tab has it.
const held_by_tab = (record: string): Promise<boolean> =>
  new Promise((known) => {
    if (!navigator.locks) return known(true);
    navigator.locks
      .request(lock_of(record), { ifAvailable: true }, (lock) => {
        known(lock !== null);
        return lock ? new Promise(() => undefined) : undefined;
      })
      .catch(() => known(true));
  });

const wait = (ms: number): Promise<void> => new Promise((over) => setTimeout(over, ms));

// That of the tab before a reload. A copy of a tab has its name too, and gets one of its own.
const record_of_tab = async (): Promise<string> => {
  const before = sessionStorage.getItem(kName);
  for (let k = 0; before !== null && k < kTries; ++k) {
    if (await held_by_tab(before)) return before;
    await wait(kBetween_ms);
  }
  const record = `${Date.now()}-${Math.random()}`;
  await held_by_tab(record);
  sessionStorage.setItem(kName, record);
  return record;
};

const records_in_use = async (): Promise<Set<string>> => {
  const { held = [] } = (await navigator.locks?.query()) ?? {};
  return new Set(held.flatMap(({ name }) => name ?? []));
};

// null: the browser stores nothing here.
export const open_store = async (): Promise<Store | null> => {
  try {
    const opening = indexedDB.open(kName, 2);
    opening.onupgradeneeded = () => {
      for (const name of [...opening.result.objectStoreNames]) opening.result.deleteObjectStore(name);
      opening.result.createObjectStore("files", { keyPath: ["record", "path"] });
      opening.result.createObjectStore("state");
    };
    const base = await done(opening);
    base.onversionchange = () => base.close();
    const store = (name: string, mode: IDBTransactionMode): IDBObjectStore => base.transaction(name, mode).objectStore(name);
    const of_record = (record: string): IDBKeyRange => IDBKeyRange.bound([record], [record, []]);
    let own = await record_of_tab();
    const clear = async (record: string): Promise<void> => {
      await done(store("files", "readwrite").delete(of_record(record)));
      await done(store("state", "readwrite").delete(record));
    };
    // Of closed tabs, the last first.
    const free = async (): Promise<{ record: string; state: KeptState }[]> => {
      const states = store("state", "readonly");
      const [keys, all] = await Promise.all([done(states.getAllKeys()), done(states.getAll() as IDBRequest<KeptState[]>)]);
      const used = await records_in_use();
      return keys
        .flatMap((key, k) => (all[k] ? [{ record: String(key), state: all[k] }] : []))
        .filter(({ record }) => record !== own && !used.has(lock_of(record)))
        .sort((a, b) => b.state.when - a.state.when);
    };
    return {
      async put(path, name, file) {
        await done(store("files", "readwrite").put({ record: own, path, name, file }));
      },
      async say(state) {
        await done(store("state", "readwrite").put(state, own));
        for (const { record } of (await free()).slice(kRecords)) await clear(record);
      },
      async kept() {
        const state = (await done(store("state", "readonly").get(own))) as KeptState | undefined;
        const last = state === undefined ? (await free())[0] : { record: own, state };
        if (!last) return null;
        const files = (await done(store("files", "readonly").getAll(of_record(last.record)))) as Kept["files"];
        return files.length === 0 ? null : { ...last, own: last.record === own, files };
      },
      async go_on(record) {
        if (record === own || !(await held_by_tab(record))) return;
        own = record;
        sessionStorage.setItem(kName, own);
      },
      clear: (record = own) => clear(record),
    };
  } catch {
    return null;
  }
};
