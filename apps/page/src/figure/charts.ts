// ECharts, with the parts that the pictures use and no others. On the page a chart is a canvas: it is fast, and unlike
// SVG elements it needs no style attributes, which the page's content security policy forbids. Files are SVG.
import { BarChart, CustomChart, HeatmapChart, LineChart, ScatterChart } from "echarts/charts";
import {
  AxisPointerComponent,
  BrushComponent,
  GraphicComponent,
  GridComponent,
  LegendComponent,
  MarkAreaComponent,
  MarkLineComponent,
  MarkPointComponent,
  PolarComponent,
  TitleComponent,
  TooltipComponent,
  VisualMapComponent,
} from "echarts/components";
import { connect, init, use, type ECharts, type EChartsCoreOption } from "echarts/core";
import { CanvasRenderer, SVGRenderer } from "echarts/renderers";
import type { Range } from "../picture";

use([BarChart, CustomChart, HeatmapChart, LineChart, ScatterChart]);
use([AxisPointerComponent, BrushComponent, GraphicComponent, GridComponent, LegendComponent, PolarComponent, TitleComponent]);
use([MarkAreaComponent, MarkLineComponent, MarkPointComponent, TooltipComponent, VisualMapComponent]);
use([CanvasRenderer, SVGRenderer]);

export type Chart = ECharts;

export const chart_in = (box: HTMLElement, width_px: number, height_px: number): Chart =>
  init(box, null, { renderer: "canvas", width: width_px, height: height_px });

// A canvas with this many pixels per CSS pixel, drawn once.
export const canvas_of = (
  option: EChartsCoreOption,
  width_px: number,
  height_px: number,
  pixels: number,
): HTMLCanvasElement => {
  const chart = chart_in(document.createElement("div"), width_px, height_px);
  chart.setOption(option);
  const canvas = chart.renderToCanvas({ pixelRatio: pixels });
  canvas.removeAttribute("style"); // it is no longer a layer of a chart
  chart.clear(); // a heatmap is drawn over several frames, which would continue in a disposed chart
  chart.dispose();
  return canvas;
};

// Needs no document, so it works outside a browser too.
export const svg_of = (option: EChartsCoreOption, width_px: number, height_px: number): string => {
  const chart = init(null, null, { renderer: "svg", ssr: true, width: width_px, height: height_px });
  chart.setOption(option);
  const text = chart.renderToSVGString();
  chart.dispose();
  return text;
};

// What the pointer reads in one chart is read in all others of the same name.
export const link = (chart: Chart, name: string): void => {
  chart.group = name;
  connect(name);
};

// A drag draws a frame, or a stretch of the x axis, as ECharts' own brush does. The brush of one chart is of no other,
// linked or not, and no curve looks different for it.

export type Brush = "rect" | "lineX" | false; // false: a drag draws nothing

export interface Brushed {
  brushId: string;
  areas: readonly { range: [number, number] | [Range, Range] }[]; // in pixels
}

export const brush_of = (name: string, dark: boolean): EChartsCoreOption => {
  const brushStyle = { color: dark ? "rgba(255,255,255,0.14)" : "rgba(30,60,90,0.12)", borderWidth: 0 };
  return { brush: { id: name, toolbox: [], xAxisIndex: "all", yAxisIndex: "all", seriesIndex: [], transformable: false, brushStyle } };
};

export const take_brush = (chart: Chart, brushType: Brush): void =>
  chart.dispatchAction({ type: "takeGlobalCursor", key: "brush", brushOption: { brushType, brushMode: "single" }, escapeConnect: true });

// The x axis as a picture without a window states it; null: no numeric axis.
export const x_limits = ({ xAxis }: EChartsCoreOption): Range | null => {
  const { min, max } = ((Array.isArray(xAxis) ? xAxis[0] : xAxis) ?? {}) as { min?: unknown; max?: unknown };
  return typeof min === "number" && typeof max === "number" && min < max ? [min, max] : null;
};

export const x_at = (chart: Chart, px: number): number =>
  chart.convertFromPixel({ xAxisIndex: 0 }, px) as unknown as number;

// Of the y axis with this number.
export const y_at = (chart: Chart, axis: number, px: number): number =>
  chart.convertFromPixel({ yAxisIndex: axis }, px) as unknown as number;

export const px_at = (chart: Chart, x: number): number =>
  chart.convertToPixel({ xAxisIndex: 0 }, x) as unknown as number;
