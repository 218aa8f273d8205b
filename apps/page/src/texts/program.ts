// Sentences of the program in another language: each as the program has it, with {} for what varies, and what it is
// there, where {1} is the first of these. One that no row is of stays English, and is marked so.
import { program_de } from "./program_de";
import { program_zh } from "./program_zh";

export type ProgramSentences = readonly (readonly [string, string])[];

interface Row {
  pattern: RegExp;
  said: string;
}

const escaped = (text: string): string => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");

// Within one sentence.
const kAnything = "((?:(?![.!?]\\s).)+?)";

const rows_of = (sentences: ProgramSentences): Row[] =>
  sentences.map(([written, said]) => ({ pattern: new RegExp(`^${escaped(written).replaceAll("\\{\\}", kAnything)}$`, "su"), said }));

const rows: Readonly<Record<string, readonly Row[]>> = { de: rows_of(program_de), zh: rows_of(program_zh) };

// "lagged_expansion(T_room_degC)"
const kLabel = /^([a-z][a-z_0-9]*)( ?\(.*\))?$/s;

export interface Words {
  language: string;
  effects: Readonly<Record<string, string>>;
  numbers(text: string): string; // with the sign of the language
}

// "A, B and C" of effects, of which brackets may hold several columns; of sizes "A, 5 um of z and B, 3 um of z".
const kBetween = /(?:, | and )(?![^()]*\))/;
const kBetweenSizes = /(?<= um of \S+) and /;
const kAll = /^(?:both|all of) /;
const kName = /^[A-Za-z_][\w.]*( ?\(.*\))?$/s; // of an effect or a column

const list_of = (text: string): string[] => {
  const all = text.replace(kAll, "");
  const sizes = all.split(kBetweenSizes);
  if (sizes.length > 1) return sizes;
  const parts = all.split(kBetween);
  return parts.every((part) => kName.test(part)) ? parts : [all];
};

const listed: Readonly<Record<string, readonly [string, string]>> = { de: [", ", " und "], zh: ["、", "和"] };

// What stands in a place of a sentence: several of what follows, a phrase, an effect, a number.
const part_of = (text: string, words: Words): string => {
  const parts = list_of(text);
  if (parts.length > 1) {
    const [between, last] = listed[words.language] ?? [", ", " and "];
    const said = parts.map((part) => part_of(part, words));
    return said.slice(0, -1).join(between) + last + (said.at(-1) ?? "");
  }
  const phrase = one_of(text, words);
  if (phrase !== null) return phrase;
  const [, name = "", columns = ""] = kLabel.exec(text) ?? [];
  const [, stem = name, axis = ""] = /^(.*)_([ab])$/.exec(name) ?? []; // "backlash_a"
  if (Object.hasOwn(words.effects, stem)) return [words.effects[stem] ?? stem, axis, columns.trim()].filter((part) => part !== "").join(" ");
  return words.numbers(text);
};

const one_of = (text: string, words: Words): string | null => {
  for (const { pattern, said } of rows[words.language] ?? []) {
    const found = pattern.exec(text);
    if (found) return said.replace(/\{(\d)\}/g, (_, place: string) => part_of(found[Number(place)] ?? "", words));
  }
  return null;
};

const kMostSentences = 4; // of one row

// Sentences, of which a row may have several together; the most that one has come first.
const all_of = (sentences: readonly string[], words: Words): string[] | null => {
  if (sentences.length === 0) return [];
  for (let n = Math.min(sentences.length, kMostSentences); n > 0; --n) {
    const said = one_of(sentences.slice(0, n).join(" "), words);
    const rest = said === null ? null : all_of(sentences.slice(n), words);
    if (said !== null && rest !== null) return [said, ...rest];
  }
  return null;
};

// null: it has none in the language.
export const program_sentence = (text: string, words: Words): string | null =>
  all_of(text.split(/(?<=[.!?])\s+/), words)?.join(words.language === "zh" ? "" : " ") ?? null;
