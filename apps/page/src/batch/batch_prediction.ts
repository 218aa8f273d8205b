// A job predicted by a regression over batches, with its 95 % interval; below it, what was measured less that.
import { curve, zero_line } from "../drawing/curve";
import { decimated, first_at } from "../drawing/decimate";
import { hover_text } from "../drawing/hover";
import type { Numbers, Picture, State, Toggle } from "../picture";
import { kBottom_px, kLeft_px, kRight_px, top_px } from "../drawing/plot_grid";
import type { BatchPart, Num } from "../report";
import { sigma_band, type Uncertain } from "../drawing/sigma_marks";
import { axis, base, curve_colour, legend, minutes, shown, tooltip } from "../drawing/theme";
import { time_axis, whole_min } from "../drawing/time_axis";
import { two_grids } from "../drawing/two_grids";
import { t } from "../texts/texts";

type Series = Record<string, unknown>;

const toggle_of = (key: string, label: () => string, colour: number, mark: Toggle["mark"]): Toggle => ({
  key,
  get label() {
    return label();
  },
  colour: (dark) => curve_colour(colour, dark),
  mark,
  on: true,
});
const predicted = toggle_of("predicted", () => t.batch_predicted, 0, "line");
const interval = toggle_of("interval", () => t.batch_interval, 0, "band");
const measured = toggle_of("measured", () => t.measured, 1, "dashed");
const residual = toggle_of("residual", () => t.batch_measured_less, 1, "line");

const difference = (a: readonly Num[], b: readonly Num[]): Num[] =>
  a.map((value, i) => {
    const other = b[i] ?? null;
    return value === null || other === null ? null : value - other;
  });

export const prediction_picture = (batch: BatchPart): Picture => {
  const time_min = batch.time_s.map(minutes);
  const whole = whole_min([time_min]);
  const { measured_um, predicted_um, half_width_um } = batch;
  const residual_um = measured_um ? difference(measured_um, predicted_um) : null;
  const zero_um = predicted_um.map((value) => (value === null ? null : 0));
  const toggles = measured_um ? [predicted, interval, measured, residual] : [predicted, interval];

  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const in_grid = (grid: number): Series => ({ xAxisIndex: grid, yAxisIndex: grid });
    const points = (values: readonly Num[]): [number, Num][] => decimated(time_min, values, window, look.width_px);
    const line = (toggle: Toggle, values: readonly Num[], grid: number, dash: "solid" | readonly number[] = "solid"): Series =>
      curve(toggle.label, toggle.colour(look.dark), dash, 1.8, points(values), in_grid(grid));
    const band = (about: readonly Num[], grid: number): Series => {
      const ends = points(about).map(([x, y]): Uncertain => [x, y, half_width_um[first_at(time_min, x)] ?? null]);
      const colour = interval.colour(look.dark);
      return { ...sigma_band(ends, colour), name: interval.label, color: colour, ...in_grid(grid) };
    };
    const when = (toggle: Toggle, series: Series): Series[] => (hidden.has(toggle.key) ? [] : [series]);
    const above = [
      ...when(interval, band(predicted_um, 0)),
      ...when(predicted, line(predicted, predicted_um, 0)),
      ...(measured_um ? when(measured, line(measured, measured_um, 0, [6, 3])) : []),
    ];
    const below = residual_um
      ? when(residual, { ...line(residual, residual_um, 1), markLine: zero_line(look) })
      : [];
    const series = [...above, ...below, ...(below.length > 0 ? when(interval, band(zero_um, 1)) : [])];
    const x = time_axis(look, window ?? whole);
    const one_grid = {
      grid: { left: kLeft_px, right: kRight_px, top: top_px(look, toggles.map((one) => one.label)), bottom: kBottom_px },
      xAxis: x,
      yAxis: axis(look, t.deviation_axis, "y"),
    };
    return {
      ...base(look),
      ...(below.length > 0 ? two_grids(look, x, t.deviation_axis, t.batch_difference_axis).drawn : one_grid),
      legend: legend(state, toggles),
      tooltip: {
        ...tooltip(look),
        trigger: "axis",
        formatter: hover_text({ drawn: series, x: 0, y: 1, head: (at) => `${shown(at, 1)} min`, unit: "µm" }),
      },
      series,
    };
  };

  const numbers = (): Numbers => ({
    columns: [
      { name: "time_min", values: time_min },
      { name: "predicted_um", values: predicted_um },
      { name: "half_width_um", values: half_width_um },
      ...(measured_um && residual_um
        ? [
            { name: "measured_um", values: measured_um },
            { name: "residual_um", values: residual_um },
          ]
        : []),
    ],
  });

  return {
    name: "batch",
    title: t.batch_title,
    caption: measured_um ? t.batch_caption_measured : t.batch_caption,
    about: measured_um ? t.batch_about_measured : "",
    height_px: measured_um ? 480 : 340,
    zoom: "time",
    choices: [],
    toggles: () => toggles,
    draw,
    numbers,
  };
};
