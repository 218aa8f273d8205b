// Sentences of the program, which come as their names with the values of their places: the text of each in a language, from
// formats/messages.
import de from "../../messages/de.toml";
import zh from "../../messages/zh.toml";

export interface Message {
  name: string; // empty: a text of no language, as the error of a reader
  values: Record<string, MessageValue>;
}
export type MessageValue = string | { effect: string } | readonly Message[];

export interface Words {
  language: string;
  effects: Readonly<Record<string, string>>;
  numbers(text: string): string; // with the sign of the language
}

const catalogues: Readonly<Record<string, Readonly<Record<string, string>>>> = { de, zh };

// A text with the values of its places: "{place}", of which the last knows that it ends the text; "{n:one|several}".
export const filled = <Value>(text: string, value_of: (place: string) => Value, part: (value: Value, ends: boolean, place: string) => string): string =>
  text.replace(/\{(\w+)(?::([^|}]*)\|([^}]*))?\}/g, (all: string, place: string, one: string | undefined, several: string | undefined, at: number) => {
    const value = value_of(place);
    if (one !== undefined) return (String(value) === "1" ? one : several) ?? "";
    return part(value, at + all.length === text.length, place);
  });

// "lagged_expansion(T_room_degC)", "backlash_a"
const effect_text = (label: string, { effects }: Words): string => {
  const [, name = label, columns = ""] = /^(\w+)(.*)$/s.exec(label) ?? [];
  const [, stem = name, axis = ""] = /^(.*)_([ab])$/.exec(name) ?? [];
  return Object.hasOwn(effects, stem) ? [effects[stem] ?? stem, axis, columns].filter((part) => part !== "").join(" ") : label;
};

// Places of what files and people have named, "Probe 2.5": not even a number that stands alone in it is one to be read.
const names = new Set("a b column columns file first inputs model name next one other second series setting settings source state target text why".split(" "));

const value_text = (value: MessageValue, words: Words, place: string): string | null => {
  if (typeof value === "string") return names.has(place) ? value : words.numbers(value);
  return "effect" in value ? effect_text(value.effect, words) : messages_text(value, words, place);
};

// Parts of a list, each joined to those before it.
const lists: Readonly<Record<string, { next: string; last: string }>> = {
  enumeration: { next: "list_next", last: "list_last" },
  list: { next: "list_next", last: "list_next" },
  semicolon_list: { next: "list_semicolon", last: "list_semicolon" },
};

const list_text = ({ next, last }: { next: string; last: string }, parts: readonly MessageValue[], words: Words, place: string): string | null => {
  const join = (before: string | null, part: MessageValue, k: number): string | null => {
    const text = value_text(part, words, place);
    if (before === null || text === null || k === 0) return text;
    const joined = catalogues[words.language]?.[k + 1 === parts.length ? last : next] ?? "";
    return filled(joined, (place) => (place === "first" ? before : text), String);
  };
  return parts.reduce<string | null>(join, "");
};

// of: the place in which it stands; a list of names is of names.
const message_text = ({ name, values }: Message, words: Words, of: string): string | null => {
  const list = lists[name];
  if (list) return list_text(list, Object.values(values), words, of);
  const text = name === "" ? "{text}" : catalogues[words.language]?.[name];
  if (text === undefined) return null;
  let known = true;
  const said = filled<MessageValue>(text, (place) => values[place] ?? "", (value, ends, place) => {
    const part = value_text(value, words, place);
    known = known && part !== null;
    return Array.isArray(value) && !ends ? (part ?? "").replace(/[.。]$/, "") : (part ?? ""); // a sentence within another one
  });
  return known ? said : null;
};

// Whether an effect's name begins the text, "zyklischer Fehler von X": a name of a column or a file keeps its letters.
const begins_with_effect = ({ name, values }: Message, language: string): boolean => {
  const place = lists[name] ? Object.keys(values)[0] : /^\{(\w+)\}/.exec(catalogues[language]?.[name] ?? "")?.[1];
  const value = values[place ?? ""];
  if (value === undefined || typeof value === "string") return false;
  return "effect" in value || (value[0] !== undefined && begins_with_effect(value[0], language));
};

const capital = (text: string): string => text.charAt(0).toUpperCase() + text.slice(1);

// null: the language has not all of them, as of an effect that a user has made.
export const messages_text = (messages: readonly Message[], words: Words, of = ""): string | null => {
  const said = messages.map((message) => {
    const text = message_text(message, words, of);
    return text?.endsWith(".") && begins_with_effect(message, words.language) ? capital(text) : text;
  });
  return said.includes(null) ? null : said.filter((one) => one !== "").join(words.language === "zh" ? "" : " ");
};
