// The readings of one test on the circle, beside them what one of the machine's errors adds, and the circle as it would
// be without it.
import {
  about_circle, error_curve, type ErrorTest, extent_of_test, ranked_errors, type RankedError, without_error,
} from "./error_curves";
import { error_name } from "./error_names";
import type { Choice, Numbers, Picture, State, Toggle } from "../picture";
import { dash_of, direction_colour, effect_colour, stacked_numbers } from "../recordings/recording_curves";
import { labels_of, once_each } from "../recordings/recording_groups";
import type { Num, Recording } from "../report";
import { round_curve, type RoundCurve, round_picture } from "../recordings/round";
import { worst_of } from "./summary";
import { plain } from "../drawing/text";
import { curve_colour, shown, toggle } from "../drawing/theme";
import { t } from "../texts/texts";
import { extent } from "../drawing/columns";

export const kErrors_picture = "machine-errors";
export const kWithout = "without";

interface Drawn {
  name: string; // of its direction, or of the recording where directions are several times there
  colour: (dark: boolean) => string;
  dash: RoundCurve["dash"];
  mark: Toggle["mark"];
}

const trace_styles = (recordings: readonly Recording[]): Drawn[] => {
  const directions = recordings.map(({ direction }) => direction);
  const each_once = new Set(directions).size === directions.length;
  const labels = labels_of(recordings);
  return recordings.map((recording, k) => ({
    name: each_once ? (recording.direction ?? t.recordings_circle) : (labels[k] ?? ""),
    colour: each_once ? direction_colour(recording) : (dark) => curve_colour([0, 1, 5, 7, 3][k % 5] ?? 0, dark),
    dash: dash_of(recording),
    mark: recording.direction === "CW" ? "dashed" : "line",
  }));
};

const label_of = (test: ErrorTest, error: string): string => error_name(error, test.recordings[0]?.plane);

const toggles_of = (test: ErrorTest, error: string): Toggle[] => [
  ...trace_styles(test.recordings).map(({ name, colour, mark }, k) =>
    toggle(`trace${k}`, t.measured_of({ which: name }), colour, mark),
  ),
  ...(error === ""
    ? []
    : [
        toggle("error", label_of(test, error), (dark) => effect_colour(0, dark), "dashed"),
        toggle(kWithout, t.errors_without, 2, "line", false),
      ]),
];

