// Files that the reader saves from the page.
import { canvas_of } from "./charts";
import { csv_of } from "./csv";
import type { Picture, State } from "../picture";
import { save } from "./save";
import { caption_of, drawn, kCaption_px, stilled, svg_file } from "./still";
import { colours, font } from "../drawing/theme";

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
export const save_png = (picture: Picture, state: State): void => {
  const width_px = width_of(state);
  const { dark } = state.look;
  const canvas = document.createElement("canvas");
  canvas.width = width_px * kPixels;
  canvas.height = (picture.height_px + kCaption_px) * kPixels;
  const pen = canvas.getContext("2d");
  if (!pen) return;
  pen.fillStyle = colours(dark).paper;
  pen.fillRect(0, 0, canvas.width, canvas.height);
  pen.fillStyle = colours(dark).ink;
  pen.font = `600 ${16 * kPixels}px ${font}`;
  pen.fillText(caption_of(picture, state), 12 * kPixels, 23 * kPixels);
  const option = drawn(picture, stilled(state, dark, width_px, picture.height_px));
  pen.drawImage(canvas_of(option, width_px, picture.height_px, kPixels), 0, kCaption_px * kPixels);
  canvas.toBlob((blob) => blob && save(`${picture.name}.png`, blob), "image/png");
};
