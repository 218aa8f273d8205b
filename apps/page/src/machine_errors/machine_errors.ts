// The errors of the machine, found from one test: the circle and the ranked table beside it.
import { error_tests, type ErrorTest } from "./error_curves";
import { error_name, unit_shown } from "./error_names";
import { circle_table, errors_table, stated_table } from "./error_tables";
import { errors_picture, kErrors_picture } from "./errors_picture";
import { without_picture } from "./without_picture";
import type { Section, Told } from "../picture";
import { ranked_errors } from "./ranked_errors";
import type { Report } from "../report";
import { shown } from "../drawing/theme";
import { decimals_for } from "../drawing/with_sigma";

const kRemedies = 3;

// What is concluded from the only test stands at the head of the page.
const told_of = (test: ErrorTest, alone: boolean): Told => {
  const { part, recordings } = test;
  const plane = recordings[0]?.plane;
  const remedies = ranked_errors(part)
    .filter(({ first }) => first.rank !== null && first.remedy)
    .slice(0, kRemedies)
    .map(({ effect, first }) => `${error_name(effect, plane)}: ${first.remedy}`);
  return {
    beside: errors_table(test),
    sentences: [
      ...(alone || part.conclusion === "" ? [] : [part.conclusion]),
      ...(part.left_text === "" ? [] : [part.left_text]),
      "IC: peak to peak of an error's own curve. G without: the circularity that remains if it is mended.",
    ],
    lists: [
      { title: "Remedies", items: remedies },
      { title: "Tolerances", items: part.tolerances },
      { title: "Not told apart by this test", items: part.undetermined.map((names) => error_name(names, plane, 300)) },
      {
        title: "Assumed before the readings (prior)",
        items: part.prior.map(
          ({ name, sigma, unit }) =>
            `${error_name(name, plane)}: 0 ± ${shown(sigma, decimals_for(null, sigma))} ${unit_shown(unit)}`,
        ),
      },
    ],
    tables: [...circle_table(test), ...stated_table(test)],
  };
};

export const machine_errors_section = (report: Report): Section[] => {
  const tests = error_tests(report);
  const [first] = tests;
  if (!first) return [];
  return [
    {
      id: "machine-errors",
      heading: "Errors of the machine",
      sentences: [],
      tables: [],
      pictures: [errors_picture(tests), without_picture(tests)],
      beside: {
        picture: kErrors_picture,
        key: "test",
        told: (chosen) => told_of(tests.find(({ value }) => value === chosen) ?? first, tests.length === 1),
      },
    },
  ];
};
