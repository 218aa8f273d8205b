// Columns that a model may explain.
import type { Report } from "../report";

const axis = /^(.*)_(um|urad|mm)$/;

// Those of a drift, or the measured columns of a series; the one that moves most first.
export const targets_in = (report: Report): string[] => {
  const ranges = new Map<string, number>();
  const hold = (name: string, values: readonly (number | null)[]): void => {
    const known = values.filter((value): value is number => value !== null);
    if (known.length < 2) return;
    let [least, largest] = [Infinity, -Infinity];
    for (const value of known) {
      least = Math.min(least, value);
      largest = Math.max(largest, value);
    }
    ranges.set(name, largest - least);
  };
  for (const name of Object.keys(report.drift?.points[0] ?? {})) {
    if (axis.test(name) && !/sigma|correction|change|shift/.test(name)) hold(name, report.drift?.points.map((point) => point[name] ?? null) ?? []);
  }
  if (ranges.size === 0) {
    for (const { columns } of report.signals) {
      for (const { name, role, values } of columns) if (role === "measured" && axis.test(name)) hold(name, values);
    }
  }
  return [...ranges].sort(([, a], [, b]) => b - a).map(([name]) => name);
};
