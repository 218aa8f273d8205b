// Whether a job stays within what its batches were: Hotelling's T2 within the plane of the components, Q off it, each
// over the largest of any row in training.
import { decimated } from "./decimate";
import { hover_text } from "./hover";
import type { Picture, State, Toggle } from "./picture";
import type { BatchPart } from "./report";
import { axis, base, colours, curve_colour, legend, minutes, shown, tooltip } from "./theme";

const T2: Toggle = { key: "T2", label: "T² (how far out)", colour: (dark) => curve_colour(0, dark), mark: "line", on: true };
const Q: Toggle = { key: "Q", label: "Q (how unlike)", colour: (dark) => curve_colour(1, dark), mark: "dashed", on: true };

export const range_picture = (batch: BatchPart): Picture => {
  const time_min = batch.time_s.map(minutes);
  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const c = colours(look.dark);
    const curves = [
      { toggle: T2, values: batch.T2_of_largest, dash: "solid" },
      { toggle: Q, values: batch.Q_of_largest, dash: "dashed" },
    ].filter(({ toggle }) => !hidden.has(toggle.key));
    const most = Math.max(1, ...[batch.T2_of_largest, batch.Q_of_largest].map((values) =>
      values.reduce((largest: number, value) => Math.max(largest, value ?? 0), 0)));
    return {
      ...base(look),
      grid: { left: 64, right: 20, top: look.still ? 44 : 14, bottom: 48 },
      legend: legend(state, [T2, Q]),
      tooltip: {
        ...tooltip(look),
        trigger: "axis",
        formatter: hover_text({ x: 0, y: 1, head: (at) => `${shown(at, 1)} min`, unit: "" }),
      },
      xAxis: {
        ...axis(look, "time, min", "x"),
        ...(window ? { min: window[0], max: window[1] } : { min: "dataMin", max: "dataMax" }),
      },
      yAxis: { ...axis(look, "of the largest in training", "y"), scale: false, min: 0, max: Number((1.15 * most).toPrecision(2)) },
      series: curves.map(({ toggle, values, dash }, k) => ({
        name: toggle.label,
        type: "line",
        showSymbol: false,
        color: toggle.colour(look.dark),
        lineStyle: { width: 1.8, type: dash },
        data: decimated(time_min, values, window, look.width_px),
        ...(k > 0 ? {} : {
          markLine: {
            symbol: "none",
            silent: true,
            label: { position: "insideEndTop", formatter: "largest in training", color: c.ink },
            lineStyle: { color: c.ink, type: "solid", width: 1.2 },
            data: [{ yAxis: 1 }],
          },
        }),
      })),
    };
  };
  return {
    name: "batch-range",
    title: "Like the batches it was trained on",
    about:
      "Hotelling's T² says how far out a row of temperatures lies, Q how unlike all rows of training it is, both over " +
      "the largest in training. Above 1 the model extrapolates.",
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
