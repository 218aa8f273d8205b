// What was measured, what the model says, and below what is left: over time, or for recordings over the angle.
import { curve, type Dash, type Point } from "../drawing/curve";
import { decimated, first_at } from "../drawing/columns";
import { curves_base } from "../drawing/hover";
import type { Picture, State, Toggle } from "../picture";
import { chosen_strands, recording_choice } from "../recordings/recording_groups";
import type { Checked, Num, Report } from "../report";
import { started_of } from "../report";
import { place_text, points_of, type Strand, strand_numbers } from "../drawing/strands";
import { colours, curve_colour, minutes, regime_colour, toggle } from "../drawing/theme";
import { in_time, time_limits, two_grids, whole_of, x_axis } from "../drawing/axes";
import { angle_limits } from "../recordings/unrolled_picture";
import { named, t } from "../texts/texts";
import { plain } from "../drawing/text";

const kMost_bars = 400; // error bars drawn, beyond them they are a blur

const toggles_of = (checked: Checked, ways: readonly Way[]): Toggle[] => [
  ...ways.map(({ suffix, measured }) => toggle(`measured${suffix}`, `${t.measured}${suffix}`, measured, "dot")),
  toggle("model", t.model, 1, "line"),
  ...ways.map(({ suffix, residual, dash }) =>
    toggle(`residual${suffix}`, `${t.residual}${suffix}`, residual, dash === "solid" ? "line" : "dashed"),
  ),
  ...(checked.floor_um === null ? [] : [toggle("floor", t.model_floor_band, (dark) => colours(dark).faint, "dashed")]),
  ...regime_toggles(checked.series.regimes),
];

// Bars as one line with gaps.
const error_bars = (strand: Strand, checked: Checked, window: State["window"]): Point[] => {
  const { measured_um, sigma_um } = checked.series;
  const from = window ? first_at(strand.x, window[0]) : 0;
  const to = window ? first_at(strand.x, window[1]) : strand.x.length;
  if (!sigma_um || to - from > kMost_bars) return [];
  return strand.rows.slice(from, to).flatMap((row, k) => {
    const [value, sigma, x] = [measured_um[row], sigma_um[row], strand.x[from + k] ?? NaN];
    if (typeof value !== "number" || typeof sigma !== "number") return [];
    return [
      [x, value - sigma],
      [x, value + sigma],
      [x, null],
    ];
  });
};

const dot_px = (points: number): number => (points <= 60 ? 8 : points <= 400 ? 5 : points <= 1500 ? 3.5 : 2.5);

const line_at = (y: number, dash: string, colour: string, text: string): Record<string, unknown> => ({
  yAxis: y,
  lineStyle: { color: colour, type: dash, width: 1 },
  label: { show: text !== "", position: "insideEndTop", formatter: text, color: colour, fontSize: 11 },
});

