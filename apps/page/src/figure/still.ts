// A picture for a file or paper: with its title and a legend of its own, without controls.
import type { EChartsCoreOption } from "echarts/core";
import { svg_of } from "./charts";
import type { Picture, State } from "../picture";
import { clamped, micrometres, wrapped } from "../drawing/text";
import { colours, font } from "../drawing/theme";

export const kCaption_px = 34; // above the drawing

// As the picture is at first.
export const initial_state = (picture: Picture, dark: boolean, width_px: number): State => {
  const chosen = Object.fromEntries((picture.choices ?? []).map((choice) => [choice.key, choice.initial]));
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
    heights: null,
  };
};

// As it is now, for paper.
export const stilled = (state: State, dark: boolean, width_px: number, height_px: number): State => ({
  ...state,
  look: { dark, width_px, height_px, still: true },
});

// All at once: of a drawing in steps, paper and files would have the first only.
export const drawn = (picture: Picture, state: State): EChartsCoreOption =>
  with_heights(with_stretch({ progressive: 0, ...picture.draw(state) }, state), state);

// The title, and which of several is shown: it cannot be seen from the drawing.
export const caption_of = (picture: Picture, state: State): string => {
  const chosen = (picture.choices ?? []).flatMap((choice) => {
    const value = choice.values.find((one) => one.value === state.chosen[choice.key]);
    if (!value && choice.slider) return [choice.slider.text(choice.slider.now(state.chosen))];
    return value && value.value !== "" ? [value.label] : [];
  });
  return clamped([picture.title, ...chosen].join(", "), 110);
};

// What is seen, whole.
export const description_of = ({ caption, about }: Picture): string => (about ? `${caption} ${about}` : caption);

export const escaped = (text: string): string => text.replace(/[&<>"']/g, (letter) => `&#${letter.charCodeAt(0)};`);

// A light SVG file of this size, caption included.
export const svg_file = (picture: Picture, state: State, width_px: number, height_px: number): string => {
  const paper = stilled(state, false, width_px, height_px - kCaption_px);
  const ink = colours(false);
  const title = escaped(caption_of(picture, state));
  const drawing = svg_of(drawn(picture, paper), width_px, height_px - kCaption_px);
  return (
    `<svg xmlns="http://www.w3.org/2000/svg" width="${width_px}" height="${height_px}" viewBox="0 0 ${width_px} ${height_px}" role="img">` +
    `<title>${title}</title><desc>${escaped(clamped(description_of(picture), 1000))}</desc>` +
    `<rect width="${width_px}" height="${height_px}" fill="${ink.paper}"/>` +
    `<text x="12" y="23" font-family="${escaped(font)}" font-size="16" font-weight="600" fill="${ink.ink}">${title}</text>` +
    `${drawing.replace("<svg ", `<svg y="${kCaption_px}" `)}</svg>\n`
  );
};

// The selected stretch of the x axis as a band in the drawing, in every picture the same way.

type Component = Record<string, unknown>;

const list = (part: unknown): Component[] => (Array.isArray(part) ? (part as Component[]) : part ? [part as Component] : []);

export const with_stretch = (option: EChartsCoreOption, state: State): EChartsCoreOption => {
  const { stretch, look } = state;
  const x_axes = list(option["xAxis"]);
  const y_axes = list(option["yAxis"]);
  if (!stretch || option["polar"]) return option;
  const colour = look.dark ? "rgba(255,255,255,0.14)" : "rgba(30,60,90,0.12)";
  const bands = x_axes.flatMap((axis, index) => {
    if (axis["type"] !== undefined && axis["type"] !== "value") return [];
    const y_index = y_axes.findIndex((one) => (one["gridIndex"] ?? 0) === (axis["gridIndex"] ?? 0));
    if (y_index < 0) return [];
    return [
      {
        type: "line",
        name: "",
        xAxisIndex: index,
        yAxisIndex: y_index,
        data: [],
        silent: true,
        tooltip: { show: false },
        markArea: {
          silent: true,
          itemStyle: { color: colour },
          data: [[{ xAxis: stretch[0] }, { xAxis: stretch[1] }]],
        },
      },
    ];
  });
  return { ...option, series: [...list(option["series"]), ...bands] };
};

// The y axis that is seen in part.
const with_heights = (option: EChartsCoreOption, { heights }: State): EChartsCoreOption => {
  if (!heights || option["polar"]) return option;
  const [min, max] = heights.range;
  const cut = (axis: Component): Component => ({ ...axis, min, max, axisLabel: { ...(axis["axisLabel"] as Component), showMinLabel: false, showMaxLabel: false } });
  return { ...option, yAxis: list(option["yAxis"]).map((axis, k) => (k === heights.axis && (axis["type"] ?? "value") === "value" ? cut(axis) : axis)) };
};

// Several pictures in one file, one below the other, under the conclusions of their report; below each stands what is
// seen in it.

const kMargin_px = 12;
const kLetter_px = 7; // about, of text of 13 px
const kLine_px = 19;
const kLines = 6; // of a paragraph
const kBetween_px = 16;

interface Row {
  height_px: number;
  at: (y_px: number) => string;
}

const paragraph = (text: string, width_px: number, fill: string): Row => {
  const lines = wrapped(micrometres(text), Math.floor((width_px - 2 * kMargin_px) / kLetter_px), kLines);
  const line = (y_px: number, words: string): string =>
    `<text x="${kMargin_px}" y="${y_px}" font-family="${escaped(font)}" font-size="13" fill="${fill}">${escaped(words)}</text>`;
  return {
    height_px: kLine_px * lines.length,
    at: (y_px) => lines.map((words, k) => line(y_px + kLine_px * k + 14, words)).join(""),
  };
};

const picture_part = (picture: Picture, width_px: number): Row => {
  const height_px = picture.height_px + kCaption_px;
  const file = svg_file(picture, initial_state(picture, false, width_px), width_px, height_px);
  return { height_px, at: (y_px) => file.trim().replace("<svg ", `<svg y="${y_px}" `) };
};

const gap = (height_px: number): Row => ({ height_px, at: () => "" });

export const sheet = (sentences: readonly string[], pictures: readonly Picture[], width_px: number): string => {
  const { paper, ink, faint } = colours(false);
  const parts = [
    gap(kMargin_px),
    ...sentences.map((sentence) => paragraph(sentence, width_px, ink)),
    ...pictures.flatMap((picture) => [
      gap(kBetween_px),
      picture_part(picture, width_px),
      paragraph(description_of(picture), width_px, faint),
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
