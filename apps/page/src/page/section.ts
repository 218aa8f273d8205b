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

const acting_rows = ({ title, actions }: NonNullable<TextTable["acts"]>, doing: NonNullable<Shared["doing"]>) =>
  (made: HTMLTableRowElement, index: number): void => {
    const [cell] = made.cells;
    const act = doing(actions[index] ?? null);
    if (cell && act) cell.replaceChildren(button(cell.textContent ?? "", title, act));
  };

const marked_rows = ({ column, of }: NonNullable<TextTable["marks"]>) =>
  (made: HTMLTableRowElement, index: number): void => {
    made.cells[column]?.setAttribute("data-judgement", of[index] ?? "");
  };

// A box before each row, and a button that compares the two that are ticked: tests of one plane.
const with_pairs = ({ label, title, tests }: NonNullable<TextTable["pairs"]>, doing: NonNullable<Shared["doing"]>) => {
  const ticked = new Set<number>();
  const boxes: HTMLInputElement[] = [];
  const compare = button(label, title, () => {
    const [before, after] = [...ticked].flatMap((k) => tests[k] ?? []).sort((a, b) => a.date.localeCompare(b.date));
    if (before && after) doing({ action: "compare", before: before.files, after: after.files })?.();
  });
  const show = (): void => {
    const planes = new Set([...ticked].map((k) => tests[k]?.plane));
    compare.disabled = ticked.size !== 2 || planes.size !== 1;
    for (const [k, box] of boxes.entries()) box.disabled = !box.checked && (ticked.size === 2 || (ticked.size === 1 && !planes.has(tests[k]?.plane)));
  };
  show();
  const row = (made: HTMLTableRowElement, index: number): void => {
    const box = element("input", { type: "checkbox", "aria-label": `${label}: ${made.cells[0]?.textContent ?? ""}` });
    box.addEventListener("change", () => {
      if (box.checked) ticked.add(index);
      else ticked.delete(index);
      show();
    });
    boxes[index] = box;
    made.cells[0]?.prepend(box, " ");
  };
  return { row, button: compare };
};

const text_table = (table: TextTable, shared: Shared): HTMLElement => {
  if (table.choose) return table_of({ ...table, row: choosing_rows(table.choose, shared) });
  const pairs = table.pairs && shared.doing && table.rows.length > 1 ? with_pairs(table.pairs, shared.doing) : null;
  const rows = [
    ...(table.acts && shared.doing ? [acting_rows(table.acts, shared.doing)] : []),
    ...(table.marks ? [marked_rows(table.marks)] : []),
    ...(pairs ? [pairs.row] : []),
  ];
  const made = table_of(rows.length > 0 ? { ...table, row: (one, k) => rows.forEach((each) => each(one, k)) } : table);
  return pairs ? element("div", {}, made, element("div", { class: "buttons" }, pairs.button)) : made;
};

// A page that does the steps by itself shows no command.
const sentences_of = ({ sentences = [], command }: Section, shared: Shared): HTMLElement[] => {
  const [first, ...rest] = sentences.map((sentence) => text_in("p", sentence));
  const typed = command && !shared.doing ? [element("pre", { class: "command", tabindex: "0" }, command)] : [];
  return [...(first ? [first] : []), ...typed, ...rest];
};

interface Parts {
  proof: HTMLElement[]; // for the first screen
  rest: HTMLElement[];
}

// What follows the sentences.
const parts_of = (section: Section, first: Section["first"], shared: Shared): Parts => {
  const { pictures = [] } = section;
  const proof = first?.picture;
  // What is not on the first screen is in the section.
  const tables = [...(section.first?.table && !first ? [section.first.table] : []), ...(section.tables ?? [])];
  const made: Parts = { proof: [], rest: (section.above ?? []).map((table) => text_table(table, shared)) };
  if (first?.table) made.proof.push(text_table(first.table, shared));
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
  const first = on_first_screen ? section.first : undefined;
  const proof = first?.picture;
  const parts = parts_of(section, first, shared);
  const head = [
    element("h2", { id: `${section.id}-heading` }, section.heading),
    element("span", { class: "result" }, micrometres(section.result)),
  ];
  const made = element(
    "section",
    { id: section.id, "aria-labelledby": `${section.id}-heading` },
    folded(section.id, shared.unfolded, head, [...sentences_of(section, shared), ...parts.rest]),
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
  let of_choices: unknown = null;
  figure.watch(({ chosen }) => {
    if (chosen === of_choices) return;
    of_choices = chosen;
    const of = page?.(chosen) ?? null;
    leaf.hidden = of === null;
    if (of) {
      leaf.replaceChildren(...leaf_of(of));
      leaf.setAttribute("aria-label", of.title);
    }
    const now = chosen[key] ?? "";
    if (now === shown) return;
    shown = now;
    const parts = made.get(now) ?? make(now);
    for (const other of made.values()) other.side.hidden = other.below.hidden = other !== parts;
  });
  const beside = [...(above ? [element("div", { class: "summary" }, made_table(above))] : []), side, ...(page ? [leaf] : [])];
  return [element("div", { class: "side-by-side" }, figure.element, element("div", { class: "beside" }, ...beside)), below];
};
