// A machine over its tests: a section a group of tests that can be compared, then squareness and scales.
import { history_picture } from "./history_picture";
import { command_of } from "../drawing/command";
import type { Next, Section, State } from "../picture";
import type { HistoryGroup, Report } from "../report";
import { plain } from "../drawing/text";

const kNext: Next = { label: "List every quantity", text: "", command: command_of("history", ["."], ["--all"]) };

// The columns of the table: quantity, unit, last, change, sigmas, a year, tolerance, met.
const quantity_sentence = ({ rows }: HistoryGroup, name: string): string => {
  const [, unit, last, change, sigmas, a_year, tolerance, met] = rows.find(([quantity]) => quantity === name) ?? [];
  if (last === undefined) return `${rows.length} quantities`;
  const told = (text: string | undefined): text is string => text !== undefined && text !== "" && text !== "-";
  const changed = told(change) ? `, ${change.replace(" *", "")} since the test before (${sigmas} sigmas)` : "";
  const trend = told(a_year) ? `, ${a_year.replace(" *", "")} a year` : "";
  return `${name} ${last} ${unit}${changed}${trend}${/\d{4}-/.test(met ?? "") ? `; it meets its tolerance ${tolerance} at ${met}` : ""}.`;
};

// A date first, then a change, then a trend that is marked.
const says_of = ({ rows, first }: HistoryGroup): number => {
  const [, , , change = "", , a_year = "", , met = ""] = rows.find(([quantity]) => quantity === first) ?? [];
  return (/\d{4}-/.test(met) ? 4 : 0) + (change.includes("*") ? 2 : 0) + (a_year.includes("*") ? 1 : 0);
};

const group_section = (group: HistoryGroup, k: number): Section => ({
  id: `history-${k + 1}`,
  heading: plain(group.label, 80),
  result: quantity_sentence(group, group.first),
  says: says_of(group),
  ...(group.quantities.length > 0
    ? {
        first: {
          picture: `history-${k + 1}`,
          kind: "Tests",
          label: plain(group.label, 80),
          told: ({ quantity }: State["chosen"]) => ({ verdict: quantity_sentence(group, quantity ?? group.first), next: kNext }),
        },
      }
    : {}),
  sentences: [],
  tables: [{ title: "Quantities", heading: group.heading, rows: group.rows }],
  pictures: group.quantities.length > 0 ? [history_picture(group, k)] : [],
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
            heading: "Squareness and scales",
            result: geometry_rows.slice(0, 3).map(([what, value]) => `${what} ${value}`).join(", "),
            sentences: geometry,
            tables: [{ title: "Squareness and scales", heading: ["", "um/m", "from"], rows: geometry_rows }],
            pictures: [],
          },
        ]
      : []),
    ...(skipped.length > 0
      ? [{ id: "skipped", heading: "Skipped files", result: `${skipped.length} ${skipped.length === 1 ? "file" : "files"}`, sentences: [], tables: [], pictures: [], lists: [{ title: "Why", items: skipped }] }]
      : []),
  ];
};
