// Text and tables as SVG, on a sheet that is measured in pixels of 1/96 inch.
import { escaped } from "../figure/still";
import { plain, wrapped } from "../drawing/text";
import { font } from "../drawing/theme";

export interface Ink {
  size_px?: number;
  bold?: boolean;
  fill?: string;
  to_the_left?: boolean; // of x: numbers
}

// Letters of Chinese are twice as wide; of Latin ones, an average.
const kLetter = 0.57;
const kBold_letter = 0.61;
const wide = (letter: string): number => (letter >= "\u2e80" ? 2 : 1);
export const width_px = (words: string, size_px: number): number =>
  kLetter * size_px * Array.from(words).reduce((sum, letter) => sum + wide(letter), 0);

export const text_at = (x: number, y: number, words: string, ink: Ink = {}): string =>
  `<text x="${x.toFixed(1)}" y="${y.toFixed(1)}" font-family="${escaped(font)}" font-size="${ink.size_px ?? 11}"` +
  ` fill="${ink.fill ?? "#000"}"${ink.bold ? ' font-weight="600"' : ""}${ink.to_the_left ? ' text-anchor="end"' : ""}>` +
  `${escaped(words)}</text>`;

export const line_at = (x: number, y: number, to_x: number, stroke = "#999"): string =>
  `<path d="M${x.toFixed(1)} ${y.toFixed(1)}H${to_x.toFixed(1)}" stroke="${stroke}" stroke-width="0.7"/>`;

// Lines of text, and where the next one would stand.
export interface Block {
  svg: string;
  below: number;
}

export const paragraph_at = (x: number, y: number, across: number, words: string, most: number, ink: Ink = {}): Block => {
  const size_px = ink.size_px ?? 11;
  const lines = wrapped(words, Math.floor(across / ((ink.bold ? kBold_letter : kLetter) * size_px)), most);
  const step = size_px * 1.4;
  return { svg: lines.map((line, k) => text_at(x, y + k * step, line, ink)).join(""), below: y + lines.length * step };
};

// The first column begins at the left, the others end at their right edges. What is too long for its share is cut.
export const table_at = (
  x: number,
  y: number,
  across: number,
  heading: readonly string[],
  rows: readonly (readonly string[])[],
  size_px: number,
  fill: (row: number, column: number) => string | undefined = () => undefined,
): Block => {
  const gap = 8;
  const heads = heading.map((head) => wrapped(head, 14, 3));
  const needed = heading.map((_, column) =>
    Math.max(
      ...(heads[column] ?? []).map((line) => width_px(line, size_px)),
      ...rows.map((row) => width_px(row[column] ?? "", size_px)),
    ),
  );
  const all = needed.reduce((sum, one) => sum + one + gap, -gap);
  const scale = Math.min(1, across / all);
  // What is left over goes between the columns.
  const more = heading.length > 1 ? Math.max(0, across - all) / (heading.length - 1) : 0;
  const rights: number[] = [];
  let at = x;
  for (const one of needed) {
    rights.push(at + one * scale);
    at += (one + gap) * scale + more;
  }
  const cell = (row: number, column: number, words: string, line_y: number, bold: boolean): string => {
    const most = Math.max(3, Math.floor(((needed[column] ?? 0) * scale + 0.5) / (kLetter * size_px)));
    const ink = { size_px, bold, fill: row < 0 ? "#444" : (fill(row, column) ?? "#000") };
    return column === 0
      ? text_at(x, line_y, plain(words, most), ink)
      : text_at(rights[column] ?? x, line_y, plain(words, most), { ...ink, to_the_left: true });
  };
  const step = size_px * 1.42;
  const head_lines = Math.max(...heads.map((lines) => lines.length));
  let svg = "";
  heads.forEach((lines, column) => {
    lines.forEach((line, k) => {
      svg += cell(-1, column, line, y + (k + head_lines - lines.length) * step, true);
    });
  });
  const ruled = y + (head_lines - 1) * step + 0.4 * size_px;
  svg += line_at(x, ruled, x + across);
  rows.forEach((row, k) => row.forEach((words, column) => (svg += cell(k, column, words, ruled + (k + 1) * step, false))));
  return { svg, below: ruled + (rows.length + 1) * step };
};

// A white sheet with all of that.
export const sheet_of = (width: number, height: number, drawn: string): string =>
  `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height}">` +
  `<rect width="${width}" height="${height}" fill="#fff"/>${drawn}</svg>\n`;
