// A job predicted by a regression over batches, with its 95 % interval; below it, what was measured less that.
import { decimated, difference, first_at } from "../drawing/columns";
import { curve, lines_across, sigma_band, type Uncertain, zero_line } from "../drawing/curve";
import { curves_base } from "../drawing/hover";
import type { Picture, State, Toggle } from "../picture";
import { time_axis, two_grids, whole_min } from "../drawing/axes";
import { columns_of, columns_of_rows, grid_below } from "../drawing/parts";
import type { BatchPart, Num } from "../report";
import { axis, base, colours, curve_colour, minutes, shown, time_text, toggle, tooltip } from "../drawing/theme";
import { t } from "../texts/texts";
import { plain } from "../drawing/text";

type Series = Record<string, unknown>;

export const prediction_picture = (batch: BatchPart): Picture => {
  const time_min = batch.time_s.map(minutes);
  const whole = whole_min([time_min]);
  const { measured_um, predicted_um, half_width_um } = batch;
  const residual_um = measured_um ? difference(measured_um, predicted_um) : null;
  const zero_um = predicted_um.map((value) => (value === null ? null : 0));
  const predicted = toggle("predicted", t.batch_predicted, 0, "line");
  const interval = toggle("interval", t.batch_interval, 0, "band");
  const measured = toggle("measured", t.measured, 1, "dashed");
  const residual = toggle("residual", t.batch_measured_less, 1, "line");
  const toggles = measured_um ? [predicted, interval, measured, residual] : [predicted, interval];

  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const in_grid = (grid: number): Series => ({ xAxisIndex: grid, yAxisIndex: grid });
    const points = (values: readonly Num[]): [number, Num][] => decimated(time_min, values, window, look.width_px);
    const line = (of: Toggle, values: readonly Num[], grid: number, dash: "solid" | readonly number[] = "solid"): Series =>
      curve(of.label, of.colour(look.dark), dash, 1.8, points(values), in_grid(grid));
    const band = (about: readonly Num[], grid: number): Series => {
      const ends = points(about).map(([x, y]): Uncertain => [x, y, half_width_um[first_at(time_min, x)] ?? null]);
      const colour = interval.colour(look.dark);
      return { ...sigma_band(ends, colour), name: interval.label, color: colour, ...in_grid(grid) };
    };
    const when = ({ key }: Toggle, series: Series): Series[] => (hidden.has(key) ? [] : [series]);
    const below = residual_um ? when(residual, { ...line(residual, residual_um, 1), markLine: zero_line(look) }) : [];
    const series = [
      ...when(interval, band(predicted_um, 0)),
      ...when(predicted, line(predicted, predicted_um, 0)),
      ...(measured_um ? when(measured, line(measured, measured_um, 0, [6, 3])) : []),
      ...below,
      ...(below.length > 0 ? when(interval, band(zero_um, 1)) : []),
    ];
    const x = time_axis(look, window ?? whole);
    const one_grid = { grid: grid_below(look, toggles), xAxis: x, yAxis: axis(look, t.deviation_axis, "y") };
    return {
      ...curves_base(state, toggles, { drawn: series, head: (at) => time_text(at, 1), unit: "µm" }),
      ...(below.length > 0 ? two_grids(look, x, t.deviation_axis, t.batch_difference_axis).drawn : one_grid),
      series,
    };
  };

  return {
    name: "batch",
    title: t.batch_title,
    caption: measured_um ? t.batch_caption_measured : t.batch_caption,
    about: measured_um ? t.batch_about_measured : "",
    height_px: measured_um ? 480 : 340,
    zoom: "time",
    toggles: () => toggles,
    draw,
    numbers: () => columns_of({ time_min, predicted_um, half_width_um, measured_um, residual_um }),
  };
};

// Whether a job stays within what its batches were: Hotelling's T2 within the plane of the components, Q off it, each
// over the largest of any row in training.

export const range_picture = (batch: BatchPart): Picture => {
  const time_min = batch.time_s.map(minutes);
  const whole = whole_min([time_min]);
  const [T2, Q] = [toggle("T2", t.batch_T2, 0, "line"), toggle("Q", t.batch_Q, 1, "dashed")];
  const label = { position: "insideEndTop", formatter: t.batch_largest_in_training };
  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const line = ({ key, label, colour }: Toggle, values: readonly Num[], dash: "solid" | "dashed"): Record<string, unknown>[] =>
      hidden.has(key)
        ? []
        : [curve(label, colour(look.dark), dash, 1.8, decimated(time_min, values, window, look.width_px))];
    const series = [...line(T2, batch.T2_of_largest, "solid"), ...line(Q, batch.Q_of_largest, "dashed")];
    return {
      ...curves_base(state, [T2, Q], { drawn: series, head: (at) => time_text(at, 1), unit: "" }),
      grid: grid_below(look, [T2, Q]),
      xAxis: time_axis(look, window ?? whole),
      yAxis: {
        ...axis(look, t.batch_share_axis, "y"),
        scale: false,
        min: 0,
        max: ({ max }: { max: number }) => (max > 1 ? null : 1.2),
      },
      series: [...series, lines_across([{ yAxis: 1 }], label, { color: colours(look.dark).ink, type: "solid", width: 1.2 })],
    };
  };
  return {
    name: "batch-range",
    title: t.batch_range_title,
    caption: t.batch_range_caption,
    about: t.batch_range_about,
    height_px: 280,
    zoom: "time",
    toggles: () => [T2, Q],
    draw,
    numbers: () => columns_of({ time_min, T2_of_largest: batch.T2_of_largest, Q_of_largest: batch.Q_of_largest }),
  };
};

// How much each batch counts in the regression.

const kLabel_px = 46; // that a name needs, lying

export const weights_picture = ({ batches }: BatchPart): Picture => ({
  name: "batch-weights",
  title: t.batch_weights_title,
  caption: t.batch_weights_caption,
  height_px: 240,
  zoom: "none",
  toggles: () => [],
  draw: ({ look }: State) => {
    const c = colours(look.dark);
    const names = batches.map(({ name }) => plain(name, 16));
    const lying = (look.width_px - 84) / Math.max(1, batches.length) > kLabel_px;
    return {
      ...base(look),
      grid: { left: 64, right: 20, top: 20, bottom: lying ? 32 : 76 },
      tooltip: { ...tooltip(look), trigger: "item", valueFormatter: (value: unknown) => shown(Number(value), 3) },
      xAxis: {
        ...axis(look, "", "x"),
        type: "category",
        data: names,
        splitLine: { show: false },
        axisTick: { show: false },
        axisLabel: { color: c.ink, rotate: lying ? 0 : 55, hideOverlap: true },
      },
      yAxis: { ...axis(look, t.batch_weight, "y"), scale: false, min: 0 },
      series: [
        {
          type: "bar",
          name: t.batch_weight,
          barMaxWidth: 36,
          color: curve_colour(0, look.dark),
          data: batches.map(({ weight }) => weight),
          label: { show: lying, position: "top", color: c.ink, fontSize: 11, formatter: ({ value }: { value: number }) => shown(value, 2) },
        },
      ],
    };
  },
  numbers: () => columns_of_rows(batches, { batch: ({ name }) => name, weight: ({ weight }) => weight }),
});
