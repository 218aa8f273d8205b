// What a button of the report does on the open data. Where it can do nothing it is left out.
import type { Loop } from "./loop";
import type { Opened } from "./opened";
import type { PageAction } from "../picture";

export interface ActionsOf {
  opened: Opened;
  test_again(): void; // a later test of the same machine
  save_of(words: readonly string[], file: string): Promise<void>; // saves the file that it writes
}

// Unfolds the first section of this name, or of several, and goes to it.
const reveal = (id: string): void => {
  const section = document.querySelector(`section[id="${id}"], section[id^="${id}-"]`);
  if (!section) return;
  section.querySelector(":scope > details")?.setAttribute("open", "");
  section.scrollIntoView({ block: "start", behavior: "instant" });
  section.querySelector<HTMLElement>("summary")?.focus({ preventScroll: true });
};

// null: nothing, for the open data.
export const doing_of = (action: PageAction | null, { opened, test_again, save_of }: ActionsOf): (() => void) | null => {
  const [loop, subject] = [opened.loop(), opened.subject()];
  if (!action) return null;
  const in_loop = (act: (of: Loop) => void): (() => void) | null =>
    loop &&
    (() => {
      act(loop);
      loop.element().scrollIntoView({ block: "nearest" }); // it may lie below a drift
    });
  switch (action.action) {
    case "add":
    case "try":
    case "free":
    case "plan":
      return in_loop((of) => of.act(action));
    case "find":
      if (subject && subject.compared.length > 0) return () => void opened.open(subject.group, { ...subject, compared: [] }).then(() => opened.loop()?.search());
      return in_loop((of) => of.find(action.target)) ?? (subject && subject.data.length > 0 ? () => void opened.diagnose() : null);
    case "show":
      return () => reveal(action.section);
    case "open":
      return opened.opening({ data: action.files, compared: [] });
    case "compare":
      return opened.opening({ data: action.before, compared: action.after });
    case "trend":
      return subject?.view === "table" ? () => void opened.open(subject.group, { ...subject, view: "history" }) : null;
    case "test_again":
      return test_again;
    case "columns":
      return opened.columns.button.hidden ? null : () => opened.columns.button.click();
    case "predict":
      return subject && subject.model !== ""
        ? () => void save_of(["predict", ...subject.data, ...subject.log, "--model", subject.model, "--out", "predicted.csv"], "predicted.csv")
        : null;
  }
};
