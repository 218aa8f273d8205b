// All tests of one kind on the circle: how it grows and wanders from the first test to the last.
import { bar_of_tests, extent_of_tests, quantity_choice, subsampled, tests_of, toggles_of_tests } from "./all_tests";
import { magnifications, radial_scale } from "./magnification";
import type { Picture } from "../picture";
import { group_choice, type Group } from "./recording_groups";
import { round_option } from "./round";
import { sequence_colour } from "../drawing/sequence_colour";
import { test_numbers } from "./test_numbers";
import { legend } from "../drawing/theme";
import { t } from "../texts/texts";

export const all_round_picture = (groups: readonly Group[]): Picture => ({
  name: "tests-circle",
  title: t.recordings_all_round_title,
  caption: t.recordings_all_round_caption,
  about: t.recordings_all_round_about,
  height_px: 560,
  zoom: "none",
  choices: [
    group_choice(groups, "group", t.recordings_figure),
    quantity_choice("deviation"),
    {
      key: "magnification",
      label: t.recordings_magnification,
      values: [
        { value: "", label: t.recordings_automatic },
        ...magnifications.map((m) => ({ value: String(m), label: t.recordings_times({ times: m }) })),
      ],
      initial: "",
    },
  ],
  toggles: ({ chosen }) => toggles_of_tests(tests_of(groups, chosen)),
  draw: (state) => {
    const tests = tests_of(groups, state.chosen);
    const first = tests[0]?.recording;
    const [least_um, largest_um] = extent_of_tests(tests);
    const scale = radial_scale(
      least_um,
      largest_um,
      (first?.nominal_length_mm ?? 100) * 1000,
      Number(state.chosen["magnification"]) || null,
    );
    const curves = tests
      .filter((test) => !state.hidden.has(test.key))
      .map((test) => ({
        ...subsampled(test),
        colour: sequence_colour(test.place, state.look.dark),
        dash: "solid" as const,
      }));
    const option = round_option(state.look, scale, first?.plane, curves, []);
    const graphic = [
      ...(option["graphic"] as Record<string, unknown>[]),
      ...bar_of_tests(tests, state, state.look.height_px - 40),
    ];
    return { ...option, graphic, legend: legend(state, toggles_of_tests(tests)) };
  },
  numbers: ({ chosen }) => test_numbers(tests_of(groups, chosen), chosen["quantity"] ?? ""),
});
