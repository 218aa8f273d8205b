// A section of the page: sentences first, then pictures, tables and lists.
import { beside_figure, lists_of } from "./beside";
import { choosing_rows } from "./choosing_rows";
import { element, text_in } from "../elements/elements";
import { figure_of } from "../figure/figure";
import { folded } from "./folded";
import type { Section, TextTable } from "../picture";
import type { Shared } from "./shared";
import { table_of } from "../elements/table";

const kUnfolded = 3; // sections of a kind, as models of a target each; more are opened if wanted

const text_table = (table: TextTable, shared: Shared): HTMLElement =>
  table_of(table.choose ? { ...table, row: choosing_rows(table.choose, shared) } : table);

const sentences_of = ({ sentences, command }: Section): HTMLElement[] => {
  const [first, ...rest] = sentences.map((sentence) => text_in("p", sentence));
  const typed = command ? [element("pre", { class: "command", tabindex: "0" }, command)] : [];
  return [...(first ? [first] : []), ...typed, ...rest];
};

// What follows the sentences.
const body_of = (section: Section, shared: Shared): HTMLElement[] => {
  const made: HTMLElement[] = (section.above ?? []).map((table) => text_table(table, shared));
  const of_none = ({ choose }: TextTable): boolean => !section.pictures.some(({ name }) => name === choose?.picture);
  for (const picture of section.pictures) {
    const figure = figure_of(picture, shared);
    shared.add(figure);
    if (section.beside?.picture === picture.name) {
      made.push(...beside_figure(figure, section.beside, (table) => text_table(table, shared)));
      continue;
    }
    made.push(figure.element);
    // What is chosen in a table is looked at right above it.
    const choosing = section.tables.filter(({ choose }) => choose?.picture === picture.name);
    made.push(...choosing.map((table) => text_table(table, shared)));
  }
  made.push(...section.tables.filter(of_none).map((table) => text_table(table, shared)));
  made.push(...lists_of(section.lists ?? []));
  return made;
};

export const section_of = (section: Section, shared: Shared): HTMLElement => {
  const wide: Record<string, string> = section.beside ? { class: "wide" } : {};
  const made = element("section", { id: section.id, "aria-labelledby": `${section.id}-heading`, ...wide });
  made.append(element("h2", { id: `${section.id}-heading` }, section.heading));
  made.append(...sentences_of(section));
  const body = body_of(section, shared);
  const kind = section.id.split("-")[0] ?? "";
  if (shared.nth(kind) > kUnfolded && body.length > 0) made.append(folded(section.id, body));
  else made.append(...body);
  return made;
};
