// Two tests of a plane, before and after: what differs clearly, in a sentence, a table, and both traces on one circle.
import { capital, plain } from "../drawing/text";
import { command_of, files_of } from "../drawing/command";
import { is_told, quantity_name } from "./quantities";
import { unit_shown } from "../machine_errors/error_names";
import { error_tests } from "../machine_errors/error_curves";
import { kSizes_picture, sizes_picture } from "./sizes_picture";
import { kTraces_picture, traces_picture, type Traced } from "./traces_picture";
import type { Conclusion, Notes, Section, TextTable } from "../picture";
import type { ComparedTests, Num, QuantityDifference, Report, TestHead } from "../report";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import { t } from "../texts/texts";

const kSaid = 3; // changes of a sentence

// With one decimal, or two where one does not tell them apart.
const both = (before: number, after: number, unit: string): { from: string; to: string; unit: string } => {
  const decimals = unit === "ms" ? 3 : before.toFixed(1) === after.toFixed(1) ? 2 : 1;
  return { from: shown(before, decimals), to: shown(after, decimals), unit: unit_shown(unit) };
};

const changed = (name: string, before: number, after: number, unit: string): string => {
  const parts = { name, ...both(before, after, unit) };
  if (before * after < 0) return t.change_turned(parts);
  return Math.abs(after) < Math.abs(before) ? t.change_fell(parts) : t.change_grew(parts);
};

const circularity_of = ({ quantities }: ComparedTests): QuantityDifference | undefined =>
  quantities.find(({ name, before, after }) => name === "circularity" && before !== null && after !== null);

// What changed, and below it that nothing else did.
const found_of = (pair: ComparedTests): { found: string; also?: string } => {
  const round = circularity_of(pair);
  const values = round ? { before: with_sigma(round.before, round.before_sigma, 1), after: with_sigma(round.after, round.after_sigma, 1) } : null;
  if (pair.judged === 0) {
    return { found: values ? t.change_unknown_round({ before: shown(round?.before, 1), after: shown(round?.after, 1) }) : t.change_unknown };
  }
  const changes = pair.changes.map(({ name, before, after, unit }) => changed(quantity_name(name, pair.before.plane), before, after, unit));
  const said = changes.slice(0, kSaid);
  if (changes.length > kSaid) said.push(t.change_more({ n: changes.length - kSaid }));
  if (round?.clear) said.push(changed(quantity_name("circularity", pair.before.plane), round.before ?? 0, round.after ?? 0, round.unit));
  if (said.length > 0) return { found: t.change_only({ changes: said.join(t.change_joint) }), also: t.change_no_other };
  return { found: values ? t.change_nothing_round(values) : t.change_nothing };
};

// What the tests were made with that is not the same.

const arc = ({ arc_deg, start_deg }: TestHead): string => t.change_arc_from({ arc: shown(arc_deg, 0), start: shown(start_deg, 0) });

const conditions: Readonly<Record<string, (before: TestHead, after: TestHead) => string>> = {
  nominal_length: (before, after) => t.change_lengths({ before: shown(before.nominal_length_mm), after: shown(after.nominal_length_mm) }),
  arc: (before, after) => t.change_arcs({ before: arc(before), after: arc(after) }),
  feed: (before, after) => t.change_feeds({ before: shown(before.feed_mm_per_min, 0), after: shown(after.feed_mm_per_min, 0) }),
  directions: (before, after) => t.change_directions({ before: before.directions.join(" + "), after: after.directions.join(" + ") }),
  bar: (before, after) => t.change_bars({ before: plain(before.bar, 40), after: plain(after.bar, 40) }),
  machine: (before, after) => t.change_machines({ before: plain(before.machine, 60), after: plain(after.machine, 60) }),
  stored: () => t.change_stored,
};

const differing = ({ before, after, differs }: ComparedTests): string[] =>
  differs.flatMap((one) => conditions[one]?.(before, after) ?? []);

