// A section of the page, folded: its heading and its result on one line, below them sentences, pictures, tables and
// lists. What proves its verdict may stand on the first screen instead.
import { choosing_rows } from "./choosing_rows";
import { button, element, table_of, text_in } from "../elements/elements";
import { type Figure, figure_of } from "../figure/figure";
import { folded } from "./folded";
import type { Companion, Leaf, List, Section, TextTable } from "../picture";
import type { Shared } from "./shared";
import { micrometres } from "../drawing/text";
import { language } from "../texts/texts";

const acting_rows = ({ title, commands }: NonNullable<TextTable["acts"]>, action_of: NonNullable<Shared["action_of"]>) =>
  (made: HTMLTableRowElement, index: number): void => {
    const [cell] = made.cells;
    const action = action_of(commands[index] ?? "");
    if (cell && action) cell.replaceChildren(button(cell.textContent ?? "", title, action));
  };

const text_table = (table: TextTable, shared: Shared): HTMLElement => {
  if (table.choose) return table_of({ ...table, row: choosing_rows(table.choose, shared) });
  return table_of(table.acts && shared.action_of ? { ...table, row: acting_rows(table.acts, shared.action_of) } : table);
};

// A page that does the steps by itself shows no command.
const sentences_of = ({ sentences = [], command }: Section, shared: Shared): HTMLElement[] => {
  const [first, ...rest] = sentences.map((sentence) => text_in("p", sentence));
  const typed = command && !shared.action_of ? [element("pre", { class: "command", tabindex: "0" }, command)] : [];
  return [...(first ? [first] : []), ...typed, ...rest];
};

interface Parts {
  proof: HTMLElement[]; // for the first screen
  rest: HTMLElement[];
}

// What follows the sentences.
const parts_of = (section: Section, proof: string | undefined, shared: Shared): Parts => {
  const { pictures = [], tables = [] } = section;
  const made: Parts = { proof: [], rest: (section.above ?? []).map((table) => text_table(table, shared)) };
  const of_none = ({ choose }: TextTable): boolean => !pictures.some(({ name }) => name === choose?.picture);
  for (const picture of pictures) {
    const figure = figure_of(picture, shared);
    shared.add(figure);
    const above = picture.name === proof ? made.proof : made.rest;
    if (section.companion?.picture === picture.name) {
      const [both, below] = figure_with_notes(figure, section.companion, (table) => text_table(table, shared));
      above.push(both);
      made.rest.push(below);
      continue;
    }
    above.push(figure.element);
    // What is chosen in a table is looked at right above it.
    const choosing = tables.filter(({ choose }) => choose?.picture === picture.name);
    made.rest.push(...choosing.map((table) => text_table(table, shared)));
  }
  made.rest.push(...tables.filter(of_none).map((table) => text_table(table, shared)));
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
    folded(section.id, head, [...sentences_of(section, shared), ...parts.rest]),
  );
  return { element: made, proof: parts.proof, figure: proof === undefined ? undefined : shared.figures.get(proof) };
};

// A picture with what tells of it: a table beside it, the rest below both. Made when a choice is first looked at.

export const lists_of = (lists: readonly List[]): HTMLElement[] =>
  lists.flatMap(({ title, items }) =>
    items.length === 0
      ? []
      : [element("h3", {}, title), element("ul", {}, ...items.map((item) => text_in("li", item)))],
  );

// What is known of what is chosen, beside its picture.
const leaf_of = ({ title, summary, parts }: Leaf): HTMLElement[] => [
  element("h3", {}, title),
  text_in("p", summary),
  element(
    "dl",
    {},
    ...parts.flatMap(({ name, text }) => {
      const told = element("dd", {});
      told.append(...text_in("p", text).childNodes);
      if (typeof text !== "string" && language !== "en") told.lang = "en";
      return [element("dt", {}, name), told];
    }),
  ),
];

export const figure_with_notes = (
  figure: Figure,
  { key, above, notes, page }: Companion,
  made_table: (table: TextTable) => HTMLElement,
): [HTMLElement, HTMLElement] => {
  const side = element("div", { class: "ranked" });
  const below = element("div");
  const leaf = element("div", { class: "leaf", role: "region" });
  const made = new Map<string, { side: HTMLElement; below: HTMLElement }>();
  const make = (chosen: string): { side: HTMLElement; below: HTMLElement } => {
    const { table, sentences, lists, tables } = notes(chosen);
    const parts = {
      side: element("div", {}, made_table(table)),
      below: element(
        "div",
        {},
        ...sentences.map((sentence) => text_in("p", sentence)),
        ...lists_of(lists),
        ...tables.map(made_table),
      ),
    };
    side.append(parts.side);
    below.append(parts.below);
    made.set(chosen, parts);
    return parts;
  };
  let shown: string | null = null;
  let told = "";
  figure.watch(({ chosen }) => {
    const of = page?.(chosen) ?? null;
    const text = JSON.stringify(of);
    leaf.hidden = of === null;
    if (of && text !== told) {
      leaf.replaceChildren(...leaf_of(of));
      leaf.setAttribute("aria-label", of.title);
    }
    told = text;
    const now = chosen[key] ?? "";
    if (now === shown) return;
    shown = now;
    const parts = made.get(now) ?? make(now);
    for (const other of made.values()) other.side.hidden = other.below.hidden = other !== parts;
  });
  const beside = [...(above ? [element("div", { class: "summary" }, made_table(above))] : []), side, ...(page ? [leaf] : [])];
  return [element("div", { class: "side-by-side" }, figure.element, element("div", { class: "beside" }, ...beside)), below];
};
