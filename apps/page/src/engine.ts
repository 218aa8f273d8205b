// The program compiled to WebAssembly, in a worker: runs commands as on a terminal, on files in memory. If the page
// contains it, a user can drop files on the page and work with them.
import { gunzipped } from "./packed";
import type { Answer, Question, Start } from "./worker";

// The output of a command. status: 0 success, 1 error in the input, 2 error in the command line, 3 a test fails its tolerance.
export interface Ran {
  status: number;
  out: string;
  err: string;
}

export interface Watch {
  progress?: (line: string) => void; // text, or JSON if it begins with a brace; empty: end of progress
  stop?: AbortSignal;
}

export interface Sample {
  name: string; // of its folder
  title: string;
  data: string[]; // the words for DATA
  model?: string;
}

export interface Engine {
  ready: Promise<void>;
  // A report of the first sample, made to warm up the engine and the page. Never resolves without samples.
  warmed: Promise<string>;
  samples: () => Promise<readonly Sample[]>;
  sample_files: (name: string) => Promise<readonly SampleFile[]>;
  // "ballbar" is not among the words. Rejects with Stopped when stopped, and with Failed when the module gave up.
  run(words: readonly string[], watch?: Watch): Promise<Ran>;
  // A call on the open subject, which the engine keeps (apps/report/page_calls.hpp). Stopping the call loses the
  // subject.
  call(call: object, watch?: Watch): Promise<Ran>;
  put(path: string, bytes: Uint8Array | Blob, read?: (bytes: number) => void): Promise<void>; // folders are made
  get(path: string): Promise<Uint8Array>;
  list(): readonly { path: string; bytes: number }[];
  remove(path: string): Promise<void>;
  memory(): { used: number; most: number }; // bytes of the module
}

export const bytes_of = (text: string): Uint8Array<ArrayBuffer> => Uint8Array.from(text, (sign) => sign.charCodeAt(0));

export interface SampleFile {
  path: string;
  text: string; // one character per byte: bytes_of
}

export class Stopped extends Error {}
export class Failed extends Error {}

const kMostMemory = 2 ** 32; // as the module is linked
const kPiece = 8 << 20;

const block = (page: Document, id: string): string | null => page.getElementById(id)?.textContent ?? null;

interface Waiting {
  done: (answer: Answer) => void;
  failed: (error: Error) => void;
  progress: ((line: string) => void) | undefined;
}

// A worker, with its pending requests.
class Link {
  private readonly worker: Worker;
  private readonly waiting = new Map<number, Waiting>();
  private next = 0;
  private over: Error | null = null; // why it no longer answers

  // With the module, or what it is packed into.
  constructor(url: string, start: Start, compiled: (module: WebAssembly.Module) => void) {
    this.worker = new Worker(url);
    this.worker.onmessage = ({ data }: MessageEvent<Answer | { kind: "compiled"; module: WebAssembly.Module }>) => {
      if (data.kind === "compiled") return compiled(data.module);
      const one = this.waiting.get(data.id);
      if (data.kind === "progress") return one?.progress?.(data.line);
      this.waiting.delete(data.id);
      if (data.kind === "failed") one?.failed(new Failed(data.why));
      else one?.done(data);
    };
    this.worker.onerror = (event) => {
      event.preventDefault();
      this.end(new Failed(event.message));
    };
    this.worker.postMessage(start);
  }

  ask(question: Question, give: Transferable[] = [], progress?: (line: string) => void): Promise<Answer> {
    if (this.over) return Promise.reject(this.over);
    const id = ++this.next;
    return new Promise((done, failed) => {
      this.waiting.set(id, { done, failed, progress });
      this.worker.postMessage({ ...question, id }, give);
    });
  }

  end(why: Error): void {
    this.over ??= why;
    this.worker.terminate();
    for (const one of this.waiting.values()) one.failed(why);
    this.waiting.clear();
  }
}

class InWorker implements Engine {
  ready: Promise<void>;
  readonly warmed: Promise<string>;
  private readonly files = new Map<string, Uint8Array | Blob>(); // the files of the worker, for the next worker
  private link: Promise<Link>;
  private readonly start: () => Promise<Link>;
  private files_of_samples: Promise<Record<string, SampleFile[]>> | null = null;
  private heap = 0;
  private readonly ended = new WeakSet<Link>();

  constructor(private readonly page: Document) {
    const script = gunzipped(block(page, "engine-worker") ?? "").then((bytes) => URL.createObjectURL(new Blob([bytes], { type: "text/javascript" })));
    let start: Start = { kind: "start", packed: block(page, "engine") ?? "" };
    // The first worker unpacks and compiles the module; those after it take what it made.
    this.start = async () => new Link(await script, start, (module) => (start = { kind: "start", module }));
    this.link = this.start();
    let warmed: (report: string) => void = () => undefined;
    this.warmed = new Promise((done) => (warmed = done));
    this.ready = this.link.then(async (link) => {
      await link.ask({ kind: "wait" });
      void this.warm(link, warmed).catch(() => undefined); // then the first answer takes longer
    });
  }

  async samples(): Promise<readonly Sample[]> {
    const text = block(this.page, "samples");
    return text ? (JSON.parse(new TextDecoder().decode(await gunzipped(text))) as Sample[]) : [];
  }

