// One axis of a comparison: above both series, below their difference with twice its standard deviation.
import { curve, sigma_band, type Uncertain } from "../drawing/curve";
import { decimated, first_at } from "../drawing/columns";
import { place_of } from "../drift/drift_axes";
import type { Picture, Range, State, Toggle } from "../picture";
import { kLeft_px, kRight_px, time_axis, top_px, value_axis } from "../drawing/axes";
import { reading_in } from "../drawing/hover";
import type { ComparedAxis, Num } from "../report";
import { plain, slug, unit_shown, words } from "../drawing/text";
import { base, colours, legend, minutes, toggle, tooltip } from "../drawing/theme";
import { t } from "../texts/texts";

const kHeight_px = 440;
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

const band = (points: readonly Uncertain[], { colour, label }: Toggle, dark: boolean): Record<string, unknown> => ({
  ...sigma_band(points, colour(dark)),
  name: label,
});

// The stretch with the largest difference beyond two standard deviations, in both plots.
const disagreement = (axis: ComparedAxis, whole_min: Range, dark: boolean): Record<string, unknown> => {
  if (!axis.deviation) return {};
  const least = (whole_min[1] - whole_min[0]) * 0.004; // a single sample is seen too
  const from = minutes(axis.deviation.from_s) - least;
  const to = minutes(axis.deviation.to_s) + least;
  const color = dark ? "rgba(255,120,80,0.16)" : "rgba(213,60,0,0.10)";
  return { markArea: { silent: true, itemStyle: { color }, data: [[{ xAxis: from }, { xAxis: to }]] } };
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
  const toggles: Toggle[] = [
    toggle("a", t.comparison_curve({ which: "A", name: plain(a, 60) }), place, "dot"),
    toggle("b", t.comparison_curve({ which: "B", name: plain(b, 60) }), place + 3, "line"),
    toggle("difference", t.comparison_a_less_b, place, "dashed"),
    ...(has_sigma ? [band_of_sigma] : []),
  ];

  const upper = (state: State): Record<string, unknown>[] => {
    const { dark, width_px } = state.look;
    const [of_a, of_b] = [toggles[0] as Toggle, toggles[1] as Toggle];
    const points = (values: readonly Num[]): [number, Num][] => decimated(time_min, values, state.window, width_px);
    const a_points = points(a_values);
    const dots = a_points.length <= kMarked;
    const shown_a = dots
      ? {
          type: "scatter",
          name: of_a.label,
          data: a_points,
          symbolSize: 7,
          itemStyle: { color: of_a.colour(dark) },
          z: 4,
        }
      : curve(of_a.label, of_a.colour(dark), "solid", 1.5, a_points, { z: 4 });
    return [
      ...(state.hidden.has("b") ? [] : [curve(of_b.label, of_b.colour(dark), "solid", 1.8, points(b_values))]),
      ...(state.hidden.has("a") ? [] : [shown_a]),
      { type: "line", name: "", data: [], ...disagreement(axis, whole_min, dark) },
    ];
  };

  const lower = (state: State): Record<string, unknown>[] => {
    const { dark, width_px } = state.look;
    const line = toggles[2] as Toggle;
    const points = decimated(time_min, difference, state.window, width_px);
    const sigma_at = (x: number): Num => sigma[first_at(time_min, x)] ?? null;
    const around_zero: Uncertain[] = points.map(([x]) => [x, 0, twice(sigma_at(x))]);
    const dashed = curve(line.label, line.colour(dark), "dashed", 1.6, points, {
      ...(points.length <= kMarked ? { showSymbol: true, symbol: "circle", symbolSize: 5 } : {}),
      z: 3,
    });
    const drawn = [
      ...(state.hidden.has("sigma") || !has_sigma ? [] : [band(around_zero, band_of_sigma, dark)]),
      ...(state.hidden.has("difference") ? [] : [dashed]),
      { type: "line", name: "", data: [], ...disagreement(axis, whole_min, dark) },
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
    height_px: kHeight_px,
    zoom: "time",
    toggles: () => toggles,
    draw,
    numbers: () => ({
      columns: [
        { name: "time_min", values: time_min },
        { name: `a_${unit}`, values: a_values },
        { name: `b_${unit}`, values: b_values },
        { name: `difference_${unit}`, values: difference },
        { name: `sigma_${unit}`, values: sigma },
      ],
    }),
  };
};

const twice = (value: Num): Num => (value === null ? null : 2 * value);

const verdict = (axis: ComparedAxis): string => {
  if (axis.agreement === "cannot tell") return t.comparison_cannot_tell;
  const within = { within: String(axis["within_2_sigma"]), samples: String(axis["samples"]) };
  return axis.agreement === "agrees" ? t.comparison_agree(within) : t.comparison_disagree(within);
};
