// Recordings with the bar along the spindle: its length over the time of a recording, all tests or one.
import { bar_of_tests, places_of, times_named, toggles_of_tests } from "./all_tests";
import { curve, type Point } from "../drawing/curve";
import { decimated, extent } from "../drawing/columns";
import { curves_base } from "../drawing/hover";
import type { Numbers, Picture, State, Toggle } from "../picture";
import { labels_of } from "./recording_groups";
import type { Num, Recording } from "../report";
import { columns_of, grid_of } from "../drawing/parts";
import { axis, curve_colour, minutes, sequence_colour, shown, toggle } from "../drawing/theme";
import { time_limits, x_axis } from "../drawing/axes";
import { t } from "../texts/texts";

interface Axial {
  key: string;
  name: string;
  recording: Recording;
  place: number;
  time_s: number[]; // since its first reading
}

const mean_um = (recording: Recording): Num =>
  typeof recording.length_mm === "number" ? (recording.length_mm - recording.nominal_length_mm) * 1000 : null;

export const axial_picture = (recordings: readonly Recording[]): Picture => {
  const places = places_of(recordings);
  const names = times_named(recordings);
  const each = labels_of(recordings).map((label, k) => ({ value: String(k), label }));
  const values = [{ value: "", label: t.recordings_all_tests }, ...each];
  const all = recordings.map((recording, k): Axial => {
    const times = recording.trace?.time_s ?? [];
    return {
      key: `axial${k}`,
      name: names[k] ?? "",
      recording,
      place: places[k] ?? 0,
      time_s: times.map((time) => time - (times[0] ?? 0)),
    };
  });
  const shown_recordings = (chosen: State["chosen"]): Axial[] => {
    const one = all[Number(chosen["recording"])];
    return chosen["recording"] && one ? [one] : all;
  };
  const toggles = (chosen: State["chosen"]): Toggle[] => {
    const [only, ...others] = shown_recordings(chosen);
    return only && others.length === 0 ? [toggle(only.key, only.name, 0, "line")] : toggles_of_tests(shown_recordings(chosen));
  };
  return {
    name: "axial",
    title: t.recordings_axial_title,
    caption: t.recordings_axial_caption,
    about: t.recordings_axial_about,
    height_px: 360,
    zoom: "own",
    choices: all.length > 1 ? [{ key: "recording", label: t.recording, values, initial: "" }] : [],
    toggles: ({ chosen }) => toggles(chosen),
    draw: (state) => {
      const { look, window } = state;
      const { dark } = look;
      const drawn = shown_recordings(state.chosen);
      const many = drawn.length > 1;
      const grid = grid_of(look, many ? 26 : 0);
      const series = drawn
        .filter((one) => !state.hidden.has(one.key))
        .flatMap((one) => {
          const colour = many ? sequence_colour(one.place, dark) : curve_colour(0, dark);
          const points = decimated(one.time_s, one.recording.trace?.deviation_um ?? [], window, look.width_px / (many ? 4 : 1));
          const mean = mean_um(one.recording);
          const level = mean === null ? [] : [one.time_s[0], one.time_s.at(-1)].map((time): Point => [time ?? 0, mean]);
          const quiet = { silent: true, tooltip: { show: false } };
          return [
            curve(one.name, colour, "solid", many ? 1 + one.place : 1.4, points),
            curve(t.figure_mean, many ? colour : curve_colour(1, dark), "dashed", 1.4, level, quiet),
          ];
        });
      return {
        ...curves_base(state, toggles(state.chosen), { drawn: series, head: (time) => `${shown(time)} s`, unit: "µm", most: 12 }),
        grid,
        xAxis: x_axis(look, t.recordings_time_axis, window, time_limits(extent(drawn.map(({ time_s }) => time_s)))),
        yAxis: axis(look, t.deviation_axis, "y"),
        graphic: many ? bar_of_tests(all, state, Number(grid["top"]) - 28) : [],
        series,
      };
    },
    numbers: ({ chosen }): Numbers => {
      const of = shown_recordings(chosen);
      return columns_of({
        time_s: of.flatMap((one) => one.time_s),
        deviation_um: of.flatMap((one) => one.recording.trace?.deviation_um ?? []),
        test: of.flatMap((one) => one.time_s.map(() => one.name)),
        test_time_min: of.flatMap(({ time_s, recording: { time_s: at_s } }) => time_s.map(() => (at_s === null ? null : minutes(at_s)))),
      });
    },
  };
};
