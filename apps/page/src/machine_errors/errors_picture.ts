// The readings of one test on the circle, beside them what one of the machine's errors adds, and the circle as it would
// be without it.
import { about_circle, error_curve, extent_of_test, without_error, type ErrorTest } from "./error_curves";
import { error_name } from "./error_names";
import { radial_scale } from "../recordings/magnification";
import type { Choice, Numbers, Picture, State, Toggle } from "../picture";
import { ranked_errors } from "./ranked_errors";
import { kept_readings, picked, stacked_numbers } from "../recordings/recording_curves";
import { direction_colour, effect_colour } from "../recordings/recording_colours";
import { labels_of } from "../recordings/recording_groups";
import type { Num, Recording } from "../report";
import { round_option, type RoundCurve } from "../recordings/round";
import { plain } from "../drawing/text";
import { colours, curve_colour, font, legend, shown } from "../drawing/theme";
import { t } from "../texts/texts";

const kStretches = 720; // of a turn, four points each

export const kErrors_picture = "machine-errors";
export const kWithout = "without";

interface Drawn {
  name: string; // of its direction, or of the recording where directions are several times there
  colour: (dark: boolean) => string;
  dash: RoundCurve["dash"];
  mark: Toggle["mark"];
}

export const trace_styles = (recordings: readonly Recording[]): Drawn[] => {
  const directions = recordings.map(({ direction }) => direction);
  const each_once = new Set(directions).size === directions.length;
  const labels = labels_of(recordings);
  return recordings.map((recording, k) => ({
    name: each_once ? (recording.direction ?? t.recordings_circle) : (labels[k] ?? ""),
    colour: each_once ? direction_colour(recording) : (dark) => curve_colour([0, 1, 5, 7, 3][k % 5] ?? 0, dark),
    dash: recording.direction === "CW" ? [7, 2] : "solid",
    mark: recording.direction === "CW" ? "dashed" : "line",
  }));
};

const label_of = (test: ErrorTest, error: string): string => error_name(error, test.recordings[0]?.plane);

const toggles_of = (test: ErrorTest, error: string): Toggle[] => [
  ...trace_styles(test.recordings).map(({ name, colour, mark }, k): Toggle => ({
    key: `trace${k}`,
    label: t.measured_of({ which: name }),
    colour,
    mark,
    on: true,
  })),
  ...(error === ""
    ? []
    : ([
        { key: "error", label: label_of(test, error), colour: (dark) => effect_colour(0, dark), mark: "dashed", on: true },
        { key: kWithout, label: t.errors_without, colour: (dark) => curve_colour(2, dark), mark: "line", on: false },
      ] satisfies Toggle[])),
];

const curves_of = (test: ErrorTest, error: string, state: State): RoundCurve[] => {
  const { dark } = state.look;
  const on = (key: string): boolean => !state.hidden.has(key);
  const without = error !== "" && on(kWithout);
  const styles = trace_styles(test.recordings);
  return test.recordings.flatMap((recording, k) => {
    const style = styles[k];
    const angles = recording.trace?.angle_deg ?? [];
    if (!style) return [];
    const drawn = (values: readonly Num[], as: Omit<RoundCurve, "angle_deg" | "value_um">): RoundCurve => {
      const kept = kept_readings(values, kStretches);
      return { angle_deg: picked(angles, kept), value_um: picked(values, kept), ...as };
    };
    const { dash, name } = style;
    const curve = error === "" ? undefined : error_curve(test, error, k);
    return [
      ...(on(`trace${k}`)
        ? [
            drawn(about_circle(test, k), {
              name: t.measured_of({ which: name }),
              colour: style.colour(dark),
              dash,
              width_px: 1.4,
              faint: without,
            }),
          ]
        : []),
      ...(without && on(`trace${k}`)
        ? [
            drawn(without_error(test, error, k), {
              name: t.errors_without,
              hover_name: t.errors_without_of({ which: name }),
              colour: curve_colour(2, dark),
              dash,
              width_px: 1.6,
            }),
          ]
        : []),
      ...(curve && on("error")
        ? [
            drawn(curve, {
              name: label_of(test, error),
              hover_name: t.errors_curve_of({ error: label_of(test, error), which: name }),
              colour: effect_colour(0, dark),
              dash: dash === "solid" ? "dashed" : "dotted",
              width_px: 2.2,
            }),
          ]
        : []),
    ];
  });
};