  // Decompressed once, on first use.
  async sample_files(name: string): Promise<readonly SampleFile[]> {
    this.files_of_samples ??= this.unpacked("sample-files");
    try {
      return (await this.files_of_samples)[name] ?? [];
    } catch (error) {
      this.files_of_samples = null; // its worker was stopped
      throw error;
    }
  }
  private async unpacked(id: string): Promise<Record<string, SampleFile[]>> {
    const packed = block(this.page, id);
    if (!packed) return {};
    const answer = await (await this.link).ask({ kind: "unpack", packed });
    return answer.kind === "unpacked" ? (JSON.parse(answer.text) as Record<string, SampleFile[]>) : {};
  }

  run(words: readonly string[], watch: Watch = {}): Promise<Ran> {
    return this.asked({ kind: "run", words: [...words] }, watch);
  }

  call(call: object, watch: Watch = {}): Promise<Ran> {
    return this.asked({ kind: "call", call }, watch);
  }

  private async asked(question: Question, { progress, stop }: Watch): Promise<Ran> {
    const link = await this.link;
    if (stop?.aborted) throw new Stopped();
    const end = (): void => this.anew(link, new Stopped());
    stop?.addEventListener("abort", end, { once: true });
    try {
      const answer = await link.ask(question, [], progress);
      if (answer.kind !== "ran") throw new Failed("the engine gave no answer");
      for (const { path, bytes } of answer.changed) this.files.set(path, bytes);
      for (const path of answer.gone) this.files.delete(path);
      this.heap = answer.heap;
      return { status: answer.status, out: answer.out, err: answer.err };
    } catch (error) {
      if (error instanceof Stopped && !stop?.aborted) return await this.asked(question, { progress, stop }); // another's stop
      if (error instanceof Failed) this.anew(link, error);
      throw error;
    } finally {
      stop?.removeEventListener("abort", end);
    }
  }

  async put(path: string, bytes: Uint8Array | Blob, read?: (bytes: number) => void): Promise<void> {
    // The present content, because a file on disk may change and another worker needs the same content.
    const kept = bytes instanceof Blob && bytes.size <= kPiece ? new Blob([await bytes.arrayBuffer()]) : bytes;
    const before = this.files.get(path);
    this.files.set(path, kept);
    try {
      await this.hand_over(await this.link, path, kept, read);
    } catch (error) {
      if (error instanceof Stopped) return void (await this.link); // the next worker has it
      if (before) this.files.set(path, before);
      else this.files.delete(path);
      throw error;
    }
  }

  async get(path: string): Promise<Uint8Array> {
    const file = this.files.get(path);
    if (!file) throw new Error(`no file ${path}`);
    return file instanceof Blob ? new Uint8Array(await file.arrayBuffer()) : file;
  }

  list(): readonly { path: string; bytes: number }[] {
    return [...this.files].map(([path, file]) => ({ path, bytes: file instanceof Blob ? file.size : file.length }));
  }

  async remove(path: string): Promise<void> {
    this.files.delete(path);
    await (await this.link).ask({ kind: "remove", path });
  }

  memory(): { used: number; most: number } {
    return { used: this.heap, most: kMostMemory };
  }

  // Twice, because by the second time the browser knows which code to optimise. One request each, so that a new file
  // waits for at most one of them.
  private async warm(link: Link, warmed: (report: string) => void): Promise<void> {
    const files = await Promise.all((await this.samples()).map(({ name }) => this.sample_files(name)));
    const test = files.flat().find(({ path }) => path.endsWith(".b5r"));
    if (!test) return;
    for (const time of [1, 2]) {
      const answer = await link.ask({ kind: "warm", bytes: bytes_of(test.text) });
      if (time === 1 && answer.kind === "warmed") warmed(answer.report);
    }
  }

  // Sends a large file in pieces, without a second copy in memory.
  private async hand_over(
    link: Link,
    path: string,
    file: Uint8Array | Blob,
    read?: (bytes: number) => void,
  ): Promise<void> {
    if (!(file instanceof Blob)) {
      const bytes = file.slice();
      await link.ask({ kind: "put", path, at: 0, bytes, size: bytes.length }, [bytes.buffer]);
      return;
    }
    for (let at = 0; at === 0 || at < file.size; at += kPiece) {
      const bytes = new Uint8Array(await file.slice(at, at + kPiece).arrayBuffer());
      await link.ask({ kind: "put", path, at, bytes, size: file.size }, [bytes.buffer]);
      read?.(Math.min(file.size, at + kPiece));
    }
  }

  // Ends a worker, and begins another with the same files.
  private anew(old: Link, why: Error): void {
    if (this.ended.has(old)) return;
    this.ended.add(old);
    old.end(why);
    this.heap = 0;
    this.link = this.start().then(async (link) => {
      for (const [path, file] of this.files) {
        // A file that has left the disk, or no longer fits: the program reports it as missing; the others stay.
        await this.hand_over(link, path, file).catch(() => undefined);
      }
      return link;
    });
  }
}

// null: the page has no engine.
export const engine_of = (page: Document): Engine | null => (block(page, "engine") ? new InWorker(page) : null);
