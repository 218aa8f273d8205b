// Measured values, model and residual with the present values of the sliders, with the residual before the last change
// and a candidate.
import { curve } from "../drawing/curve";
import { model_fit_picture } from "../model/model_fit_picture";
import type { Stretch } from "./history_of_steps";
import { with_left_out } from "./left_out";
import type { Picture, State, Toggle } from "../picture";
import { chosen_strands } from "../recordings/recording_groups";
import type { Candidate, Checked, Num, Report } from "../report";
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
