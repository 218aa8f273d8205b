// Text from files, no longer than there is room for.

// Without the characters that turn the direction of writing: in a name they would mirror the rest of a sentence.
export const without_turns = (text: string): string => text.replace(/[\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]/g, "");

// A sentence of the terminal, which writes ASCII, with the unit as pictures write it: "8.81 um" is "8.81 µm". Only after
// a number, or where the unit goes on; names such as y_um and "run 3 um.csv" stay.
export const micrometres = (sentence: string): string =>
  sentence.replace(/(?<=[\d±]\s)um(?![\w-]|\.\w)|(?<=[\s(])um(?=\/K\b| RMS\b)/g, "µm");

// For a picture or a table: on one line, without the marks that ECharts reads as rich text, without characters that turn
// the direction of writing.
export const plain = (text: string, most: number): string => {
  const begin = text.slice(0, 8 * most + 64); // more is never shown; names may be very long
  const clean = without_turns(begin)
    .replace(/[\u0000-\u001f\u007f-\u009f\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\uffff]+/g, " ")
    .replace(/\{/g, "(")
    .replace(/\}/g, ")")
    .replace(/\s+/g, " ")
    .trim();
  const characters = Array.from(clean);
  return characters.length > most ? `${characters.slice(0, most - 1).join("")}…` : clean;
};

// As it is, only shorter: for where text is nothing but text, as in the page's own elements and in attributes.
export const clamped = (text: string, most: number): string => {
  const clean = without_turns(text);
  const characters = Array.from(clean.slice(0, 2 * most + 2));
  return characters.length > most ? `${characters.slice(0, most - 1).join("")}…` : clean;
};

// Part of the name of a file.
export const slug = (text: string): string =>
  plain(text, 40)
    .replace(/[^A-Za-z0-9_-]+/g, "-")
    .replace(/^-+|-+$/g, "") || "x";

// A sentence that begins with this name or phrase.
export const capital = (text: string): string => text.slice(0, 1).toUpperCase() + text.slice(1);
