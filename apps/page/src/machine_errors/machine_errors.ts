// The errors of the machine, found from one test: the circle and the ranked table beside it.
import { error_tests, type ErrorTest, ranked_errors } from "./error_curves";
import { error_name, unit_shown } from "./error_names";
import { circle_table, errors_table, stated_table } from "./error_tables";
import { errors_picture, kErrors_picture, without_picture } from "./errors_pictures";
import { command_of } from "../drawing/command";
import { capital } from "../drawing/text";
import type { Section, Notes, Conclusion } from "../picture";
import type { Report } from "../report";
import { decimals_for, range_text, shown } from "../drawing/theme";
import { english, english_after, language, named, type Sentence, t } from "../texts/texts";

const kRemedies = 3;

// Of "backlash_a" that of "backlash"; one that the language does not have stays as the program says it.
const remedy_sentence = (error: string, effect: string, remedy: string): Sentence => {
  const what = effect.replace(/_[ab]$/, "");
  const known = language !== "en" && Object.hasOwn(t.remedies, what);
  return known ? t.errors_remedy({ error, remedy: named(t.remedies, what) }) : english_after(`${error}:`, remedy);
};

// In English the program's own sentences.
export const verdict_of = ({ part, recordings }: ErrorTest): Sentence => {
  const circularity = shown(part.circularity_um, 1);
  if (part.conclusion === "") return t.errors_circularity_is({ value: shown(part.circularity_um, 2) });
  if (language === "en") return english(part.conclusion);
  const first = ranked_errors(part).find((one) => one.first.rank !== null);
  if (!first) return t.errors_conclusion_none({ circularity });
  return t.errors_conclusion({
    circularity,
    error: error_name(first.effect, recordings[0]?.plane),
    without: shown(first.first.circularity_without_um, 1),
  });
};

// What is concluded from the only test stands at the head of the page.
const notes_of = (test: ErrorTest, alone: boolean): Notes => {
  const { part, recordings } = test;
  const plane = recordings[0]?.plane;
  const remedies = ranked_errors(part)
    .filter(({ first }) => first.rank !== null && first.remedy)
    .slice(0, kRemedies)
    .map(({ effect, first }) => remedy_sentence(error_name(effect, plane), effect, first.remedy ?? ""));
  return {
    table: errors_table(test),
    sentences: [
      ...(alone || part.conclusion === "" ? [] : [verdict_of(test)]),
      ...(part.left_text === "" ? [] : [english(part.left_text)]),
      t.errors_explained,
    ],
    lists: [
      { title: t.errors_remedies, items: remedies },
      { title: t.errors_tolerances, items: part.tolerances.map(english) },
      { title: t.errors_undetermined, items: part.undetermined.map((names) => error_name(names, plane, 300)) },
      {
        title: t.errors_prior,
        items: part.prior.map(
          ({ name, sigma, unit }) =>
            `${error_name(name, plane)}: 0 ± ${shown(sigma, decimals_for(null, sigma))} ${unit_shown(unit)}`,
        ),
      },
    ],
    tables: [...circle_table(test), ...stated_table(test)],
  };
};

const result_of = (tests: readonly ErrorTest[]): string => {
  const values = tests.flatMap(({ part }) => part.circularity_um ?? []);
  return t.errors_result({ circularity: range_text(values, 2), tests: tests.length });
};

// The error that gains most is mended, and the test made again.
const conclusion_of = (test: ErrorTest): Conclusion => {
  const { part, recordings } = test;
  const largest = ranked_errors(part).find(({ first }) => first.rank !== null && first.remedy);
  return {
    verdict: verdict_of(test),
    concluded: part.conclusion,
    next: {
      label: t.errors_next,
      text: largest
        ? remedy_sentence(capital(error_name(largest.effect, recordings[0]?.plane)), largest.effect, largest.first.remedy ?? "")
        : "",
      command: command_of("errors", [...part.files.slice(0, 1), "again.b5r"], ["--show", "change"]),
    },
  };
};

export const machine_errors_section = (report: Report): Section[] => {
  const tests = error_tests(report);
  const [first] = tests;
  if (!first) return [];
  return [
    {
      id: "machine-errors",
      heading: t.errors,
      result: result_of(tests),
      first: {
        picture: kErrors_picture,
        conclusion: ({ test }) => conclusion_of(tests.find(({ value }) => value === test) ?? first),
      },
      pictures: [errors_picture(tests), without_picture(tests)],
      companion: {
        picture: kErrors_picture,
        key: "test",
        notes: (chosen) => notes_of(tests.find(({ value }) => value === chosen) ?? first, tests.length === 1),
      },
    },
  ];
};
