// Columns on several clocks, brought onto one: at a time that a clock does not have, its columns have no value.
import type { Numbers } from "../picture";
import type { Num } from "../report";

export interface Timed {
  name: string;
  time_min: readonly number[]; // rises
  values: readonly Num[];
}

const union_of = (clocks: readonly (readonly number[])[]): readonly number[] => {
  if (clocks.length === 1) return clocks[0] as readonly number[];
  const all = Float64Array.from(clocks.flatMap((clock) => [...clock])).sort();
  return Array.from(all.filter((time, k) => k === 0 || time !== all[k - 1]));
};

const spread = (timed: Timed, clock: readonly number[]): readonly Num[] => {
  if (timed.time_min === clock) return timed.values;
  let next = 0;
  return clock.map((time) => {
    while (next < timed.time_min.length && (timed.time_min[next] as number) < time) next += 1;
    return timed.time_min[next] === time ? (timed.values[next] ?? null) : null;
  });
};

export const on_one_clock = (columns: readonly Timed[]): Numbers => {
  const clock = union_of([...new Set(columns.map((column) => column.time_min))]);
  return {
    columns: [
      { name: "time_min", values: clock },
      ...columns.map((column) => ({ name: column.name, values: spread(column, clock) })),
    ],
  };
};
