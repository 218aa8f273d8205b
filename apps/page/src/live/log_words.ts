// How a log is read where it does not tell: options of the program, a word each, such as "--role=T3=ambient". They
// stand behind the data in every command on that log.

const kOptions = ["sheet", "time", "time-unit", "every", "unit", "role", "scale", "leave-out", "missing", "skip-bad-rows", "delimiter", "decimal", "dates"];

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

// A sentence of the program without its advice for a terminal, "; give the interval with --every, such as --every 1s":
// its parts that name an option go. "": nothing is left.
export const without_advice = (sentence: string): string => {
  const parts = sentence.replace(/^--[a-z-]+: /, "").split(/(?<=[.;?!])\s+/);
  const kept = parts.filter((part) => !/(?<![\w-])--?[A-Za-z]/.test(part)).join(" ");
  return kept.replace(/;$/, ".");
};

// The options that it names.
export const options_in = (sentence: string): string[] => [...sentence.matchAll(/(?<![\w-])--([a-z]+(?:-[a-z]+)*)/g)].map(([, option]) => option ?? "");
