// The step of the page for a button that shows a command. Without such a step the button is left out.
import { added_by, words_of } from "./runs";
import type { Loop } from "./loop";
import type { Opened } from "./opened";

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

// null: the page has no such step for the open data.
export const action_of = (command: string, { opened, test_again, save_of }: ActionsOf): (() => void) | null => {
  const [verb, ...rest] = words_of(command);
  const [loop, subject, report] = [opened.loop(), opened.subject(), opened.report()];
  const can = verb === "add" ? loop !== null && added_by(command, loop.subject()).length > 0 : verb !== "report" || rest.includes("--diagnose");
  const act = (of: Loop): void => {
    of.act(command);
    of.element.scrollIntoView({ block: "nearest" }); // it may lie below a drift
  };
  const of_loop = loop && can ? () => act(loop) : null;
  const test = opened.test_of(command);
  if (test) return test;
  switch (verb) {
    case "errors":
      if (rest.at(-2) === "--show" && rest.at(-1) === "change") return test_again;
      return report?.machine_errors ? () => reveal("machine-errors") : of_loop;
    case "check":
      return report?.check ? () => reveal("model") : null;
    case "diagnose":
    case "report":
      if (subject && subject.compared.length > 0) return () => void opened.open(subject.group, { ...subject, compared: [] }).then(() => opened.loop()?.search());
      return of_loop ?? (subject && subject.data.length > 0 ? () => void opened.diagnose() : null);
    case "add":
    case "plan":
      return of_loop;
    case "history":
      return report?.history ? () => reveal("history-1") : null;
    case "could": // nothing is measured: what the columns are taken for
      return opened.columns.button.hidden ? null : () => opened.columns.button.click();
    case "predict":
      return subject && subject.model !== ""
        ? () => void save_of(["predict", ...subject.data, ...subject.log, "--model", subject.model, "--out", "predicted.csv"], "predicted.csv")
        : null;
    default:
      return null;
  }
};
