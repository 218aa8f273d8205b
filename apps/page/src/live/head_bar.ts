// Above the report: the files, what of them is looked at and how, what is running, what can be saved.
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
  saves: HTMLElement;
  work: HTMLElement;
  told: HTMLElement;
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

const last = (path: string): string => path.slice(path.lastIndexOf("/") + 1);

export const head_bar = ({ take, close, saves, work, told }: HeadOf): HeadBar => {
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
      const own = subject.model !== "" && !models.some(({ path }) => path === subject.model) ? [subject.model] : [];
      const paths = [...models.map(({ path }) => path), ...own];
      if (paths.length > 0) {
        const values = [["", t.live_no_model] as const, ...paths.map((path) => [path, last(path)] as const)];
        choices.append(choice(t.live_model_of, values, subject.model, (model) => choose({ model })));
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
