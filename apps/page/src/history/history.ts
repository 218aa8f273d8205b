// A machine over its tests: a section a group of tests that can be compared, then squareness and scales.
import { history_picture } from "./history_picture";
import type { Section } from "../picture";
import type { HistoryGroup, Report } from "../report";
import { plain } from "../drawing/text";

const group_section = (group: HistoryGroup, k: number): Section => ({
  id: `history-${k + 1}`,
  heading: plain(group.label, 80),
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
            sentences: geometry,
            tables: [{ title: "Squareness and scales", heading: ["", "um/m", "from"], rows: geometry_rows }],
            pictures: [],
          },
        ]
      : []),
    ...(skipped.length > 0
      ? [{ id: "skipped", heading: "Skipped files", sentences: [], tables: [], pictures: [], lists: [{ title: "Why", items: skipped }] }]
      : []),
  ];
};
