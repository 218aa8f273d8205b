// The errors of the machine, found from one test: the circle and the ranked table beside it.
import { error_tests, type ErrorTest, ranked_errors } from "./error_curves";
import { error_name, unit_shown } from "./error_names";
import { error_page } from "./error_page";
import { circle_table, errors_table, gains_table, made_with, stated_table } from "./error_tables";
import { errors_picture, kErrors_picture, without_picture } from "./errors_pictures";
import { headline, summary_table, worst_of } from "./summary";
import { command_of } from "../drawing/command";
import { capital } from "../drawing/text";
import type { Section, Notes, Conclusion } from "../picture";
import type { Report } from "../report";
import { decimals_for, range_text, shown } from "../drawing/theme";
import { all_said, explained_by, said, type Sentence, t } from "../texts/texts";

const kRemedies = 3;

const remedy_sentence = (error: string, { effect, remedy = "" }: { effect?: string; remedy?: string }): Sentence => {
  const text = explained_by("recording", effect ?? "", "remedy", remedy);
  return typeof text === "string" ? t.errors_remedy({ error, remedy: text }) : { before: `${error}:`, english: text.english };
};

export const verdict_of = ({ part }: ErrorTest): Sentence =>
  part.conclusion === "" ? t.errors_circularity_is({ value: shown(part.circularity_um, 2) }) : said(part.conclusion, part.conclusion_message);

// What is concluded from the only test stands at the head of the page.
const notes_of = (test: ErrorTest, alone: boolean): Notes => {
  const { part, recordings } = test;
  const plane = recordings[0]?.plane;
  const remedies = ranked_errors(part)
    .filter(({ first }) => first.rank !== null && first.remedy)
    .slice(0, kRemedies)
    .map(({ effect, first }) => remedy_sentence(error_name(effect, plane), first));
  return {
    table: gains_table(test),
    sentences: [
      ...(alone || part.conclusion === "" ? [] : [verdict_of(test)]),
      ...(part.left_text === "" ? [] : [said(part.left_text, part.left_text_message)]),
      t.errors_explained,
    ],
    lists: [
      { title: t.errors_remedies, items: remedies },
      { title: t.errors_tolerances, items: all_said(part.tolerances, part.tolerances_message) },
      { title: t.errors_undetermined, items: part.undetermined.map((names) => error_name(names, plane, 300)) },
      {
        title: t.errors_prior,
        items: part.prior.map(
          ({ name, sigma, unit }) =>
            `${error_name(name, plane)}: 0 ± ${shown(sigma, decimals_for(null, sigma))} ${unit_shown(unit)}`,
        ),
      },
    ],
    tables: [errors_table(test), ...circle_table(test), ...stated_table(test)],
  };
};

// "circularity 2.81 to 6.70 µm, 3 tests"
const result_of = (tests: readonly ErrorTest[]): string => {
  const values = tests.flatMap(({ part }) => part.circularity_um ?? []);
  const rest = tests.length === 1 ? t.errors_result_one : t.errors_result_tests({ tests: tests.length });
  return values.length === 0 ? rest : t.errors_result({ circularity: range_text(values, 2), rest });
};

// The error that gains most is mended, and the test made again.
const conclusion_of = (report: Report, tests: readonly ErrorTest[], test: ErrorTest): Conclusion => {
  const { part, recordings } = test;
  const largest = ranked_errors(part).find(({ first }) => first.rank !== null && first.remedy);
  return {
    ...(tests.length === 1 ? { made_with: made_with(test) } : {}),
    verdict: headline(report, tests, test),
    also: part.conclusion === "" ? "" : verdict_of(test),
    concluded: part.conclusion,
    next: {
      label: t.errors_next,
      text: largest
        ? remedy_sentence(capital(error_name(largest.effect, recordings[0]?.plane)), largest.first)
        : "",
      command: command_of("errors", [...part.files.slice(0, 1), "again.b5r"], ["--show", "change"]),
      action: { action: "test_again" },
    },
  };
};

export const machine_errors_section = (report: Report): Section[] => {
  const tests = error_tests(report);
  if (tests.length === 0) return [];
  const test_of = (value: string | undefined): ErrorTest => tests.find((one) => one.value === value) ?? worst_of(tests);
  return [
    {
      id: "machine-errors",
      heading: t.errors,
      result: result_of(tests),
      first: { picture: kErrors_picture, conclusion: ({ test }) => conclusion_of(report, tests, test_of(test)) },
      pictures: [errors_picture(tests), without_picture(tests)],
      companion: {
        picture: kErrors_picture,
        key: "test",
        above: summary_table(report, tests, kErrors_picture),
        notes: (chosen) => notes_of(test_of(chosen), tests.length === 1),
        page: ({ test, error = "" }) => error_page(test_of(test), error),
      },
    },
  ];
};
