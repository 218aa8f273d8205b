// Any effect of the catalogue, found by its name or a word of it in any language of the page, with the columns that suit.
import type { Signal } from "@preact/signals-core";
import { button, element } from "../elements/elements";
import type { Catalogue, CatalogueEntry } from "./catalogue";
import { details_of } from "../elements/elements";
import { plain } from "../drawing/text";
import { error_name } from "../machine_errors/error_names";
import { can_be_typed, type EffectChoice } from "./runs";
import { explained_by, in_all_languages, named, sentence_text, t } from "../texts/texts";

export interface EffectSearchOf {
  word: Signal<string>; // that is typed
  catalogue: Catalogue;
  add(label: string): void;
  beside(label: string): void; // as a hypothesis
}

export interface EffectSearch {
  element: HTMLDetailsElement;
  show(choices: readonly EffectChoice[], level: string): void; // of the model as it is
}

const effect_name = (name: string): string => error_name(name, undefined);

// Everything by which an effect is found: its names and words, what the program says of it in a line.
const words_of_effect = ({ name, summary, inputs }: CatalogueEntry): string =>
  [
    name,
    name.replaceAll("_", " "),
    summary,
    ...inputs.flatMap(({ role, meaning }) => [role, meaning]),
    ...in_all_languages((t) => `${named(t.effects, name)} ${named(t.hands_words, name.replace(/_[ab]$/, ""))}`),
  ]
    .join(" ")
    .toLowerCase();

const in_words = (entry: CatalogueEntry): string => entry.inputs.map(({ role }) => named(t.hands_inputs, role)).join(", ");

// One list an input; each offers what goes with those before it. `chosen` is the number of the choice.
const columns_chosen = (entry: CatalogueEntry, { columns }: EffectChoice): { element: HTMLElement; chosen(): number } => {
  const can = columns.map((_, k) => k).filter((k) => can_be_typed(columns[k] ?? []));
  const selects = entry.inputs.map(({ role }) =>
    element("select", { "aria-label": t.hands_column_of({ effect: effect_name(entry.name), input: named(t.hands_inputs, role) }) }),
  );
  const left = (before: number): number[] =>
    can.filter((k) => selects.slice(0, before).every((select, i) => columns[k]?.[i] === select.value));
  const renew = (from: number): void => {
    for (const [i, select] of selects.entries()) {
      if (i < from) continue;
      const offered = [...new Set(left(i).map((k) => columns[k]?.[i] ?? ""))];
      const kept = select.value;
      select.replaceChildren(...offered.map((column) => new Option(plain(column, 40), column)));
      if (offered.includes(kept)) select.value = kept;
    }
  };
  selects.forEach((select, i) => select.addEventListener("change", () => renew(i + 1)));
  renew(0);
  const lists = (columns[0]?.length ?? 0) > 0 ? selects : []; // on recordings columns bind by themselves
  return { element: element("span", { class: "columns" }, ...lists), chosen: () => left(lists.length)[0] ?? can[0] ?? -1 };
};

export const effect_search = ({ word, catalogue, add, beside }: EffectSearchOf): EffectSearch => {
  let choices: readonly EffectChoice[] = [];
  let level = "";
  const field = element("input", { type: "search", placeholder: t.hands_find_example, "aria-label": t.hands_find, autocomplete: "off", value: word.peek() });
  const list = element("ul", { class: "effects" });
  const note = element("p", { class: "note" }, t.hands_read);
  const box = details_of("live-effects", t.hands_add, field, note, list);

  const row_of = (entry: CatalogueEntry, choice: EffectChoice): HTMLElement => {
    const shown_name = effect_name(entry.name);
    const name = element("span", { class: "effect-name" }, shown_name);
    name.title = sentence_text(explained_by(entry.level, entry.name, "summary", entry.summary));
    const program = element("bdi", { class: "program" }, entry.name);
    const columns = columns_chosen(entry, choice);
    const needs = in_words(entry);
    const can = columns.chosen() >= 0;
    const label = (): string => choice.labels[columns.chosen()] ?? entry.name;
    const plus = button("+", t.live_add_title({ effect: shown_name }), () => add(label()));
    plus.className = "plus";
    plus.setAttribute("aria-label", t.live_add_title({ effect: shown_name }));
    plus.disabled = !can;
    const compare = button(t.hands_beside, t.hands_set_beside({ effect: shown_name }), () => beside(label()));
    compare.setAttribute("aria-label", t.hands_set_beside({ effect: shown_name }));
    compare.hidden = !can;
    const asked = can
      ? needs === "" || choice.columns[0]?.length === 0 ? "" : t.hands_needs({ inputs: needs })
      : needs === "" || entry.level === "recording" ? t.hands_in_model : t.hands_no_column({ inputs: needs });
    const row = element("li", { class: can ? "" : "cannot" }, plus, element("span", { class: "found" }, name, " ", program), element("span", { class: "found" }, element("span", { class: "note" }, asked), columns.element, compare));
    row.dataset.effect = entry.name;
    return row;
  };

  const draw = (): void => {
    const asked = word.value.toLowerCase().split(/[\s,()]+/).filter((word) => word !== "");
    const found = choices.flatMap((choice) => {
      const entry = catalogue.entry(choice.effect, level);
      if (!entry) return [];
      const words = words_of_effect(entry);
      return asked.every((word) => words.includes(word)) ? [{ entry, choice }] : [];
    });
    // A name that begins so before one that only mentions it; what can be added before what cannot.
    const rank = ({ entry, choice }: (typeof found)[number]): number =>
      (choice.labels.length > 0 ? 0 : 4) + (asked[0] !== undefined && !effect_name(entry.name).toLowerCase().startsWith(asked[0]) ? 1 : 0);
    found.sort((a, b) => rank(a) - rank(b));
    note.hidden = choices.length > 0 && found.length > 0;
    note.textContent = choices.length === 0 ? t.hands_read : t.hands_none_found;
    list.replaceChildren(...found.map(({ entry, choice }) => row_of(entry, choice)));
  };
  field.addEventListener("input", () => (word.value = field.value));
  box.addEventListener("toggle", () => {
    if (box.open && box.contains(document.activeElement)) field.focus({ preventScroll: true });
  });
  return {
    element: box,
    show(now, level_now) {
      choices = now;
      level = level_now;
      draw();
    },
  };
};
