// A machine over its tests: a section a group of tests that can be compared, then squareness and scales.
import { history_picture, type Shown } from "./history_picture";
import { command_of } from "../drawing/command";
import type { Next, Section, State } from "../picture";
import type { HistoryGroup, Report } from "../report";
import { plain } from "../drawing/text";
import { english, t } from "../texts/texts";
import { heading_of, table_text, typed } from "./history_words";

const next = (): Next => ({ label: t.history_next, text: "", command: command_of("history", ["."], ["--all"]) });

// The columns of the table: quantity, unit, last, change, sigmas, a year, tolerance, met.
const quantity_sentence = ({ rows }: HistoryGroup, name: string): string => {
  const row = rows.find(([quantity]) => quantity === name);
  if (!row) return t.history_count({ n: rows.length });
  const [, unit = "", last = "", change = "", sigmas = "", a_year = "", tolerance = "", met = ""] = row.map(table_text);
  const told = (text: string): boolean => text !== "" && text !== "-";
  return t.history_says({
    name: typed(name),
    last,
    unit,
    changed: told(change) ? t.history_says_changed({ change: change.replace(" *", ""), sigmas }) : "",
    trend: told(a_year) ? t.history_says_trend({ a_year: a_year.replace(" *", "") }) : "",
    met: /\d{4}-/.test(met) ? t.history_says_met({ tolerance, met }) : "",
  });
};

// A date first, then a change, then a trend that is marked.
const says_of = ({ rows, first }: HistoryGroup): number => {
  const [, , , change = "", , a_year = "", , met = ""] = rows.find(([quantity]) => quantity === first) ?? [];
  return (/\d{4}-/.test(met) ? 4 : 0) + (change.includes("*") ? 2 : 0) + (a_year.includes("*") ? 1 : 0);
};

const shown = (k: number): Shown => ({
  name: `history-${k + 1}`,
  trend: t.history_trend,
  caption: t.history_caption,
  about: t.history_about,
});

const group_section = (group: HistoryGroup, k: number): Section => ({
  id: `history-${k + 1}`,
  heading: plain(group.label, 80),
  result: quantity_sentence(group, group.first),
  says: says_of(group),
  ...(group.quantities.length > 0
    ? {
        first: {
          picture: `history-${k + 1}`,
          kind: t.history_tests_kind,
          label: plain(group.label, 80),
          told: ({ quantity }: State["chosen"]) => ({ verdict: quantity_sentence(group, quantity ?? group.first), next: next() }),
        },
      }
    : {}),
  sentences: [],
  tables: [
    {
      title: t.history_quantities,
      heading: group.heading.map(heading_of),
      rows: group.rows.map(([quantity = "", ...rest]) => [typed(quantity), ...rest.map(table_text)]),
    },
  ],
  pictures: group.quantities.length > 0 ? [history_picture(group, shown(k))] : [],
});

export const history_sections = ({ history }: Report): Section[] => {
  if (!history) return [];
  const { groups, geometry, geometry_rows, skipped } = history;
  return [
    ...groups.map(group_section),
    ...(geometry_rows.length > 0
      ? [
          {
            id: "geometry",
            heading: t.history_geometry,
            result: geometry_rows.slice(0, 3).map(([what, value]) => `${table_text(what ?? "")} ${table_text(value ?? "")}`).join(", "),
            sentences: geometry.map(english),
            tables: [
              {
                title: t.history_geometry,
                heading: ["", "µm/m", t.history_from],
                rows: geometry_rows.map((row) => row.map(table_text)),
              },
            ],
            pictures: [],
          },
        ]
      : []),
    ...(skipped.length > 0
      ? [
          {
            id: "skipped",
            heading: t.history_skipped,
            result: t.history_files({ n: skipped.length }),
            sentences: [],
            tables: [],
            pictures: [],
            lists: [{ title: t.history_why, items: skipped.map(english) }],
          },
        ]
      : []),
  ];
};
