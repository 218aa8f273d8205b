// What the model leaves, and over it what each candidate would add. The best set is drawn; any one candidate is chosen
// beside it, by its row in the table or from the list, and shows what would be left with it taken off.
import { best_curves, chosen_curves, residual_curve, type Curve, type Shown } from "./candidate_curves";
import { hover_text } from "../drawing/hover";
import type { Choice, Numbers, Picture, State } from "../picture";
import { kBottom_px, kLeft_px, kRight_px, top_px } from "../drawing/plot_grid";
import type { Ranked } from "./ranking";
import type { Checked, Num, Report } from "../report";
import { points_of, strands_of, type Strand } from "../drawing/strands";
import { plain } from "../drawing/text";
import { axis, base, legend, shown, tooltip } from "../drawing/theme";
import { time_axis, whole_min } from "../drawing/time_axis";
import { x_axis } from "../drawing/two_grids";

const kDrawnTogether = 4; // recordings; of more, one at a time is seen at first

const recording_choice = (strands: readonly Strand[], report: Report): Choice[] => {
  if (strands.length < 2) return [];
  const circles = (report.fit?.recordings ?? []).filter(({ kind }) => kind === "circle");
  const label = (number: Num): string => plain(circles[number ?? -1]?.label ?? `recording ${number}`, 40);
  const one_each = strands.map(({ recording }) => ({ value: String(recording), label: label(recording) }));
  return [
    {
      key: "recording",
      label: "Recording",
      values: [{ value: "", label: "all of them" }, ...one_each],
      initial: strands.length > kDrawnTogether ? (one_each[0]?.value ?? "") : "",
    },
  ];
};

export const candidates_picture = (
  report: Report,
  checked: Checked,
  candidates: readonly Ranked[],
  companions: readonly Ranked[],
  refit_um: readonly Num[],
  name: string,
): Picture => {
  const over_angle = checked.level === "recording";
  const strands = strands_of(checked);
  const all = [...candidates, ...companions].map((one): Shown => ({ ...one, values_um: one.candidate.curve_um }));
  const fixed = [
    residual_curve(checked.series.residual_um),
    ...best_curves(
      all.filter((one) => one.candidate.in_best_set),
      refit_um,
    ),
  ];
  const curves = (chosen: State["chosen"]): Curve[] => {
    const one = all.find((ranked) => ranked.key === chosen["candidate"]);
    return one ? [...fixed, ...chosen_curves(one, checked.series.residual_um, refit_um)] : fixed;
  };
  const seen = (chosen: State["chosen"]): Strand[] =>
    strands.filter(({ recording }) => !chosen["recording"] || String(recording) === chosen["recording"]);

  const whole = over_angle ? null : whole_min(strands.map((strand) => strand.x));
  const angles = strands.flatMap((strand) => [strand.x[0] ?? 0, strand.x.at(-1) ?? 0]);
  const turn = { min: 10 * Math.floor(Math.min(...angles) / 10), max: 10 * Math.ceil(Math.max(...angles) / 10) };
  const x_axis_of = ({ look, window }: State): Record<string, unknown> =>
    whole ? time_axis(look, window ?? whole) : x_axis(look, "angle, °", window, turn);

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
    const whose = seen(chosen).length > 1 ? ", one of the recordings" : "";
    const head = (at: number): string => (over_angle ? `${shown(at, 1)}°${whose}` : `${shown(at, 1)} min`);
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
      yAxis: axis(look, "deviation, µm", "y"),
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

  const list = all.map(({ key, name: label }) => ({ value: key, label }));
  return {
    name,
    title: "Candidates over the residual",
    about:
      "What is measured less what the model says, and over it what the effects of the best set (*) would add: that part " +
      "of each which the model cannot make by parameters of its own. Candidates without * belong to other sets, each beside the " +
      "rest of its own. One chosen from the list or in the table is drawn broad and pale; dotted, what is left with it " +
      "taken off.",
    height_px: 400,
    zoom: over_angle ? "own" : "time",
    choices: [
      ...(list.length > 0
        ? [{ key: "candidate", label: "Candidate", values: [{ value: "", label: "none" }, ...list], initial: "" }]
        : []),
      ...recording_choice(strands, report),
    ],
    toggles: ({ chosen }) => curves(chosen).map((one) => one.toggle),
    draw,
    numbers,
  };
};
