// Tables of the page. Columns of numbers are aligned at their ends.
import type { TextTable } from "../picture";
import { button, element, text_in } from "./elements";
import { explained } from "./explained";
import { t } from "../texts/texts";

const kRows = 200; // at first; a longer table is a slow page

// "12.01 ± 0.04", "0.27 → 0.08", "13 of 13", "0,016 (2 %)", "< 0.1 %", "1*"; not "8 min, XY CCW".
const number = /^([<>] )?[-+−–]?\d[\d.,]*(e[-+]?\d+)?\*?( ?(±|→|->|of|von|\/) ?\S+)?( %| \(\d+ %\))?$|^–?$/;
const numeric = (text: string): boolean => number.test(text) || text === t.drift_reference;

// A column of numbers: no cell below the heading is anything else.
const numeric_columns = (rows: readonly (readonly string[])[], columns: number): boolean[] =>
  Array.from(
    { length: columns },
    (_, k) => rows.length > 0 && rows.slice(0, kRows).every((row) => numeric(row[k] ?? "")),
  );

export interface TableOf extends Pick<TextTable, "title" | "about" | "heading" | "rows" | "bars"> {
  row?: (made: HTMLTableRowElement, index: number) => void;
}

// Its length is a property, not an attribute: the page allows no styles in its markup.
const bar_in = (cell: Element | undefined, share: number): void => {
  if (!(cell instanceof HTMLElement)) return;
  cell.classList.add("bar");
  cell.style.setProperty("--share", String(Math.min(1, Math.max(0, share))));
};

let explained_tables = 0;

const caption_of = (title: string, about: string): HTMLElement => {
  if (about === "") return element("caption", {}, element("span", { class: "stays" }, title));
  explained_tables += 1;
  const { button: more, note } = explained(`about-table-${explained_tables}`, title, about);
  return element("caption", {}, element("div", { class: "stays" }, title, " ", more, note));
};

export const table_of = ({ title, about = "", heading, rows, bars, row }: TableOf): HTMLElement => {
  const numbers = numeric_columns(rows, heading.length);
  const kind = (k: number): Record<string, string> => (numbers[k] ? { class: "number" } : {});
  const cell = (tag: "td" | "th", text: string, k: number): HTMLElement => {
    const made = text_in(tag, text);
    for (const [name, value] of Object.entries(kind(k))) made.setAttribute(name, value);
    return made;
  };
  const head = element("tr", {}, ...heading.map((text, k) => cell(text === "" ? "td" : "th", text, k)));
  for (const one of head.querySelectorAll("th")) one.setAttribute("scope", "col");
  const body = element("tbody");
  const append = (from: number, to: number): void => {
    for (let k = from; k < Math.min(to, rows.length); ++k) {
      const made = element("tr", {}, ...(rows[k] ?? []).map((text, column) => cell("td", text, column)));
      const share = bars?.shares[k] ?? null;
      if (bars && share !== null) bar_in(made.children[bars.column], share);
      row?.(made, k);
      body.append(made);
    }
  };
  append(0, kRows);
  const table = element("table", {}, caption_of(title, about), element("thead", {}, head), body);
  // Scrolled by its keys when it has the focus; where its rows can have it, that is no stop of its own.
  const stop: Record<string, string> = row && rows.length > 0 ? {} : { tabindex: "0" };
  const scroll = element("div", { class: "table", ...stop, role: "group", "aria-label": title }, table);
  if (rows.length <= kRows) return scroll;
  const all = button(t.elements_all_rows({ rows: rows.length }), "", () => {
    append(kRows, rows.length);
    all.remove();
  });
  return element("div", {}, scroll, all);
};
