// Of a ledger that knows forecasts, over its revisions: the error on the rows that were fitted, and of rows forecast
// from earlier ones alone.
import { curve, type Dash, type Point } from "../drawing/curve";
import { curves_base } from "../drawing/hover";
import { x_axis } from "../drawing/axes";
import { grid_below } from "../drawing/parts";
import { plain } from "../drawing/text";
import { axis, toggle } from "../drawing/theme";
import { revision_before } from "./steps";
import type { Picture, State, Toggle } from "../picture";
import type { LedgerPart, LedgerRow, Num } from "../report";
import { named, t } from "../texts/texts";

interface Figure extends Toggle {
  key: "rmse_um" | "forecast_um";
  dash: Dash;
  symbol: string;
}
const figure = (key: Figure["key"], label: string, k: number, mark: "line" | "dotted", symbol: string): Figure => ({
  ...toggle(key, label, k, mark),
  key,
  dash: mark === "line" ? "solid" : mark,
  symbol,
});

const known = (row: LedgerRow, key: Figure["key"] | "discrepancy_um"): Num => row[key] ?? null;

export const has_forecasts = (rows: readonly LedgerRow[]): boolean => rows.some((row) => known(row, "forecast_um") !== null);

export const forecast_curves = (ledger: LedgerPart, target: string, name: string): Picture => {
  const rows = ledger.rows.filter((row) => row.target === target);
  const both = [
    figure("rmse_um", t.diagnosis_rows_fitted, 0, "dotted", "circle"),
    figure("forecast_um", t.diagnosis_forecasts_curve, 2, "line", "diamond"),
  ];
  const figures = both.filter(({ key }) => rows.some((row) => known(row, key) !== null));
  const revisions = rows.map(({ revision }) => revision);
  // A gap where the data change: the errors before and after cannot be compared.
  const points = (key: Figure["key"]): Point[] =>
    ledger.rows.flatMap((row, at): Point[] => {
      if (row.target !== target) return [];
      const point: Point = [row.revision, known(row, key)];
      return revision_before(ledger.rows, at) ? [point] : [[row.revision - 0.5, null], point];
    });
  const head = (revision: number): string => {
    const row = rows.find((one) => one.revision === revision);
    return row ? `${row.revision} ${plain(row.change, 60)}, ${plain(named(t.verdicts, row.verdict), 30)}` : "";
  };
  const draw = (state: State): Record<string, unknown> => {
    const { look, window, hidden } = state;
    const drawn = figures
      .filter(({ key }) => !hidden.has(key))
      .map(({ key, label, colour, dash, symbol }) =>
        curve(label, colour(look.dark), dash, 2, points(key), { showSymbol: true, symbol, symbolSize: 9, z: 4 }),
      );
    return {
      ...curves_base(state, figures, { drawn, head, unit: "µm" }),
      grid: grid_below(look, figures),
      xAxis: {
        ...x_axis(look, t.diagnosis_revision, window, { min: Math.min(...revisions) - 0.5, max: Math.max(...revisions) + 0.5 }),
        minInterval: 1,
      },
      yAxis: { ...axis(look, t.diagnosis_rmse, "y"), min: 0 },
      series: drawn,
    };
  };
  return {
    name,
    title: t.diagnosis_forecasts_title({ target: plain(target, 60) }),
    caption: t.diagnosis_honest,
    height_px: 340,
    zoom: "none",
    toggles: () => figures,
    draw,
    numbers: () => ({
      columns: [
        { name: "revision", values: revisions },
        { name: "what", values: rows.map(({ change }) => change) },
        { name: "verdict", values: rows.map(({ verdict }) => verdict) },
        ...[...figures.map(({ key }) => key), "discrepancy_um" as const].map((key) => ({
          name: key,
          values: rows.map((row) => known(row, key)),
        })),
      ],
    }),
  };
};
