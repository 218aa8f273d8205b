// Commands to paste into a terminal, made of the names of a report's files.
import type { Report } from "../report";

// As the program quotes; a name that a terminal would obey is left to the reader.
const shell_word = (word: string): string => {
  if (/[\p{Cc}\p{Cf}]/u.test(word)) return "DATA";
  return /^[\w./=:,+@%-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
};

export const command_of = (verb: string, files: readonly string[], options: readonly string[] = []): string =>
  ["ballbar", verb, ...files.map((file) => (file.startsWith("-") ? `./${file}` : file)), ...options].map(shell_word).join(" ");

// The files of a test.
export const files_of = ({ file, second_file }: { file: string; second_file: string }): string[] => [file, second_file].filter((one) => one !== "");

// What a command takes as its data: of a session its one file, of recordings the folder they lie in where they are many.
const kMost_files = 4;
export const data_files = ({ files, fit }: Report): string[] => {
  const session = files.filter((file) => file === "session.toml");
  if (session.length > 0) return session;
  const data = files.filter((file) => !/\.(toml|json)$/.test(file));
  return fit !== undefined && data.length > kMost_files ? ["."] : data;
};

// The model that a report is of, as options.
export const model_options = ({ files }: Report): string[] => {
  const model = files.find((file) => file.endsWith(".toml") && file !== "session.toml");
  return model === undefined ? [] : ["--model", model];
};

// The page of everything, with what is missing.
export const report_command = (files: readonly string[]): string =>
  command_of("report", files, ["--diagnose", "--out", "page.html"]);
