// What was dropped, and the model as it stands, kept by the browser so that a crash or a reload loses nothing; until it
// is deleted. Where the browser keeps nothing, as in a private window, everything else works.

export interface KeptState {
  when: number; // ms since 1970
  title: string;
  data: readonly string[]; // words of a command
  model: string; // path; "": none
  target: string;
}

export interface Kept {
  state: KeptState;
  files: { path: string; name: string; file: Blob }[];
}

export interface Store {
  put(path: string, name: string, file: Blob): Promise<void>;
  say(state: KeptState): Promise<void>;
  kept(): Promise<Kept | null>;
  clear(): Promise<void>;
}

const kName = "ballbar";

const done = <T>(request: IDBRequest<T>): Promise<T> =>
  new Promise((fulfil, fail) => {
    request.onsuccess = () => fulfil(request.result);
    request.onerror = () => fail(request.error);
  });

// null: the browser keeps nothing here.
export const open_store = async (): Promise<Store | null> => {
  try {
    const opening = indexedDB.open(kName, 1);
    opening.onupgradeneeded = () => {
      opening.result.createObjectStore("files", { keyPath: "path" });
      opening.result.createObjectStore("state");
    };
    const base = await done(opening);
    const store = (name: string, mode: IDBTransactionMode): IDBObjectStore => base.transaction(name, mode).objectStore(name);
    return {
      async put(path, name, file) {
        await done(store("files", "readwrite").put({ path, name, file }));
      },
      async say(state) {
        await done(store("state", "readwrite").put(state, "now"));
      },
      async kept() {
        const state = (await done(store("state", "readonly").get("now"))) as KeptState | undefined;
        const files = (await done(store("files", "readonly").getAll())) as Kept["files"];
        return files.length === 0 || state === undefined ? null : { state, files };
      },
      async clear() {
        await done(store("files", "readwrite").clear());
        await done(store("state", "readwrite").clear());
      },
    };
  } catch {
    return null;
  }
};
