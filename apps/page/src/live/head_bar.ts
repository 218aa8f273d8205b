// Above the report: the files, what of them is looked at and how, what is running, what can be saved. Files may be
// dropped anywhere.
import type { Subject } from "./commands";
import type { Dropped } from "./dropped_files";
import { button, element } from "../elements/elements";
import type { Group } from "./groups";
import { choosing } from "./start";
import { plain } from "../drawing/text";
import { t } from "../texts/texts";

export interface HeadOf {
  take(files: readonly Dropped[]): void;
  close(): void;
  undo(): void;
  redo(): void;
  stop(): void;
  saves: HTMLElement;
  work: HTMLElement;
  told: HTMLElement;
  dropped_of(transfer: DataTransfer): Promise<Dropped[]>;
}

export interface Head {
  shelf: HTMLElement;
  subject: Subject | null;
  compared: readonly Group[]; // what it may be compared with
  folder: string; // the tests as a session; "": they are none
  choose(as: Partial<Subject>): void;
}

export interface HeadBar {
  element: HTMLElement;
  show(head: Head | null): void;
}

const choice = (label: string, values: readonly (readonly [string, string])[], now: string, choose: (value: string) => void): HTMLElement => {
  const select = element("select");
  for (const [value, shown] of values) select.add(new Option(plain(shown, 60), value));
  select.value = now;
  select.addEventListener("change", () => choose(select.value));
  return element("label", { class: "choice" }, element("span", {}, label), select);
};

// A key typed into a field is the field's.
const is_typed = ({ target }: Event): boolean => target instanceof HTMLElement && target.matches("input:not([type=range]):not([type=checkbox]), textarea");

export const head_bar = ({ take, close, undo, redo, stop, saves, work, told, dropped_of }: HeadOf): HeadBar => {
  const shelf = element("div");
  const choices = element("div", { class: "choices" });
  const bar = element(
    "div",
    { class: "live-bar" },
    shelf,
    choices,
    element(
      "div",
      { class: "buttons" },
      choosing(t.live_add_files, t.live_add_files_title, false, take),
      saves,
      button(t.live_close, t.live_close_title, close),
    ),
  );
  bar.hidden = true;
  const all = element("div", { class: "live-head" }, bar, work, told);

  let over = 0;
  const hovered = (by: number): void => {
    over = Math.max(0, over + by);
    document.documentElement.classList.toggle("dropping", over > 0);
  };
  const files_in = ({ dataTransfer }: DragEvent): boolean => dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragenter", (event) => files_in(event) && hovered(1));
  addEventListener("dragleave", (event) => files_in(event) && hovered(-1));
  addEventListener("dragover", (event) => files_in(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!event.dataTransfer || !files_in(event)) return;
    event.preventDefault();
    over = 0;
    hovered(0);
    void dropped_of(event.dataTransfer).then(take);
  });
  addEventListener("keydown", (event) => {
    if (event.key === "Escape") stop();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || is_typed(event)) return;
    const key = event.key.toLowerCase();
    if (key === "z" && !event.shiftKey) undo();
    else if (key === "y" || key === "z") redo();
    else return;
    event.preventDefault();
  });

  return {
    element: all,
    show(head) {
      bar.hidden = head === null;
      if (!head) return;
      shelf.replaceChildren(head.shelf);
      choices.replaceChildren();
      const { subject, compared, folder, choose } = head;
      if (!subject) return;
      const { models } = subject.group;
      if (models.length > 0) {
        const values = [["", t.live_no_model], ...models.map(({ path, name }) => [path, name.slice(name.lastIndexOf("/") + 1)] as const)] as const;
        const own = subject.model !== "" && !models.some(({ path }) => path === subject.model) ? [[subject.model, subject.model] as const] : [];
        choices.append(choice(t.live_model_of, [...values, ...own], subject.model, (model) => choose({ model })));
      }
      if (folder !== "") {
        const as_session = subject.data[0] === folder;
        const values = [["", t.live_as_tests], [folder, t.live_as_session]] as const;
        choices.append(choice(t.live_view, values, as_session ? folder : "", (value) => choose({ data: value === "" ? subject.group.data : [value], model: "" })));
      }
      if (compared.length > 0 && (subject.group.kind === "session" || subject.group.kind === "series")) {
        const values = [["", t.live_nothing] as const, ...compared.map(({ data, title }) => [data[0] ?? "", title] as const)];
        choices.append(choice(t.live_compare_with, values, subject.compared, (value) => choose({ compared: value })));
      }
    },
  };
};
