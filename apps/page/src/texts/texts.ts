// The language of the page. `t.some_key` is what it says there, now; nothing else on the page is written in a language.
// The files of the languages have the same keys, which the compiler checks.
import { de } from "./de";
import { en, type Texts } from "./en";
import { program_sentence } from "./program";
import { zh } from "./zh";

export type Language = "en" | "de" | "zh";

const spoken: Readonly<Record<Language, Texts>> = { en, de, zh };

// As each calls itself, for the choice of one.
export const languages: readonly { language: Language; name: string }[] = [
  { language: "en", name: "English" },
  { language: "de", name: "Deutsch" },
  { language: "zh", name: "中文" },
];

export let language: Language = "en";
export let t: Texts = en;

// Of each language, as where a word of any of them is looked for.
export const in_all_languages = <T>(of: (texts: Texts) => T): T[] => Object.values(spoken).map(of);

const changed: (() => void)[] = [];

// What is done when another language is chosen: whoever has written something writes it anew.
export const when_spoken = (write: () => void): void => {
  changed.push(write);
};

export const speak = (now: Language): void => {
  language = now;
  t = spoken[now];
  if (typeof document !== "undefined") document.documentElement.lang = now === "zh" ? "zh-Hans" : now;
  for (const write of changed) write();
};

// The first that a browser asks for and that is known: "de-CH" is "de".
export const language_of = (asked: readonly string[]): Language => {
  for (const tag of asked) {
    const found = languages.find((one) => one.language === tag.split("-")[0]?.toLowerCase());
    if (found) return found.language;
  }
  return "en";
};

// A sentence of the program: in the page's language where that has it (program.ts), else English, and marked as such
// where it is shown; `before` it stands what the page says.
export interface Quoted {
  readonly before: string;
  readonly english: string;
}
export type Sentence = string | Quoted;

const in_the_language = (text: string): string | null =>
  program_sentence(text, { language, effects: t.effects, numbers: (part) => with_decimal_sign(part).replace(/(?<=\d )degC\b/g, "°C") });
export const english = (text: string): Sentence => in_the_language(text) ?? { before: "", english: text };
export const english_after = (before: string, text: string): Sentence => {
  const said = in_the_language(text);
  return said === null ? { before, english: text } : `${before} ${said}`;
};
export const sentence_text = (sentence: Sentence): string =>
  typeof sentence === "string" ? sentence : [sentence.before, sentence.english].filter((part) => part !== "").join(" ");

// Sentences of the page in one paragraph.
export const together = (sentences: readonly string[]): string => sentences.filter((one) => one !== "").join(language === "zh" ? "" : " ");

// A name of the program by a glossary of the language; one that it does not have stays as it is.
export const named = (glossary: Readonly<Record<string, string>>, name: string): string =>
  Object.hasOwn(glossary, name) ? (glossary[name] ?? name) : name;

// Numbers within a text, "12.01 ± 0.04", with the decimal sign of the language.
export const with_decimal_sign = (text: string): string =>
  t.decimal_sign === "." ? text : text.replace(/(?<=\d)\.(?=\d)/g, t.decimal_sign);
