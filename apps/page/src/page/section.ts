// A section of the page, folded: its heading and its result on one line, below them sentences, pictures, tables and
// lists. What proves its verdict may stand on the first screen instead.
import { beside_figure, lists_of } from "./beside";
import { choosing_rows } from "./choosing_rows";
import { element, text_in } from "../elements/elements";
import { figure_of, type Figure } from "../figure/figure";
import { folded } from "./folded";
import type { Section, TextTable } from "../picture";
import type { Shared } from "./shared";
import { table_of } from "../elements/table";
import { micrometres } from "../drawing/text";

const text_table = (table: TextTable, shared: Shared): HTMLElement =>
  table_of(table.choose ? { ...table, row: choosing_rows(table.choose, shared) } : table);

const sentences_of = ({ sentences, command }: Section): HTMLElement[] => {
  const [first, ...rest] = sentences.map((sentence) => text_in("p", sentence));
  const typed = command ? [element("pre", { class: "command", tabindex: "0" }, command)] : [];
  return [...(first ? [first] : []), ...typed, ...rest];
};

interface Parts {
  proof: HTMLElement[]; // for the first screen
  rest: HTMLElement[];
}

// What follows the sentences.
const parts_of = (section: Section, proof: string | undefined, shared: Shared): Parts => {
  const made: Parts = { proof: [], rest: (section.above ?? []).map((table) => text_table(table, shared)) };
  const of_none = ({ choose }: TextTable): boolean => !section.pictures.some(({ name }) => name === choose?.picture);
  for (const picture of section.pictures) {
    const figure = figure_of(picture, shared);
    shared.add(figure);
    const above = picture.name === proof ? made.proof : made.rest;
    if (section.beside?.picture === picture.name) {
      const [both, below] = beside_figure(figure, section.beside, (table) => text_table(table, shared));
      above.push(both);
      made.rest.push(below);
      continue;
    }
    above.push(figure.element);
    // What is chosen in a table is looked at right above it.
    const choosing = section.tables.filter(({ choose }) => choose?.picture === picture.name);
    made.rest.push(...choosing.map((table) => text_table(table, shared)));
  }
  made.rest.push(...section.tables.filter(of_none).map((table) => text_table(table, shared)));
  made.rest.push(...lists_of(section.lists ?? []));
  return made;
};

export interface MadeSection {
  element: HTMLElement;
  proof: HTMLElement[]; // what is not in it, but on the first screen
  figure: Figure | undefined; // the picture of that
}

export const section_of = (section: Section, on_first_screen: boolean, shared: Shared): MadeSection => {
  const proof = on_first_screen ? section.first?.picture : undefined;
  const parts = parts_of(section, proof, shared);
  const head = [
    element("h2", { id: `${section.id}-heading` }, section.heading),
    element("span", { class: "result" }, micrometres(section.result)),
  ];
  const made = element(
    "section",
    { id: section.id, "aria-labelledby": `${section.id}-heading` },
    folded(section.id, head, [...sentences_of(section), ...parts.rest]),
  );
  return { element: made, proof: parts.proof, figure: proof === undefined ? undefined : shared.figures.get(proof) };
};
