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

// What is looked at, as behind `ballbar report`.
export const look_words = (subject: Subject): string[] => [
  ...subject.data,
  ...of_model(subject),
  ...(subject.compared === "" ? [] : ["--compare", subject.compared]),
];

// The same with a model in any case: without a file what every model has before its first effect.
export const model_words = (subject: Subject): string[] => [
  ...look_words(subject),
  ...(subject.model === "" ? ["--diagnose", ...targeted(subject)] : []),
];

export interface Setting {
  effect: string;
  parameter: string;
  value: number;
}

// As --set has it.
export const setting_text = ({ effect, parameter, value }: Setting): string => `${effect}.${parameter}=${value}`;

export const try_words = (subject: Subject, effect: string): string[] => [
  "add",
  effect,
  ...subject.data,
  ...of_model(subject),
  ...(subject.model === "" ? targeted(subject) : []),
  "--dry-run",
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
  if (verb !== "add") return [];
  const end = rest.findIndex((word) => word === data[0] || word.startsWith("--"));
  return rest.slice(0, end < 0 ? rest.length : end);
};