export const model_fit_picture = (
  report: Report,
  checked: Checked,
  strands: readonly Strand[],
  name: string,
): Picture => {
  const over_angle = checked.level === "recording";
  const { series } = checked;
  const curve_min = checked.curve?.time_s.map(minutes);

  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const shown_strands = chosen_strands(strands, state.chosen);
    const c = colours(look.dark);
    const colour = (k: number): string => curve_colour(k, look.dark);
    const all = over_angle ? angle_limits(shown_strands.flatMap((strand) => strand.x)) : time_limits(shown_strands[0]?.x ?? []);
    const common = x_axis(look, over_angle ? t.angle_axis : t.time_axis, window, all);
    const x = over_angle ? common : in_time(common, look, window ?? whole_of(all));
    const grids = two_grids(look, x, t.deviation_axis, t.residual_axis);
    const width = grids.width_px / Math.max(1, shown_strands.length);
    const below = { xAxisIndex: 1, yAxisIndex: 1 };
    const drawn: Record<string, unknown>[] = [];
    const ways = ways_of(checked, shown_strands);
    for (const way of ways) {
      // The rows of a drift are in order as they are; there may be very many.
      const points = (values: readonly Num[]): [number, Num][] =>
        over_angle
          ? points_of(way.strands, values, window, width)
          : decimated(strands[0]?.x ?? [], values, window, width);
      const measured = points(series.measured_um);
      const few = measured.length <= 200;
      if (!hidden.has(`measured${way.suffix}`)) {
        drawn.push({
          type: "scatter",
          name: `${t.measured}${way.suffix}`,
          data: measured,
          symbol: way.symbol,
          symbolSize: dot_px(measured.length),
          itemStyle: { color: colour(way.measured), opacity: measured.length > 1500 ? 0.6 : 0.9 },
          emphasis: { disabled: true },
          z: few ? 5 : 3,
        });
        const bars = way.strands.flatMap((strand) => error_bars(strand, checked, window));
        const quiet = { silent: true, z: 2, tooltip: { show: false } };
        if (bars.length > 0) drawn.push(curve(t.model_error_bars, colour(way.measured), "solid", 1.2, bars, quiet));
      }
      if (!hidden.has("model")) {
        const between = checked.curve && curve_min ? decimated(curve_min, checked.curve.predicted_um, window, width) : null;
        const hover_name = `${t.model}${way.suffix}`;
        drawn.push(curve(t.model, colour(1), "solid", 2, between ?? points(series.predicted_um), { z: 4, hover_name }));
      }
      if (!hidden.has(`residual${way.suffix}`)) {
        const more = { ...below, z: 3, ...(few ? { showSymbol: true, symbol: "diamond", symbolSize: 6 } : {}) };
        drawn.push(curve(`${t.residual}${way.suffix}`, colour(way.residual), way.dash, few ? 1.2 : 1, points(series.residual_um), more));
      }
    }
    const floor = hidden.has("floor") ? null : checked.floor_um;
    const marks = [
      line_at(0, "solid", c.faint, ""),
      ...(floor === null ? [] : [line_at(floor, "dashed", c.ink, t.floor), line_at(-floor, "dashed", c.ink, "")]),
    ];
    // Its points, which are not drawn, keep the floor within the axis.
    const start = window?.[0] ?? shown_strands[0]?.x[0] ?? 0;
    const reach = floor === null ? [] : [-floor, floor].map((end): Point => [start, end]);
    const lines = curve(t.model_floor_band, c.faint, "dashed", 0, reach, {
      ...below,
      silent: true,
      tooltip: { show: false },
      markLine: { silent: true, symbol: "none", data: marks },
    });
    return {
      ...curves_base(state, toggles_of(checked, ways), { drawn, head: place_text(checked, 2, started_of(report)), unit: "µm" }),
      ...grids.drawn,
      series: [...regime_bands(series.regimes, hidden, look.dark), lines, ...drawn],
    };
  };

  return {
    name,
    title: t.model_fit_title,
    caption: t.model_fit_caption,
    about: [
      ...(series.sigma_um ? [t.model_fit_bars] : []),
      t.model_fit_floor,
      ...(series.regimes.length > 0 ? [t.model_fit_regimes] : []),
    ].join(" "),
    height_px: 500,
    zoom: over_angle ? "own" : "time",
    choices: recording_choice(report, strands, true),
    toggles: ({ chosen }) => toggles_of(checked, ways_of(checked, chosen_strands(strands, chosen))),
    draw,
    numbers: ({ chosen }) =>
      strand_numbers(checked, chosen_strands(strands, chosen), [
        { name: "measured_um", values: series.measured_um },
        ...(series.sigma_um ? [{ name: "sigma_um", values: series.sigma_um }] : []),
        { name: "model_um", values: series.predicted_um },
        { name: "residual_um", values: series.residual_um },
      ]),
  };
};

// Regimes of the speed as shades behind curves over time.

type Regimes = Checked["series"]["regimes"];

const regime_names = (regimes: Regimes): string[] => [...new Set(regimes.map(({ regime }) => regime))];

// A small mark in a legend needs more than a shade.
const stronger = (regime: string, dark: boolean, alpha: number): string =>
  regime_colour(regime, dark).replace(/[\d.]+\)$/, `${alpha})`);

const regime_toggles = (regimes: Regimes): Toggle[] =>
  regime_names(regimes).map((regime) =>
    toggle(`regime ${regime}`, plain(named(t.regimes, regime), 40), (dark) => stronger(regime, dark, 1), "band"),
  );

// One series a regime, in each grid; without points, so that only its shade is seen.
const regime_bands = (regimes: Regimes, hidden: ReadonlySet<string>, dark: boolean): Record<string, unknown>[] =>
  regime_names(regimes)
    .filter((regime) => !hidden.has(`regime ${regime}`))
    .flatMap((regime) =>
      [0, 1].map((grid) => ({
        type: "line",
        name: plain(named(t.regimes, regime), 40),
        data: [],
        silent: true,
        xAxisIndex: grid,
        yAxisIndex: grid,
        itemStyle: { color: stronger(regime, dark, 0.4) },
        markArea: {
          silent: true,
          itemStyle: { color: regime_colour(regime, dark) },
          data: regimes
            .filter((one) => one.regime === regime)
            .map((one) => [{ xAxis: minutes(one.from_s) }, { xAxis: minutes(one.to_s) }]),
        },
      })),
    );

// The directions of checked recordings, each with a look of its own.

// Strands that look the same: all of a drift, or those of one direction.
interface Way {
  suffix: string; // of names and keys
  strands: Strand[];
  measured: number; // colour
  residual: number;
  symbol: string;
  dash: Dash;
}

const ways_of = (checked: Checked, strands: readonly Strand[]): Way[] => {
  const direction = checked.series.inputs.find((column) => column.name === "direction")?.values ?? [];
  const clockwise = (strand: Strand): boolean => (direction[strand.rows[0] ?? 0] ?? 1) < 0;
  const one = { suffix: "", measured: 0, residual: 2, symbol: "circle", dash: "solid" as const };
  if (!strands.some(clockwise) || strands.every(clockwise)) return [{ ...one, strands: [...strands] }];
  return [
    { ...one, suffix: ", CCW", strands: strands.filter((strand) => !clockwise(strand)) },
    { suffix: ", CW", measured: 4, residual: 3, symbol: "triangle", dash: [7, 2], strands: strands.filter(clockwise) },
  ];
};
