// The marks of a step of a waterfall, drawn by hand: its bar, the fall from the step before, the best surrogate and the
// floor.
import type { Look, Toggle } from "../picture";
import { surrogate_um, type Step } from "./step";
import { colours, curve_colour, font, shown } from "../drawing/theme";
import { t } from "../texts/texts";

// Parts of the place of a step: of the bar, and of the marks over it.
export const kBar = 0.56;
const kMark = 0.8;
export const kRoomy_px = 110; // place of a step from which its name is written below it

const toggle = (key: string, label: () => string, colour: number | null, mark: Toggle["mark"]): Toggle => ({
  key,
  get label() {
    return label();
  },
  colour: (dark) => (colour === null ? colours(dark).faint : curve_colour(colour, dark)),
  mark,
  on: true,
});
export const toggles = {
  rmse: toggle("rmse", () => "RMSE", 0, "bar"),
  fall: toggle("fall", () => t.diagnosis_fall_from, null, "band"),
  surrogate: toggle("surrogate", () => t.diagnosis_best_surrogate, 1, "dashed"),
  floor: toggle("floor", () => t.diagnosis_floor, 2, "dotted"),
  held_out: toggle("held_out", () => t.diagnosis_left_out, 3, "dot"),
};

// "#0072b2" with an opacity.
const with_alpha = (colour: string, alpha: number): string =>
  `${colour}${Math.round(255 * alpha).toString(16).padStart(2, "0")}`;

// What ECharts tells a drawing by hand: values of the item, pixels of a point and of a distance.
export interface Api {
  value: (dimension: number) => number;
  coord: (point: [number, number]) => [number, number];
  size: (extent: [number, number]) => [number, number];
}
export type Drawn = Record<string, unknown>;
type Rectangle = Record<"x" | "y" | "width" | "height", number>;

const place = (api: Api, k: number, part: number): { left: number; width: number; right: number } => {
  const width = api.size([1, 0])[0] * part;
  const left = api.coord([k, 0])[0] - width / 2;
  return { left, width, right: left + width };
};

const rectangle = (api: Api, k: number, low: number, high: number): Rectangle => {
  const { left, width } = place(api, k, kBar);
  const top = api.coord([k, high])[1];
  return { x: left, y: top, width, height: api.coord([k, low])[1] - top };
};

// Solid where it is in the model, hollow where it is only proposed; its value is written within.
export const bar = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  if (step.rmse_um === null) return [];
  const colour = toggles.rmse.colour(look.dark);
  const shape = rectangle(api, k, 0, step.rmse_um);
  const { y: top, height } = shape;
  // Within the bar where it fits, clear of the lines of surrogate and floor.
  const lines_px = [surrogate_um(step), step.floor_um].flatMap((level) => (level === null ? [] : [api.coord([k, level])[1]]));
  const within = height > 28;
  const y = [top + 14, top + height / 2, top + height - 12].find((at) => lines_px.every((line) => Math.abs(line - at) > 12));
  const style = step.proposed
    ? { fill: with_alpha(colour, 0.16), stroke: colour, lineWidth: 1.5, lineDash: [6, 4] }
    : { fill: colour };
  const value = shown(Number(step.rmse_um.toPrecision(3)));
  const text = {
    text: shape.width > 70 ? `${value} µm` : shape.width > 36 ? value : "",
    x: shape.x + shape.width / 2,
    y: within ? (y ?? top + 14) : top - 11,
    align: "center",
    verticalAlign: "middle",
    font: `600 13px ${font}`,
    fill: within && !step.proposed ? colours(look.dark).paper : colours(look.dark).ink,
  };
  return [
    { type: "rect", shape, style },
    { type: "text", style: text, silent: true },
  ];
};

// From the top of the bar before, which stays as a dotted line, to the top of this one.
export const fall = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  if (step.rmse_um === null || step.from_um === null) return [];
  const faint = toggles.fall.colour(look.dark);
  const [low, high] = [Math.min(step.rmse_um, step.from_um), Math.max(step.rmse_um, step.from_um)];
  const y = api.coord([k, step.from_um])[1];
  const stroke = { stroke: faint, lineWidth: 1, lineDash: [2, 3] };
  return [
    { type: "rect", shape: rectangle(api, k, low, high), style: { fill: with_alpha(faint, 0.14) } },
    {
      type: "line",
      shape: { x1: place(api, k - 1, kBar).right, y1: y, x2: place(api, k, kBar).right, y2: y },
      style: stroke,
    },
  ];
};

export const surrogate = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  const level = surrogate_um(step);
  if (level === null) return [];
  const colour = toggles.surrogate.colour(look.dark);
  const { left, right, width } = place(api, k, kMark);
  const y = api.coord([k, level])[1];
  return [
    { type: "line", shape: { x1: left, y1: y, x2: right, y2: y }, style: { stroke: colour, lineWidth: 2.5, lineDash: [6, 4] } },
    ...(width < kRoomy_px * kMark
      ? []
      : [{
          type: "text",
          silent: true,
          style: {
            text: t.diagnosis_surrogate_percent({ percent: shown(100 * (step.surrogate_fall ?? 0), 0) }),
            x: right,
            y: y - 4,
            align: "right",
            verticalAlign: "bottom",
            font: `12px ${font}`,
            fill: colours(look.dark).ink,
            stroke: colours(look.dark).paper,
            lineWidth: 3,
          },
        }]),
  ];
};

export const floor = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  if (step.floor_um === null) return [];
  const { left, right } = place(api, k, 1);
  const y = api.coord([k, step.floor_um])[1];
  const line = { stroke: toggles.floor.colour(look.dark), lineWidth: 2, lineDash: [1, 3], lineCap: "round" };
  return [{ type: "line", shape: { x1: left, y1: y, x2: right, y2: y }, style: line }];
};
