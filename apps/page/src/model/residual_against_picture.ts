// What a residual can be drawn against: the time, every column of the data that varies, and what the model says.
import { worst_first } from "./model_tables";
import type { Checked, Num, Report } from "../report";
import { plain, split_name, unit_shown, words } from "../drawing/text";
import { axis, base, colours, legend, minutes, shown, toggle, tooltip } from "../drawing/theme";
import { t } from "../texts/texts";
import { extent, kFewest_in_bin, type Quartiles, running_quartiles, subsampled_rows } from "../drawing/columns";
import { curve, zero_series } from "../drawing/curve";
import { type Kinds, kinds_of } from "./kinds";
import { grid_of } from "../drawing/parts";
import type { Picture, State, Toggle } from "../picture";
import { chosen_strands, recording_choice } from "../recordings/recording_groups";
import type { Strand } from "../drawing/strands";
import { x_axis } from "../drawing/axes";

interface AgainstAxis {
  value: string; // of the choice
  label: string;
  column: string; // name, as in the numbers
  name: string; // of the axis, with its unit
  unit: string;
  values: readonly Num[];
}

const varies = (values: readonly Num[]): boolean => {
  const first = values.find((value) => value !== null);
  return values.some((value) => value !== null && value !== first);
};

const axes_of = (checked: Checked): AgainstAxis[] => {
  const { series } = checked;
  const in_s = checked.level === "recording";
  const time = in_s ? series.time_s : series.time_s.map(minutes);
  const unit = in_s ? "s" : "min";
  const columns = series.inputs
    .filter((column) => varies(column.values))
    .map((column, k): AgainstAxis => {
      const { quantity } = split_name(column.name);
      const written = unit_shown(plain(column.unit, 16));
      const name = plain(words(quantity), 60);
      return {
        value: `input${k}`,
        label: name,
        column: column.name,
        name: written ? t.model_in_unit({ name, unit: written }) : name,
        unit: written,
        values: column.values,
      };
    });
  return [
    { value: "time", label: t.model_time, column: "time", name: t.model_time_in({ unit }), unit, values: time },
    ...columns,
    { value: "model", label: t.model_says, column: "model_um", name: t.model_axis, unit: "µm", values: series.predicted_um },
  ];
};

// At first the axis along which the model fails most.
export const against_choice = (checked: Checked): { values: AgainstAxis[]; initial: string } => {
  const values = axes_of(checked);
  const worst = worst_first(checked.where).map(({ what }) =>
    values.find(({ column, value }) => column === what && value !== "time"),
  );
  const usual = values.find(({ column }) => column === "angle_deg") ?? values.find(({ unit }) => unit === "°C");
  return { values, initial: (worst.find((one) => one) ?? usual ?? values[0])?.value ?? "time" };
};

// What the model leaves against anything that the data have: a trend says that the model lacks it, or has it wrong; two
// branches, heating and cooling, say that it comes or goes at another pace.

const kMost_points = 4000;
const kMost_of_trend = 50000;
const drawn_of = (rows: number): string =>
  rows > kMost_of_trend
    ? t.model_against_many_of_trend({ rows, points: kMost_points, trend: kMost_of_trend })
    : t.model_against_many({ rows, points: kMost_points });
const kBins = 12;
const kBins_of_a_turn = 36;
const kFewest_bins = 3; // that make a trend

// Few values, as a speed has: marks that would hide each other stand side by side, by kind and then by row.
const kFew_values = 12;
const few_values = (values: readonly Num[], rows: readonly number[]): boolean => {
  const different = new Set<Num>();
  for (const row of rows) if (different.add(values[row] ?? null).size > kFew_values) return false;
  return rows.length > 2 * different.size;
};
const offset_px = (row: number, kind: number, kinds: number): [number, number] => [
  14 * (kind - (kinds - 1) / 2) + ((row * 7919) % 11) - 5,
  0,
];

// So that no mark is cut in half at the edge.
const room_around = (rows: readonly number[], values: readonly Num[]): Record<string, unknown> => {
  const [least, largest] = extent([rows.map((row) => values[row])]);
  const room = 0.04 * (largest - least);
  return room > 0 && Number.isFinite(room) ? { min: least - room, max: largest + room } : {};
};

