// A picture for a file or paper: with its title and a legend of its own, without controls.
import type { EChartsCoreOption } from "echarts/core";
import { svg_of } from "./charts";
import type { Picture, State } from "../picture";
import { with_stretch } from "./stretch";
import { clamped } from "../drawing/text";
import { colours, font } from "../drawing/theme";

export const kCaption_px = 34; // above the drawing

// As the picture is at first.
export const initial_state = (picture: Picture, dark: boolean, width_px: number): State => {
  const chosen = Object.fromEntries(picture.choices.map((choice) => [choice.key, choice.initial]));
  return {
    look: { dark, width_px, height_px: picture.height_px, still: false },
    chosen,
    hidden: new Set(
      picture
        .toggles({ chosen })
        .filter((toggle) => !toggle.on)
        .map((toggle) => toggle.key),
    ),
    window: null,
    stretch: null,
  };
};

// As it is now, for paper.
export const stilled = (state: State, dark: boolean, width_px: number, height_px: number): State => ({
  ...state,
  look: { dark, width_px, height_px, still: true },
});

// All at once: of a drawing in steps, paper and files would have the first only.
export const drawn = (picture: Picture, state: State): EChartsCoreOption =>
  with_stretch({ progressive: 0, ...picture.draw(state) }, state);

// The title, and which of several is shown: it cannot be seen from the drawing.
export const caption_of = (picture: Picture, state: State): string => {
  const chosen = picture.choices.flatMap((choice) => {
    const value = choice.values.find((one) => one.value === state.chosen[choice.key]);
    return value && value.value !== "" ? [value.label] : [];
  });
  return clamped([picture.title, ...chosen].join(", "), 110);
};

// What is seen, whole.
export const told_of = ({ caption, about }: Picture): string => (about === "" ? caption : `${caption} ${about}`);

export const escaped = (text: string): string => text.replace(/[&<>"']/g, (letter) => `&#${letter.charCodeAt(0)};`);

// A light SVG file of this size, caption included.
export const svg_file = (picture: Picture, state: State, width_px: number, height_px: number): string => {
  const paper = stilled(state, false, width_px, height_px - kCaption_px);
  const ink = colours(false);
  const title = escaped(caption_of(picture, state));
  const drawing = svg_of(drawn(picture, paper), width_px, height_px - kCaption_px);
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width_px}" height="${height_px}" viewBox="0 0 ${width_px} ${height_px}" role="img">` +
    `<title>${title}</title><desc>${escaped(clamped(told_of(picture), 1000))}</desc>` +
    `<rect width="${width_px}" height="${height_px}" fill="${ink.paper}"/>` +
    `<text x="12" y="23" font-family="${escaped(font)}" font-size="16" font-weight="600" fill="${ink.ink}">${title}</text>` +
    `${drawing.replace("<svg ", `<svg y="${kCaption_px}" `)}</svg>\n`
  );
};
