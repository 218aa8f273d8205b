// One axis of a comparison: above both series, below their difference with twice its standard deviation.
import { curve, sigma_band, type Uncertain } from "../drawing/curve";
import { decimated, first_at } from "../drawing/columns";
import { place_of } from "../drift/drift_axes";
import type { Picture, Range, State } from "../picture";
import { kLeft_px, kRight_px, time_axis, top_px, value_axis } from "../drawing/axes";
import { reading_in } from "../drawing/hover";
import type { ComparedAxis, Num } from "../report";
import { plain, slug, unit_shown, words } from "../drawing/text";
import { base, colours, legend, minutes, toggle, tooltip } from "../drawing/theme";
import { columns_of } from "../drawing/parts";
import { t } from "../texts/texts";

const kMarked = 300; // points of a; more are a line

export interface Compared {
  name: string; // of the axis
  axis: ComparedAxis;
  k: number; // the axis among all
  unit: string;
  a: string;
  b: string;
  whole_min: Range;
}

// The stretch with the largest difference beyond two standard deviations, in both plots.
const disagreement = (axis: ComparedAxis, whole_min: Range, dark: boolean): Record<string, unknown> => {
  const none = { type: "line", name: "", data: [] };
  if (!axis.deviation) return none;
  const least = (whole_min[1] - whole_min[0]) * 0.004; // a single sample is seen too
  const from = minutes(axis.deviation.from_s) - least;
  const to = minutes(axis.deviation.to_s) + least;
  const color = dark ? "rgba(255,120,80,0.16)" : "rgba(213,60,0,0.10)";
  return { ...none, markArea: { silent: true, itemStyle: { color }, data: [[{ xAxis: from }, { xAxis: to }]] } };
};

export const comparison_picture = ({ name, axis, k, unit, a, b, whole_min }: Compared): Picture => {
  const time_min = axis.points.map((point) => minutes(point.time_s));
  const column = (key: string): Num[] => axis.points.map((point) => point[key] ?? null);
  const a_values = column(`a_${unit}`);
  const b_values = column(`b_${unit}`);
  const difference = column(`difference_${unit}`);
  const sigma = column(`sigma_${unit}`);
  const quantity = plain(words(name), 40);
  const written = unit_shown(unit);
  const place = place_of(name, k);
  const has_sigma = sigma.some((value) => value !== null);
  const band_of_sigma = toggle("sigma", t.comparison_sigma_band, (dark) => colours(dark).faint, "band");
  const of_a = toggle("a", t.comparison_curve({ which: "A", name: plain(a, 60) }), place, "dot");
  const of_b = toggle("b", t.comparison_curve({ which: "B", name: plain(b, 60) }), place + 3, "line");
  const of_difference = toggle("difference", t.comparison_a_less_b, place, "dashed");
  const toggles = [of_a, of_b, of_difference, ...(has_sigma ? [band_of_sigma] : [])];

  const upper = (state: State): Record<string, unknown>[] => {
    const { dark, width_px } = state.look;
    const points = (values: readonly Num[]): [number, Num][] => decimated(time_min, values, state.window, width_px);
    const a_points = points(a_values);
    const dots = a_points.length <= kMarked;
    const shown_a = dots
      ? { type: "scatter", name: of_a.label, data: a_points, symbolSize: 7, itemStyle: { color: of_a.colour(dark) }, z: 4 }
      : curve(of_a.label, of_a.colour(dark), "solid", 1.5, a_points, { z: 4 });
    return [
      ...(state.hidden.has("b") ? [] : [curve(of_b.label, of_b.colour(dark), "solid", 1.8, points(b_values))]),
      ...(state.hidden.has("a") ? [] : [shown_a]),
      disagreement(axis, whole_min, dark),
    ];
  };

  const lower = (state: State): Record<string, unknown>[] => {
    const { dark, width_px } = state.look;
    const points = decimated(time_min, difference, state.window, width_px);
    const around_zero = points.map(([x]): Uncertain => {
      const sigma_there = sigma[first_at(time_min, x)] ?? null;
      return [x, 0, sigma_there === null ? null : 2 * sigma_there];
    });
    const dashed = curve(of_difference.label, of_difference.colour(dark), "dashed", 1.6, points, {
      ...(points.length <= kMarked ? { showSymbol: true, symbol: "circle", symbolSize: 5 } : {}),
      z: 3,
    });
    const drawn = [
      ...(state.hidden.has("sigma") || !has_sigma ? [] : [{ ...sigma_band(around_zero, band_of_sigma.colour(dark)), name: band_of_sigma.label }]),
      ...(state.hidden.has("difference") ? [] : [dashed]),
      disagreement(axis, whole_min, dark),
    ];
    return drawn.map((one) => ({ ...one, xAxisIndex: 1, yAxisIndex: 1 }));
  };

  const draw: Picture["draw"] = (state) => {
    const top = top_px(
      state.look,
      toggles.filter((one) => !state.hidden.has(one.key)).map((one) => one.label),
    );
    const below_px = Math.round((state.look.height_px - top) * 0.36);
    const time = time_axis(state.look, state.window ?? whole_min);
    const grid = { left: kLeft_px, right: kRight_px, outerBoundsMode: "none" };
    const upper_time = { ...time, name: "", axisLabel: { show: false }, axisTick: { show: false } };
    return {
      ...base(state.look),
      legend: legend(state, toggles),
      grid: [
        { ...grid, top, bottom: below_px + 18 },
        { ...grid, height: below_px - 46, bottom: 46 },
      ],
      axisPointer: { link: [{ xAxisIndex: "all" }] },
      tooltip: { ...tooltip(state.look), trigger: "axis", formatter: reading_in(written) },
      xAxis: [upper_time, { ...time, gridIndex: 1 }],
      yAxis: [
        value_axis(state.look, t.model_in_unit({ name: quantity, unit: written })),
        { ...value_axis(state.look, t.comparison_difference_axis({ unit: written })), gridIndex: 1, splitNumber: 3 },
      ],
      series: [...upper(state), ...lower(state)],
    };
  };

  return {
    name: `comparison-${slug(name)}`,
    title: t.comparison_title({ quantity }),
    caption: verdict(axis),
    about: [
      t.comparison_above,
      has_sigma ? t.comparison_below_sigma : t.comparison_below,
      ...(axis.deviation ? [t.comparison_shaded] : []),
    ].join(" "),
    height_px: 440,
    zoom: "time",
    toggles: () => toggles,
    draw,
    numbers: () =>
      columns_of({ time_min, [`a_${unit}`]: a_values, [`b_${unit}`]: b_values, [`difference_${unit}`]: difference, [`sigma_${unit}`]: sigma }),
  };
};

const verdict = (axis: ComparedAxis): string => {
  if (axis.agreement === "cannot tell") return t.comparison_cannot_tell;
  const within = { within: String(axis["within_2_sigma"]), samples: String(axis["samples"]) };
  return axis.agreement === "agrees" ? t.comparison_agree(within) : t.comparison_disagree(within);
};
