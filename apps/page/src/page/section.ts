// A section of the page: sentences first, then pictures, tables and lists.
import { element, text_in } from "./elements";
import { figure_of } from "../figure/figure";
import type { Section, TextTable } from "../picture";
import type { Shared } from "./shared";
import { table_of } from "./table";

const text_table = (table: TextTable, shared: Shared): HTMLElement => {
  const { choose } = table;
  if (!choose) return table_of(table);
  // A row under the pointer, or reached with the tabulator, is shown in the picture; afterwards none is, where the
  // picture can do without.
  return table_of({
    ...table,
    row(made, index) {
      const show = (value: string) => () => shared.figures.get(choose.picture)?.choose(choose.key, value);
      made.tabIndex = 0;
      made.className = "chooses";
      for (const event of ["pointerenter", "focus"]) made.addEventListener(event, show(choose.values[index] ?? ""));
      for (const event of ["pointerleave", "blur"]) made.addEventListener(event, show(""));
    },
  });
};

export const section_of = (section: Section, shared: Shared): HTMLElement => {
  const made = element("section", { id: section.id, "aria-labelledby": `${section.id}-heading` });
  made.append(element("h2", { id: `${section.id}-heading` }, section.heading));
  made.append(...section.sentences.map((sentence) => text_in("p", sentence)));
  const of_none = ({ choose }: TextTable): boolean => !section.pictures.some(({ name }) => name === choose?.picture);
  for (const picture of section.pictures) {
    const figure = figure_of(picture, shared);
    shared.add(figure);
    made.append(figure.element);
    // What is chosen in a table is looked at right above it.
    const choosing = section.tables.filter(({ choose }) => choose?.picture === picture.name);
    made.append(...choosing.map((table) => text_table(table, shared)));
  }
  made.append(...section.tables.filter(of_none).map((table) => text_table(table, shared)));
  for (const { title, items } of section.lists ?? []) {
    if (items.length === 0) continue;
    made.append(element("h3", {}, title), element("ul", {}, ...items.map((item) => text_in("li", item))));
  }
  return made;
};
