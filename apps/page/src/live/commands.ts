// The command lines that the page runs, and those that the program proposes.
import type { Group } from "./groups";

// What is looked at.
export interface Subject {
  group: Group;
  data: readonly string[]; // words: the group's own, or the folder it lies in
  model: string; // path; "": none
  target: string; // "": the model's own, or all
  compared: string; // data to compare with; "": none
}

const targeted = ({ group, target }: Subject): string[] =>
  target === "" || group.kind === "recordings" ? [] : ["--target", target];

const of_model = (subject: Subject): string[] =>
  subject.model === "" ? [] : ["--model", subject.model, ...targeted(subject)];

// Soon done: all but the search for what is missing.
export const report_words = (subject: Subject): string[] => [
  "report",
  ...subject.data,
  ...of_model(subject),
  ...(subject.model === "" || subject.model.endsWith(".json") ? [] : ["--no-diagnosis"]),
  ...(subject.compared === "" ? [] : ["--compare", subject.compared]),
  "--json",
];

export const search_words = (subject: Subject): string[] => [
  "report",
  ...subject.data,
  ...(subject.model === "" ? ["--diagnose", ...targeted(subject)] : of_model(subject)),
  ...(subject.compared === "" ? [] : ["--compare", subject.compared]),
  "--json",
];

export interface Setting {
  effect: string;
  parameter: string;
  value: number;
}

// The model with these values in the place of fitted ones.
export const set_words = (subject: Subject, settings: readonly Setting[]): string[] => [
  ...report_words(subject).filter((word) => word !== "--json"),
  ...settings.flatMap(({ effect, parameter, value }) => ["--set", `${effect}.${parameter}=${value}`]),
  "--json",
];

export const add_words = (subject: Subject, effects: readonly string[], model: string): string[] => [
  "add",
  ...effects,
  ...subject.data,
  "--model",
  model,
  ...targeted(subject),
  "--json",
];

export const try_words = (subject: Subject, effect: string): string[] => [
  "try",
  effect,
  ...subject.data,
  ...of_model(subject),
  ...(subject.model === "" ? targeted(subject) : []),
  "--json",
];

export const plan_words = (subject: Subject, hours: number, folder: string): string[] => [
  "plan",
  ...subject.data,
  ...of_model(subject),
  ...(subject.model === "" ? targeted(subject) : []),
  "--hours",
  String(hours),
  "--out",
  folder,
  "--json",
];

// A line as the program prints it, in words: blanks part them, but not within '...'; \ keeps the next letter.
export const words_of = (line: string): string[] => {
  const words: string[] = [];
  for (const [word] of line.matchAll(/(?:'[^']*'|\\.|[^\s'\\])+/g)) {
    words.push(word.replace(/'([^']*)'|\\(.)/g, (_, quoted?: string, kept?: string) => quoted ?? kept ?? ""));
  }
  return words[0] === "ballbar" ? words.slice(1) : words;
};

// The effects of `ballbar add EFFECT... DATA ...`; none: it adds none.
export const added_by = (line: string, { data }: Subject): string[] => {
  const [verb, ...rest] = words_of(line);
  if (verb !== "add" && verb !== "try") return [];
  const end = rest.findIndex((word) => word === data[0] || word.startsWith("--"));
  return rest.slice(0, end < 0 ? rest.length : end);
};
