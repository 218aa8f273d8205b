// A machine over its tests: a section a group of tests that can be compared, then squareness and scales.
import { history_picture, type Shown } from "./history_picture";
import { command_of, files_of } from "../drawing/command";
import type { Next, Section } from "../picture";
import type { DrawnTest, HistoryGroup, Report } from "../report";
import { capital, plain } from "../drawing/text";
import { shown, with_sigma } from "../drawing/theme";
import { english, named, t, with_decimal_sign } from "../texts/texts";
import { error_name, typed_name, unit_shown } from "../machine_errors/error_names";
import { quantity_name } from "../change/quantities";

const next = (): Next => ({ label: t.history_next, command: command_of("history", ["."], ["--all"]), action: { action: "show", section: "history-1" } });

// The columns of the table: quantity, unit, last, change, sigmas, a year, tolerance, met.
const quantity_sentence = ({ rows, plane }: HistoryGroup, name: string): string => {
  const row = rows.find(([quantity]) => quantity === name);
  if (!row) return t.history_count({ n: rows.length });
  const [, unit = "", last = "", change = "", sigmas = "", a_year = "", tolerance = "", met = ""] = row.map(table_text);
  const is_stated = (text: string): boolean => text !== "" && text !== "-";
  return t.history_says({
    name: capital(quantity_name(name, plane)),
    last,
    unit,
    changed: is_stated(change) ? t.history_says_changed({ change: change.replace(" *", ""), sigmas }) : "",
    trend: is_stated(a_year) ? t.history_says_trend({ a_year: a_year.replace(" *", "") }) : "",
    met: /\d{4}-/.test(met) ? t.history_says_met({ tolerance, met }) : "",
  });
};

// A date first, then a change, then a trend that is marked.
const says_of = ({ rows, first }: HistoryGroup): number => {
  const [, , , change = "", , a_year = "", , met = ""] = rows.find(([quantity]) => quantity === first) ?? [];
  return (/\d{4}-/.test(met) ? 4 : 0) + (change.includes("*") ? 2 : 0) + (a_year.includes("*") ? 1 : 0);
};

const shown_as = (k: number): Shown => ({ name: `history-${k + 1}`, trend: t.history_trend, caption: t.history_caption, about: t.history_about });

// "10 tests, 2025-01-20 to 2026-01-19"
const count_and_dates = (tests: readonly DrawnTest[]): string => {
  const dates = tests.flatMap(({ date }) => (date ? [date.slice(0, 10)] : []));
  const [from = "", to = ""] = [dates[0], dates.at(-1)];
  const count = t.history_tests_count({ n: tests.length });
  return from === "" ? count : `${count}, ${from === to ? from : t.several_from_to({ from, to })}`;
};

const group_section = (group: HistoryGroup, k: number, tests: readonly DrawnTest[]): Section => ({
  id: `history-${k + 1}`,
  heading: plain(group.label, 80),
  result: quantity_sentence(group, group.first),
  says: says_of(group),
  first: group.quantities.length === 0 ? undefined : {
    picture: `history-${k + 1}`,
    kind: t.history_tests_kind,
    label: plain(group.label, 80),
    conclusion: ({ quantity }) => ({
      verdict: quantity_sentence(group, quantity ?? group.first),
      also: tests.length > 0 ? count_and_dates(tests) : undefined,
      next: next(),
    }),
  },
  tables: [
    {
      title: t.history_quantities,
      heading: group.heading.map((heading) => named(t.history_headings, heading)),
      rows: group.rows.map(([quantity = "", unit = "", ...rest]) => [quantity_name(quantity, group.plane), unit_shown(unit), ...rest.map(table_text)]),
    },
  ],
  pictures: group.quantities.length > 0 ? [history_picture(group, shown_as(k), (name) => quantity_name(name, group.plane))] : [],
});

const tests_section = (tests: readonly DrawnTest[]): Section[] =>
  tests.length === 0
    ? []
    : [
        {
          id: "tests",
          heading: t.history_list,
          result: count_and_dates(tests),
          tables: [
            {
              title: t.history_list,
              heading: [t.history_file, t.history_date, t.history_plane, "mm/min", `${named(t.effects, "circularity")} µm`, t.history_first_to_mend],
              rows: tests.map((test) => [
                plain(test.file.split("/").slice(-2).join("/"), 80),
                (test.date ?? "–").slice(0, 10),
                test.plane,
                shown(test.feed_mm_per_min, 0),
                with_sigma(test.circularity_um, test.circularity_sigma_um, 2),
                test.first_to_mend === "" ? t.none : error_name(test.first_to_mend, test.plane),
              ]),
              acts: { title: t.history_opens_test, actions: tests.map((test) => ({ action: "open", files: files_of(test) })) },
            },
          ],
        },
      ];

export const history_sections = ({ history }: Report): Section[] => {
  if (!history) return [];
  const { groups, geometry, geometry_rows, skipped, tests } = history;
  return [
    ...groups.map((group, k) => group_section(group, k, tests)),
    ...tests_section(tests),
    ...(geometry_rows.length > 0
      ? [
          {
            id: "geometry",
            heading: t.history_geometry,
            result: geometry_rows.slice(0, 3).map(([what, value]) => `${table_text(what ?? "")} ${table_text(value ?? "")}`).join(", "),
            sentences: geometry.map(english),
            tables: [{ title: t.history_geometry, heading: ["", "µm/m", t.history_from], rows: geometry_rows.map((row) => row.map(table_text)) }],
          },
        ]
      : []),
    ...(skipped.length > 0
      ? [
          {
            id: "skipped",
            heading: t.history_skipped,
            result: t.history_files({ n: skipped.length }),
            lists: [{ title: t.history_why, items: skipped.map(english) }],
          },
        ]
      : []),
  ];
};

// What the program writes into the table of a history, in the language of the page.

export const typed = (quantity: string): string => typed_name(quantity, 120);

const kDate = /^(\S+) \((\S+) to (\S+)\)$/; // "2026-03-01 (2025-12-01 to open)"
const kYears = /^not within (\S+) years$/;
const kRange = /^(?:(\S+) )?to (\S+)$/; // "-5 to 10", "to 5"
const kFrom = /^from (\S+)$/;
const kOf = /^(squareness|scale) (\S+)$/; // "squareness XY"

// A cell: a number, a name, or one of few phrases.
export const table_text = (text: string): string => {
  const date = kDate.exec(text);
  if (date) return t.history_span({ at: date[1] ?? "", from: date[2] ?? "", to: date[3] === "open" ? t.history_open : (date[3] ?? "") });
  const years = kYears.exec(text);
  if (years) return t.history_not_within({ years: years[1] ?? "" });
  const range = kRange.exec(text);
  const [from, to] = [with_decimal_sign(range?.[1] ?? ""), with_decimal_sign(range?.[2] ?? "")];
  if (range) return from === "" ? t.history_to({ limit: to }) : t.several_from_to({ from, to });
  const least = kFrom.exec(text);
  if (least) return t.history_at_least({ limit: with_decimal_sign(least[1] ?? "") });
  const of = kOf.exec(text);
  if (of) return `${named(t.history_words, of[1] ?? "")} ${of[2] ?? ""}`;
  return with_decimal_sign(named(t.history_words, text));
};
