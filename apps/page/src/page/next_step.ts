// The button that says what to do next. It copies the command, and says so; where the page itself can do it, it does.
import { element, text_in } from "../elements/elements";
import type { Next } from "../picture";
import type { Shared } from "./shared";
import { said_text, t } from "../texts/texts";

const kTold_ms = 4000;

const selected = (text: HTMLElement): void => {
  const range = document.createRange();
  range.selectNodeContents(text);
  const selection = getSelection();
  selection?.removeAllRanges();
  selection?.addRange(range);
};

// A page from a file may not be let at the clipboard: then the command is selected, and a key copies it.
const copied = async (text: HTMLElement): Promise<boolean> => {
  try {
    await navigator.clipboard.writeText(text.textContent ?? "");
    return true;
  } catch {
    selected(text);
    return document.execCommand("copy");
  }
};

export interface NextStep {
  element: HTMLElement;
  show(next: Next): void;
}

export const next_step = (shared: Shared): NextStep => {
  let text: HTMLElement = element("p", { class: "why" });
  const command = element("code", { class: "command", tabindex: "0" });
  const told = element("span", { class: "told", role: "status" });
  const button = element("button", { type: "button", class: "act" });
  let awaited = 0;
  const tell = (what: string): void => {
    clearTimeout(awaited);
    told.textContent = what;
    awaited = setTimeout(() => (told.textContent = ""), kTold_ms);
  };
  button.addEventListener("click", () => {
    const typed = command.textContent ?? "";
    if (shared.act) shared.act(typed);
    else
      void copied(command).then((done) => {
        tell(done ? t.page_copied : t.page_press_to_copy);
        button.dataset.copied = String(done);
      });
  });
  const show = (next: Next): void => {
    const why = text_in("p", next.text);
    why.className = "why";
    why.hidden = said_text(next.text) === "";
    text.replaceWith(why);
    text = why;
    command.textContent = next.command;
    button.textContent = next.label;
    button.title = shared.act ? next.command : t.page_copies;
  };
  const made = element("div", { class: "next" }, text, element("div", { class: "do" }, button, command, told));
  return { element: made, show };
};
