// The marks of a step of a waterfall, drawn by hand: its bar, the fall from the step before, and the floor.
import { columns_of_rows, grid_below } from "../drawing/parts";
import type { Look, Picture, State, Toggle } from "../picture";
import type { Step } from "./steps";
import { axis, base, colours, font, legend, rounded, shown, toggle, tooltip } from "../drawing/theme";
import { t } from "../texts/texts";
import { round_up } from "../drawing/axes";
import type { Num } from "../report";
import { plain } from "../drawing/text";

const kBar = 0.56; // part of the place of a step
const kRoomy_px = 110; // place of a step from which its name is written below it

const step_toggles = () => ({
  rmse: toggle("rmse", "RMSE", 0, "bar"),
  fall: toggle("fall", t.diagnosis_fall_from, (dark) => colours(dark).faint, "band"),
  floor: toggle("floor", t.floor, 2, "dotted"),
  held_out: toggle("held_out", t.diagnosis_left_out, 3, "dot"),
});

// "#0072b2" with an opacity.
const with_alpha = (colour: string, alpha: number): string =>
  `${colour}${Math.round(255 * alpha).toString(16).padStart(2, "0")}`;

// What ECharts tells a drawing by hand: values of the item, pixels of a point and of a distance.
interface Api {
  value: (dimension: number) => number;
  coord: (point: [number, number]) => [number, number];
  size: (extent: [number, number]) => [number, number];
}
type Drawn = Record<string, unknown>;

const place = (api: Api, k: number, part: number): { left: number; width: number; right: number } => {
  const width = api.size([1, 0])[0] * part;
  const left = api.coord([k, 0])[0] - width / 2;
  return { left, width, right: left + width };
};

const rectangle = (api: Api, k: number, low: number, high: number): Record<"x" | "y" | "width" | "height", number> => {
  const { left, width } = place(api, k, kBar);
  const top = api.coord([k, high])[1];
  return { x: left, y: top, width, height: api.coord([k, low])[1] - top };
};

// Solid where it is in the model, hollow where it is only proposed; its value is written within.
const bar = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  if (step.rmse_um === null) return [];
  const colour = step_toggles().rmse.colour(look.dark);
  const shape = rectangle(api, k, 0, step.rmse_um);
  const { y: top, height } = shape;
  // Within the bar where it fits, clear of the line of the floor.
  const line = step.floor_um === null ? -Infinity : api.coord([k, step.floor_um])[1];
  const within = height > 28;
  const y = [top + 14, top + height / 2, top + height - 12].find((at) => Math.abs(line - at) > 12);
  const style = step.proposed
    ? { fill: with_alpha(colour, 0.16), stroke: colour, lineWidth: 1.5, lineDash: [6, 4] }
    : { fill: colour };
  const value = rounded(step.rmse_um, 3);
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
const fall = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  if (step.rmse_um === null || step.from_um === null) return [];
  const faint = step_toggles().fall.colour(look.dark);
  const [low, high] = [Math.min(step.rmse_um, step.from_um), Math.max(step.rmse_um, step.from_um)];
  const y = api.coord([k, step.from_um])[1];
  const style = { stroke: faint, lineWidth: 1, lineDash: [2, 3] };
  return [
    { type: "rect", shape: rectangle(api, k, low, high), style: { fill: with_alpha(faint, 0.14) } },
    { type: "line", shape: { x1: place(api, k - 1, kBar).right, y1: y, x2: place(api, k, kBar).right, y2: y }, style },
  ];
};

const floor = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  if (step.floor_um === null) return [];
  const { left, right } = place(api, k, 1);
  const y = api.coord([k, step.floor_um])[1];
  const line = { stroke: step_toggles().floor.colour(look.dark), lineWidth: 2, lineDash: [1, 3], lineCap: "round" };
  return [{ type: "line", shape: { x1: left, y1: y, x2: right, y2: y }, style: line }];
};

// How far the error falls from step to step: a falling error proves fit, not cause.

// Of what is known of one step at least.
const present = (steps: readonly Step[]): Toggle[] => {
  const toggles = step_toggles();
  const some = (value: (step: Step) => Num): boolean => steps.some((step) => value(step) !== null);
  return [
    toggles.rmse,
    ...(some((step) => step.from_um) ? [toggles.fall] : []),
    ...(some((step) => step.floor_um) ? [toggles.floor] : []),
    ...(some((step) => step.held_out_um) ? [toggles.held_out] : []),
  ];
};

