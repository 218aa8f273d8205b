// What the model leaves, and over it what each candidate would add. The best set is drawn, where something was found; any
// one candidate is chosen beside it, by its row in the table or from the list. Where it is a set by itself it shows what
// would be left with it taken off.
import { curves_base } from "../drawing/hover";
import type { Picture, State, Toggle } from "../picture";
import { time_axis, whole_min, x_axis } from "../drawing/axes";
import { grid_below } from "../drawing/parts";
import { type Ranked, ranked_candidates, set_name, type SetName } from "./ranking";
import { chosen_strands, recording_choice } from "../recordings/recording_groups";
import type { Checked, Diagnosed, Num, Report } from "../report";
import { started_of } from "../report";
import { place_text, points_of, strand_numbers, strands_of } from "../drawing/strands";
import { plain } from "../drawing/text";
import { axis, colours, dashes, shown, toggle } from "../drawing/theme";
import { t } from "../texts/texts";
import { difference, sum } from "../drawing/columns";
import { curve, type Dash } from "../drawing/curve";

export const candidates_picture = (
  report: Report,
  checked: Checked,
  found: Diagnosed,
  name: string,
): Picture => {
  const over_angle = checked.level === "recording";
  const strands = strands_of(checked);
  const { refit_um } = found;
  const all = ranked_candidates(found);
  const best = all.filter((one) => one.drawn);
  const named = set_name(found) ?? "best";
  const fixed = [residual_curve(checked.series.residual_um, best.length > 0), ...best_curves(best, refit_um, named)];
  const curves = (chosen: State["chosen"]): Curve[] => {
    const one = all.find((ranked) => ranked.key === chosen["candidate"]);
    return one ? [...fixed, ...chosen_curves(one, checked.series.residual_um, refit_um)] : fixed;
  };
  const whole = over_angle ? null : whole_min(strands.map((strand) => strand.x));
  const angles = strands.flatMap((strand) => [strand.x[0] ?? 0, strand.x.at(-1) ?? 0]);
  const turn = { min: 10 * Math.floor(Math.min(...angles) / 10), max: 10 * Math.ceil(Math.max(...angles) / 10) };
  const draw = (state: State): Record<string, unknown> => {
    const { look, window, chosen, hidden } = state;
    const shown_strands = chosen_strands(strands, chosen);
    const drawn = curves(chosen).filter((one) => !hidden.has(one.toggle.key));
    const series = drawn.map(({ toggle: { label, colour }, values_um, dash, width_px, more }) =>
      curve(label, colour(look.dark), dash, width_px, points_of(shown_strands, values_um, window, look.width_px), more?.(colour(look.dark))),
    );
    // Of recordings drawn together the nearest point is read, whichever it belongs to.
    const several = over_angle && shown_strands.length > 1;
    const head = several ? (at: number) => t.diagnosis_one_of_recordings({ at: shown(at, 1) }) : place_text(checked, 1, started_of(report));
    return {
      ...curves_base(state, curves(chosen).map((one) => one.toggle), { drawn: series, head, unit: "µm" }),
      grid: grid_below(look, drawn.map((one) => one.toggle)),
      xAxis: whole ? time_axis(look, window ?? whole) : x_axis(look, t.angle_axis, window, turn),
      yAxis: axis(look, t.deviation_axis, "y"),
      series,
    };
  };

  const of_set = named === "best" ? t.diagnosis_candidates_best : t.diagnosis_candidates_closest;
  const drawn_set = best.length > 0 ? of_set : t.diagnosis_candidates_none;
  const one_chosen = all.some((one) => one.alone) ? t.diagnosis_candidates_chosen_alone : t.diagnosis_candidates_chosen;
  const list = all.map(({ key, name: label }) => ({ value: key, label }));
  return {
    name,
    title: t.diagnosis_candidates_title,
    caption: best.length > 0 ? t.diagnosis_candidates_caption : t.diagnosis_candidates_caption_none,
    about: `${drawn_set} ${one_chosen}`,
    height_px: 400,
    zoom: over_angle ? "own" : "time",
    choices: [
      ...(list.length > 0
        ? [{ key: "candidate", label: t.diagnosis_candidate, values: [{ value: "", label: t.none }, ...list], initial: "" }]
        : []),
      ...recording_choice(report, strands, true),
    ],
    toggles: ({ chosen }) => curves(chosen).map((one) => one.toggle),
    draw,
    numbers: ({ chosen }) =>
      strand_numbers(checked, chosen_strands(strands, chosen), [
        { name: "residual_um", values: checked.series.residual_um },
        ...all.map(({ candidate: { label, curve_um } }) => ({ name: `${plain(label, 60)}_um`, values: curve_um })),
      ]),
  };
};

// The curves of the picture of candidates: the residual, the best set, and the candidate that is chosen.

interface Curve {
  toggle: Toggle;
  values_um: readonly Num[];
  dash: Dash;
  width_px: number;
  more?: (colour: string) => Record<string, unknown>;
}

// As a marker pen draws: below the other curves.
const highlighted = (color: string): Record<string, unknown> => ({ z: 1, lineStyle: { color, width: 8, opacity: 0.4, cap: "round" } });

// Faint below the curve of a set; where there is none, it is what is looked at.
const residual_curve = (residual_um: readonly Num[], below: boolean): Curve => ({
  toggle: toggle("residual", t.residual, below ? (dark) => colours(dark).faint : 1, "line"),
  values_um: residual_um,
  dash: "solid",
  width_px: 1,
});

// Of the k-th effect of a set; the solid line is that of all together.
const dash_of = (k: number): Dash => dashes[1 + (k % (dashes.length - 1))] ?? "dashed";

// The set that is drawn, by the name that it may have: where it has several effects their sum, which is what stands for
// the residual, and each of them. What the model gives way by counts once, with the set.
const best_curves = (best: readonly Ranked[], refit_um: readonly Num[], named: SetName): Curve[] => {
  const strong = (label: string, values_um: readonly Num[]): Curve => ({
    toggle: toggle("best", label, 1, "line"),
    values_um,
    dash: "solid",
    width_px: 2.2,
  });
  const [only, ...others] = best;
  if (!only) return [];
  if (others.length === 0) {
    const label = named === "best" ? only.name : t.diagnosis_only({ effect: only.name, set: t.diagnosis_closest_set_label });
    return [strong(label, sum([only.candidate.curve_um, refit_um]))];
  }
  const each = best.map(
    (one, k): Curve => ({
      toggle: toggle(`best-${one.key}`, one.name, k + 2, dash_of(k) === "dotted" ? "dotted" : "dashed"),
      values_um: one.candidate.curve_um,
      dash: dash_of(k),
      width_px: 1.4,
    }),
  );
  const label = named === "best" ? t.diagnosis_best_set_together : t.diagnosis_closest_set_label;
  return [strong(label, sum([refit_um, ...best.map((one) => one.candidate.curve_um)])), ...each];
};

// What is left without it is known only where it was fitted alone: in a set, its amplitude goes with the others.
const chosen_curves = (one: Ranked, residual_um: readonly Num[], refit_um: readonly Num[]): Curve[] => {
  const with_refit = sum([one.candidate.curve_um, refit_um]);
  const marked = toggle("chosen", t.diagnosis_chosen({ effect: one.name }), 0, "band");
  const without = toggle("without", t.diagnosis_left_without, 0, "dotted");
  const left: Curve = { toggle: without, values_um: difference(residual_um, with_refit), dash: "dotted", width_px: 1.1 };
  return [{ toggle: marked, values_um: with_refit, dash: "solid", width_px: 8, more: highlighted }, ...(one.alone ? [left] : [])];
};