export const residual_against_picture = (
  report: Report,
  checked: Checked,
  strands: readonly Strand[],
  name: string,
): Picture => {
  const { series } = checked;
  const { values: axes, initial } = against_choice(checked);
  const all_rows = series.time_s.length;
  const many = all_rows > kMost_points;
  const axis_of = (chosen: State["chosen"]): AgainstAxis =>
    axes.find(({ value }) => value === chosen["against"]) ?? (axes[0] as AgainstAxis);
  const known = new Map<string, Kinds>();
  const kinds_for = (against: AgainstAxis): Kinds => {
    const kinds = known.get(against.value) ?? kinds_of(checked, against.unit === "°C" ? against.values : null);
    known.set(against.value, kinds);
    return kinds;
  };
  const enough_for_trend = series.time_s.length >= kFewest_bins * kFewest_in_bin;
  const trend = toggle("trend", t.model_trend, (dark) => colours(dark).ink, "line");
  const toggles = (chosen: State["chosen"]): Toggle[] => [
    ...kinds_for(axis_of(chosen)).kinds.map(({ key, name, colour }) => toggle(key, name(), colour, "dot")),
    ...(enough_for_trend ? [trend] : []),
  ];
  const rows_of = ({ chosen, window }: Pick<State, "chosen" | "window">, x: readonly Num[]): number[] => {
    const rows: number[] = [];
    for (const strand of chosen_strands(strands, chosen)) {
      for (const row of strand.rows) {
        const at = x[row] ?? null;
        if (at === null || (series.residual_um[row] ?? null) === null) continue;
        if (!window || (at >= window[0] && at <= window[1])) rows.push(row);
      }
    }
    return rows;
  };

  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const against = axis_of(state.chosen);
    const rows = rows_of(state, against.values);
    const { kinds, of_row } = kinds_for(against);
    const c = colours(look.dark);
    const drawn = subsampled_rows(rows, series.residual_um, kMost_points);
    const side_by_side = few_values(against.values, drawn);
    const size = drawn.length <= 60 ? 10 : drawn.length <= 400 ? 7 : 5;
    const clouds = kinds.flatMap((kind, k) =>
      hidden.has(kind.key)
        ? []
        : [
            {
              type: "scatter",
              name: kind.name(),
              symbol: kind.symbol,
              symbolRotate: kind.rotate,
              symbolSize: size,
              itemStyle: { color: kind.colour(look.dark), opacity: drawn.length > 800 ? 0.45 : 0.8 },
              emphasis: { disabled: true },
              data: drawn
                .filter((row) => of_row[row] === k)
                .map((row) => {
                  const value = [against.values[row] ?? null, series.residual_um[row] ?? null, row];
                  return side_by_side ? { value, symbolOffset: offset_px(row, k, kinds.length) } : value;
                }),
              z: 2,
            },
          ],
    );
    // Quantiles of so many do not change visibly with more.
    const every = Math.max(1, Math.ceil(rows.length / kMost_of_trend));
    const evenly = every === 1 ? rows : rows.filter((_, i) => i % every === 0);
    // Play and lag have opposite signs in the two directions, so each has a trend of its own.
    const trend_of = (places: readonly number[], key: string, colour: string): Record<string, unknown>[] => {
      const kept = evenly.filter((row) => places.includes(of_row[row] ?? 0));
      const bins = running_quartiles(
        kept.map((row) => against.values[row] ?? NaN),
        kept.map((row) => series.residual_um[row] ?? NaN),
        against.unit === "°" ? kBins_of_a_turn : kBins,
      );
      if (bins.length < kFewest_bins) return [];
      const stacked = { stack: `quartiles ${key}`, stackStrategy: "all", z: 3 };
      const line = (name: string, width_px: number, y: (bin: Quartiles) => number, more: Record<string, unknown>) =>
        curve(name, colour, "solid", width_px, bins.map((bin) => [bin.x, y(bin)]), { silent: true, tooltip: { show: false }, ...more });
      return [
        line(t.model_lower_quartile, 0, ({ lower }) => lower, stacked),
        line(t.model_upper_quartile, 0, ({ lower, upper }) => upper - lower, { ...stacked, areaStyle: { color: colour, opacity: 0.13 } }),
        line(t.model_trend, 2.2, ({ median }) => median, { z: 4, showSymbol: true, symbol: "rect", symbolSize: 6 }),
      ];
    };
    const on = kinds.map((_, k) => k).filter((k) => !hidden.has(kinds[k]?.key ?? ""));
    const groups = checked.level === "recording" ? on.map((k) => [k]) : [on];
    const trend = hidden.has("trend") ? [] : groups.flatMap((places) => trend_of(places, places.join(), c.ink));
    const row_text = (row: number): string =>
      checked.level === "recording" ? "" : `\n${t.model_at_min({ minutes: shown(minutes(series.time_s[row] ?? 0), 1) })}`;
    return {
      ...base(look),
      grid: grid_of(look),
      xAxis: x_axis(look, against.name, window, room_around(rows, against.values)),
      yAxis: axis(look, t.residual_axis, "y"),
      legend: legend(state, toggles(state.chosen)),
      tooltip: {
        ...tooltip(look),
        trigger: "item",
        formatter: (hovered: { seriesName?: string; value?: unknown }) => {
          const [x, y, row] = Array.isArray(hovered.value) ? (hovered.value as number[]) : [];
          return `${against.name}  ${shown(x)}\n${t.residual}  ${shown(y, 3)} µm\n${hovered.seriesName ?? ""}${row_text(row ?? 0)}`;
        },
      },
      series: [zero_series(look), ...clouds, ...trend],
    };
  };

  return {
    name,
    title: t.model_against_title,
    caption: t.model_against_caption,
    about: [
      t.model_against_about,
      checked.level === "recording" ? t.model_against_directions : t.model_against_heating,
      ...(many ? [drawn_of(all_rows)] : []),
    ].join(" "),
    height_px: 440,
    zoom: "own",
    choices: [
      { key: "against", label: t.model_against, values: axes.map(({ value, label }) => ({ value, label })), initial },
      ...recording_choice(report, strands, true),
    ],
    toggles: ({ chosen }) => toggles(chosen),
    draw,
    numbers: ({ chosen }) => {
      const against = axis_of(chosen);
      const { kinds, of_row } = kinds_for(against);
      const rows = rows_of({ chosen, window: null }, against.values);
      const column = against.value === "time" ? `time_${against.unit}` : plain(against.column, 60);
      return {
        columns: [
          { name: column, values: rows.map((row) => against.values[row] ?? null) },
          { name: "residual_um", values: rows.map((row) => series.residual_um[row] ?? null) },
          { name: "kind", values: rows.map((row) => kinds[of_row[row] ?? 0]?.key ?? "") },
        ],
      };
    },
  };
};
