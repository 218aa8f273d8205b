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
