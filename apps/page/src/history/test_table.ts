// All ballbar tests of a folder, a row each: the worst first, by the circular deviation that stands there.
import { command_of, files_of } from "../drawing/command";
import { capital, plain } from "../drawing/text";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import { error_name, unit_shown } from "../machine_errors/error_names";
import type { Section, TextTable } from "../picture";
import type { Num, Report, TestRow } from "../report";
import { english, t } from "../texts/texts";

const number_of = ({ numbers }: TestRow, key: string): Num => numbers.find((one) => one.key === key)?.ours ?? null;

// The larger circular deviation G of both directions; of a test without one what the file stores.
const rank_um = (test: TestRow): number =>
  Math.max(number_of(test, "g_ccw_um") ?? -1, number_of(test, "g_cw_um") ?? -1, test.numbers.length === 0 ? (test.both_runs?.value ?? -1) : -1);

const both = (test: TestRow, ccw: string, cw: string): string => {
  const values = [number_of(test, ccw), number_of(test, cw)].filter((value) => value !== null);
  return values.length === 0 ? "–" : values.map((value) => shown(value, 2)).join(" / ");
};
// The radial deviation F, the least and the largest of both directions.
const range = (test: TestRow): string => {
  const ends = (end: "min" | "max"): number[] => ["ccw", "cw"].flatMap((direction) => number_of(test, `f_${end}_${direction}_um`) ?? []);
  const [least, largest] = [ends("min"), ends("max")];
  return least.length === 0 || largest.length === 0 ? "–" : `${shown(Math.min(...least), 2)} … ${shown(Math.max(...largest), 2)}`;
};

const size_of = ({ value, sigma, unit }: { value: Num; sigma: Num; unit: string }): string =>
  `${sigma === null ? shown(value, 2) : with_sigma(value, sigma, Math.min(2, decimals_for(value, sigma)))} ${unit_shown(unit)}`;

const largest_of = ({ largest, plane, stored }: TestRow): string =>
  largest ? `${error_name(largest.name, plane)} ${size_of(largest)}` : stored ? t.tests_not_in_file : t.none;

const day_of = ({ date }: TestRow): string => (date ?? "–").slice(0, 16).replace("T", " ");

// Its file, with the folder where names repeat.
const name_of = (test: TestRow, all: readonly TestRow[]): string => {
  const last = (path: string): string => path.slice(path.lastIndexOf("/") + 1);
  const repeats = all.filter(({ file }) => last(file) === last(test.file)).length > 1;
  return plain(repeats ? test.file.split("/").slice(-2).join("/") : last(test.file), 60);
};

const judgement_of = ({ passes }: TestRow): "pass" | "fail" | "" => (passes === null ? "" : passes ? "pass" : "fail");

const result_of = (test: TestRow): string => {
  const judgement = judgement_of(test);
  return judgement === "" ? "–" : t.judgements[judgement];
};

interface Column {
  heading: string;
  of: (test: TestRow) => string;
}

const columns_of = (tests: readonly TestRow[]): Column[] => {
  const any = (of: (test: TestRow) => unknown): boolean => tests.some((test) => of(test));
  return [
    { heading: t.errors_test, of: (test) => name_of(test, tests) },
    ...(any(({ machine }) => machine) ? [{ heading: t.stated.machine, of: ({ machine }: TestRow) => plain(machine, 40) || "–" }] : []),
    ...(any(judgement_of) ? [{ heading: t.tests_result, of: result_of }] : []),
    { heading: t.history_plane, of: ({ plane }) => plane },
    { heading: t.history_date, of: day_of },
    { heading: t.tests_bar, of: ({ nominal_length_mm }) => shown(nominal_length_mm, 0) },
    { heading: "mm/min", of: ({ feed_mm_per_min }) => shown(feed_mm_per_min, 0) },
    { heading: t.tests_g, of: (test) => both(test, "g_ccw_um", "g_cw_um") },
    { heading: t.tests_f, of: range },
    { heading: t.tests_d, of: (test) => shown(number_of(test, "d_um"), 2) },
    { heading: t.tests_both_runs, of: ({ both_runs }) => shown(both_runs?.value ?? null, 2) },
    { heading: t.errors_largest, of: largest_of },
    { heading: t.tests_from, of: ({ stored }) => (stored ? t.tests_stored : t.tests_fitted) },
  ];
};

const table_of_tests = (tests: readonly TestRow[]): TextTable => {
  const columns = columns_of(tests);
  return {
    title: t.tests_all,
    about: t.tests_about,
    heading: columns.map(({ heading }) => heading),
    rows: tests.map((test) => columns.map(({ of }) => of(test))),
    at_first: 60,
    marks: { column: columns.findIndex(({ heading }) => heading === t.tests_result), of: tests.map(judgement_of) },
    acts: { title: t.history_opens_test, actions: tests.map((test) => ({ action: "open", files: files_of(test) })) },
    pairs: { label: t.tests_compare, title: t.tests_compare_title, tests: tests.map((test) => ({ files: files_of(test), plane: test.plane, date: test.date ?? "" })) },
  };
};

// "XY, 2026-01-19 10:00"
const named = (test: TestRow): string => [test.plane, ...(test.date === null ? [] : [day_of(test)])].join(", ");

const verdict_of = (tests: readonly TestRow[], tolerance_um: Num): string => {
  const [worst] = tests;
  const n = tests.length;
  const judged = tests.filter(({ passes }) => passes !== null).length;
  const fail = tests.filter(({ passes }) => passes === false).length;
  const by = { fail, judged, tolerance: shown(tolerance_um) };
  const said =
    tolerance_um === null
      ? fail === 0 ? t.tests_judged_pass(by) : t.tests_judged(by)
      : fail === 0 ? t.tests_judged_by_pass(by) : t.tests_judged_by(by);
  if (!worst || rank_um(worst) < 0) return [t.tests_count({ n }), ...(judged > 0 ? [said] : [])].join(" ");
  const g = both(worst, "g_ccw_um", "g_cw_um");
  const first = g === "–" ? t.tests_worst_stored({ n, name: named(worst), circularity: shown(worst.both_runs?.value ?? null, 2) }) : t.tests_worst({ n, name: named(worst), g });
  return [first, ...(judged > 0 ? [said] : [])].join(" ");
};

// Whether a plane was tested on several days.
const is_over_days = (tests: readonly TestRow[]): boolean =>
  tests.some((one) => tests.some((other) => one.plane === other.plane && one.date !== null && other.date !== null && one.date.slice(0, 10) !== other.date.slice(0, 10)));

export const test_table_sections = ({ test_table: of }: Report): Section[] => {
  if (!of) return [];
  const tests = [...of.tests].sort((a, b) => rank_um(b) - rank_um(a));
  const skipped = of.skipped.map(({ sentence }) => english(sentence));
  const table = table_of_tests(tests);
  return [
    {
      id: "all-tests",
      heading: t.tests_all,
      result: t.history_tests_count({ n: tests.length }),
      first: {
        table,
        conclusion: () => ({
          verdict: capital(verdict_of(tests, of.tolerance_um)),
          next: { label: t.tests_trend, command: command_of("history", ["."]), action: is_over_days(tests) ? { action: "trend" } : null },
        }),
      },
      lists: [
        { title: t.history_skipped, items: skipped },
        { title: t.tests_remarks, items: of.remarks.map(english) },
      ],
    },
  ];
};
