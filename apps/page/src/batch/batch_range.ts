// Whether a job stays within what its batches were: Hotelling's T2 within the plane of the components, Q off it, each
// over the largest of any row in training.
import { curve } from "../drawing/curve";
import { decimated } from "../drawing/decimate";
import { hover_text } from "../drawing/hover";
import { lines_across } from "../drawing/lines_across";
import type { Picture, State, Toggle } from "../picture";
import { kBottom_px, kLeft_px, kRight_px, top_px } from "../drawing/plot_grid";
import type { BatchPart, Num } from "../report";
import { axis, base, colours, curve_colour, legend, minutes, shown, tooltip } from "../drawing/theme";
import { time_axis, whole_min } from "../drawing/time_axis";
import { t } from "../texts/texts";

const T2: Toggle = {
  key: "T2",
  get label() {
    return t.batch_T2;
  },
  colour: (dark) => curve_colour(0, dark),
  mark: "line",
  on: true,
};
const Q: Toggle = {
  key: "Q",
  get label() {
    return t.batch_Q;
  },
  colour: (dark) => curve_colour(1, dark),
  mark: "dashed",
  on: true,
};

const limit = (color: string): Record<string, unknown> =>
  lines_across(
    [{ yAxis: 1 }],
    { position: "insideEndTop", formatter: t.batch_largest_in_training },
    { color, type: "solid", width: 1.2 },
  );

export const range_picture = (batch: BatchPart): Picture => {
  const time_min = batch.time_s.map(minutes);
  const whole = whole_min([time_min]);
  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const line = (toggle: Toggle, values: readonly Num[], dash: "solid" | "dashed"): Record<string, unknown>[] =>
      hidden.has(toggle.key)
        ? []
        : [curve(toggle.label, toggle.colour(look.dark), dash, 1.8, decimated(time_min, values, window, look.width_px))];
    const series = [...line(T2, batch.T2_of_largest, "solid"), ...line(Q, batch.Q_of_largest, "dashed")];
    return {
      ...base(look),
      grid: { left: kLeft_px, right: kRight_px, top: top_px(look, [T2.label, Q.label]), bottom: kBottom_px },
      legend: legend(state, [T2, Q]),
      tooltip: {
        ...tooltip(look),
        trigger: "axis",
        formatter: hover_text({ drawn: series, x: 0, y: 1, head: (at) => `${shown(at, 1)} min`, unit: "" }),
      },
      xAxis: time_axis(look, window ?? whole),
      yAxis: {
        ...axis(look, t.batch_share_axis, "y"),
        scale: false,
        min: 0,
        max: ({ max }: { max: number }) => (max > 1 ? null : 1.2),
      },
      series: [...series, limit(colours(look.dark).ink)],
    };
  };
  return {
    name: "batch-range",
    title: t.batch_range_title,
    caption: t.batch_range_caption,
    about: t.batch_range_about,
    height_px: 280,
    zoom: "time",
    choices: [],
    toggles: () => [T2, Q],
    draw,
    numbers: () => ({
      columns: [
        { name: "time_min", values: time_min },
        { name: "T2_of_largest", values: batch.T2_of_largest },
        { name: "Q_of_largest", values: batch.Q_of_largest },
      ],
    }),
  };
};
