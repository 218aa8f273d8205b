// Elements of the page. Text goes in as text nodes only: what a file says is never read as markup, nor can it turn the
// direction of writing.
import { clamped, micrometres, without_turns } from "../drawing/text";
import { language, type Sentence, sentence_text, t } from "../texts/texts";
import type { TextTable } from "../picture";

export const element = <K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Readonly<Record<string, string>> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, without_turns(value));
  made.append(...children.map((one) => (typeof one === "string" ? without_turns(one) : one)));
  return made;
};

export const button = (label: string, title: string, act: () => void): HTMLButtonElement => {
  const made = element("button", { type: "button", title }, label);
  made.addEventListener("click", act);
  return made;
};

// A list of [value, label] to choose from, and the label that it stands in.
export const select_of = (
  name: string,
  values: readonly (readonly [string, string])[],
  choose: (value: string) => void = () => undefined,
): { label: HTMLElement; select: HTMLSelectElement } => {
  const select = element("select");
  for (const [value, shown] of values) select.add(new Option(shown, value));
  select.addEventListener("change", () => choose(select.value));
  return { label: element("label", { class: "choice" }, element("span", {}, name), select), select };
};

// What is opened if wanted.
export const details_of = (name: string, summary: string, ...parts: readonly Node[]): HTMLDetailsElement =>
  element("details", { class: name }, element("summary", {}, summary), ...parts);

// What a reader unfolds stays so in `unfolded`, by its name, and is unfolded again where it is made anew.
export const kept_open = (made: HTMLDetailsElement, name: string, unfolded: Set<string>): HTMLDetailsElement => {
  made.open = unfolded.has(name);
  made.addEventListener("toggle", () => void (made.open ? unfolded.add(name) : unfolded.delete(name)));
  return made;
};

// Text longer than a paragraph, as a hostile name may be, scrolls in a box of its own. Paragraphs and items are sentences;
// headings and cells may be names. What is English on a page that is not is marked, for those who hear it.
export const text_in = <K extends keyof HTMLElementTagNameMap>(tag: K, text: Sentence): HTMLElementTagNameMap[K] => {
  const in_place = (part: string): string => (tag === "p" || tag === "li" ? micrometres(part) : part);
  const written = in_place(sentence_text(text));
  const foreign = typeof text !== "string" && language !== "en";
  if (foreign && text.before !== "" && written.length <= 1200) {
    return element(tag, {}, `${text.before} `, element("span", { lang: "en" }, in_place(text.english)));
  }
  const spoken: Record<string, string> = foreign ? { lang: "en" } : {};
  return written.length > 1200
    ? element(tag, spoken, element("span", { class: "long", tabindex: "0" }, written))
    : element(tag, spoken, written);
};

// SVG with attributes only: the page allows no styles in its markup.
export const svg_element = (tag: string, attributes: Readonly<Record<string, string>>): SVGElement => {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
};

// What does not fit on one line: behind a button that opens it in place. Escape closes it.

export interface Explained {
  button: HTMLButtonElement;
  note: HTMLElement;
}

export const explained = (id: string, of: string, about: string): Explained => {
  const note = element("div", { class: "about", id }, text_in("p", about));
  note.hidden = true;
  const button = element("button", { type: "button", class: "explain", "aria-label": t.elements_about({ title: of }), "aria-controls": id }, "i");
  const show = (open: boolean): void => {
    note.hidden = !open;
    button.setAttribute("aria-expanded", String(open));
  };
  show(false);
  button.addEventListener("click", () => show(note.hidden));
  const close = (event: KeyboardEvent): void => {
    if (event.key !== "Escape" || note.hidden) return;
    show(false);
    button.focus();
    event.stopPropagation();
  };
  button.addEventListener("keydown", close);
  note.addEventListener("keydown", close);
  return { button, note };
};

// Tables of the page. Columns of numbers are aligned at their ends.

const kRows = 200; // at first; a longer table is a slow page

// "12.01 ± 0.04", "0.27 → 0.08", "13 of 13", "0,016 (2 %)", "< 0.1 %", "1*"; not "8 min, XY CCW".
const number = /^([<>] )?[-+−–]?\d[\d.,]*(e[-+]?\d+)?\*?( ?(±|→|->|of|von|\/) ?\S+)?( %| \(\d+ %\)| µm(\/m)?| ms)?$|^–?$/;
const numeric = (text: string): boolean => number.test(text) || text === t.drift_reference;

// A column of numbers: no cell below the heading is anything else.
const numeric_columns = (rows: readonly (readonly string[])[], columns: number): boolean[] =>
  Array.from(
    { length: columns },
    (_, k) => rows.length > 0 && rows.slice(0, kRows).every((row) => numeric(row[k] ?? "")),
  );

export interface TableOf extends Pick<TextTable, "title" | "about" | "heading" | "rows" | "row_titles" | "at_first" | "bars"> {
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

export const table_of = ({ title, about = "", heading, rows, row_titles, at_first = kRows, bars, row }: TableOf): HTMLElement => {
  const numbers = numeric_columns(rows, heading.length);
  const kind = (k: number): Record<string, string> => (numbers[k] || bars?.column === k ? { class: "number" } : {});
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
      if (row_titles) made.title = clamped(row_titles[k] ?? "", 100);
      row?.(made, k);
      body.append(made);
    }
  };
  append(0, at_first);
  const table = element("table", {}, caption_of(title, about), element("thead", {}, head), body);
  // Scrolled by its keys when it has the focus; where its rows can have it, that is no stop of its own.
  const stop: Record<string, string> = row && rows.length > 0 ? {} : { tabindex: "0" };
  const scroll = element("div", { class: "table", ...stop, role: "group", "aria-label": title }, table);
  if (rows.length <= at_first) return scroll;
  const all = button(t.elements_all_rows({ rows: rows.length }), "", () => {
    append(at_first, rows.length);
    all.remove();
  });
  return element("div", {}, scroll, all);
};
