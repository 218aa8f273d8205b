// The numbers behind a picture, as a table that is made when it is opened and only then.
import { rows_of } from "./csv";
import { element } from "../elements/elements";
import type { Numbers } from "../picture";
import { table_of } from "../elements/table";
import { shown } from "../drawing/theme";
import { t } from "../texts/texts";

const kRows = 200;

const rows_from = (numbers: Numbers): string[][] =>
  Array.from({ length: Math.min(kRows, rows_of(numbers)) }, (_, row) =>
    numbers.columns.map(({ values }) => {
      const value = values[row] ?? null;
      return typeof value === "string" ? value : shown(value);
    }),
  );

export interface NumbersTable {
  element: HTMLDetailsElement;
  update(): void;
}

export const numbers_table = (title: string, numbers: () => Numbers): NumbersTable => {
  const body = element("div");
  const details = element(
    "details",
    { class: "numbers" },
    element("summary", {}, t.figure_numbers),
    body,
  );
  let shown_last: Numbers | null = null;
  const update = (): void => {
    if (!details.open) return;
    const all = numbers();
    if (all === shown_last) return;
    shown_last = all;
    const rows = rows_of(all);
    const heading = all.columns.map((column) => column.name);
    const note = rows > kRows ? t.figure_first_rows({ shown: kRows, rows }) : t.figure_rows({ rows });
    body.replaceChildren(table_of({ title, heading, rows: rows_from(all) }), element("p", { class: "note" }, note));
  };
  details.addEventListener("toggle", update);
  return { element: details, update };
};
