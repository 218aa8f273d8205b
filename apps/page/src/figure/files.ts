// Files that the reader saves from the page.
import { canvas_of } from "./charts";
import type { Numbers, Picture, State } from "../picture";
import { caption_of, drawn, kCaption_px, stilled, svg_file } from "./still";
import { colours, font } from "../drawing/theme";
import type { Num } from "../report";

const kPixels = 2; // of a PNG, for one of the page

export const save_csv = (picture: Picture, state: State): void =>
  save(`${picture.name}.csv`, new Blob([csv_of(picture.numbers(state))], { type: "text/csv;charset=utf-8" }));

// Wide enough that the labels of a narrow screen do not collide.
const width_of = (state: State): number => Math.max(720, Math.round(state.look.width_px));

export const save_svg = (picture: Picture, state: State): void => {
  const text = svg_file(picture, state, width_of(state), picture.height_px + kCaption_px);
  save(`${picture.name}.svg`, new Blob([text], { type: "image/svg+xml" }));
};

// On light or dark paper, as the page is.
const png_of = (picture: Picture, state: State): Promise<Blob> => {
  const width_px = width_of(state);
  const { dark } = state.look;
  const canvas = document.createElement("canvas");
  canvas.width = width_px * kPixels;
  canvas.height = (picture.height_px + kCaption_px) * kPixels;
  const pen = canvas.getContext("2d");
  if (!pen) return Promise.reject(new Error("no canvas"));
  pen.fillStyle = colours(dark).paper;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = colours(dark).ink;
  pen.font = `600 ${16 * kPixels}px ${font}`;
  pen.fillText(caption_of(picture, state), 12 * kPixels, 23 * kPixels);
  const option = drawn(picture, stilled(state, dark, width_px, picture.height_px));
  pen.drawImage(canvas_of(option, width_px, picture.height_px, kPixels), 0, kCaption_px * kPixels);
  return new Promise((done, failed) => canvas.toBlob((blob) => (blob ? done(blob) : failed(new Error("no image"))), "image/png"));
};

export const save_png = async (picture: Picture, state: State): Promise<void> => save(`${picture.name}.png`, await png_of(picture, state));

// For a letter or a message; a browser that cannot has no button for it.
export const can_copy = (): boolean => "ClipboardItem" in window && typeof navigator.clipboard?.write === "function";
// A ClipboardItem that takes no promise rejects it too.
export const copy_png = async (picture: Picture, state: State): Promise<void> =>
  navigator.clipboard.write([new ClipboardItem({ "image/png": png_of(picture, state) })]);

// A file for the reader.
export const save = (name: string, content: Blob): void => {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(content);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
};

// Numbers as a CSV file (RFC 4180).

// A text that a spreadsheet would take for a formula is preceded by an apostrophe, which makes it text; numbers stay.
const field = (value: Num | string | undefined): string => {
  if (value === null || value === undefined) return "";
  if (typeof value === "number") return Number.isFinite(value) ? String(value) : "";
  const text = /^[=+\-@\t\r]/.test(value) ? `'${value}` : value;
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};

export const rows_of = (numbers: Numbers): number =>
  Math.max(0, ...numbers.columns.map((column) => column.values.length));

const spelled: ReadonlyMap<string, string> = new Map(
  Object.entries({ "µ": "u", "μ": "u", "°": "deg", "−": "-", "–": "-", "±": "+-", "…": "...", "×": "x" }),
);

// A name in ASCII, which every program reads alike: letters without their accents, and others by their number, "U+6E29".
const ascii = (name: string): string =>
  Array.from(name.replace(/\s*→\s*/g, " to "), (letter) => spelled.get(letter) ?? letter.normalize("NFKD").replace(/[\u0300-\u036f]/g, ""))
    .join("")
    .replace(/[^\x00-\x7f]/gu, (letter) => `U+${(letter.codePointAt(0) ?? 0).toString(16).toUpperCase().padStart(4, "0")}`);

export const csv_of = (numbers: Numbers): string => {
  const lines = [numbers.columns.map((column) => field(ascii(column.name))).join(",")];
  const rows = rows_of(numbers);
  for (let row = 0; row < rows; ++row) lines.push(numbers.columns.map((column) => field(column.values[row])).join(","));
  return `${lines.join("\r\n")}\r\n`;
};
