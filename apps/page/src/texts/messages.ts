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

const catalogue_of = (toml: string): ReadonlyMap<string, string> =>
  new Map(
    toml.split("\n").flatMap((line) => {
      const [, name = "", text = ""] = /^(\w+) = (".*")$/.exec(line) ?? [];
      return name === "" ? [] : [[name, JSON.parse(text) as string] as const];
    }),
  );

const catalogues: Readonly<Record<string, ReadonlyMap<string, string>>> = { de: catalogue_of(de), zh: catalogue_of(zh) };

// "lagged_expansion(T_room_degC)", "backlash_a"
const effect_text = (label: string, { effects }: Words): string => {
  const [, name = label, columns = ""] = /^(\w+)(.*)$/s.exec(label) ?? [];
  const [, stem = name, axis = ""] = /^(.*)_([ab])$/.exec(name) ?? [];
  return Object.hasOwn(effects, stem) ? [effects[stem] ?? stem, axis, columns].filter((part) => part !== "").join(" ") : label;
};

const value_text = (value: MessageValue, words: Words): string | null => {
  if (typeof value === "string") return words.numbers(value);
  return "effect" in value ? effect_text(value.effect, words) : messages_text(value, words);
};

// Parts of a list, each joined to those before it.
const lists: Readonly<Record<string, { next: string; last: string }>> = {
  enumeration: { next: "list_next", last: "list_last" },
  list: { next: "list_next", last: "list_next" },
  semicolon_list: { next: "list_semicolon", last: "list_semicolon" },
};

const list_text = ({ next, last }: { next: string; last: string }, parts: readonly MessageValue[], words: Words): string | null => {
  const join = (before: string | null, part: MessageValue, k: number): string | null => {
    const text = value_text(part, words);
    if (before === null || text === null || k === 0) return text;
    const catalogue = catalogues[words.language];
    return (catalogue?.get(k + 1 === parts.length ? last : next) ?? "").replace(/\{(\w+)\}/g, (_, place: string) => (place === "first" ? before : text));
  };
  return parts.reduce<string | null>(join, "");
};

const message_text = ({ name, values }: Message, words: Words): string | null => {
  const list = lists[name];
  if (list) return list_text(list, Object.values(values), words);
  const text = name === "" ? "{text}" : catalogues[words.language]?.get(name);
  if (text === undefined) return null;
  let known = true;
  // "{place}"; "{n:one|several}"
  const said = text.replace(/\{(\w+)(?::([^|}]*)\|([^}]*))?\}/g, (all: string, place: string, one: string | undefined, several: string | undefined, at: number) => {
    const value = values[place] ?? "";
    if (one !== undefined) return (value === "1" ? one : several) ?? "";
    const part = value_text(value, words);
    known = known && part !== null;
    const within = at + all.length < text.length && Array.isArray(value);
    return within ? (part ?? "").replace(/[.。]$/, "") : (part ?? ""); // a sentence within another one
  });
  return known ? said : null;
};

// null: the language has not all of them, as of an effect that a user has made.
export const messages_text = (messages: readonly Message[], words: Words): string | null => {
  const said = messages.map((message) => message_text(message, words));
  return said.includes(null) ? null : said.filter((one) => one !== "").join(words.language === "zh" ? "" : " ");
};