const curves_of = (test: ErrorTest, error: string, state: State): RoundCurve[] => {
  const { dark } = state.look;
  const on = (key: string): boolean => !state.hidden.has(key);
  const without = error !== "" && on(kWithout);
  const styles = trace_styles(test.recordings);
  return test.recordings.flatMap((recording, k) => {
    const style = styles[k];
    if (!style) return [];
    const { dash, name } = style;
    const curve = error === "" ? undefined : error_curve(test, error, k);
    return [
      ...(on(`trace${k}`)
        ? [
            round_curve(recording, about_circle(test, k), {
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
            round_curve(recording, without_error(test, error, k), {
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
            round_curve(recording, curve, {
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

const test_choice = (tests: readonly ErrorTest[]): Choice[] => {
  if (tests.length < 2) return [];
  const names = once_each(tests.map(({ recordings: [first] }) => plain(`${first?.test}, ${first?.plane}`, 60)));
  const values = tests.map(({ value }, k) => ({ value, label: names[k] ?? "" }));
  return [{ key: "test", label: t.errors_test, values, initial: worst_of(tests).value }];
};

// That which is out most at first.
const chosen_test = (tests: readonly ErrorTest[], chosen: State["chosen"]): ErrorTest =>
  tests.find(({ value }) => value === chosen["test"]) ?? worst_of(tests);

// What both pictures are of; there is a test.
const of_tests = (tests: readonly ErrorTest[]) => ({
  test_of: (chosen: State["chosen"]): ErrorTest => chosen_test(tests, chosen),
  scaled: (chosen: State["chosen"]) => {
    const test = chosen_test(tests, chosen);
    return { first: test.recordings[0], extent_um: extent_of_test(test) };
  },
});

// Of all tests, in the order of the first that has it.
const error_choice = (tests: readonly ErrorTest[]): Choice => {
  const all = new Map<string, string>();
  for (const test of tests) {
    for (const { effect } of ranked_errors(test.part)) if (!all.has(effect)) all.set(effect, label_of(test, effect));
  }
  const largest = ranked_errors(worst_of(tests).part)[0];
  return {
    key: "error",
    label: t.errors_error,
    values: [{ value: "", label: t.none }, ...[...all].map(([value, label]) => ({ value, label }))],
    initial: largest && (largest.first.rank !== null || largest.first.significant === true) ? largest.effect : "",
  };
};

export const errors_picture = (tests: readonly ErrorTest[]): Picture => {
  const { test_of, scaled } = of_tests(tests);
  const error_of = (chosen: State["chosen"]): string => chosen["error"] ?? "";
  return round_picture({
    name: kErrors_picture,
    title: t.errors_picture_title,
    caption: t.errors_picture_caption,
    about: t.errors_picture_about,
    height_px: 680,
    in_window: true,
    choices: [...test_choice(tests), error_choice(tests)],
    scaled,
    toggles: (chosen) => toggles_of(test_of(chosen), error_of(chosen)),
    round: (state) => {
      const [test, error] = [test_of(state.chosen), error_of(state.chosen)];
      return { curves: curves_of(test, error, state), note: circularity_note(test, error) };
    },
    numbers: ({ chosen }): Numbers => {
      const [test, error] = [test_of(chosen), error_of(chosen)];
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
  });
};

// The circle as it would be without some of the machine's errors: each can be switched off, several at once.

const key_of = (effect: string): string => `error ${effect}`;

const sized_name = (test: ErrorTest, { effect, first }: RankedError): string =>
  t.errors_of_size({
    error: error_name(effect, test.recordings[0]?.plane),
    value: shown(first.individual_circularity_um, 2),
  });

const switches_of = (test: ErrorTest): Toggle[] =>
  ranked_errors(test.part).map((one, k) =>
    toggle(key_of(one.effect), sized_name(test, one), (dark) => effect_colour(k, dark), "dot"),
  );

const off_in = (test: ErrorTest, hidden: State["hidden"]): RankedError[] =>
  ranked_errors(test.part).filter(({ effect }) => hidden.has(key_of(effect)));

// Of the k-th recording, with what these errors add taken off.
const left_of = (test: ErrorTest, off: readonly RankedError[], k: number): Num[] =>
  off.reduce<Num[]>((values, { effect }) => {
    const curve = error_curve(test, effect, k);
    return curve ? values.map((value, i) => (value === null ? null : value - (curve[i] ?? 0))) : values;
  }, about_circle(test, k));

// Without one, as the program says; without several, what is drawn.
const note_of = (test: ErrorTest, off: readonly RankedError[]): string => {
  const all = t.errors_circularity({ value: shown(test.part.circularity_um, 2) });
  const [first] = off;
  if (!first) return all;
  const [least, largest] = extent(test.recordings.map((_, k) => left_of(test, off, k)));
  const left = off.length === 1 ? first.first.circularity_without_um : largest - least;
  const error = off.length === 1 ? sized_name(test, first) : t.errors_these({ n: off.length });
  return `${all}\n${t.errors_circularity_without({ error, value: shown(left, 2) })}`;
};

export const without_picture = (tests: readonly ErrorTest[]): Picture => {
  const { test_of, scaled } = of_tests(tests);
  const curves_of = (test: ErrorTest, state: State): RoundCurve[] => {
    const { dark } = state.look;
    const off = off_in(test, state.hidden);
    return trace_styles(test.recordings).flatMap(({ name, colour, dash }, k) => {
      const recording = test.recordings[k];
      if (!recording) return [];
      const measured = { name: t.measured_of({ which: name }), colour: colour(dark), dash, width_px: 1.4, faint: off.length > 0 };
      const without = { name: t.errors_off({ which: name }), colour: curve_colour(2, dark), dash, width_px: 1.7 };
      return [
        round_curve(recording, about_circle(test, k), measured),
        ...(off.length > 0 ? [round_curve(recording, left_of(test, off, k), without)] : []),
      ];
    });
  };
  return round_picture({
    name: "machine-errors-without",
    title: t.errors_off_title,
    caption: t.errors_off_caption,
    about: t.errors_off_about,
    height_px: 560,
    choices: test_choice(tests),
    scaled,
    toggles: (chosen) => switches_of(test_of(chosen)),
    round: (state) => {
      const test = test_of(state.chosen);
      return { curves: curves_of(test, state), toggles: [], note: note_of(test, off_in(test, state.hidden)) };
    },
    numbers: ({ chosen, hidden }): Numbers => {
      const test = test_of(chosen);
      const off = off_in(test, hidden);
      return stacked_numbers(test.recordings, (_, of, k) => [
        { name: `measured${of}_um`, values: about_circle(test, k) },
        ...(off.length > 0 ? [{ name: `without${of}_um`, values: left_of(test, off, k) }] : []),
      ]);
    },
  });
};
