
import { named, t } from "../texts/texts";

// Text from files, no longer than there is room for.

// Without the characters that turn the direction of writing: in a name they would mirror the rest of a sentence.
export const without_turns = (text: string): string => text.replace(/[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]/g, "");

// A sentence of the terminal, which writes ASCII, with the unit as pictures write it: "8.81 um" is "8.81 µm". Only after
// a number, or where the unit goes on; names such as y_um and "run 3 um.csv" stay.
export const micrometres = (sentence: string): string =>
  sentence.replace(/(?<=[\d±]\s)um(?![\w-]|\.\w)|(?<=[\s(])um(?=\/K\b| RMS\b)/g, "µm");

// Without what is no letter, which a file of XML may not even hold.
const on_one_line = (text: string): string =>
  without_turns(text)
    .replace(/[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\uffff]+/g, " ")
    .replace(/\s+/g, " ")
    .trim();

// For a picture or a table: on one line, without the marks that ECharts reads as rich text, without characters that turn
// the direction of writing.
export const plain = (text: string, most: number): string => {
  const begin = text.slice(0, 8 * most + 64); // more is never shown; names may be very long
  const clean = on_one_line(begin).replace(/\{/g, "(").replace(/\}/g, ")");
  const characters = Array.from(clean);
  return characters.length > most ? `${characters.slice(0, most - 1).join("")}…` : clean;
};

// As it is, only shorter: for where text is nothing but text, as in the page's own elements and in attributes.
export const clamped = (text: string, most: number): string => {
  const clean = without_turns(text);
  const characters = Array.from(clean.slice(0, 2 * most + 2));
  return characters.length > most ? `${characters.slice(0, most - 1).join("")}…` : clean;
};

// Letters of Chinese, Japanese and Korean are twice as wide as others.
const columns = (text: string): number => Array.from(text).reduce((sum, letter) => sum + (letter >= "\u2e80" ? 2 : 1), 0);

// The first letters that fit.
const start_of = (text: string, most_columns: number): string => {
  let start = "";
  for (const letter of text) {
    if (start !== "" && columns(start) + columns(letter) > most_columns) break;
    start += letter;
  }
  return start;
};

// A paragraph in lines of so many columns; what is too long for a line is cut, and the last line ends where no more fit.
export const wrapped = (text: string, most_columns: number, most_lines: number): string[] => {
  const lines: string[] = [];
  let rest = on_one_line(text.slice(0, 2 * most_columns * most_lines));
  while (rest !== "" && lines.length < most_lines) {
    let line = start_of(rest, most_columns);
    const space = line.lastIndexOf(" ");
    if (line.length < rest.length && rest[line.length] !== " " && space > 0) line = line.slice(0, space);
    rest = rest.slice(line.length).trim();
    lines.push(line);
  }
  const last = lines.pop() ?? "";
  return rest === "" ? [...lines, ...(last === "" ? [] : [last])] : [...lines, `${start_of(last, most_columns - 1)}…`];
};

// Part of the name of a file.
export const slug = (text: string): string =>
  plain(text, 40)
    .replace(/[^A-Za-z0-9_-]+/g, "-")
    .replace(/^-+|-+$/g, "") || "x";

// A sentence that begins with this name or phrase.
export const capital = (text: string): string => text.slice(0, 1).toUpperCase() + text.slice(1);

// Up to the first full stop that another sentence follows; numbers and names go on after theirs.
export const first_sentence = (text: string): string => /^.*?(?:[.!?](?=\s+\p{Lu})|。(?=.))/su.exec(text)?.[0] ?? text;

// Labels that differ: the second of a name is "name (2)".
export const labels_once = (labels: readonly string[]): string[] =>
  labels.map((label, k) => (labels.indexOf(label) === k ? label : `${label} (${k + 1})`));

// Units as people write them. Files spell them in ASCII at the end of a column's name: "T_room_degC".

const written = new Map(
  Object.entries({
    um: "µm",
    mm: "mm",
    degC: "°C",
    K: "K",
    rpm: "rpm",
    min: "min",
    s: "s",
    deg: "°",
    urad: "µrad",
    ppm: "ppm",
    um_per_K: "µm/K",
    A: "A",
    V: "V",
    W: "W",
    kW: "kW",
    Nm: "N m",
    N: "N",
    bar: "bar",
    percent: "%",
    lpm: "l/min",
  }),
);

export const unit_shown = (unit: string): string => written.get(unit) ?? unit;

// "T_room_degC" is the quantity T_room in °C; a name without a known unit has none.
export const split_name = (name: string): { quantity: string; unit: string } => {
  for (const unit of ["um_per_K", ...written.keys()]) {
    if (name.endsWith(`_${unit}`)) return { quantity: name.slice(0, -unit.length - 1), unit: unit_shown(unit) };
  }
  return { quantity: name, unit: "" };
};

// Words, for reading: "radius_change" is "radius change"; what files have as well is said in the language of the page.
export const words = (name: string): string => named(t.quantities, name).replaceAll("_", " ");
