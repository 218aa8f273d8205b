// A job predicted by a regression over batches, with its 95 % interval; below it, what was measured less that.
import { band_between } from "./band";
import { decimated } from "./decimate";
import { hover_text } from "./hover";
import type { Numbers, Picture, State, Toggle } from "./picture";
import type { BatchPart, Num } from "./report";
import { axis, base, colours, curve_colour, legend, minutes, shown, tooltip } from "./theme";

const predicted: Toggle = { key: "predicted", label: "predicted", colour: (dark) => curve_colour(0, dark), mark: "line", on: true };
const interval: Toggle = { key: "interval", label: "95 % interval", colour: (dark) => curve_colour(0, dark), mark: "band", on: true };
const measured: Toggle = { key: "measured", label: "measured", colour: (dark) => curve_colour(1, dark), mark: "dashed", on: true };
const residual: Toggle = { key: "residual", label: "measured less predicted", colour: (dark) => curve_colour(1, dark), mark: "line", on: true };

const combined = (a: readonly Num[], b: readonly Num[], sign: 1 | -1): Num[] =>
  a.map((value, i) => {
    const other = b[i] ?? null;
    return value === null || other === null ? null : value + sign * other;
  });

// Two lines, the upper stacked on the lower; the room between them is filled.
const filled = (toggle: Toggle, band: ReturnType<typeof band_between>, colour: string, grid: number): Record<string, unknown>[] => {
  const part = {
    type: "line",
    xAxisIndex: grid,
    yAxisIndex: grid,
    stack: `band ${grid}`,
    stackStrategy: "all",
    showSymbol: false,
    silent: true,
    lineStyle: { opacity: 0 },
    tooltip: { show: false },
    color: colour,
  };
  return [
    { ...part, name: `${toggle.label}, from`, data: band.low },
    { ...part, name: toggle.label, data: band.above, areaStyle: { color: colour, opacity: 0.2 } },
  ];
};

export const prediction_picture = (batch: BatchPart): Picture => {
  const time_min = batch.time_s.map(minutes);
  const low = combined(batch.predicted_um, batch.half_width_um, -1);
  const high = combined(batch.predicted_um, batch.half_width_um, 1);
  const { measured_um } = batch;
  const residual_um = measured_um ? combined(measured_um, batch.predicted_um, -1) : null;
  const minus_half = batch.half_width_um.map((value) => (value === null ? null : -value));
  const toggles = measured_um ? [predicted, interval, measured, residual] : [predicted, interval];

  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const below = residual_um !== null && !hidden.has("residual");
    const points = (values: readonly Num[]): [number, Num][] => decimated(time_min, values, window, look.width_px);
    const between = (from: readonly Num[], to: readonly Num[]) => band_between(time_min, from, to, window, look.width_px);
    const line = (toggle: Toggle, values: readonly Num[], grid: number, dash: unknown = "solid") => ({
      name: toggle.label,
      type: "line",
      xAxisIndex: grid,
      yAxisIndex: grid,
      showSymbol: false,
      connectNulls: false,
      color: toggle.colour(look.dark),
      lineStyle: { width: 1.8, type: dash },
      data: points(values),
    });
    const when = (toggle: Toggle, series: readonly Record<string, unknown>[]) => (hidden.has(toggle.key) ? [] : series);
    const colour = interval.colour(look.dark);
    const limits = window ? { min: window[0], max: window[1] } : { min: "dataMin", max: "dataMax" };
    const x = { ...axis(look, "time, min", "x"), ...limits };
    const top = look.still ? 44 : 14;
    const side = { left: 64, right: 20 };
    return {
      ...base(look),
      legend: legend(state, toggles.filter((toggle) => toggle !== residual)),
      tooltip: {
        ...tooltip(look),
        trigger: "axis",
        formatter: hover_text({ x: 0, y: 1, head: (at) => `${shown(at, 1)} min`, unit: "µm" }),
      },
      axisPointer: { link: [{ xAxisIndex: "all" }] },
      grid: below
        ? [{ ...side, top, bottom: "38%" }, { ...side, top: "67%", bottom: 48 }]
        : [{ ...side, top, bottom: 48 }],
      xAxis: below ? [{ ...x, name: "", gridIndex: 0, axisLabel: { show: false } }, { ...x, gridIndex: 1 }] : [x],
      yAxis: [
        { ...axis(look, "deviation, µm", "y") },
        ...(below ? [{ ...axis(look, "difference, µm", "y"), gridIndex: 1, splitNumber: 3 }] : []),
      ],
      series: [
        ...when(interval, filled(interval, between(low, high), colour, 0)),
        ...when(predicted, [line(predicted, batch.predicted_um, 0)]),
        ...(measured_um ? when(measured, [line(measured, measured_um, 0, [6, 3])]) : []),
        ...(below && residual_um
          ? [
              ...when(interval, filled(interval, between(minus_half, batch.half_width_um), colour, 1)),
              {
                ...line(residual, residual_um, 1),
                markLine: {
                  symbol: "none",
                  silent: true,
                  label: { show: false },
                  lineStyle: { color: colours(look.dark).faint, type: "solid", width: 1 },
                  data: [{ yAxis: 0 }],
                },
              },
            ]
          : []),
      ],
    };
  };

  const numbers = (): Numbers => ({
    columns: [
      { name: "time_min", values: time_min },
      { name: "predicted_um", values: batch.predicted_um },
      { name: "half_width_um", values: batch.half_width_um },
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
    title: "Predicted by batches",
    about: measured_um
      ? "The deviation that the batches predict for this job, with its 95 % interval, and what was measured; below, " +
        "measured less predicted within the same interval."
      : "The deviation that the batches predict for this job, with its 95 % interval. Nothing was measured beside it.",
    height_px: measured_um ? 480 : 340,
    zoom: "time",
    choices: [],
    toggles: () => toggles,
    draw,
    numbers,
  };
};
