// The errors of the machine, found from one test: the circle and the ranked table beside it.
import { error_tests, type ErrorTest } from "./error_curves";
import { error_name, unit_shown } from "./error_names";
import { circle_table, errors_table, stated_table } from "./error_tables";
import { errors_picture, kErrors_picture } from "./errors_picture";
import { without_picture } from "./without_picture";
import { command_of } from "../drawing/command";
import { capital } from "../drawing/text";
import type { First, Section, Told } from "../picture";
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

const result_of = (tests: readonly ErrorTest[]): string => {
  const values = tests.map(({ part }) => part.circularity_um).filter((value) => value !== null);
  const [least, most] = [Math.min(...values), Math.max(...values)].map((value) => shown(value, 2));
  const circularity = values.length === 0 ? "" : `circularity ${least === most ? least : `${least} to ${most}`} µm, `;
  return `${circularity}${tests.length === 1 ? "what is left, remedies and tolerances" : `${tests.length} tests`}`;
};

// The largest error is mended, and the test made again.
const told_first = ({ part, recordings }: ErrorTest): ReturnType<First["told"]> => {
  const largest = ranked_errors(part).find(({ first }) => first.rank !== null && first.remedy);
  const name = largest ? error_name(largest.effect, recordings[0]?.plane) : "";
  return {
    verdict: part.conclusion === "" ? `Circularity ${shown(part.circularity_um, 2)} µm.` : part.conclusion,
    next: {
      label: "Test again, and compare",
      text: largest ? `${capital(name)}: ${largest.first.remedy ?? ""}` : "",
      command: command_of("history", ["."], ["--out", "history.html"]),
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
      heading: "Errors of the machine",
      result: result_of(tests),
      first: {
        picture: kErrors_picture,
        kind: "",
        label: "",
        told: ({ test }) => told_first(tests.find(({ value }) => value === test) ?? first),
      },
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
