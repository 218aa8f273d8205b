// The worker of the engine: its own bundle, put behind the module's script. It knows files and commands, no page.
import { XzReadableStream } from "xz-decompress";
import { bytes_of_base64 } from "./packed";

export type Question =
  | { kind: "wait" }
  | { kind: "unpack"; packed: string } // a text
  | { kind: "warm"; bytes: Uint8Array } // a ballbar test, whose report is answered
  | { kind: "run"; words: string[] } // a command
  | { kind: "call"; call: object } // of apps/report/page_calls.hpp
  | { kind: "put"; path: string; at: number; bytes: Uint8Array; size: number }
  | { kind: "remove"; path: string };

export type Start = { kind: "start" } & ({ packed: string } | { module: WebAssembly.Module });

export type Answer = { id: number } & (
  | { kind: "done" }
  | { kind: "progress"; line: string }
  | { kind: "unpacked"; text: string }
  | { kind: "warmed"; report: string }
  | { kind: "failed"; why: string }
  | {
      kind: "ran";
      status: number;
      out: string;
      err: string;
      changed: { path: string; bytes: Uint8Array<ArrayBuffer> }[];
      gone: string[];
      heap: number;
    }
);

interface FileStream {
  fd: number;
}
interface FileSystem {
  mkdirTree(path: string): void;
  chdir(path: string): void;
  open(path: string, flags: string): FileStream;
  write(stream: FileStream, bytes: Uint8Array, offset: number, length: number, position: number, own?: boolean): number;
  truncate(path: string, size: number): void;
  close(stream: FileStream): void;
  readFile(path: string): Uint8Array<ArrayBuffer>;
  writeFile(path: string, bytes: Uint8Array, options: { canOwn: boolean }): void;
  unlink(path: string): void;
  readdir(path: string): string[];
  stat(path: string): { mode: number; size: number; mtime: Date; ino: number };
  isDir(mode: number): boolean;
}
interface Module {
  FS: FileSystem;
  HEAP8: Int8Array;
  ccall(name: string, returns: string, types: string[], values: string[]): number;
}
interface Options {
  instantiateWasm(
    imports: WebAssembly.Imports,
    made: (instance: WebAssembly.Instance, module: WebAssembly.Module) => void,
  ): object;
  progress(line: string): void;
}
declare const ballbar_engine: (options: Options) => Promise<Module>;

const kHome = "/files";
const kOut = "/run/out";
const kErr = "/run/err";

let module: Promise<Module>;
let running = 0; // the id of the question

const answer = (one: Answer, give: Transferable[] = []): void => postMessage(one, { transfer: give });

const started = async (compiled: WebAssembly.Module): Promise<Module> => {
  const made = await ballbar_engine({
    instantiateWasm(imports, done) {
      void WebAssembly.instantiate(compiled, imports).then((instance) => done(instance, compiled));
      return {};
    },
    progress: (line) => answer({ id: running, kind: "progress", line }),
  });
  for (const folder of [kHome, "/run", "/tmp"]) made.FS.mkdirTree(folder);
  made.FS.chdir(kHome);
  return made;
};

// Each file below the folder, with a mark that another content has not.
const marks_of = (fs: FileSystem, folder: string, marks = new Map<string, string>()): Map<string, string> => {
  for (const name of fs.readdir(folder)) {
    if (name === "." || name === "..") continue;
    const path = `${folder}/${name}`;
    const { mode, size, mtime, ino } = fs.stat(path);
    if (fs.isDir(mode)) marks_of(fs, path, marks);
    else marks.set(path, `${ino} ${size} ${mtime.getTime()}`);
  }
  return marks;
};

const own_name = (path: string): string => path.slice(kHome.length + 1);

const asked = (made: Module, name: "ballbar_run" | "ballbar_call", what: object): number =>
  made.ccall(name, "number", ["string", "string", "string"], [JSON.stringify(what), kOut, kErr]);

const text_of = (fs: FileSystem, path: string): string => new TextDecoder().decode(fs.readFile(path));

const run = (made: Module, id: number, name: "ballbar_run" | "ballbar_call", what: object): void => {
  const { FS } = made;
  const before = marks_of(FS, kHome);
  const status = asked(made, name, what);
  const after = marks_of(FS, kHome);
  const changed = [...after]
    .filter(([path, mark]) => before.get(path) !== mark)
    .map(([path]) => ({ path: own_name(path), bytes: FS.readFile(path) }));
  const gone = [...before.keys()].filter((path) => !after.has(path)).map(own_name);
  const give = changed.map(({ bytes }) => bytes.buffer);
  answer({ id, kind: "ran", status, out: text_of(FS, kOut), err: text_of(FS, kErr), changed, gone, heap: made.HEAP8.length }, give);
};

// Browsers compile a function of the module when it is first called: half a second of a first answer.
const warm = (made: Module, id: number, bytes: Uint8Array): void => {
  const path = "/tmp/warm.b5r";
  made.FS.writeFile(path, bytes, { canOwn: true });
  asked(made, "ballbar_call", { call: "report", words: [path] });
  made.FS.unlink(path);
  answer({ id, kind: "warmed", report: text_of(made.FS, kOut) });
};

const put = (fs: FileSystem, { path, at, bytes, size }: Question & { kind: "put" }): void => {
  const place = `${kHome}/${path}`;
  fs.mkdirTree(place.slice(0, place.lastIndexOf("/")));
  if (at === 0 && bytes.length === size) return fs.writeFile(place, bytes, { canOwn: true });
  if (at === 0) fs.close(fs.open(place, "w"));
  if (at === 0) fs.truncate(place, size); // its memory at once, not in steps that each copy it
  const stream = fs.open(place, "r+");
  fs.write(stream, bytes, 0, bytes.length, at);
  fs.close(stream);
};

const done = (made: Module, question: Question & { id: number }): void => {
  const { id } = question;
  if (question.kind === "run") return run(made, id, "ballbar_run", question.words);
  if (question.kind === "call") return run(made, id, "ballbar_call", question.call);
  if (question.kind === "warm") return warm(made, id, question.bytes);
  if (question.kind === "put") put(made.FS, question);
  if (question.kind === "remove") made.FS.unlink(`${kHome}/${question.path}`);
  answer({ id, kind: "done" });
};

const unpacked = (packed: string, type: string): Response =>
  new Response(new XzReadableStream(new Blob([bytes_of_base64(packed)]).stream()), { headers: { "Content-Type": type } });

const compiled_of = async (start: Start): Promise<WebAssembly.Module> => {
  if ("module" in start) return start.module;
  const compiled = await WebAssembly.compileStreaming(unpacked(start.packed, "application/wasm"));
  postMessage({ kind: "compiled", module: compiled });
  return compiled;
};

onmessage = ({ data }: MessageEvent<({ id: number } & Question) | Start>) => {
  if (data.kind === "start") {
    module = compiled_of(data).then(started);
    return;
  }
  const done_with = async (made: Module): Promise<void> => {
    if (data.kind === "unpack") return answer({ id: data.id, kind: "unpacked", text: await unpacked(data.packed, "text/plain").text() });
    running = data.id;
    done(made, data);
  };
  module
    .then(done_with)
    .catch((error: unknown) => answer({ id: data.id, kind: "failed", why: String(error) }));
};
