// How far the error falls from step to step, and beside every fall what a fake effect would have bought: a falling
// error proves fit, not cause.
import { round_up } from "./niceness";
import type { Look, Numbers, Picture, State, Toggle } from "./picture";
import type { Num } from "./report";
import { plain } from "./text";
import { axis, base, colours, curve_colour, font, legend, shown, tooltip } from "./theme";

// One bar. Null: not known.
export interface Step {
  label: string;
  short: string; // where there is little room
  rmse_um: Num;
  from_um: Num; // of the step before, where the two can be compared
  floor_um: Num;
  fake_fall: Num; // share of from_um that the best fake took off
  held_out_um: Num;
  proposed: boolean; // not in the model
}
export interface Fall {
  name: string;
  title: string;
  about: string;
  steps: readonly Step[];
}

export const fake_um = (step: Step): Num =>
  step.from_um === null || step.fake_fall === null ? null : step.from_um * (1 - step.fake_fall);

// Parts of the place of a step: of the bar, and of the marks over it.
const bar_part = 0.56;
const mark_part = 0.8;
const roomy_px = 110; // place of a step from which its name is written below it

const toggles: readonly Toggle[] = [
  { key: "rmse", label: "RMSE", colour: (dark) => curve_colour(0, dark), mark: "bar", on: true },
  { key: "fall", label: "fall from the step before", colour: (dark) => colours(dark).faint, mark: "band", on: true },
  { key: "fake", label: "the best fake", colour: (dark) => curve_colour(1, dark), mark: "dashed", on: true },
  { key: "floor", label: "floor", colour: (dark) => curve_colour(2, dark), mark: "line", on: true },
  { key: "held_out", label: "left out", colour: (dark) => curve_colour(3, dark), mark: "dot", on: true },
];
const toggle_of = (key: string): Toggle => {
  const found = toggles.find((toggle) => toggle.key === key);
  if (!found) throw new Error(`There is no toggle ${key}.`);
  return found;
};

// "#0072b2" with an opacity.
const with_alpha = (colour: string, alpha: number): string =>
  `${colour}${Math.round(255 * alpha).toString(16).padStart(2, "0")}`;

const told = (step: Step): string => {
  const row = (what: string, value: Num): string[] => (value === null ? [] : [`${what} ${shown(value, 3)} µm`]);
  const fake = fake_um(step);
  return [
    plain(step.label, 60),
    ...row("RMSE", step.rmse_um),
    ...(fake === null || step.fake_fall === null
      ? []
      : [`best fake ${shown(fake, 3)} µm (−${(100 * step.fake_fall).toFixed(0)} %)`]),
    ...row("floor", step.floor_um),
    ...row("left out", step.held_out_um),
  ].join("\n");
};

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

const rectangle = (api: Api, k: number, low: number, high: number): Drawn => {
  const { left, width } = place(api, k, bar_part);
  const top = api.coord([k, high])[1];
  return { x: left, y: top, width, height: api.coord([k, low])[1] - top };
};

// Solid where it is in the model, hollow where it is only proposed; its value is written within.
const bar = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  if (step.rmse_um === null) return [];
  const colour = toggle_of("rmse").colour(look.dark);
  const shape = rectangle(api, k, 0, step.rmse_um);
  const within = Number(shape["height"]) > 28;
  const style = step.proposed
    ? { fill: with_alpha(colour, 0.16), stroke: colour, lineWidth: 1.5, lineDash: [6, 4] }
    : { fill: colour };
  const text = {
    text: `${shown(Number(step.rmse_um.toPrecision(3)))} µm`,
    x: Number(shape["x"]) + Number(shape["width"]) / 2,
    y: within ? Number(shape["y"]) + 7 : Number(shape["y"]) - 4,
    align: "center",
    verticalAlign: within ? "top" : "bottom",
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
  const faint = toggle_of("fall").colour(look.dark);
  const [low, high] = [Math.min(step.rmse_um, step.from_um), Math.max(step.rmse_um, step.from_um)];
  const y = api.coord([k, step.from_um])[1];
  const stroke = { stroke: faint, lineWidth: 1, lineDash: [2, 3] };
  return [
    { type: "rect", shape: rectangle(api, k, low, high), style: { fill: with_alpha(faint, 0.14) } },
    {
      type: "line",
      shape: { x1: place(api, k - 1, bar_part).right, y1: y, x2: place(api, k, bar_part).right, y2: y },
      style: stroke,
    },
  ];
};

