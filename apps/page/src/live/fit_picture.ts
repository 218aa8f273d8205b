// Measured values, model and residual with the present values of the sliders, with the residual before the last change
// and a candidate.
import { curve } from "../drawing/curve";
import { model_fit_picture } from "../model/model_fit_picture";
import type { Stretch } from "./history_of_steps";
import { with_left_out } from "./left_out";
import type { Picture, State, Toggle } from "../picture";
import { chosen_strands } from "../recordings/recording_groups";
import type { Candidate, Checked, Num, Parameter, Report } from "../report";
import { points_of, type Strand, strands_of } from "../drawing/strands";
import { plain } from "../drawing/text";
import { colours, toggle } from "../drawing/theme";
import { t } from "../texts/texts";

export interface Now {
  report: Report;
  checked: Checked;
  before: Checked | null; // of the same rows
  candidate: Candidate | null;
  left_out: readonly Stretch[];
}

export const kFit_picture = "live-fit";

const same_rows = (a: Checked, b: Checked): boolean => a.series.time_s.length === b.series.time_s.length;

export const fit_picture = (now: () => Now): Picture => {
  let strands: { of: readonly number[]; are: Strand[] } | null = null;
  let inner: { of: Checked; is: Picture } | null = null;
  const strands_now = (): Strand[] => {
    const { checked } = now();
    if (strands?.of !== checked.series.time_s) strands = { of: checked.series.time_s, are: strands_of(checked) };
    return strands.are;
  };
  const picture = (): Picture => {
    const { report, checked } = now();
    if (inner?.of !== checked) inner = { of: checked, is: model_fit_picture(report, checked, strands_now(), kFit_picture) };
    return inner.is;
  };
  const extra = (): { toggle: Toggle; values_um: readonly Num[] }[] => {
    const { checked, before, candidate } = now();
    return [
      ...(before && same_rows(before, checked)
        ? [
            {
              toggle: toggle("before", t.live_residual_before, (dark) => colours(dark).faint, "dotted"),
              values_um: before.series.residual_um,
            },
          ]
        : []),
      ...(candidate && candidate.curve_um.length === checked.series.time_s.length
        ? [
            {
              toggle: toggle("candidate", plain(candidate.label, 60), 3, "line"),
              values_um: candidate.curve_um,
            },
          ]
        : []),
    ];
  };
  const draw = (state: State): Record<string, unknown> => {
    const drawn = picture().draw(state) as Record<string, unknown>;
    const shown_strands = chosen_strands(strands_now(), state.chosen);
    const width = state.look.width_px / Math.max(1, shown_strands.length);
    const lines = extra()
      .filter(({ toggle }) => !state.hidden.has(toggle.key))
      .map(({ toggle, values_um }) =>
        curve(toggle.label, toggle.colour(state.look.dark), toggle.key === "before" ? "dotted" : "solid", toggle.key === "before" ? 1.2 : 2.4, points_of(shown_strands, values_um, state.window, width), {
          xAxisIndex: 1,
          yAxisIndex: 1,
          z: toggle.key === "before" ? 2 : 5,
          silent: true,
          tooltip: { show: false },
        }),
      );
    const series = drawn["series"];
    const all = { ...drawn, series: [...(Array.isArray(series) ? series : []), ...lines] };
    return with_left_out(all, now().left_out, state.look.dark, state.window === null);
  };
  const { title, caption, about, zoom, choices } = picture();
  return {
    name: kFit_picture,
    title,
    caption,
    about,
    height_px: 430,
    zoom,
    choices,
    toggles: (state) => [...picture().toggles(state), ...extra().map(({ toggle }) => toggle)],
    draw,
    numbers: (state) => picture().numbers(state),
  };
};

// A fitted model with changed gains: their curves are scaled, which is exact because the model is linear in them. The
// program computes changes of shapes, such as a time constant.

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
