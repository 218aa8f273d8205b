// What each effect adds to a model, ready to be stacked: of a drift counted from its start, where every effect is taken
// as zero; of a recording from the nominal circle.
import type { Checked, Num } from "../report";
import type { Strand } from "../drawing/strands";
import { plain } from "../drawing/text";
import { curve_colour } from "../drawing/theme";
import { t } from "../texts/texts";

export interface Part {
  key: string;
  name: string; // in a file
  label: string;
  values_um: readonly Num[]; // at the strand's rows
  colour: (dark: boolean) => string;
}

export interface Stack {
  strand: Strand;
  parts: Part[];
  model_um: Num[];
}

const kUnseen_um = 1e-6; // a part that never differs more from zero is none

export const largest_of = (values: readonly Num[]): number =>
  values.reduce((largest: number, value) => Math.max(largest, Math.abs(value ?? 0)), 0);

const colour_of =
  (k: number) =>
  (dark: boolean): string =>
    curve_colour([2, 3, 4, 5, 6, 7, 0][k % 7] ?? 2, dark);

const labels_once = (labels: readonly string[]): string[] =>
  labels.map((label, k) => (labels.indexOf(label) === k ? label : `${label} (${k + 1})`));

export const stack_of = (checked: Checked, strand: Strand): Stack => {
  const { series } = checked;
  const from_start = checked.level === "series";
  const counted = (values: readonly Num[]): Num[] => {
    const at_rows = strand.rows.map((row) => values[row] ?? null);
    const start = from_start ? (at_rows.find((value) => value !== null) ?? 0) : 0;
    return at_rows.map((value) => (value === null ? null : value - start));
  };
  const model_um = counted(series.predicted_um);
  const columns = series.contributions.map(({ values_um }) => counted(values_um));
  // What is in the model and in no effect: a constant.
  const rest = model_um.map((model, i): Num => {
    if (model === null) return null;
    const sum = columns.reduce((total, column) => total + (column[i] ?? 0), 0);
    return Math.abs(model - sum) < 1e-4 * Math.max(1, Math.abs(model)) ? 0 : model - sum;
  });
  const labels = labels_once(series.contributions.map(({ effect }) => plain(effect, 60)));
  const parts = [...columns, rest].map((values_um, k): Part => ({
    key: `part${k}`,
    name: labels[k] ?? "constant",
    label: labels[k] ?? t.model_constant,
    values_um,
    colour: colour_of(k),
  }));
  return { strand, parts: parts.filter((part) => largest_of(part.values_um) > kUnseen_um), model_um };
};