const verdict_of = (pair: ComparedTests): Pick<Conclusion, "verdict" | "also"> => {
  const { found, ...also } = found_of(pair);
  const differ = differing({ ...pair, differs: pair.differs.filter((one) => one !== "bar" && one !== "stored") });
  return { verdict: capital(differ.length === 0 ? found : t.change_though({ differ: differ.join(t.change_joint), found })), ...also };
};

// The table: circularity, what differs clearly, what one of the tests shows; the rest below.

const row_of = (one: QuantityDifference, plane: string): string[] => {
  const cell = (value: Num, sigma: Num): string => with_sigma(value, sigma, Math.min(3, decimals_for(one.difference ?? value, one.sigma ?? sigma)));
  return [
    quantity_name(one.name, plane),
    cell(one.before, one.before_sigma),
    cell(one.after, one.after_sigma),
    cell(one.difference, one.sigma),
    unit_shown(one.unit),
    one.of_set_up || one.clear === null ? "–" : one.clear ? t.yes : t.no,
  ];
};

const table_of = (title: string, rows: readonly QuantityDifference[], plane: string): TextTable => ({
  title,
  about: t.change_table_about,
  heading: [t.errors_one, t.change_before, t.change_after, t.change_difference, t.unit, t.change_clear],
  rows: rows.map((one) => row_of(one, plane)),
});

const test_text = ({ file, second_file, date, plane, nominal_length_mm, feed_mm_per_min, arc_deg, directions, stored }: TestHead): string =>
  [
    [file, second_file].filter((one) => one !== "").map((one) => plain(one, 80)).join(" + "),
    (date ?? "").slice(0, 16).replace("T", " "),
    plane,
    `${shown(nominal_length_mm)} mm`,
    feed_mm_per_min === null ? "" : `${shown(feed_mm_per_min, 0)} mm/min`,
    `${shown(arc_deg, 0)}°`,
    directions.join(" + "),
    stored ? t.change_of_results : "",
  ]
    .filter((part) => part !== "")
    .join(", ");

const notes_of = (pair: ComparedTests): Notes => {
  const { before, after, quantities, judged } = pair;
  const rest = quantities.filter((one) => !is_told(one));
  return {
    table: table_of(t.change_table, quantities.filter(is_told), before.plane),
    sentences: [
      t.change_test({ which: t.change_before, test: test_text(before) }),
      t.change_test({ which: t.change_after, test: test_text(after) }),
      ...differing(pair).map((one) => `${one}.`),
      ...(judged > 0 ? [t.change_explained({ judged })] : []),
    ],
    lists: [],
    tables: rest.length > 0 ? [table_of(t.change_rest, rest, before.plane)] : [],
  };
};

const conclusion_of = (pair: ComparedTests): Conclusion => ({
  ...verdict_of(pair),
  concluded: pair.conclusion,
  next: { label: t.change_next, text: t.change_next_text, command: command_of("errors", files_of(pair.after)), action: { action: "open", files: files_of(pair.after) } },
});

export const change_section = (report: Report): Section[] => {
  const pairs = report.test_comparisons ?? [];
  const [first] = pairs;
  if (!first) return [];
  const tests = error_tests(report);
  const of_place = (place: number | null): Traced["before"] => tests.find(({ value }) => value === String(place));
  const traced = pairs.map((pair): Traced => ({ pair, before: of_place(pair.before_place), after: of_place(pair.after_place) }));
  const has_traces = traced.every(({ before, after }) => before && after);
  const picture = has_traces ? kTraces_picture : kSizes_picture;
  const pair_of = (value: string | undefined): ComparedTests => pairs[Number(value ?? 0)] ?? first;
  return [
    {
      id: "change",
      heading: t.change,
      result: pairs.map(({ before: { plane }, changes: { length: n } }) => (n === 0 ? t.change_result_none({ plane }) : t.change_result({ plane, n }))).join("; "),
      first: { picture, conclusion: ({ pair }) => conclusion_of(pair_of(pair)) },
      pictures: [...(has_traces ? [traces_picture(traced)] : []), sizes_picture(pairs)],
      companion: { picture, key: "pair", notes: (chosen) => notes_of(pair_of(chosen)) },
    },
  ];
};
