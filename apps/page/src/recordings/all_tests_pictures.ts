// All tests of one kind on the circle: how it grows and wanders from the first test to the last.
import {
  bar_of_tests, kStretches, quantity_choice, subsampled, test_numbers, tests_of, toggles_of_tests,
} from "./all_tests";
import { extent } from "../drawing/columns";
import type { Picture } from "../picture";
import { type Group, group_choice } from "./recording_groups";
import { round_picture } from "./round";
import { grid_of } from "../drawing/parts";
import { axis, sequence_colour, shown } from "../drawing/theme";
import { t } from "../texts/texts";
import { curve, type Point } from "../drawing/curve";
import { curves_base } from "../drawing/hover";
import { x_axis } from "../drawing/axes";
import { angle_limits } from "./unrolled_picture";

export const all_round_picture = (groups: readonly Group[]): Picture => round_picture({
  name: "tests-circle",
  title: t.recordings_all_round_title,
  caption: t.recordings_all_round_caption,
  about: t.recordings_all_round_about,
  height_px: 560,
  choices: [group_choice(groups, "group", t.recordings_figure), quantity_choice("deviation")],
  scaled: (chosen) => {
    const tests = tests_of(groups, chosen);
    return { first: tests[0]?.recording, extent_um: extent(tests.map(({ value_um }) => value_um), [0, 0]) };
  },
  toggles: (chosen) => toggles_of_tests(tests_of(groups, chosen)),
  round: (state) => {
    const tests = tests_of(groups, state.chosen);
    const curves = tests
      .filter((test) => !state.hidden.has(test.key))
      .map((test) => ({ ...subsampled(test), colour: sequence_colour(test.place, state.look.dark), dash: "solid" as const }));
    return { curves, graphic: bar_of_tests(tests, state, state.look.height_px - 40) };
  },
  numbers: ({ chosen }) => test_numbers(tests_of(groups, chosen), chosen["quantity"] ?? ""),
});

// All tests of one kind against the angle.

const axis_name = (quantity: string | undefined): string =>
  quantity === "change" ? t.recordings_change_axis : quantity === "residual" ? t.residual_axis : t.deviation_axis;

export const all_unrolled_picture = (groups: readonly Group[]): Picture => ({
  name: "tests-unrolled",
  title: t.recordings_all_unrolled_title,
  caption: t.recordings_all_unrolled_caption,
  about: t.recordings_all_unrolled_about,
  height_px: 400,
  zoom: "own",
  choices: [group_choice(groups, "group", t.recordings_figure), quantity_choice("change")],
  toggles: ({ chosen }) => toggles_of_tests(tests_of(groups, chosen)),
  draw: (state) => {
    const { look, window } = state;
    const tests = tests_of(groups, state.chosen);
    const grid = { ...grid_of(look), top: look.still ? 90 : 34 };
    const share = window ? Math.max(0.05, (window[1] - window[0]) / 360) : 1;
    const series = tests
      .filter((test) => !state.hidden.has(test.key))
      .map((test) => {
        const { angle_deg, value_um } = subsampled(test, kStretches / share);
        const points: Point[] = angle_deg.map((angle, i) => [angle, value_um[i] ?? null]);
        return curve(test.name, sequence_colour(test.place, look.dark), "solid", test.width_px, points);
      });
    return {
      ...curves_base(state, toggles_of_tests(tests), { drawn: series, head: (angle) => `${shown(angle, 1)}°`, unit: "µm", most: 12 }),
      grid,
      xAxis: x_axis(look, t.angle_axis, window, angle_limits(tests.flatMap((test) => test.angle_deg))),
      yAxis: axis(look, axis_name(state.chosen["quantity"]), "y"),
      graphic: bar_of_tests(tests, state, grid.top - 30),
      series,
    };
  },
  numbers: ({ chosen }) => test_numbers(tests_of(groups, chosen), chosen["quantity"] ?? ""),
});
