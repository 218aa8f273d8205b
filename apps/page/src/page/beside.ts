// A picture with what tells of it: a table beside it, the rest below both. Made when a choice is first looked at.
import { element, text_in } from "../elements/elements";
import type { Figure } from "../figure/figure";
import type { Beside, List, TextTable } from "../picture";

export const lists_of = (lists: readonly List[]): HTMLElement[] =>
  lists.flatMap(({ title, items }) =>
    items.length === 0
      ? []
      : [element("h3", {}, title), element("ul", {}, ...items.map((item) => text_in("li", item)))],
  );

export const beside_figure = (
  figure: Figure,
  { key, told }: Beside,
  made_table: (table: TextTable) => HTMLElement,
): [HTMLElement, HTMLElement] => {
  const beside = element("div");
  const below = element("div");
  const made = new Map<string, { beside: HTMLElement; below: HTMLElement }>();
  const make = (chosen: string): { beside: HTMLElement; below: HTMLElement } => {
    const { beside: table, sentences, lists, tables } = told(chosen);
    const parts = {
      beside: element("div", {}, made_table(table)),
      below: element(
        "div",
        {},
        ...sentences.map((sentence) => text_in("p", sentence)),
        ...lists_of(lists),
        ...tables.map(made_table),
      ),
    };
    beside.append(parts.beside);
    below.append(parts.below);
    made.set(chosen, parts);
    return parts;
  };
  let shown: string | null = null;
  figure.watch(({ chosen }) => {
    const now = chosen[key] ?? "";
    if (now === shown) return;
    shown = now;
    const parts = made.get(now) ?? make(now);
    for (const other of made.values()) other.beside.hidden = other.below.hidden = other !== parts;
  });
  return [element("div", { class: "side-by-side" }, figure.element, beside), below];
};
