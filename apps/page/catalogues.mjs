// The catalogues of sentences, src/texts/*.toml and ../../formats/messages/*.toml: what is read of them, whether the
// languages agree, which node catalogues.mjs says, and node catalogues.mjs TYPES_FILE: the types of the page's texts.
import { readFileSync, realpathSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const texts = join(dirname(fileURLToPath(import.meta.url)), "src/texts");

// name = "text"; a word of [glossary] is "glossary.word".
export const catalogue_of = (file) => {
  const catalogue = {};
  let glossary = "";
  for (const [k, line] of readFileSync(file, "utf8").split("\n").entries()) {
    if (line === "" || line.startsWith("#")) continue;
    const [, opened] = /^\[(\w+)\]$/.exec(line) ?? [];
    const [, name, quoted, text] = /^(?:([\w-]+)|(".*?")) = (".*")$/.exec(line) ?? [];
    if (opened) glossary = `${opened}.`;
    else if (!text) throw new Error(`${file}:${k + 1}: expected name = "text" or [glossary], found: ${line}`);
    else {
      const known = glossary + (name ?? JSON.parse(quoted));
      if (known in catalogue) throw new Error(`${file}:${k + 1}: ${known} stands there twice`);
      catalogue[known] = JSON.parse(text);
    }
  }
  return catalogue;
};

// {place}; in {place:one|several} it is a number.
const places_of = (text) => {
  const places = new Map();
  for (const [, place, words] of text.matchAll(/\{(\w+)(:[^|}]*\|[^}]*)?\}/g)) places.set(place, words ? "number" : (places.get(place) ?? "number | string"));
  return places;
};

// Throws where a language has a name or a place that English has not, or lacks one.
export const expect_translated = (english, language, file) => {
  const faults = [
    ...Object.keys(english).filter((name) => !(name in language)).map((name) => `expected a line for ${name}, as en.toml has it`),
    ...Object.keys(language).filter((name) => !(name in english)).map((name) => `${name} is no text of en.toml`),
    ...Object.keys(english).filter((name) => name in language).flatMap((name) => {
      const [ours, theirs] = [places_of(english[name]), places_of(language[name])];
      return [
        ...[...ours.keys()].filter((place) => !theirs.has(place)).map((place) => `${name} lacks the place {${place}} of en.toml`),
        ...[...theirs.keys()].filter((place) => !ours.has(place)).map((place) => `${name} has a place {${place}} that en.toml does not have`),
      ];
    }),
  ];
  if (faults.length > 0) throw new Error(faults.map((fault) => `${file}: ${fault}`).join("\n"));
};

const types_of = (english) => {
  const members = { "": [] };
  for (const [name, text] of Object.entries(english)) {
    const [, glossary, word] = /^(\w+)\.(.*)$/.exec(name) ?? [];
    if (glossary) (members[glossary] ??= []).push(`${JSON.stringify(word)}: string`);
    else {
      const places = [...places_of(text)].map(([place, type]) => `${place}: ${type}`).join("; ");
      members[""].push(`${name}: ${places === "" ? "string" : `(places: { ${places} }) => string`}`);
    }
  }
  const { "": own, ...glossaries } = members;
  const all = [...own, ...Object.entries(glossaries).map(([name, words]) => `${name}: Readonly<{ ${words.join("; ")} }>`)];
  return `// Made by catalogues.mjs.\nexport interface Texts {\n${all.map((one) => `  readonly ${one};\n`).join("")}}\n`;
};

// The page's texts in all languages, that each is translated.
export const page_texts = (folder = texts) => {
  const english = catalogue_of(join(folder, "en.toml"));
  for (const language of ["de", "zh"]) expect_translated(english, catalogue_of(join(folder, `${language}.toml`)), join(folder, `${language}.toml`));
  return english;
};

if (process.argv[1] && realpathSync(process.argv[1]) === fileURLToPath(import.meta.url)) {
  try {
    const english = page_texts();
    if (process.argv[2]) writeFileSync(process.argv[2], types_of(english));
  } catch ({ message }) {
    console.error(message);
    process.exit(1);
  }
}
