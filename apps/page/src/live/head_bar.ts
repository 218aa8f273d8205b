// The bar above the report: the files, the open data and their options, running work, and what can be saved.
import type { Subject } from "./runs";
import { type Dropped, type Group, type Held, last_part } from "./files";
import { button, details_of, element, select_of } from "../elements/elements";
import { choosing } from "./start";
import { files_of } from "../drawing/command";
import { plain } from "../drawing/text";
import { t } from "../texts/texts";
import { size_spoken } from "./spoken";
import { by_date, is_history, type Other, test_label } from "./tests";
import type { TestHead } from "../report";

export interface HeadOf {
  take(files: readonly Dropped[]): void;
  close(): void;
  saves: HTMLElement;
  columns: HTMLElement; // the button
  work: HTMLElement;
  message: HTMLElement;
}

export interface Head {
  shelf: HTMLElement;
  subject: Subject | null;
  compared: readonly Group[]; // what it may be compared with
  tests: readonly TestHead[]; // of the group, where it is one of ballbar tests
  others: readonly Other[]; // tests that those looked at may be compared with
  folder: string; // the tests as a session; "": they are none
  choose(as: Partial<Subject>): void;
}

export interface HeadBar {
  element: HTMLElement;
  show(head: Head | null): void;
}

// `none`: what "" is called.
const choice = (label: string, none: string, values: readonly (readonly [string, string])[], now: string, choose: (value: string) => void): HTMLElement => {
  const made = select_of(label, [["", none] as const, ...values].map(([value, shown]) => [value, plain(shown, 60)]), choose);
  made.select.value = now;
  return made.label;
};

const by_first = ({ data, title }: Group): readonly [string, string] => [data[0] ?? "", title];

// By which tests pass or fail.
const tolerance_field = ({ tolerance_um }: Subject, choose: Head["choose"]): HTMLElement => {
  const field = element("input", { type: "number", min: "0", step: "any", "data-done": "", value: tolerance_um === null ? "" : String(tolerance_um) });
  field.addEventListener("change", () => {
    const value = Number(field.value);
    choose({ tolerance_um: field.value === "" || !Number.isFinite(value) || value <= 0 ? null : value });
  });
  return element("label", { class: "choice", title: t.tests_tolerance_title }, element("span", {}, t.tests_tolerance), field);
};

