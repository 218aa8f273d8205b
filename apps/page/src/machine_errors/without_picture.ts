// The circle as it would be without some of the machine's errors: each can be switched off, several at once.
import { about_circle, error_curve, extent_of_test, type ErrorTest } from "./error_curves";
import { error_name } from "./error_names";
import { test_choice, trace_styles } from "./errors_picture";
import { radial_scale } from "../recordings/magnification";
import type { Numbers, Picture, State, Toggle } from "../picture";
import { ranked_errors, type RankedError } from "./ranked_errors";
import { kept_readings, picked, stacked_numbers } from "../recordings/recording_curves";
import { effect_colour } from "../recordings/recording_colours";
import type { Num } from "../report";
import { round_option, type RoundCurve } from "../recordings/round";
import { colours, curve_colour, font, legend, shown } from "../drawing/theme";
import { t } from "../texts/texts";

const kStretches = 720; // of a turn, four points each

export const kWithout_picture = "machine-errors-without";

const key_of = (effect: string): string => `error ${effect}`;

const label_of = (test: ErrorTest, { effect, first }: RankedError): string =>
  t.errors_of_size({
    error: error_name(effect, test.recordings[0]?.plane),
    value: shown(first.individual_circularity_um, 2),
  });

const toggles_of = (test: ErrorTest): Toggle[] =>
  ranked_errors(test.part).map((one, k): Toggle => ({
    key: key_of(one.effect),
    label: label_of(test, one),
    colour: (dark) => effect_colour(k, dark),
    mark: "dot",
    on: true,
  }));

const off_in = (test: ErrorTest, hidden: State["hidden"]): RankedError[] =>
  ranked_errors(test.part).filter(({ effect }) => hidden.has(key_of(effect)));

// Of the k-th recording, with what these errors add taken off.
const left_of = (test: ErrorTest, off: readonly RankedError[], k: number): Num[] =>
  off.reduce<Num[]>((values, { effect }) => {
    const curve = error_curve(test, effect, k);
    return curve ? values.map((value, i) => (value === null ? null : value - (curve[i] ?? 0))) : values;
  }, about_circle(test, k));

// From the lowest to the highest that is drawn.
const range_of = (columns: readonly (readonly Num[])[]): number => {
  let [least, largest] = [Infinity, -Infinity];
  for (const values of columns) {
    for (const value of values) {
      if (value === null) continue;
      least = Math.min(least, value);
      largest = Math.max(largest, value);
    }
  }
  return largest - least;
};

// Without one, as the program says; without several, what is drawn.
const note_of = (test: ErrorTest, off: readonly RankedError[]): string => {
  const all = t.errors_circularity({ value: shown(test.part.circularity_um, 2) });
  const [first] = off;
  if (!first) return all;
  const left =
    off.length === 1
      ? first.first.circularity_without_um
      : range_of(test.recordings.map((_, k) => left_of(test, off, k)));
  const error = off.length === 1 ? label_of(test, first) : t.errors_these({ n: off.length });
  return `${all}\n${t.errors_circularity_without({ error, value: shown(left, 2) })}`;
};

export const without_picture = (tests: readonly ErrorTest[]): Picture => {
  const test_of = (chosen: State["chosen"]): ErrorTest | undefined =>
    tests.find(({ value }) => value === chosen["test"]) ?? tests[0];
  const curves_of = (test: ErrorTest, state: State): RoundCurve[] => {
    const { dark } = state.look;
    const off = off_in(test, state.hidden);
    return trace_styles(test.recordings).flatMap(({ name, colour, dash }, k) => {
      const angles = test.recordings[k]?.trace?.angle_deg ?? [];
      const drawn = (values: readonly Num[], as: Omit<RoundCurve, "angle_deg" | "value_um">): RoundCurve => {
        const kept = kept_readings(values, kStretches);
        return { angle_deg: picked(angles, kept), value_um: picked(values, kept), ...as };
      };
      const measured = { name: t.measured_of({ which: name }), colour: colour(dark), dash, width_px: 1.4, faint: off.length > 0 };
      const without = { name: t.errors_off({ which: name }), colour: curve_colour(2, dark), dash, width_px: 1.7 };
      return [drawn(about_circle(test, k), measured), ...(off.length > 0 ? [drawn(left_of(test, off, k), without)] : [])];
    });
  };
  return {
    name: kWithout_picture,
    title: t.errors_off_title,
    caption: t.errors_off_caption,
    about: t.errors_off_about,
    height_px: 440,
    zoom: "none",
    choices: test_choice(tests),
    toggles: ({ chosen }) => {
      const test = test_of(chosen);
      return test ? toggles_of(test) : [];
    },
    draw: (state) => {
      const test = test_of(state.chosen);
      if (!test) return {};
      const { look } = state;
      const nominal_um = (test.recordings[0]?.nominal_length_mm ?? 100) * 1000;
      const scale = radial_scale(...extent_of_test(test), nominal_um, null);
      const option = round_option(look, scale, test.recordings[0]?.plane, curves_of(test, state), []);
      const style = { fill: colours(look.dark).ink, fontSize: 12, lineHeight: 17, fontFamily: font, textAlign: "right" };
      const text = note_of(test, off_in(test, state.hidden));
      const note = { type: "text", right: 8, bottom: 8, silent: true, style: { text, ...style } };
      return {
        ...option,
        graphic: [...(option["graphic"] as Record<string, unknown>[]), note],
        legend: legend(state, []),
      };
    },
    numbers: ({ chosen, hidden }): Numbers => {
      const test = test_of(chosen);
      if (!test) return { columns: [] };
      const off = off_in(test, hidden);
      return stacked_numbers(test.recordings, (_, of, k) => [
        { name: `measured${of}_um`, values: about_circle(test, k) },
        ...(off.length > 0 ? [{ name: `without${of}_um`, values: left_of(test, off, k) }] : []),
      ]);
    },
  };
};
