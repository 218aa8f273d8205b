// The language of the page. `t.some_key` is what it says there, now; nothing else on the page is written in a language.
// The build checks that the catalogues of the languages have the same names and places, and makes their type.
import type { Texts } from "../text_types";
import de from "./de.toml";
import en from "./en.toml";
import { filled, type Message, messages_text } from "./messages";
import zh from "./zh.toml";

export type Language = "en" | "de" | "zh";

// Of "name" and "glossary.word" of a catalogue; a text with places is a function of their values.
const texts_of = (catalogue: Readonly<Record<string, string>>): Texts => {
  const texts: Record<string, unknown> = {};
  for (const [name, text] of Object.entries(catalogue)) {
    const [, glossary, word = ""] = /^(\w+)\.(.*)$/.exec(name) ?? [];
    if (glossary) texts[glossary] = { ...(texts[glossary] ?? {}), [word]: text };
    else texts[name] = text.includes("{") ? (places: Readonly<Record<string, unknown>>) => filled(text, (place) => places[place], String) : text;
  }
  return texts as unknown as Texts;
};
const spoken: Readonly<Record<Language, Texts>> = { en: texts_of(en), de: texts_of(de), zh: texts_of(zh) };

// As each calls itself, for the choice of one.
export const languages: readonly { language: Language; name: string }[] = [
  { language: "en", name: "English" },
  { language: "de", name: "Deutsch" },
  { language: "zh", name: "中文" },
];

export let language: Language = "en";
export let t: Texts = spoken.en;

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

// A sentence of the program in the page's language; else English, and marked as such where it is shown; `before` it stands
// what the page says.
export interface Quoted {
  readonly before: string;
  readonly english: string;
}
export type Sentence = string | Quoted;

// What no catalogue has, such as the error of a reader.
export const english = (text: string): Sentence => ({ before: "", english: text });

const numbers = (part: string): string => with_decimal_sign(part).replace(/(?<=\d )degC\b/g, "°C");

const in_the_language = (messages: readonly Message[] | undefined): string | null =>
  messages === undefined
    ? null
    : messages_text(messages, { language, effects: t.effects, numbers });

// A text of a result, and the messages beside it, of which a report of an older program has none.
export const said = (text: string, messages: readonly Message[] | undefined): Sentence =>
  (language === "en" ? null : in_the_language(messages)) ?? english(text);
export const all_said = (texts: readonly string[], messages: readonly (readonly Message[])[] | undefined): Sentence[] =>
  texts.map((text, k) => said(text, messages?.[k]));
export const said_after = (before: string, text: string, messages: readonly Message[] | undefined): Sentence => {
  const sentence = said(text, messages);
  return typeof sentence === "string" ? `${before} ${sentence}` : { before, english: text };
};

// What an effect says of itself; all but the summary is the same for both axes. axes: "XY".
export const explained_by = (level: string, effect: string, key: string, text: string, axes = "AB"): Sentence =>
  said(text, [{ name: `${level}_${key === "summary" ? effect : effect.replace(/_[ab]$/, "")}_${key}`, values: { a: axes.slice(0, 1), b: axes.slice(1) } }]);

export const sentence_text = (sentence: Sentence): string =>
  typeof sentence === "string" ? sentence : [sentence.before, sentence.english].filter((part) => part !== "").join(" ");

// A name of the program by a glossary of the language; one that it does not have stays as it is.
export const named = (glossary: Readonly<Record<string, string>>, name: string): string =>
  Object.hasOwn(glossary, name) ? (glossary[name] ?? name) : name;

// Numbers within a text, "12.01 ± 0.04", with the decimal sign of the language. Those alone that stand by themselves: a
// name may hold digits and dots too, "T1.5_degC", "run_2.5.csv".
export const with_decimal_sign = (text: string): string =>
  t.decimal_sign === "." ? text : text.replace(/(?<![\w.])(\d+)\.(?=\d+(?:e[-+]?\d+)?(?![\w.]))/g, `$1${t.decimal_sign}`);
