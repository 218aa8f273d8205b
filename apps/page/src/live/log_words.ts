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