export const head_bar = ({ take, close, saves, columns, work, message }: HeadOf): HeadBar => {
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
      columns,
      saves,
      button(t.live_close, t.live_close_title, close),
    ),
  );
  bar.hidden = true;
  const all = element("div", { class: "live-head" }, bar, work, message);

  return {
    element: all,
    show(head) {
      bar.hidden = head === null;
      if (!head) return;
      shelf.replaceChildren(head.shelf);
      choices.replaceChildren();
      const { subject, compared, tests, others: other_tests, folder, choose } = head;
      if (!subject) return;
      const { models } = subject.group;
      const own = subject.model !== "" && !models.some(({ path }) => path === subject.model) ? [subject.model] : [];
      const paths = [...models.map(({ path }) => path), ...own];
      if (paths.length > 0) {
        const values = paths.map((path) => [path, last_part(path)] as const);
        choices.append(choice(t.live_model_of, t.live_no_model, values, subject.model, (model) => choose({ model })));
      }
      const alone_before = { compared: [], model: "" };
      const group = { ...alone_before, data: subject.group.data };
      const one = tests.length > 1 ? tests.find((test) => files_of(test).join("\n") === subject.data.join("\n")) : undefined;
      const whole = subject.data.join("\n") === subject.group.data.join("\n") && subject.compared.length === 0;
      if (tests.length > 1) {
        const tab = (label: string, title: string, on: boolean, as: Partial<Subject>): HTMLElement => {
          const made = button(label, title, () => choose(as));
          made.setAttribute("aria-pressed", String(on));
          return made;
        };
        const tabs = [
          tab(t.tests_tab_table, t.tests_tab_table_title, subject.view === "table", { ...group, view: "table" }),
          ...(is_history(tests) ? [tab(t.tests_trend, t.tests_tab_history_title, subject.view === "history", { ...group, view: "history" })] : []),
          ...(folder === "" ? [] : [tab(t.live_as_session, t.tests_tab_session_title, subject.data[0] === folder, { ...alone_before, view: "", data: [folder] })]),
          tab(t.tests_tab_page, t.tests_tab_page_title, whole && subject.view === "", { ...group, view: "" }),
        ];
        choices.append(element("div", { class: "tabs", role: "group", "aria-label": t.live_view }, ...tabs));
        const values = by_date(tests).map((test) => [files_of(test).join("\n"), test_label(test, tests)] as const);
        const now = one ? files_of(one).join("\n") : "";
        choices.append(choice(t.errors_test, t.change_all_tests, values, now, (value) => choose(value === "" ? { ...group, view: "table" } : { ...alone_before, view: "", data: value.split("\n") })));
      }
      if (subject.view === "table") choices.append(tolerance_field(subject, choose));
      if (other_tests.length > 0) {
        const values = other_tests.map(({ words, label }) => [words.join("\n"), label] as const);
        choices.append(
          choice(t.live_compare_with, t.live_nothing, values, subject.compared.join("\n"), (value) => {
            const other = other_tests.find(({ words }) => words.join("\n") === value);
            const words = other?.words ?? [];
            choose({ model: "", ...(other?.older ? { data: words, compared: subject.data } : { compared: words }) });
          }),
        );
      }
      const [alone, ...others] = subject.data;
      const runs = compared.filter((group) => group.kind === "series" && subject.group.kind === "series");
      if (runs.length > 0 && alone !== undefined) {
        choices.append(choice(t.live_together_with, t.live_nothing, runs.map(by_first), others[0] ?? "", (value) => choose({ data: value === "" ? [alone] : [alone, value], compared: [] })));
      }
      if (compared.length > 0 && others.length === 0 && (subject.group.kind === "session" || subject.group.kind === "series")) {
        choices.append(choice(t.live_compare_with, t.live_nothing, compared.map(by_first), subject.compared[0] ?? "", (value) => choose({ compared: value === "" ? [] : [value] })));
      }
    },
  };
};

// The present files in groups that are opened together, each with its fault.

export interface ShelfOf {
  held: readonly Held[];
  groups: readonly Group[];
  faults: ReadonlyMap<string, string>; // by path
  open: string; // key of the group that is
  choose(group: Group): void;
}

const kMost_tabs = 6; // more groups are a list

const row_of = (one: Held, fault: string | undefined): HTMLElement =>
  element(
    "li",
    fault === undefined ? {} : { class: "faulty" },
    element("bdi", {}, plain(one.name, 200)),
    element("span", { class: "note" }, `${t.live_file_kinds[one.kind]}, ${size_spoken(one.bytes)}`),
    ...(fault === undefined ? [] : [element("span", { class: "fault" }, plain(fault, 600))]),
  );

export const shelf_of = ({ held, groups, faults, open, choose }: ShelfOf): HTMLElement => {
  const listed = groups.length > kMost_tabs;
  const tabs = (listed ? [] : groups).map((group) => {
    const tab = button(plain(group.title, 60), t.live_open_group({ title: plain(group.title, 200) }), () => choose(group));
    tab.setAttribute("aria-pressed", String(group.key === open));
    return element("li", {}, tab, element("span", { class: "note" }, t.live_group_kinds[group.kind]));
  });
  const list = element("ul", {}, ...held.map((one) => row_of(one, faults.get(one.path))));
  const files = details_of("live-files", t.live_files({ count: held.length }), list);
  files.open = faults.size > 0;
  const names = groups.map(({ key, title, kind }) => [key, `${plain(title, 60)} (${t.live_group_kinds[kind]})`] as const);
  const { label, select } = select_of(t.live_opened, names, (key) => {
    const group = groups.find((one) => one.key === key);
    if (group) choose(group);
  });
  select.value = open;
  return element("div", { class: "live-shelf" }, ...(listed ? [label] : groups.length > 1 ? [element("ul", { class: "groups" }, ...tabs)] : []), files);
};