// How far from round it is, and would be.
const circularity_note = (test: ErrorTest, error: string): string => {
  const first = ranked_errors(test.part).find(({ effect }) => effect === error)?.first;
  const lines = [t.errors_circularity({ value: shown(test.part.circularity_um, 2) })];
  const without = first?.circularity_without_um;
  if (first) lines.push(t.errors_circularity_without({ error: label_of(test, error), value: shown(without, 2) }));
  return lines.join("\n");
};

export const test_choice = (tests: readonly ErrorTest[]): Choice[] => {
  if (tests.length < 2) return [];
  const names = tests.map(({ recordings: [first] }) => plain(`${first?.test}, ${first?.plane}`, 60));
  const values = tests.map(({ value }, k) => {
    const name = names[k] ?? "";
    return { value, label: names.indexOf(name) === names.lastIndexOf(name) ? name : `${name} (${k + 1})` };
  });
  return [{ key: "test", label: t.errors_test, values, initial: values[0]?.value ?? "" }];
};

// Of all tests, in the order of the first that has it.
const error_choice = (tests: readonly ErrorTest[]): Choice => {
  const all = new Map<string, string>();
  for (const test of tests) {
    for (const { effect } of ranked_errors(test.part)) if (!all.has(effect)) all.set(effect, label_of(test, effect));
  }
  const largest = tests[0] ? ranked_errors(tests[0].part)[0] : undefined;
  return {
    key: "error",
    label: t.errors_error,
    values: [{ value: "", label: t.none }, ...[...all].map(([value, label]) => ({ value, label }))],
    initial: largest && largest.first.rank !== null ? largest.effect : "",
  };
};

export const errors_picture = (tests: readonly ErrorTest[]): Picture => {
  const test_of = (chosen: State["chosen"]): ErrorTest | undefined =>
    tests.find(({ value }) => value === chosen["test"]) ?? tests[0];
  const error_of = (chosen: State["chosen"]): string => chosen["error"] ?? "";
  const extents = new Map<ErrorTest, [number, number]>();
  const extent_of = (test: ErrorTest): [number, number] => {
    const known = extents.get(test) ?? extent_of_test(test);
    extents.set(test, known);
    return known;
  };
  return {
    name: kErrors_picture,
    title: t.errors_picture_title,
    caption: t.errors_picture_caption,
    about: t.errors_picture_about,
    height_px: 440,
    zoom: "none",
    choices: [...test_choice(tests), error_choice(tests)],
    toggles: ({ chosen }) => {
      const test = test_of(chosen);
      return test ? toggles_of(test, error_of(chosen)) : [];
    },
    draw: (state) => {
      const test = test_of(state.chosen);
      if (!test) return {};
      const { look } = state;
      const error = error_of(state.chosen);
      const nominal_um = (test.recordings[0]?.nominal_length_mm ?? 100) * 1000;
      const scale = radial_scale(...extent_of(test), nominal_um, null);
      const option = round_option(look, scale, test.recordings[0]?.plane, curves_of(test, error, state), []);
      const note = {
        type: "text",
        right: 8,
        bottom: 8,
        silent: true,
        style: {
          text: circularity_note(test, error),
          fill: colours(look.dark).ink,
          fontSize: 12,
          lineHeight: 17,
          fontFamily: font,
          textAlign: "right",
        },
      };
      return {
        ...option,
        graphic: [...(option["graphic"] as Record<string, unknown>[]), note],
        legend: legend(state, toggles_of(test, error)),
      };
    },
    numbers: ({ chosen }): Numbers => {
      const test = test_of(chosen);
      const error = error_of(chosen);
      if (!test) return { columns: [] };
      return stacked_numbers(test.recordings, (_, of, k) => {
        const curve = error === "" ? undefined : error_curve(test, error, k);
        return [
          { name: `measured${of}_um`, values: about_circle(test, k) },
          ...(curve
            ? [
                { name: `${plain(error, 60)}${of}_um`, values: curve },
                { name: `without${of}_um`, values: without_error(test, error, k) },
              ]
            : []),
        ];
      });
    },
  };
};
