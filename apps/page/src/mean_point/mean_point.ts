// Where one sensor tells the axial elongation.
import { command_of } from "../drawing/command";
import type { Numbers, Picture, Section, State, Toggle } from "../picture";
import type { MeanPointPart, MeanPointState, Num, Report } from "../report";
import { axis, colours, shown, toggle } from "../drawing/theme";
import { said, type Sentence, t } from "../texts/texts";
import { curve, lines_across } from "../drawing/curve";
import { decimated } from "../drawing/columns";
import { curves_base } from "../drawing/hover";
import { time_limits, x_axis } from "../drawing/axes";
import { grid_below } from "../drawing/parts";
import { plain } from "../drawing/text";

const verdict_of = (part: MeanPointPart): Sentence => said(part.conclusion, part.conclusion_message);

export const mean_point_section = ({ mean_point }: Report): Section[] =>
  mean_point
    ? [
        {
          id: "mean-point",
          heading: t.mean_point,
          result: 
            mean_point.best
              ? t.mean_point_result({ at: shown(mean_point.best.x_mm, 1) })
              : t.mean_point_states({ n: mean_point.states.length }),
          first: {
            picture: "mean-point",
            conclusion: () => ({
              verdict: verdict_of(mean_point),
              concluded: mean_point.conclusion,
              next: { label: t.mean_point_next, command: command_of("effects", ["expansion"]), action: null },
            }),
          },
          sentences: [verdict_of(mean_point)],
          pictures: [mean_point_picture(mean_point)],
        },
      ]
    : [];

// Temperature along a spindle, of one state or several: the mean of each dashed, a dot where T is that mean. Of several
// states an upright line at the one place that serves them all best.

type Series = Record<string, unknown>;

// All places of all states, each once, rising; a state has a gap where it was not read.
const numbers_of = (states: readonly MeanPointState[]): Numbers => {
  const places = [...new Set(states.flatMap(({ x_mm }) => x_mm))].sort((a, b) => a - b);
  const columns = states.map(({ x_mm, degC }, k) => {
    const at = new Map(x_mm.map((x, i): [number, Num] => [x, degC[i] ?? null]));
    return { name: `T${states.length > 1 ? k + 1 : ""}_degC`, values: places.map((x) => at.get(x) ?? null) };
  });
  return { columns: [{ name: "x_mm", values: places }, ...columns] };
};

export const mean_point_picture = ({ states, best }: MeanPointPart): Picture => {
  const toggles = states.map(({ name }, k) => toggle(`state${k}`, plain(name, 50), k, "line"));
  const ends = states.flatMap(({ x_mm }) => [x_mm[0] ?? 0, x_mm[x_mm.length - 1] ?? 0]);
  const whole = time_limits([Math.min(...ends), Math.max(...ends)]);

  const drawn_state = ({ x_mm, degC, mean_degC, mean_points }: MeanPointState, k: number, state: State): Series[] => {
    const { look, window, hidden } = state;
    const { key, label, colour } = toggles[k] as Toggle;
    if (hidden.has(key)) return [];
    const mine = colour(look.dark);
    const mean = [x_mm[0], x_mm[x_mm.length - 1]].map((x): [number, Num] => [x ?? 0, mean_degC]);
    return [
      curve(label, mine, "solid", 1.8, decimated(x_mm, degC, window, look.width_px)),
      curve("", mine, "dashed", 1.4, mean, { silent: true }),
      {
        type: "scatter",
        name: "",
        data: mean_points.map((point) => [point.x_mm, mean_degC]),
        symbolSize: 9,
        itemStyle: { color: mine },
        silent: true,
        z: 4,
      },
    ];
  };

  const draw = (state: State): Series => {
    const { look, window } = state;
    const series = states.flatMap((one, k) => drawn_state(one, k, state));
    const line = { color: colours(look.dark).ink, type: "solid", width: 2 } as const;
    const grid = grid_below(look, toggles);
    return {
      ...curves_base(state, toggles, { drawn: series, head: (at) => `${shown(at, 1)} mm`, unit: "°C" }),
      grid: { ...grid, top: Number(grid["top"]) + (best ? 16 : 0) },
      xAxis: x_axis(look, t.mean_point_x_axis, window, whole),
      yAxis: axis(look, t.mean_point_axis, "y"),
      series: [...series, ...(best ? [lines_across([{ xAxis: best.x_mm }], { formatter: t.mean_point_best({ at: shown(best.x_mm, 2) }) }, line)] : [])],
    };
  };

  return {
    name: "mean-point",
    title: t.mean_point_title,
    caption: t.mean_point_caption,
    about: best ? t.mean_point_about_best : "",
    height_px: 440,
    zoom: "own",
    toggles: () => toggles,
    draw,
    numbers: () => numbers_of(states),
  };
};
