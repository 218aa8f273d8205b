// The selected stretch of the x axis as a band in the drawing, in every picture the same way.
import type { EChartsCoreOption } from "echarts/core";
import type { State } from "../picture";

type Part = Record<string, unknown>;

const list = (part: unknown): Part[] => (Array.isArray(part) ? (part as Part[]) : part ? [part as Part] : []);

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
