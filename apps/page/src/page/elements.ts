// Elements of the page. Text goes in as text nodes only: what a file says is never read as markup.
export const element = <K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Readonly<Record<string, string>> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
};

export const button = (label: string, title: string, act: () => void): HTMLButtonElement => {
  const made = element("button", { type: "button", title }, label);
  made.addEventListener("click", act);
  return made;
};

// Text longer than a paragraph, as a hostile name may be, scrolls in a box of its own.
export const text_in = <K extends keyof HTMLElementTagNameMap>(tag: K, text: string): HTMLElementTagNameMap[K] =>
  text.length > 1200
    ? element(tag, {}, element("span", { class: "long", tabindex: "0" }, text))
    : element(tag, {}, text);
