// The errors of both tests, one a line: before and after with their sigma, and the way between.
import { axis, base, colours, curve_colour, decimals_for, legend, toggle, tooltip, with_sigma } from "../drawing/theme";
import type { CustomSeriesRenderItemAPI } from "echarts";
import { columns_of_rows, grid_below } from "../drawing/parts";
import type { Choice, Picture, State, Toggle } from "../picture";
import type { ComparedTests, Num, QuantityDifference } from "../report";
import { is_told, quantity_name } from "./quantities";
import { pair_choice } from "./traces_picture";
import { plain, unit_shown } from "../drawing/text";
import { t } from "../texts/texts";

type Api = Pick<CustomSeriesRenderItemAPI, "coord" | "value">;

export const kSizes_picture = "change-sizes";

const kRow_px = 30;
const kName_px = 170;
const kNarrow_name_px = 110;

const has_both = ({ before, after }: QuantityDifference): boolean => before !== null && after !== null;
const drawn_of = ({ quantities }: ComparedTests): QuantityDifference[] => quantities.filter((one) => is_told(one) && has_both(one));
const units_of = (pairs: readonly ComparedTests[]): string[] => [...new Set(pairs.flatMap((pair) => drawn_of(pair).map(({ unit }) => unit)))];

const toggles = (): Toggle[] => [toggle("before", t.change_before, 1, "dot"), toggle("after", t.change_after, 0, "dot")];

const unit_choice = (units: readonly string[]): Choice[] =>
  units.length < 2 ? [] : [{ key: "unit", label: t.unit, values: units.map((value) => ({ value, label: unit_shown(value) })), initial: units[0] ?? "" }];

// Sigma as a bar along x, with the point on it.
const points = (rows: readonly QuantityDifference[], when: "before" | "after", name: string, color: string): Record<string, unknown> => ({
  type: "custom",
  name,
  color,
  data: rows.map((row, k) => [row[when], k, row[`${when}_sigma`] ?? 0]),
  encode: { x: 0, y: 1 },
  z: 3,
  renderItem: (_: unknown, api: Api) => {
    const [value, k, sigma] = [Number(api.value(0)), Number(api.value(1)), Number(api.value(2))];
    const [x = 0, y = 0] = api.coord([value, k]);
    const [from = x] = api.coord([value - sigma, k]);
    const [to = x] = api.coord([value + sigma, k]);
    return {
      type: "group",
      children: [
        { type: "line", shape: { x1: from, y1: y, x2: to, y2: y }, style: { stroke: color, lineWidth: 2 } },
        { type: "circle", shape: { cx: x, cy: y, r: 5 }, style: { fill: color } },
      ],
    };
  },
});

// Dashed where it is not clear.
const ways = (rows: readonly QuantityDifference[], colour: string): Record<string, unknown> => ({
  type: "custom",
  name: "",
  silent: true,
  tooltip: { show: false },
  data: rows.map((row, k) => [row.before, k, row.after]),
  encode: { x: [0, 2], y: 1 },
  z: 2,
  renderItem: (_: unknown, api: Api) => {
    const k = Number(api.value(1));
    const [x1 = 0, y = 0] = api.coord([api.value(0), k]);
    const [x2 = 0] = api.coord([api.value(2), k]);
    const lineDash = rows[k]?.clear === true ? null : [3, 3];
    return { type: "line", shape: { x1, y1: y, x2, y2: y }, style: { stroke: colour, lineWidth: 1.5, lineDash } };
  },
});

export const sizes_picture = (pairs: readonly ComparedTests[]): Picture => {
  const units = units_of(pairs);
  const pair_of = (chosen: State["chosen"]): ComparedTests | undefined => pairs[Number(chosen["pair"] ?? 0)] ?? pairs[0];
  const rows_of = (chosen: State["chosen"]): QuantityDifference[] => {
    const pair = pair_of(chosen);
    return pair ? drawn_of(pair).filter(({ unit }) => unit === (chosen["unit"] ?? units[0])) : [];
  };
  const most = Math.max(1, ...pairs.flatMap((pair) => units.map((unit) => drawn_of(pair).filter((one) => one.unit === unit).length)));
  return {
    name: kSizes_picture,
    title: t.change_sizes_title,
    caption: t.change_sizes_caption,
    about: t.change_sizes_about,
    height_px: 110 + kRow_px * Math.max(3, most),
    rows_of_text: true,
    zoom: "none",
    choices: [...pair_choice(pairs), ...unit_choice(units)],
    toggles,
    draw: (state) => {
      const { look, hidden } = state;
      const rows = rows_of(state.chosen);
      const plane = pair_of(state.chosen)?.before.plane ?? "";
      const unit = unit_shown(rows[0]?.unit ?? "");
      const shown_toggles = toggles();
      const c = colours(look.dark);
      const name_px = look.width_px < 480 ? kNarrow_name_px : kName_px;
      const line_of = (label: string, value: Num, sigma: Num): string => `${label}   ${with_sigma(value, sigma, Math.min(3, decimals_for(value, sigma)))} ${unit}`;
      return {
        ...base(look),
        legend: legend(state, shown_toggles),
        tooltip: {
          ...tooltip(look),
          trigger: "item",
          formatter: ({ dataIndex }: { dataIndex: number }) => {
            const row = rows[dataIndex];
            if (!row) return "";
            return [
              quantity_name(row.name, plane),
              line_of(t.change_before, row.before, row.before_sigma),
              line_of(t.change_after, row.after, row.after_sigma),
              line_of(t.change_difference, row.difference, row.sigma),
            ].join("\n");
          },
        },
        grid: { ...grid_below(look, shown_toggles), left: name_px + 12, right: 24 },
        xAxis: axis(look, unit, "x"),
        yAxis: {
          type: "category",
          inverse: true,
          data: rows.map((_, k) => String(k)),
          axisLine: { lineStyle: { color: c.faint } },
          axisTick: { show: false },
          axisLabel: {
            color: c.ink,
            interval: 0,
            width: name_px,
            overflow: "truncate",
            formatter: (_: string, k: number) => plain(quantity_name(rows[k]?.name ?? "", plane), 60),
          },
          splitLine: { show: true, lineStyle: { color: c.grid } },
        },
        series: [
          ...(hidden.has("before") || hidden.has("after") ? [] : [ways(rows, c.faint)]),
          ...(hidden.has("before") ? [] : [points(rows, "before", t.change_before, curve_colour(1, look.dark))]),
          ...(hidden.has("after") ? [] : [points(rows, "after", t.change_after, curve_colour(0, look.dark))]),
        ],
      };
    },
    numbers: ({ chosen }) =>
      columns_of_rows(rows_of(chosen), {
        row: (_, k) => k + 1,
        error: ({ name }) => name,
        unit: ({ unit }) => unit,
        before: ({ before }) => before,
        before_sigma: ({ before_sigma }) => before_sigma,
        after: ({ after }) => after,
        after_sigma: ({ after_sigma }) => after_sigma,
        difference: ({ difference }) => difference,
        difference_sigma: ({ sigma }) => sigma,
        clear: ({ clear }) => (clear === null ? null : Number(clear)),
      }),
  };
};