const fake = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  const level = fake_um(step);
  if (level === null) return [];
  const colour = toggle_of("fake").colour(look.dark);
  const { left, right, width } = place(api, k, mark_part);
  const y = api.coord([k, level])[1];
  return [
    { type: "line", shape: { x1: left, y1: y, x2: right, y2: y }, style: { stroke: colour, lineWidth: 2.5, lineDash: [6, 4] } },
    ...(width < roomy_px * mark_part
      ? []
      : [{
          type: "text",
          silent: true,
          style: {
            text: `best fake −${(100 * (step.fake_fall ?? 0)).toFixed(0)} %`,
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

const floor = (api: Api, k: number, step: Step, look: Look): Drawn[] => {
  if (step.floor_um === null) return [];
  const { left, right } = place(api, k, 1);
  const y = api.coord([k, step.floor_um])[1];
  const line = { stroke: toggle_of("floor").colour(look.dark), lineWidth: 2, lineDash: [1, 3], lineCap: "round" };
  return [{ type: "line", shape: { x1: left, y1: y, x2: right, y2: y }, style: line }];
};

const drawing = ({ steps }: Fall, state: State): Record<string, unknown> => {
  const { look, hidden } = state;
  const c = colours(look.dark);
  const place_px = (look.width_px - 84) / Math.max(1, steps.length);
  const levels = steps.flatMap((step) => [step.rmse_um, step.held_out_um, step.floor_um, fake_um(step)]);
  const most = Math.max(1e-9, ...levels.map((level) => level ?? 0));
  const letters = Math.max(0, ...steps.map((step) => step.label.length));
  const lines = place_px > roomy_px ? Math.min(4, Math.ceil((7 * letters) / (place_px - 24))) : 1;
  // A series of marks drawn by hand, one a step.
  const by_hand = (key: string, draw: (api: Api, k: number, step: Step, look: Look) => Drawn[], z: number): Drawn[] =>
    hidden.has(key)
      ? []
      : [{
          type: "custom",
          name: toggle_of(key).label,
          color: toggle_of(key).colour(look.dark),
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
    grid: { left: 64, right: 20, top: look.still ? 44 : 24, bottom: 18 + 15 * lines },
    legend: legend(state, toggles),
    tooltip: {
      ...tooltip(look),
      trigger: "item",
      formatter: (one: { dataIndex: number }) => {
        const step = steps[one.dataIndex];
        return step ? told(step) : "";
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
          place_px > roomy_px ? plain(steps[k]?.label ?? "", 70).replaceAll("(", " (") : (steps[k]?.short ?? ""),
      },
    },
    yAxis: { ...axis(look, "RMSE, µm", "y"), scale: false, min: 0, max: round_up(most * 1.08, [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) },
    series: [
      ...by_hand("fall", fall, 1),
      ...by_hand("rmse", bar, 2),
      ...by_hand("floor", floor, 3),
      ...by_hand("fake", fake, 4),
      ...(hidden.has("held_out")
        ? []
        : [{
            type: "scatter",
            name: toggle_of("held_out").label,
            color: toggle_of("held_out").colour(look.dark),
            symbol: "diamond",
            symbolSize: 13,
            symbolOffset: [(-bar_part / 2) * place_px, 0], // on the left edge of the bar, clear of its value
            itemStyle: { borderColor: c.paper, borderWidth: 1.5 },
            data: steps.map((step, k) => [k, step.held_out_um]),
            z: 5,
          }]),
    ],
  };
};

const numbers = ({ steps }: Fall): Numbers => ({
  columns: [
    { name: "step", values: steps.map((_, k) => k) },
    { name: "what", values: steps.map((step) => step.label) },
    { name: "rmse_um", values: steps.map((step) => step.rmse_um) },
    { name: "best_fake_um", values: steps.map(fake_um) },
    { name: "floor_um", values: steps.map((step) => step.floor_um) },
    { name: "left_out_um", values: steps.map((step) => step.held_out_um) },
  ],
});

export const waterfall = (fall: Fall): Picture => ({
  name: fall.name,
  title: fall.title,
  about: fall.about,
  height_px: 340,
  zoom: "none",
  choices: [],
  toggles: () => toggles,
  draw: (state) => drawing(fall, state),
  numbers: () => numbers(fall),
});
