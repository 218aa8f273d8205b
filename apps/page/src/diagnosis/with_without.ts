// What was measured, the model as it is and with what it lacks; below, what either leaves. It proves the verdict.
import { difference, sum } from "../drawing/columns";
import { curve, zero_series } from "../drawing/curve";
import { curves_base } from "../drawing/hover";
import type { Picture, State, Toggle } from "../picture";
import { best_set, set_name } from "./ranking";
import { chosen_strands, recording_choice } from "../recordings/recording_groups";
import type { Checked, Diagnosed, Num, Report } from "../report";
import { started_of } from "../report";
import { place_text, points_of, strand_numbers, strands_of } from "../drawing/strands";
import { plain } from "../drawing/text";
import { shown, toggle } from "../drawing/theme";
import { time_axis, two_grids, whole_min, x_axis } from "../drawing/axes";
import { angle_limits } from "../recordings/unrolled_picture";
import { t } from "../texts/texts";

type Series = Record<string, unknown>;

// "with lagged_expansion(T_room_degC)"
const set_text = (found: Diagnosed): string => {
  const labels = best_set(found).map(({ label }) => plain(label, 44));
  const [a = "", b = ""] = labels;
  const set =
    labels.length > 2 ? t.diagnosis_effects({ n: labels.length }) : labels.length === 2 ? t.a_and_b({ a, b }) : a;
  if (set_name(found) !== "best") return t.diagnosis_with_not_accepted({ set });
  return found.verdict === "equivalent" ? t.diagnosis_with_one_of_several({ set }) : t.diagnosis_with({ set });
};

const with_rmse = (curve: string, rmse_um: Num): string =>
  rmse_um === null ? curve : t.diagnosis_with_rmse({ curve, rmse: shown(rmse_um, 3) });

export const with_without_picture = (report: Report, checked: Checked, found: Diagnosed, name: string): Picture => {
  const over_angle = checked.level === "recording";
  const strands = strands_of(checked);
  const { measured_um, predicted_um, residual_um } = checked.series;
  const best = best_set(found);
  const with_um = best.length > 0 ? sum([predicted_um, found.refit_um, ...best.map(({ curve_um }) => curve_um)]) : null;
  const left_um = with_um ? difference(measured_um, with_um) : null;
  const toggles: Toggle[] = [
    toggle("measured", t.measured, 0, "dot"),
    toggle("without", with_rmse(t.model, found.rmse_um), 1, with_um ? "dashed" : "line"),
    ...(with_um ? [toggle("with", with_rmse(set_text(found), found.rmse_after_um), 2, "line")] : []),
  ];

  const draw = (state: State): Series => {
    const { look, window, hidden } = state;
    const drawn_strands = chosen_strands(strands, state.chosen);
    const x = over_angle
      ? x_axis(look, t.angle_axis, window, angle_limits(drawn_strands.flatMap((strand) => strand.x)))
      : time_axis(look, window ?? whole_min(strands.map((strand) => strand.x)));
    const grids = two_grids(look, x, t.deviation_axis, t.residual_axis, 0.4);
    const points = (values: readonly Num[]): [number, Num][] =>
      points_of(drawn_strands, values, window, grids.width_px / Math.max(1, drawn_strands.length));
    const below = { xAxisIndex: 1, yAxisIndex: 1 };
    const lines = (toggle: Toggle | undefined, values: readonly Num[], left: readonly Num[], z: number): Series[] => {
      if (!toggle || hidden.has(toggle.key)) return [];
      const colour = toggle.colour(look.dark);
      const dash = toggle.mark === "dashed" ? "dashed" : "solid";
      return [
        curve(toggle.label, colour, dash, 2, points(values), { z }),
        curve(toggle.label, colour, dash, 1.3, points(left), { ...below, z, hover_name: t.diagnosis_left({ curve: toggle.label }) }),
      ];
    };
    const dots = points(measured_um);
    const [measured, without, with_set] = toggles;
    const drawn: Series[] = [
      ...(measured && !hidden.has(measured.key)
        ? [
            {
              type: "scatter",
              name: measured.label,
              data: dots,
              symbolSize: dots.length <= 60 ? 8 : dots.length <= 400 ? 5 : 3,
              itemStyle: { color: measured.colour(look.dark), opacity: dots.length > 400 ? 0.6 : 0.9 },
              emphasis: { disabled: true },
              z: 2,
            },
          ]
        : []),
      ...lines(without, predicted_um, residual_um, 3),
      ...(with_um && left_um ? lines(with_set, with_um, left_um, 4) : []),
    ];
    return {
      ...curves_base(state, toggles, { drawn, head: place_text(checked, 1, started_of(report)), unit: "µm" }),
      ...grids.drawn,
      series: [zero_series(look, below), ...drawn],
    };
  };

  return {
    name,
    title: with_um ? t.diagnosis_with_without_title : t.diagnosis_measured_title,
    caption: with_um ? t.diagnosis_with_without_caption : t.diagnosis_measured_caption,
    about: with_um ? t.diagnosis_with_without_about : t.diagnosis_measured_about,
    height_px: 440,
    zoom: over_angle ? "own" : "time",
    choices: recording_choice(report, strands, true),
    toggles: () => toggles,
    draw,
    numbers: ({ chosen }) =>
      strand_numbers(checked, chosen_strands(strands, chosen), [
        { name: "measured_um", values: measured_um },
        { name: "model_um", values: predicted_um },
        { name: "residual_um", values: residual_um },
        ...(with_um ? [{ name: "with_um", values: with_um }] : []),
        ...(left_um ? [{ name: "residual_with_um", values: left_um }] : []),
      ]),
  };
};
