// What the model leaves, and over it what each candidate would add. The best set is drawn, where something was found; any
// one candidate is chosen beside it, by its row in the table or from the list. Where it is a set by itself it shows what
// would be left with it taken off.
import { curves_base } from "../drawing/hover";
import type { Numbers, Picture, State, Toggle } from "../picture";
import { kBottom_px, kLeft_px, kRight_px, time_axis, top_px, whole_min, x_axis } from "../drawing/axes";
import { type Ranked, ranked_candidates, set_name, type SetName } from "./ranking";
import { chosen_strands, recording_choice } from "../recordings/recording_groups";
import type { Checked, Diagnosed, Num, Report } from "../report";
import { place_text, points_of, type Strand, strand_numbers, strands_of } from "../drawing/strands";
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
  const ranked = ranked_candidates(found);
  const all = ranked.map((one): Shown => ({ ...one, values_um: one.candidate.curve_um }));
  const best = all.filter((one) => one.starred);
  const named = set_name(found) ?? "best";
  const fixed = [
    residual_curve(checked.series.residual_um, best.length > 0),
    ...best_curves(best, refit_um, named),
  ];
  const curves = (chosen: State["chosen"]): Curve[] => {
    const one = all.find((ranked) => ranked.key === chosen["candidate"]);
    return one ? [...fixed, ...chosen_curves(one, checked.series.residual_um, refit_um)] : fixed;
  };
  const shown_strands = (chosen: State["chosen"]): Strand[] =>
    chosen_strands(strands, chosen);

  const whole = over_angle ? null : whole_min(strands.map((strand) => strand.x));
  const angles = strands.flatMap((strand) => [strand.x[0] ?? 0, strand.x.at(-1) ?? 0]);
  const turn = { min: 10 * Math.floor(Math.min(...angles) / 10), max: 10 * Math.ceil(Math.max(...angles) / 10) };
  const x_axis_of = ({ look, window }: State): Record<string, unknown> =>
    whole ? time_axis(look, window ?? whole) : x_axis(look, t.angle_axis, window, turn);

  const draw = (state: State): Record<string, unknown> => {
    const { look, window, chosen, hidden } = state;
    const drawn = curves(chosen).filter((one) => !hidden.has(one.toggle.key));
    const series = drawn.map((one) =>
      one.series(
        one.toggle.label,
        one.toggle.colour(look.dark),
        points_of(shown_strands(chosen), one.values_um, window, look.width_px),
      ),
    );
    // Of recordings drawn together the nearest point is read, whichever it belongs to.
    const several = over_angle && shown_strands(chosen).length > 1;
    const head = several ? (at: number) => t.diagnosis_one_of_recordings({ at: shown(at, 1) }) : place_text(checked, 1);
    return {
      ...curves_base(state, curves(chosen).map((one) => one.toggle), { drawn: series, head, unit: "µm" }),
      grid: {
        left: kLeft_px,
        right: kRight_px,
        top: top_px(look, drawn.map((one) => one.toggle.label)),
        bottom: kBottom_px,
      },
      xAxis: x_axis_of(state),
      yAxis: axis(look, t.deviation_axis, "y"),
      series,
    };
  };

  const numbers = ({ chosen }: State): Numbers =>
    strand_numbers(checked, shown_strands(chosen), [
      { name: "residual_um", values: checked.series.residual_um },
      ...all.map((one) => ({ name: `${plain(one.candidate.label, 60)}_um`, values: one.values_um })),
    ]);

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
    numbers,
  };
};

// The curves of the picture of candidates: the residual, the best set, and the candidate that is chosen.

// A candidate with what it adds that the model cannot make.
export interface Shown extends Ranked {
  values_um: readonly Num[];
}

type Points = readonly [number, Num][];

export interface Curve {
  toggle: Toggle;
  values_um: readonly Num[];
  series: (name: string, colour: string, points: Points) => Record<string, unknown>; // of ECharts
}

const lined =
  (dash: Dash, width_px: number): Curve["series"] =>
  (name, colour, points) =>
    curve(name, colour, dash, width_px, points);

// As a marker pen draws: below the other curves.
const highlighted: Curve["series"] = (name, colour, points) =>
  curve(name, colour, "solid", 8, points, { z: 1, lineStyle: { color: colour, width: 8, opacity: 0.4, cap: "round" } });

// Faint below the curve of a set; where there is none, it is what is looked at.
export const residual_curve = (residual_um: readonly Num[], below: boolean): Curve => ({
  toggle: toggle("residual", t.residual, below ? (dark) => colours(dark).faint : 1, "line"),
  values_um: residual_um,
  series: lined("solid", 1),
});

// Of the k-th effect of a set; the solid line is that of all together.
const dash_of = (k: number): Dash => dashes[1 + (k % (dashes.length - 1))] ?? "dashed";

// The set that is drawn, by the name that it may have: where it has several effects their sum, which is what stands for
// the residual, and each of them. What the model gives way by counts once, with the set.
export const best_curves = (best: readonly Shown[], refit_um: readonly Num[], named: SetName): Curve[] => {
  const strong = (label: string, values_um: readonly Num[]): Curve => ({
    toggle: toggle("best", label, 1, "line"),
    values_um,
    series: lined("solid", 2.2),
  });
  const [only, ...others] = best;
  if (!only) return [];
  if (others.length === 0) {
    const label = named === "best" ? only.name : t.diagnosis_only({ effect: only.name, set: t.diagnosis_closest_set_label });
    return [strong(label, sum([only.values_um, refit_um]))];
  }
  const each = best.map(
    (one, k): Curve => ({
      toggle: toggle(`best-${one.key}`, one.name, k + 2, dash_of(k) === "dotted" ? "dotted" : "dashed"),
      values_um: one.values_um,
      series: lined(dash_of(k), 1.4),
    }),
  );
  const label = named === "best" ? t.diagnosis_best_set_together : t.diagnosis_closest_set_label;
  return [strong(label, sum([refit_um, ...best.map((one) => one.values_um)])), ...each];
};

// What is left without it is known only where it was fitted alone: in a set, its amplitude goes with the others.
export const chosen_curves = (one: Shown, residual_um: readonly Num[], refit_um: readonly Num[]): Curve[] => {
  const with_refit = sum([one.values_um, refit_um]);
  return [
    {
      toggle: toggle("chosen", t.diagnosis_chosen({ effect: one.name }), 0, "band"),
      values_um: with_refit,
      series: highlighted,
    },
    ...(one.alone
      ? [
          {
            toggle: toggle("without", t.diagnosis_left_without, 0, "dotted"),
            values_um: difference(residual_um, with_refit),
            series: lined("dotted", 1.1),
          },
        ]
      : []),
  ];
};
