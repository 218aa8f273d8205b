// All tests of one kind against the angle.
import { bar_of_tests, kStretches, quantity_choice, subsampled, tests_of, toggles_of_tests } from "./all_tests";
import { curve, type Point } from "../drawing/curve";
import { hover_text } from "../drawing/hover";
import type { Picture } from "../picture";
import { group_choice, type Group } from "./recording_groups";
import { sequence_colour } from "../drawing/sequence_colour";
import { test_numbers } from "./test_numbers";
import { axis, base, legend, shown, tooltip } from "../drawing/theme";
import { x_axis } from "../drawing/two_grids";
import { angle_limits } from "./unrolled_picture";
import { t } from "../texts/texts";

const axis_name = (quantity: string | undefined): string =>
  quantity === "change" ? t.recordings_change_axis : quantity === "residual" ? t.residual_axis : t.deviation_axis;

export const all_unrolled_picture = (groups: readonly Group[]): Picture => ({
  name: "tests-unrolled",
  title: t.recordings_all_unrolled_title,
  caption: t.recordings_all_unrolled_caption,
  about: t.recordings_all_unrolled_about,
  height_px: 400,
  zoom: "own",
  choices: [
    group_choice(groups, "group", t.recordings_figure),
    quantity_choice("change"),
  ],
  toggles: ({ chosen }) => toggles_of_tests(tests_of(groups, chosen)),
  draw: (state) => {
    const { look, window } = state;
    const tests = tests_of(groups, state.chosen);
    const top = look.still ? 90 : 34;
    const seen = window ? Math.max(0.05, (window[1] - window[0]) / 360) : 1;
    const series = tests
      .filter((test) => !state.hidden.has(test.key))
      .map((test) => {
        const { angle_deg, value_um } = subsampled(test, kStretches / seen);
        const points: Point[] = angle_deg.map((angle, i) => [angle, value_um[i] ?? null]);
        return curve(test.name, sequence_colour(test.place, look.dark), "solid", test.width_px, points);
      });
    return {
      ...base(look),
      grid: { left: 64, right: 20, top, bottom: 48 },
      xAxis: x_axis(look, t.angle_axis, window, angle_limits(tests.flatMap((test) => test.angle_deg))),
      yAxis: axis(look, axis_name(state.chosen["quantity"]), "y"),
      legend: legend(state, toggles_of_tests(tests)),
      tooltip: {
        ...tooltip(look),
        trigger: "axis",
        formatter: hover_text({
          drawn: series,
          x: 0,
          y: 1,
          head: (angle) => `${shown(angle, 1)}°`,
          unit: "µm",
          most: 12,
        }),
      },
      graphic: bar_of_tests(tests, state, top - 30),
      series,
    };
  },
  numbers: ({ chosen }) => test_numbers(tests_of(groups, chosen), chosen["quantity"] ?? ""),
});
