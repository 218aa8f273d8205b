// What the model leaves, and over it what each candidate would add. The best set is drawn; any one candidate is chosen
// beside it, by its row in the table or from the list, and shows what would be left with it taken off.
import { best_curves, chosen_curves, residual_curve, type Curve, type Shown } from "./candidate_curves";
import { hover_text } from "./hover";
import type { Choice, Numbers, Picture, State } from "./picture";
import type { Ranked } from "./ranking";
import type { Checked, Num, Report } from "./report";
import { points_of, strands_of, type Strand } from "./strands";
import { surviving } from "./surviving";
import { plain } from "./text";
import { axis, base, legend, shown, tooltip } from "./theme";

const most_drawn_together = 4; // recordings; of more, one at a time is seen at first

const recording_choice = (strands: readonly Strand[], report: Report): Choice[] => {
  if (strands.length < 2) return [];
  const label = (index: Num): string =>
    plain(report.fit?.recordings.find((one) => one.index === index)?.label ?? `recording ${index}`, 40);
  const one_each = strands.map(({ recording }) => ({ value: String(recording), label: label(recording) }));
  return [
    {
      key: "recording",
      label: "Recording",
      values: [{ value: "", label: "all of them" }, ...one_each],
      initial: strands.length > most_drawn_together ? (one_each[0]?.value ?? "") : "",
    },
  ];
};

export const candidates_picture = (
  report: Report,
  checked: Checked,
  candidates: readonly Ranked[],
  companions: readonly Ranked[],
  name: string,
): Picture => {
  const over_angle = checked.level === "recording";
  const strands = strands_of(checked);
  const model = checked.series.contributions.map((one) => one.values_um);
  const all = [...candidates, ...companions].map(
    (one): Shown => ({ ...one, values_um: surviving(one.candidate.curve_um, model) }),
  );
  const fixed = [residual_curve(checked), ...best_curves(all.filter((one) => one.candidate.in_best_set))];
  const curves = (chosen: State["chosen"]): Curve[] => {
    const one = all.find((ranked) => ranked.key === chosen["candidate"]);
    return one ? [...fixed, ...chosen_curves(one, checked.series.residual_um)] : fixed;
  };
  const seen = (chosen: State["chosen"]): Strand[] =>
    strands.filter(({ recording }) => !chosen["recording"] || String(recording) === chosen["recording"]);

  const draw = ({ look, window, chosen, hidden }: State): Record<string, unknown> => {
    const drawn = curves(chosen).filter((one) => !hidden.has(one.toggle.key));
    const limits = window ? { min: window[0], max: window[1] } : { min: "dataMin", max: "dataMax" };
    return {
      ...base(look),
      grid: { left: 64, right: 20, top: look.still ? 64 : 14, bottom: 48 },
      legend: legend({ look, window, chosen, hidden, stretch: null }, curves(chosen).map((one) => one.toggle)),
      tooltip: {
        ...tooltip(look),
        trigger: "axis",
        formatter: hover_text({
          x: 0,
          y: 1,
          head: (at) => `${shown(at, 1)} ${over_angle ? "°" : "min"}`,
          unit: "µm",
        }),
      },
      xAxis: { ...axis(look, over_angle ? "angle, °" : "time, min", "x"), ...limits },
      yAxis: axis(look, "deviation, µm", "y"),
      series: drawn.map(({ toggle, values_um, series }) =>
        series(toggle.label, toggle.colour(look.dark), points_of(seen(chosen), values_um, window, look.width_px)),
      ),
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
      "of each which the model cannot make by other gains. Candidates without * belong to other sets, each beside the " +
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
