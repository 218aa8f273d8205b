// Options of the program for an ambiguous log, one word each, such as "--role=T3=ambient". They follow the data in
// every command on that log.

const kOptions = ["sheet", "header-line", "radius", "time", "time-unit", "every", "unit", "role", "scale", "leave-out", "missing", "skip-bad-rows", "delimiter", "decimal", "dates", "max-gap"];

export type LogWords = readonly string[];

// Of a page from elsewhere nothing but these is taken.
export const is_log_word = (word: string): boolean => kOptions.some((option) => word === `--${option}` || word.startsWith(`--${option}=`));

// Of an option, or of an option of one column, whose header may hold a "=".
const matches = (word: string, option: string, column: string | null): boolean =>
  column === null ? word.startsWith(`--${option}=`) : word.slice(0, word.lastIndexOf("=")) === `--${option}=${column}`;

// "": nothing is said.
export const said = (words: LogWords, option: string, column: string | null = null): string => {
  const word = words.find((one) => matches(one, option, column)) ?? "";
  return word.slice(column === null ? word.indexOf("=") + 1 : word.lastIndexOf("=") + 1);
};

export const with_said = (words: LogWords, option: string, value: string, column: string | null = null): string[] => {
  const others = words.filter((one) => !matches(one, option, column));
  if (value === "") return others;
  return [...others, column === null ? `--${option}=${value}` : `--${option}=${column}=${value.replace(/=/g, "")}`];
};

export const with_word = (words: LogWords, word: string, on: boolean): string[] => [...words.filter((one) => one !== word), ...(on ? [word] : [])];

// "--every 1s", "`ballbar plan`"
const kAdvice = /(?<![\w-])--?[A-Za-z]|`ballbar |\bballbar (add|check|compare|could|diagnose|drift|effects|errors|fit|history|import|plan|predict|simulate|train|undo)\b/;

// A sentence of the program without its advice for a terminal, "; give the interval with --every, such as --every 1s":
// its parts that name an option or a command go. "": nothing is left.
export const without_advice = (sentence: string): string => {
  const parts = sentence.replace(/^--[a-z-]+: /, "").split(/(?<=[.;?!])\s+/);
  const kept = parts.filter((part) => !kAdvice.test(part)).join(" ");
  return kept.replace(/;$/, ".");
};

// Keys of what is no sentence: commands to do, and names that a file has.
const kNames: ReadonlySet<string> = new Set(["command", "header", "headers", "name", "names", "column", "columns", "target", "label", "file", "files", "title", "sheet"]);

// An answer of the program, all of its sentences without such advice.
export const answer_without_advice = <T>(answer: T, key = ""): T => {
  if (typeof answer === "string") return (!kNames.has(key) && /\s/.test(answer) && kAdvice.test(answer) ? without_advice(answer) : answer) as T;
  if (typeof answer !== "object" || answer === null) return answer;
  if (Array.isArray(answer)) {
    if (typeof answer[0] === "number") return answer; // a column
    return answer.map((one: unknown) => answer_without_advice(one, key)) as T;
  }
  return Object.fromEntries(Object.entries(answer).map(([name, one]) => [name, answer_without_advice(one as unknown, name)])) as T;
};

// The options that it names.
export const options_in = (sentence: string): string[] => [...sentence.matchAll(/(?<![\w-])--([a-z]+(?:-[a-z]+)*)/g)].map(([, option]) => option ?? "");
