// What was measured, what the model says, and below what is left: over time, or for recordings over the angle.
import { curve, type Point } from "../drawing/curve";
import { decimated, first_at } from "../drawing/decimate";
import { hover_text } from "../drawing/hover";
import type { Numbers, Picture, State, Toggle } from "../picture";
import { chosen_strands, recording_choice } from "../recordings/recording_names";
import { regime_bands, regime_toggles } from "./regime_bands";
import type { Checked, Num, Report } from "../report";
import { points_of, type Strand } from "../drawing/strands";
import { base, colours, curve_colour, legend, minutes, shown, tooltip } from "../drawing/theme";
import { time_limits, two_grids, x_axis } from "../drawing/two_grids";
import { angle_limits } from "../recordings/unrolled_picture";
import { ways_of, type Way } from "./ways";
import { t } from "../texts/texts";

const kMost_bars = 400; // error bars drawn, beyond them they are a blur

const toggles_of = (checked: Checked, ways: readonly Way[]): Toggle[] => [
  ...ways.map(({ suffix, measured }): Toggle => ({
    key: `measured${suffix}`,
    label: `${t.measured}${suffix}`,
    colour: (dark) => curve_colour(measured, dark),
    mark: "dot",
    on: true,
  })),
  { key: "model", label: t.model, colour: (dark) => curve_colour(1, dark), mark: "line", on: true },
  ...ways.map(({ suffix, residual, dash }): Toggle => ({
    key: `residual${suffix}`,
    label: `${t.residual}${suffix}`,
    colour: (dark) => curve_colour(residual, dark),
    mark: dash === "solid" ? "line" : "dashed",
    on: true,
  })),
  ...(checked.floor_um === null
    ? []
    : [
        {
          key: "floor",
          label: t.model_floor_band,
          colour: (dark: boolean) => colours(dark).faint,
          mark: "dashed",
          on: true,
        } as const,
      ]),
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
    const seen = chosen_strands(strands, state.chosen);
    const c = colours(look.dark);
    const colour = (k: number): string => curve_colour(k, look.dark);
    const all = over_angle ? angle_limits(seen.flatMap((strand) => strand.x)) : time_limits(seen[0]?.x ?? []);
    const grids = two_grids(
      look,
      x_axis(look, over_angle ? t.angle_axis : t.time_axis, window, all),
      t.deviation_axis,
      t.residual_axis,
    );
    const width = grids.width_px / Math.max(1, seen.length);
    const below = { xAxisIndex: 1, yAxisIndex: 1 };
    const drawn: Record<string, unknown>[] = [];
    const ways = ways_of(checked, seen);
    for (const way of ways) {
      // The rows of a drift are in order as they are; there may be very many.
      const points = (values: readonly Num[]): [number, Num][] =>
        over_angle
          ? points_of(way.strands, values, window, width)
          : decimated(strands[0]?.x ?? [], values, window, width);
      const measured = points(series.measured_um);
      const few = measured.length <= 200;
      if (!hidden.has(`measured${way.suffix}`)) {
        const itemStyle = { color: colour(way.measured), opacity: measured.length > 1500 ? 0.6 : 0.9 };
        const look_of = {
          symbol: way.symbol,
          symbolSize: dot_px(measured.length),
          itemStyle,
          emphasis: { disabled: true },
          z: few ? 5 : 3,
        };
        drawn.push({ type: "scatter", name: `${t.measured}${way.suffix}`, data: measured, ...look_of });
        const bars = way.strands.flatMap((strand) => error_bars(strand, checked, window));
        if (bars.length > 0)
          drawn.push(
            curve(t.model_error_bars, colour(way.measured), "solid", 1.2, bars, {
              silent: true,
              z: 2,
              tooltip: { show: false },
            }),
          );
      }
      if (!hidden.has("model")) {
        const between =
          checked.curve && curve_min ? decimated(curve_min, checked.curve.predicted_um, window, width) : null;
        drawn.push(
          curve(t.model, colour(1), "solid", 2, between ?? points(series.predicted_um), {
            z: 4,
            hover_name: `${t.model}${way.suffix}`,
          }),
        );
      }
      if (!hidden.has(`residual${way.suffix}`)) {
        const marks = few ? { showSymbol: true, symbol: "diamond", symbolSize: 6 } : {};
        drawn.push(
          curve(`${t.residual}${way.suffix}`, colour(way.residual), way.dash, few ? 1.2 : 1, points(series.residual_um), {
            ...below,
            z: 3,
            ...marks,
          }),
        );
      }
    }
    const floor = hidden.has("floor") ? null : checked.floor_um;
    const marks = [
      line_at(0, "solid", c.faint, ""),
      ...(floor === null ? [] : [line_at(floor, "dashed", c.ink, t.model_floor), line_at(-floor, "dashed", c.ink, "")]),
    ];
    // Its points, which are not drawn, keep the floor within the axis.
    const start = window?.[0] ?? seen[0]?.x[0] ?? 0;
    const reach: Point[] =
      floor === null
        ? []
        : [
            [start, -floor],
            [start, floor],
          ];
    const lines = curve(t.model_floor_band, c.faint, "dashed", 0, reach, {
      ...below,
      silent: true,
      tooltip: { show: false },
      markLine: { silent: true, symbol: "none", data: marks },
    });
    return {
      ...base(look),
      ...grids.drawn,
      legend: legend(state, toggles_of(checked, ways)),
      tooltip: {
        ...tooltip(look),
        trigger: "axis",
        formatter: hover_text({
          drawn,
          x: 0,
          y: 1,
          head: (at) => (over_angle ? `${shown(at, 2)}°` : `${shown(at, 2)} min`),
          unit: "µm",
        }),
      },
      series: [...regime_bands(series.regimes, hidden, look.dark, 2), lines, ...drawn],
    };
  };

  const numbers = (state: State): Numbers => {
    const seen = chosen_strands(strands, state.chosen);
    const one = seen.length === 1 && seen[0]?.rows.length === series.time_s.length && !over_angle;
    const rows = one ? [] : seen.flatMap((strand) => strand.rows);
    const column = (values: readonly Num[]): readonly Num[] => (one ? values : rows.map((i) => values[i] ?? null));
    return {
      columns: [
        {
          name: over_angle ? "angle_deg" : "time_min",
          values: one ? (seen[0]?.x ?? []) : seen.flatMap((strand) => strand.x),
        },
        ...(over_angle
          ? [{ name: "recording", values: seen.flatMap(({ rows: of, recording }) => of.map(() => recording)) }]
          : []),
        { name: "measured_um", values: column(series.measured_um) },
        ...(series.sigma_um ? [{ name: "sigma_um", values: column(series.sigma_um) }] : []),
        { name: "model_um", values: column(series.predicted_um) },
        { name: "residual_um", values: column(series.residual_um) },
      ],
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
    numbers,
  };
};
