// The program itself, in a worker, on files in memory: commands in, what a terminal would show out.

export interface Ran {
  status: number; // 0 done, 1 the input is at fault, 2 the command line
  out: string;
  err: string;
}

export interface Watch {
  progress?: (line: string) => void;
  stop?: AbortSignal; // ends the worker, and starts another with the same files
}

export interface Sample {
  name: string;
  title: string;
  files: readonly { path: string; bytes: Uint8Array }[];
  data: readonly string[];
  model?: string;
}

export interface Engine {
  ready: Promise<void>;
  samples: readonly Sample[];
  run(words: readonly string[], watch?: Watch): Promise<Ran>; // "ballbar" is not among the words
  put(path: string, bytes: Uint8Array | Blob): Promise<void>; // folders are made; big files are read in pieces
  get(path: string): Promise<Uint8Array>;
  list(): Promise<readonly { path: string; bytes: number }[]>;
  remove(path: string): Promise<void>;
  memory(): Promise<{ used: number; most: number }>; // bytes
}

export const engine_in = (_page: Document): Engine | null =>
  (globalThis as unknown as { ballbar_engine?: Engine }).ballbar_engine ?? null;
