// One quantity over the tests of a group: its values with sigma, the trend with its own, the tolerance.
import { curve, lines_across, sigma_band, sigma_bars, type Uncertain } from "../drawing/curve";
import { curves_base } from "../drawing/hover";
import type { Numbers, Picture, State, Toggle } from "../picture";
import { x_axis } from "../drawing/axes";
import { columns_of, grid_below } from "../drawing/parts";
import type { HistoryGroup, HistoryQuantity, Num } from "../report";
import { plain, unit_shown } from "../drawing/text";
import { axis, colours, shown, toggle } from "../drawing/theme";
import { t } from "../texts/texts";
import { typed_name } from "../machine_errors/error_names";

type Series = Record<string, unknown>;

const uncertain = (year: readonly number[], values: readonly Num[], sigmas: readonly Num[]): Uncertain[] =>
  year.map((at, i) => [at, values[i] ?? null, sigmas[i] ?? null]);

// "2025-07-02" of 2025.5.
const date_of = (year: number): string => {
  const whole = Math.floor(year);
  const [from, to] = [Date.UTC(whole, 0), Date.UTC(whole + 1, 0)];
  const date = new Date(from + (year - whole) * (to - from));
  return Number.isNaN(date.getTime()) ? shown(year, 2) : date.toISOString().slice(0, 10); // of years that no calendar has
};

// None where they are at no place.
const lines_at = (at: readonly ({ xAxis: number } | { yAxis: number })[], formatter: string, type: "solid" | "dashed", color: string): Series[] =>
  at.length === 0 ? [] : [lines_across(at, { position: "insideEndTop", formatter }, { color, type, width: 1.4 })];

// A limit far from all values would press them flat: then it is not drawn.
const limits_near = ({ lower, upper, values, trend }: HistoryQuantity): number[] => {
  const all = [...values, ...(trend?.values ?? [])].filter((value): value is number => value !== null);
  if (all.length === 0) return [];
  const [least, most] = [Math.min(...all), Math.max(...all)];
  const reach = Math.max(most - least, 0.5 * Math.abs(least), 0.5 * Math.abs(most));
  return [lower, upper].filter(
    (limit): limit is number => limit !== undefined && limit > least - reach && limit < most + reach,
  );
};

const ends_of = ({ year, trend }: HistoryQuantity): Record<string, unknown> => {
  const all = [...year, ...(trend?.year ?? [])];
  const [from, to] = [Math.min(...all), Math.max(...all)];
  const room = Math.max(0.05 * (to - from), 0.02);
  return { min: from - room, max: to + room };
};

// What a picture shows: `name` of it, `caption` and `about` below, `trend`: what its curve is called.
export interface Shown {
  name: string;
  trend: string;
  caption: string;
  about: string;
}

export const history_picture = (
  group: Pick<HistoryGroup, "label" | "first" | "quantities">,
  shown: Shown,
  name_of: (quantity: string) => string = (quantity) => typed_name(quantity, 120),
): Picture => {
  const { quantities } = group;
  const { trend: called, ...head } = shown;
  const kTests = toggle("tests", t.history_tests, 0, "dot");
  const kTrend = toggle("trend", called, 1, "line");
  const chosen_of = ({ chosen }: Pick<State, "chosen">): HistoryQuantity =>
    quantities.find(({ name }) => name === chosen["quantity"]) ?? (quantities[0] as HistoryQuantity);
  const toggles = (state: Pick<State, "chosen">): Toggle[] => (chosen_of(state).trend ? [kTests, kTrend] : [kTests]);

  const draw = (state: State): Series => {
    const { look, window, hidden } = state;
    const quantity = chosen_of(state);
    const { year, values, sigmas, trend, unit, marks: years = [] } = quantity;
    const [of_tests, of_trend] = [kTests.colour(look.dark), kTrend.colour(look.dark)];
    const drawn = [
      ...(trend && !hidden.has(kTrend.key)
        ? [curve(kTrend.label, of_trend, "solid", 1.6, trend.year.map((at, i) => [at, trend.values[i] ?? null]))]
        : []),
      ...(hidden.has(kTests.key)
        ? []
        : [
            curve(kTests.label, of_tests, "dotted", 1, year.map((at, i) => [at, values[i] ?? null]), {
              showSymbol: true,
              symbol: "circle",
              symbolSize: 7,
              z: 4,
            }),
          ]),
    ];
    const marks = [
      ...(trend && !hidden.has(kTrend.key) ? [sigma_band(uncertain(trend.year, trend.values, trend.sigmas), of_trend)] : []),
      ...(hidden.has(kTests.key) ? [] : [sigma_bars(uncertain(year, values, sigmas), of_tests)]),
    ];
    const limits = limits_near(quantity);
    const { ink } = colours(look.dark);
    const x = x_axis(look, t.history_date, window, ends_of(quantity));
    return {
      ...curves_base(state, toggles(state), { drawn, head: date_of, unit: unit_shown(unit) }),
      grid: grid_below(look, toggles(state)),
      // "2025-07" at its ticks.
      xAxis: { ...x, axisLabel: { ...(x["axisLabel"] as object), formatter: (at: number) => date_of(at).slice(0, 7) } },
      yAxis: {
        ...axis(look, t.model_in_unit({ name: plain(name_of(quantity.name), 60), unit: unit_shown(unit) }), "y"),
        min: ({ min }: { min: number }) => (limits.some((limit) => limit < min) ? Math.min(...limits) * 1.05 : null),
        max: ({ max }: { max: number }) => (limits.some((limit) => limit > max) ? Math.max(...limits) * 1.05 : null),
      },
      series: [
        ...marks,
        ...drawn,
        ...lines_at(limits.map((limit) => ({ yAxis: limit })), t.history_tolerance, "solid", ink),
        ...lines_at(years.map((at) => ({ xAxis: at })), t.fleet_step, "dashed", ink), // between which tests it steps
      ],
    };
  };

  const numbers = (state: State): Numbers => {
    const { year, values, sigmas, trend } = chosen_of(state);
    const all = [...year, ...(trend?.year ?? [])];
    const pad = (column: readonly Num[] | undefined, before: number): Num[] =>
      all.map((_, i) => column?.[i - before] ?? null);
    return columns_of({
      year: all,
      value: pad(values, 0),
      sigma: pad(sigmas, 0),
      trend: pad(trend?.values, year.length),
      trend_sigma: pad(trend?.sigmas, year.length),
    });
  };

  return {
    ...head,
    title: plain(group.label, 80),
    height_px: 360,
    zoom: "own",
    choices: [
      {
        key: "quantity",
        label: t.history_quantity,
        values: quantities.map(({ name }) => ({ value: name, label: name_of(name) })),
        initial: group.first,
      },
    ],
    toggles,
    draw,
    numbers,
  };
};