const step_text = (step: Step): string => {
  const row = (what: string, value: Num): string[] => (value === null ? [] : [`${what} ${shown(value, 3)} µm`]);
  return [
    plain(step.label, 60),
    ...row("RMSE", step.rmse_um),
    ...row(t.floor, step.floor_um),
    ...row(t.diagnosis_left_out, step.held_out_um),
  ].join("\n");
};

const drawing = (steps: readonly Step[], state: State): Record<string, unknown> => {
  const { look, hidden } = state;
  const c = colours(look.dark);
  const toggles = step_toggles();
  const grid = grid_below(look, present(steps));
  const place_px = (look.width_px - 84) / Math.max(1, steps.length);
  const levels = steps.flatMap((step) => [step.rmse_um, step.held_out_um, step.floor_um]);
  const most = Math.max(1e-9, ...levels.map((level) => level ?? 0));
  const letters = Math.max(0, ...steps.map((step) => step.label.length));
  const lines = place_px > kRoomy_px ? Math.min(4, Math.ceil((7 * letters) / (place_px - 24))) : 1;
  // A series of marks drawn by hand, one a step.
  const by_hand = (of: Toggle, draw: (api: Api, k: number, step: Step, look: Look) => Drawn[], z: number): Drawn[] =>
    hidden.has(of.key)
      ? []
      : [{
          type: "custom",
          name: of.label,
          color: of.colour(look.dark),
          z,
          data: steps.map((step, k) => [k, step.rmse_um ?? 0]),
          renderItem: (_: unknown, api: Api) => {
            const k = api.value(0);
            const step = steps[k];
            return step ? { type: "group", children: draw(api, k, step, look) } : null;
          },
        }];
  return {
    ...base(look),
    grid: { ...grid, top: 12 + Number(grid["top"]), bottom: 18 + 15 * lines },
    legend: legend(state, present(steps)),
    tooltip: {
      ...tooltip(look),
      trigger: "item",
      formatter: (one: { dataIndex: number }) => {
        const step = steps[one.dataIndex];
        return step ? step_text(step) : "";
      },
    },
    xAxis: {
      ...axis(look, "", "x"),
      type: "category",
      data: steps.map((_, k) => String(k)),
      axisTick: { show: false },
      splitLine: { show: false },
      axisLabel: {
        color: c.ink,
        interval: 0,
        width: place_px - 10,
        overflow: "break",
        lineHeight: 15,
        // Words may break at the brackets of an effect as well.
        formatter: (_: string, k: number) =>
          place_px > kRoomy_px ? plain(steps[k]?.label ?? "", 70).replaceAll("(", " (") : (steps[k]?.short ?? ""),
      },
    },
    yAxis: { ...axis(look, t.diagnosis_rmse, "y"), min: 0, max: round_up(most * 1.08, [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) },
    series: [
      ...by_hand(toggles.fall, fall, 1),
      ...by_hand(toggles.rmse, bar, 2),
      ...by_hand(toggles.floor, floor, 3),
      ...(hidden.has(toggles.held_out.key)
        ? []
        : [{
            type: "scatter",
            name: toggles.held_out.label,
            color: toggles.held_out.colour(look.dark),
            symbol: "diamond",
            symbolSize: 13,
            symbolOffset: [(-kBar / 2) * place_px, 0], // on the left edge of the bar, clear of its value
            itemStyle: { borderColor: c.paper, borderWidth: 1.5 },
            data: steps.map((step, k) => [k, step.held_out_um]),
            z: 4,
          }]),
    ],
  };
};

export const waterfall = ({ steps, ...head }: Pick<Picture, "name" | "title" | "caption" | "about"> & { steps: readonly Step[] }): Picture => ({
  ...head,
  height_px: 340,
  zoom: "none",
  toggles: () => present(steps),
  draw: (state) => drawing(steps, state),
  numbers: () =>
    columns_of_rows(steps, {
      step: (_, k) => k,
      what: ({ label }) => label,
      rmse_um: ({ rmse_um }) => rmse_um,
      floor_um: ({ floor_um }) => floor_um,
      left_out_um: ({ held_out_um }) => held_out_um,
    }),
});
