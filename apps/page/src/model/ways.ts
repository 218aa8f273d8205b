// The directions of checked recordings, each with a look of its own.
import type { Dash } from "../drawing/curve";
import type { Checked } from "../report";
import type { Strand } from "../drawing/strands";

// Strands that look the same: all of a drift, or those of one direction.
export interface Way {
  suffix: string; // of names and keys
  strands: Strand[];
  measured: number; // colour
  residual: number;
  symbol: string;
  dash: Dash;
}

export const ways_of = (checked: Checked, strands: readonly Strand[]): Way[] => {
  const direction = checked.series.inputs.find((column) => column.name === "direction")?.values ?? [];
  const clockwise = (strand: Strand): boolean => (direction[strand.rows[0] ?? 0] ?? 1) < 0;
  const one = { suffix: "", measured: 0, residual: 2, symbol: "circle", dash: "solid" as const };
  if (!strands.some(clockwise) || strands.every(clockwise)) return [{ ...one, strands: [...strands] }];
  return [
    { ...one, suffix: ", CCW", strands: strands.filter((strand) => !clockwise(strand)) },
    { suffix: ", CW", measured: 4, residual: 3, symbol: "triangle", dash: [7, 2], strands: strands.filter(clockwise) },
  ];
};
