// Several pictures in one file, one below the other, under the conclusions of their report; below each stands what is
// seen in it.
import type { Picture } from "../picture";
import { escaped, initial_state, kCaption_px, svg_file, told_of } from "./still";
import { micrometres, wrapped } from "../drawing/text";
import { colours, font } from "../drawing/theme";

const kMargin_px = 12;
const kLetter_px = 7; // about, of text of 13 px
const kLine_px = 19;
const kLines = 6; // of a paragraph
const kBetween_px = 16;

interface Part {
  height_px: number;
  at: (y_px: number) => string;
}

const paragraph = (text: string, width_px: number, fill: string): Part => {
  const lines = wrapped(micrometres(text), Math.floor((width_px - 2 * kMargin_px) / kLetter_px), kLines);
  const line = (y_px: number, words: string): string =>
    `<text x="${kMargin_px}" y="${y_px}" font-family="${escaped(font)}" font-size="13" fill="${fill}">${escaped(words)}</text>`;
  return {
    height_px: kLine_px * lines.length,
    at: (y_px) => lines.map((words, k) => line(y_px + kLine_px * k + 14, words)).join(""),
  };
};

const picture_part = (picture: Picture, width_px: number): Part => {
  const height_px = picture.height_px + kCaption_px;
  const file = svg_file(picture, initial_state(picture, false, width_px), width_px, height_px);
  return { height_px, at: (y_px) => file.trim().replace("<svg ", `<svg y="${y_px}" `) };
};

const gap = (height_px: number): Part => ({ height_px, at: () => "" });

export const sheet = (sentences: readonly string[], pictures: readonly Picture[], width_px: number): string => {
  const { paper, ink, faint } = colours(false);
  const parts = [
    gap(kMargin_px),
    ...sentences.map((sentence) => paragraph(sentence, width_px, ink)),
    ...pictures.flatMap((picture) => [
      gap(kBetween_px),
      picture_part(picture, width_px),
      paragraph(told_of(picture), width_px, faint),
    ]),
    gap(kMargin_px),
  ];
  let height_px = 0;
  let drawn = "";
  for (const part of parts) {
    drawn += part.at(height_px);
    height_px += part.height_px;
  }
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width_px}" height="${height_px}" viewBox="0 0 ${width_px} ${height_px}">` +
    `<rect width="${width_px}" height="${height_px}" fill="${paper}"/>${drawn}</svg>\n`
  );
};
