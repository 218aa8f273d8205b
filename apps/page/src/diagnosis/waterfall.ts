// How far the error falls from step to step, and beside every fall what a surrogate effect would have bought: a falling
// error proves fit, not cause.
import { round_up } from "../drawing/niceness";
import type { Look, Numbers, Picture, State, Toggle } from "../picture";
import { kLeft_px, kRight_px, top_px } from "../drawing/plot_grid";
import type { Num } from "../report";
import { surrogate_um, type Step } from "./step";
import { bar, kBar, surrogate, fall, floor, kRoomy_px, toggles, type Api, type Drawn } from "./step_marks";
import { plain } from "../drawing/text";
import { axis, base, colours, legend, shown, tooltip } from "../drawing/theme";
import { t } from "../texts/texts";

export interface Fall {
  name: string;
  title: string;
  caption: string;
  about: string;
  steps: readonly Step[];
}

// Of what is known of one step at least.
const present = (steps: readonly Step[]): Toggle[] => {
  const some = (value: (step: Step) => Num): boolean => steps.some((step) => value(step) !== null);
  return [
    toggles.rmse,
    ...(some((step) => step.from_um) ? [toggles.fall] : []),
    ...(some(surrogate_um) ? [toggles.surrogate] : []),
    ...(some((step) => step.floor_um) ? [toggles.floor] : []),
    ...(some((step) => step.held_out_um) ? [toggles.held_out] : []),
  ];
};

const told = (step: Step): string => {
  const row = (what: string, value: Num): string[] => (value === null ? [] : [`${what} ${shown(value, 3)} µm`]);
  const percent = step.surrogate_fall === null ? "" : shown(100 * step.surrogate_fall, 0);
  return [
    plain(step.label, 60),
    ...row("RMSE", step.rmse_um),
    ...row(t.diagnosis_surrogate_percent_of({ percent }), surrogate_um(step)),
    ...row(t.diagnosis_floor, step.floor_um),
    ...row(t.diagnosis_left_out, step.held_out_um),
  ].join("\n");
};

const drawing = ({ steps }: Fall, state: State): Record<string, unknown> => {
  const { look, hidden } = state;
  const c = colours(look.dark);
  const place_px = (look.width_px - 84) / Math.max(1, steps.length);
  const levels = steps.flatMap((step) => [step.rmse_um, step.held_out_um, step.floor_um, surrogate_um(step)]);
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
    grid: {
      left: kLeft_px,
      right: kRight_px,
      top: 12 + top_px(look, present(steps).map((one) => one.label)),
      bottom: 18 + 15 * lines,
    },
    legend: legend(state, present(steps)),
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
          place_px > kRoomy_px ? plain(steps[k]?.label ?? "", 70).replaceAll("(", " (") : (steps[k]?.short ?? ""),
      },
    },
    yAxis: { ...axis(look, t.diagnosis_rmse, "y"), min: 0, max: round_up(most * 1.08, [1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8]) },
    series: [
      ...by_hand(toggles.fall, fall, 1),
      ...by_hand(toggles.rmse, bar, 2),
      ...by_hand(toggles.floor, floor, 3),
      ...by_hand(toggles.surrogate, surrogate, 4),
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
    { name: "best_surrogate_um", values: steps.map(surrogate_um) },
    { name: "floor_um", values: steps.map((step) => step.floor_um) },
    { name: "left_out_um", values: steps.map((step) => step.held_out_um) },
  ],
});

export const waterfall = (fall: Fall): Picture => ({
  name: fall.name,
  title: fall.title,
  caption: fall.caption,
  about: fall.about,
  height_px: 340,
  zoom: "none",
  choices: [],
  toggles: () => present(fall.steps),
  draw: (state) => drawing(fall, state),
  numbers: () => numbers(fall),
});
