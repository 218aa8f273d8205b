// What does not fit on one line: behind a button that opens it in place. Escape closes it.
import { element, text_in } from "./elements";
import { t } from "../texts/texts";

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
