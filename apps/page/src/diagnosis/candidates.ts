// What the model leaves, and over it what each candidate would add. The best set is drawn, where something was found; any
// one candidate is chosen beside it, by its row in the table or from the list. Where it is a set by itself it shows what
// would be left with it taken off.
import { best_curves, chosen_curves, residual_curve, type Curve, type Shown } from "./candidate_curves";
import { hover_text } from "../drawing/hover";
import type { Numbers, Picture, State } from "../picture";
import { kBottom_px, kLeft_px, kRight_px, top_px } from "../drawing/plot_grid";
import { ranked_candidates, set_name } from "./ranking";
import { chosen_strands, recording_choice } from "../recordings/recording_names";
import type { Checked, Diagnosed, Num, Report } from "../report";
import { points_of, strands_of, type Strand } from "../drawing/strands";
import { plain } from "../drawing/text";
import { axis, base, legend, shown, tooltip } from "../drawing/theme";
import { time_axis, whole_min } from "../drawing/time_axis";
import { x_axis } from "../drawing/two_grids";
import { t } from "../texts/texts";

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
  const seen = (chosen: State["chosen"]): Strand[] =>
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
        points_of(seen(chosen), one.values_um, window, look.width_px),
      ),
    );
    // Of recordings drawn together the nearest point is read, whichever it belongs to.
    const head = (at: number): string => {
      if (!over_angle) return `${shown(at, 1)} min`;
      return seen(chosen).length > 1 ? t.diagnosis_one_of_recordings({ at: shown(at, 1) }) : `${shown(at, 1)}°`;
    };
    return {
      ...base(look),
      grid: {
        left: kLeft_px,
        right: kRight_px,
        top: top_px(look, drawn.map((one) => one.toggle.label)),
        bottom: kBottom_px,
      },
      legend: legend(state, curves(chosen).map((one) => one.toggle)),
      tooltip: {
        ...tooltip(look),
        trigger: "axis",
        formatter: hover_text({ drawn: series, x: 0, y: 1, head, unit: "µm" }),
      },
      xAxis: x_axis_of(state),
      yAxis: axis(look, t.deviation_axis, "y"),
      series,
    };
  };

  const numbers = ({ chosen }: State): Numbers => {
    const rows = seen(chosen).flatMap((strand) => strand.rows);
    const column = (values: readonly Num[]): Num[] => rows.map((i) => values[i] ?? null);
    const recording = seen(chosen).flatMap((strand) => strand.rows.map(() => strand.recording));
    return {
      columns: [
        { name: over_angle ? "angle_deg" : "time_min", values: seen(chosen).flatMap((strand) => strand.x) },
        ...(over_angle ? [{ name: "recording", values: recording }] : []),
        { name: "residual_um", values: column(checked.series.residual_um) },
        ...all.map((one) => ({ name: `${plain(one.candidate.label, 60)}_um`, values: column(one.values_um) })),
      ],
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
    numbers,
  };
};
