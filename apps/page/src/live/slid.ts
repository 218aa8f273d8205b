// A fitted model with changed gains: their curves are scaled, which is exact because the model is linear in them. The
// program computes changes of shapes, such as a time constant.
import type { Catalogue } from "./catalogue";
import type { Setting } from "./runs";
import type { Checked, Num, Parameter } from "../report";

export const kConstant = "constant_um";

export const key_of = ({ effect, name }: Pick<Parameter, "effect" | "name">): string => `${effect ?? ""}\n${name}`;

// Of the effect's own curve: it scales with this value alone.
export type Gains = ReadonlySet<string>; // by key_of

const part_of = (checked: Checked, effect: string | undefined): readonly Num[] | undefined => {
  const found = checked.series.contributions.filter((one) => one.effect === effect);
  return found.length === 1 ? found[0]?.values_um : undefined;
};

export const is_scaled = (checked: Checked, one: Parameter, gains: Gains): boolean => {
  if (one.name === kConstant) return checked.level === "series";
  return (
    gains.has(key_of(one)) &&
    one.value !== null &&
    one.value !== 0 &&
    checked.parameters.filter((other) => other.effect === one.effect && gains.has(key_of(other))).length === 1 &&
    part_of(checked, one.effect) !== undefined
  );
};

const kRun = "run"; // the number of a run, which nobody fits

// With a slider. Circles of recordings are fitted to what is left in any case.
export const free_parameters = ({ level, parameters }: Checked, catalogue: Catalogue): Parameter[] =>
  parameters.filter(({ value, effect, name }) => value !== null && name !== kRun && (level === "series" || catalogue.parameter(effect ?? "", name)));

export const gains_of = ({ parameters }: Checked, catalogue: Catalogue): Gains =>
  new Set(parameters.filter(({ effect, name }) => name === kConstant || catalogue.parameter(effect ?? "", name)?.kind === "gain").map(key_of));

// All of them, where one whose curve does not scale is away from its fit. `values` by key_of.
export const settings_of = (checked: Checked, free: readonly Parameter[], values: ReadonlyMap<string, number>, gains: Gains): Setting[] => {
  const value_of = (one: Parameter): number => values.get(key_of(one)) ?? one.value ?? 0;
  if (!free.some((one) => value_of(one) !== one.value && !is_scaled(checked, one, gains))) return [];
  // One stays free, for a fit has to have something to fit; its curve is then scaled as well.
  const fitted = free.find((one) => one.state !== "held" && is_scaled(checked, one, gains));
  return free.filter((one) => one !== fitted).map((one) => ({ effect: one.effect ?? "", parameter: one.name, value: value_of(one) }));
};

export const rmse_of = (residual_um: readonly Num[]): number => {
  let sum = 0;
  let n = 0;
  for (const value of residual_um) {
    if (value === null) continue;
    sum += value * value;
    ++n;
  }
  return n > 0 ? Math.sqrt(sum / n) : NaN;
};

// `values` by key_of; those of `base` are its parameters.
export const slid = (base: Checked, values: ReadonlyMap<string, number>, gains: Gains): Checked => {
  const scaled = base.parameters.filter((one) => {
    const value = values.get(key_of(one));
    return value !== undefined && value !== one.value && is_scaled(base, one, gains);
  });
  if (scaled.length === 0) return base;
  const { series } = base;
  const added = new Float64Array(series.predicted_um.length);
  let contributions = series.contributions;
  for (const one of scaled) {
    const value = values.get(key_of(one)) ?? 0;
    if (one.name === kConstant) {
      for (let i = 0; i < added.length; ++i) added[i] = (added[i] ?? 0) + value - (one.value ?? 0);
      continue;
    }
    const part = part_of(base, one.effect) ?? [];
    const by = value / (one.value ?? 1);
    for (let i = 0; i < added.length; ++i) added[i] = (added[i] ?? 0) + (by - 1) * (part[i] ?? 0);
    const scaled_part = part.map((at) => (at === null ? null : by * at));
    contributions = contributions.map((old) => (old.effect === one.effect ? { ...old, values_um: scaled_part } : old));
  }
  const less = (sign: number) => (value: Num, i: number): Num => (value === null ? null : value + sign * (added[i] ?? 0));
  const residual_um = series.residual_um.map(less(-1));
  return {
    ...base,
    parameters: base.parameters.map((one) => (scaled.includes(one) ? { ...one, value: values.get(key_of(one)) ?? null } : one)),
    rmse_um: rmse_of(residual_um),
    series: { ...series, contributions, predicted_um: series.predicted_um.map(less(1)), residual_um },
    curve: undefined, // between the rows the effects are not known one by one
  };
};
