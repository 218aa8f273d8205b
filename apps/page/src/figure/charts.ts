// ECharts, with the parts that the pictures use and no others. On the page a chart is a canvas: it is fast, and unlike
// SVG elements it needs no style attributes, which the page's content security policy forbids. Files are SVG.
import { BarChart, CustomChart, HeatmapChart, LineChart, ScatterChart } from "echarts/charts";
import {
  AxisPointerComponent,
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
import { init, use, type ECharts, type EChartsCoreOption } from "echarts/core";
import { CanvasRenderer, SVGRenderer } from "echarts/renderers";
import type { Range } from "../picture";

use([BarChart, CustomChart, HeatmapChart, LineChart, ScatterChart]);
use([AxisPointerComponent, GraphicComponent, GridComponent, LegendComponent, PolarComponent, TitleComponent]);
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

interface Model {
  getComponent(
    kind: string,
    index: number,
  ): { axis?: { type: string; scale: { getExtent(): [number, number] } } } | undefined;
}

// The range of the x axis as drawn; null: no numeric axis. Uses internals of ECharts.
export const x_extent = (chart: Chart): Range | null => {
  const axis = (chart as unknown as { getModel(): Model | undefined }).getModel()?.getComponent("xAxis", 0)?.axis;
  if (axis?.type !== "value") return null;
  const [from, to] = axis.scale.getExtent();
  return Number.isFinite(from) && Number.isFinite(to) && from < to ? [from, to] : null;
};

export const x_at = (chart: Chart, px: number): number =>
  chart.convertFromPixel({ xAxisIndex: 0 }, px) as unknown as number;

// Of the y axis with this number.
export const y_at = (chart: Chart, axis: number, px: number): number =>
  chart.convertFromPixel({ yAxisIndex: axis }, px) as unknown as number;

export const px_at = (chart: Chart, x: number): number =>
  chart.convertToPixel({ xAxisIndex: 0 }, x) as unknown as number;
