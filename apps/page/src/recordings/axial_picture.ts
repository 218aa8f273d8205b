// Recordings with the bar along the spindle: its length over the time of a recording, all tests or one.
import { kMost_toggles, places_of, times_named } from "./all_tests";
import { curve, type Point } from "../drawing/curve";
import { decimated } from "../drawing/columns";
import { curves_base } from "../drawing/hover";
import type { Numbers, Picture, State, Toggle } from "../picture";
import { labels_of } from "./recording_groups";
import type { Num, Recording } from "../report";
import {
  axis, colours, curve_colour, font, minutes, sequence_bar, sequence_colour, shown, toggle,
} from "../drawing/theme";
import { x_axis } from "../drawing/axes";
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
  const labels = labels_of(recordings);
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
    const shown_now = shown_recordings(chosen);
    if (shown_now.length > kMost_toggles) return [];
    const several = shown_now.length > 1;
    return shown_now.map(({ key, name, place }) => toggle(key, name, several ? (dark) => sequence_colour(place, dark) : 0, "line"));
  };
  return {
    name: "axial",
    title: t.recordings_axial_title,
    caption: t.recordings_axial_caption,
    about: t.recordings_axial_about,
    height_px: 360,
    zoom: "own",
    choices:
      all.length > 1
        ? [
            {
              key: "recording",
              label: t.recording,
              values: [{ value: "", label: t.recordings_all_tests }, ...labels.map((label, k) => ({ value: String(k), label }))],
              initial: "",
            },
          ]
        : [],
    toggles: ({ chosen }) => toggles(chosen),
    draw: (state) => {
      const { look, window } = state;
      const { dark } = look;
      const drawn = shown_recordings(state.chosen);
      const many = drawn.length > 1;
      const top = (look.still ? 64 : 14) + (many ? 26 : 0);
      const series = drawn
        .filter((one) => !state.hidden.has(one.key))
        .flatMap((one) => {
          const colour = many ? sequence_colour(one.place, dark) : curve_colour(0, dark);
          const points: Point[] = decimated(
            one.time_s,
            one.recording.trace?.deviation_um ?? [],
            window,
            look.width_px / (many ? 4 : 1),
          );
          const mean = mean_um(one.recording);
          const level: Point[] =
            mean === null
              ? []
              : [
                  [one.time_s[0] ?? 0, mean],
                  [one.time_s[one.time_s.length - 1] ?? 0, mean],
                ];
          return [
            curve(one.name, colour, "solid", many ? 1 + one.place : 1.4, points),
            curve(t.figure_mean, many ? colour : curve_colour(1, dark), "dashed", 1.4, level, {
              silent: true,
              tooltip: { show: false },
            }),
          ];
        });
      const c = colours(dark);
      return {
        ...curves_base(state, toggles(state.chosen), { drawn: series, head: (time) => `${shown(time)} s`, unit: "µm", most: 12 }),
        grid: { left: 64, right: 20, top, bottom: 48 },
        xAxis: x_axis(look, t.recordings_time_axis, window),
        yAxis: axis(look, t.deviation_axis, "y"),
        graphic: many
          ? [sequence_bar(all[0]?.name ?? "", all[all.length - 1]?.name ?? "", dark, c.faint, font, top - 28)]
          : [],
        series,
      };
    },
    numbers: ({ chosen }): Numbers => {
      const of = shown_recordings(chosen);
      return {
        columns: [
          { name: "time_s", values: of.flatMap((one) => one.time_s) },
          { name: "deviation_um", values: of.flatMap((one) => one.recording.trace?.deviation_um ?? []) },
          { name: "test", values: of.flatMap((one) => one.time_s.map(() => one.name)) },
          {
            name: "test_time_min",
            values: of.flatMap((one) =>
              one.time_s.map(() => (one.recording.time_s === null ? null : minutes(one.recording.time_s))),
            ),
          },
        ],
      };
    },
  };
};
