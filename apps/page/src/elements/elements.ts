// Elements of the page. Text goes in as text nodes only: what a file says is never read as markup, nor can it turn the
// direction of writing.
import { micrometres, without_turns } from "../drawing/text";
import { language, said_text, type Said } from "../texts/texts";

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

// Text longer than a paragraph, as a hostile name may be, scrolls in a box of its own. Paragraphs and items are sentences;
// headings and cells may be names. What is English on a page that is not is marked, for those who hear it.
export const text_in = <K extends keyof HTMLElementTagNameMap>(tag: K, text: Said): HTMLElementTagNameMap[K] => {
  const in_place = (part: string): string => (tag === "p" || tag === "li" ? micrometres(part) : part);
  const written = in_place(said_text(text));
  const foreign = typeof text !== "string" && language !== "en";
  if (foreign && text.before !== "" && written.length <= 1200) {
    return element(tag, {}, `${text.before} `, element("span", { lang: "en" }, in_place(text.english)));
  }
  const spoken: Record<string, string> = foreign ? { lang: "en" } : {};
  return written.length > 1200
    ? element(tag, spoken, element("span", { class: "long", tabindex: "0" }, written))
    : element(tag, spoken, written);
};
