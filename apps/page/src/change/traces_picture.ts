// The traces of both tests on one circle, each about its own fitted circle, in one magnification.
import { about_circle, type ErrorTest } from "../machine_errors/error_curves";
import type { Choice, Numbers, Picture, State, Toggle } from "../picture";
import { dash_of, stacked_numbers } from "../recordings/recording_curves";
import type { ComparedTests, Recording } from "../report";
import { round_curve, type RoundCurve, round_picture } from "../recordings/round";
import { curve_colour, shown, toggle } from "../drawing/theme";
import { extent } from "../drawing/columns";
import { t } from "../texts/texts";

export const kTraces_picture = "change";

export interface Traced {
  pair: ComparedTests;
  before: ErrorTest | undefined; // of results alone there is none
  after: ErrorTest | undefined;
}

type When = "before" | "after";

const kColour: Readonly<Record<When, number>> = { before: 1, after: 0 };

interface Trace {
  key: string;
  label: string;
  when: When;
  test: ErrorTest;
  recording: Recording;
  place: number; // in the test
}

const traces_of = ({ before, after }: Traced): Trace[] =>
  (["before", "after"] as const).flatMap((when) => {
    const test = when === "before" ? before : after;
    const which = when === "before" ? t.change_before : t.change_after;
    return !test ? [] : test.recordings.map((recording, place): Trace => {
      const label = [which, ...(recording.direction ? [recording.direction] : [])].join(" ");
      return { key: `${when}${place}`, label, when, test, recording, place };
    });
  });

const toggle_of = ({ key, label, when, recording }: Trace): Toggle =>
  toggle(key, label, kColour[when], recording.direction === "CW" ? "dashed" : "line");

export const pair_choice = (pairs: readonly ComparedTests[]): Choice[] =>
  pairs.length < 2
    ? []
    : [{ key: "pair", label: t.change_plane, values: pairs.map(({ before }, k) => ({ value: String(k), label: before.plane })), initial: "0" }];

export const traces_picture = (all: readonly Traced[]): Picture => {
  const traced_of = (chosen: State["chosen"]): Traced | undefined => all[Number(chosen["pair"] ?? 0)] ?? all[0];
  const traces = (chosen: State["chosen"]): Trace[] => {
    const traced = traced_of(chosen);
    return traced ? traces_of(traced) : [];
  };
  return round_picture({
    name: kTraces_picture,
    title: t.change_picture_title,
    caption: t.change_picture_caption,
    about: t.change_picture_about,
    height_px: 440,
    choices: pair_choice(all.map(({ pair }) => pair)),
    scaled: (chosen) => ({
      first: traces(chosen)[0]?.recording,
      extent_um: extent(traces(chosen).map(({ test, place }) => about_circle(test, place))),
    }),
    toggles: (chosen) => traces(chosen).map(toggle_of),
    round: (state) => {
      const drawn = traces(state.chosen);
      const curves = drawn
        .filter(({ key }) => !state.hidden.has(key))
        .map(({ label, when, test, recording, place }): RoundCurve =>
          round_curve(recording, about_circle(test, place), {
            name: label,
            colour: curve_colour(kColour[when], state.look.dark),
            dash: dash_of(recording),
            width_px: when === "after" ? 1.8 : 1.4,
          }),
        );
      const pair = traced_of(state.chosen)?.pair;
      const round = pair?.quantities.find(({ name }) => name === "circularity");
      return { curves, note: round && t.change_circularity_note({ before: shown(round.before, 2), after: shown(round.after, 2) }) };
    },
    numbers: ({ chosen }): Numbers => {
      const drawn = traces(chosen);
      return stacked_numbers(
        drawn.map(({ recording }) => recording),
        (_, __, k) => {
          const one = drawn[k];
          return one ? [{ name: `${one.when}_${(one.recording.direction ?? String(one.place + 1)).toLowerCase()}_um`, values: about_circle(one.test, one.place) }] : [];
        },
      );
    },
  });
};
