// Parts that pictures have in common: the edges of a plot, the columns of their numbers.
import { kBottom_px, kLeft_px, kRight_px, top_px } from "./axes";
import type { Look, Numbers } from "../picture";

// Between the edges that pictures over time have, below a legend of these labels.
export const grid_below = (look: Look, labels: readonly { label: string }[]): Record<string, unknown> => ({
  left: kLeft_px,
  right: kRight_px,
  top: top_px(look, labels.map(({ label }) => label)),
  bottom: kBottom_px,
});

// The same with room for a legend of any length; `more_px` above it.
export const grid_of = (look: Look, more_px = 0): Record<string, unknown> => ({
  left: kLeft_px,
  right: kRight_px,
  top: (look.still ? 64 : 14) + more_px,
  bottom: 48,
});

type Values = Numbers["columns"][number]["values"];

// Columns by name; what is not there is none.
export const columns_of = (columns: Readonly<Record<string, Values | null | undefined>>): Numbers => ({
  columns: Object.entries(columns).flatMap(([name, values]) => (values ? [{ name, values }] : [])),
});

type Cell = Values[number];

// Columns of what each row has.
export const columns_of_rows = <Row>(rows: readonly Row[], cells: Readonly<Record<string, (row: Row, k: number) => Cell>>): Numbers => ({
  columns: Object.entries(cells).map(([name, cell]) => ({ name, values: rows.map(cell) })),
});
