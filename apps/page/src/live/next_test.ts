// The run of the machine that would decide what is open: asked for by a button, because it takes long.
import { button, element } from "../elements/elements";
import type { Diagnosed, Num } from "../report";
import type { Subject } from "./commands";
import { save } from "./save";
import { table_of } from "../elements/table";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { words } from "./words";

export interface Planned {
  sentence: string;
  tests: { kind: string; hours: number; p_right: Num; p_right_sigma: Num; p_part: Num; p_wrong: Num; truths: number }[];
  curves: { effects: string; p: Num }[];
}

export interface PlannedFiles {
  plan: Planned;
  files: readonly { name: string; bytes: Uint8Array }[];
}

export interface NextTest {
  element: HTMLElement;
  show(found: Diagnosed): void;
  open(): void;
}

const kHours = [4, 8, 12, 24];

const tests_table = (tests: Planned["tests"]): HTMLElement =>
  table_of({
    title: words.tests,
    heading: words.tests_heading,
    rows: tests.map((one) => [
      plain(one.kind, 60),
      shown(one.hours),
      `${shown(one.p_right, 2)} ± ${shown(one.p_right_sigma, 2)}`,
      shown(one.p_part, 2),
      shown(one.p_wrong, 2),
      String(one.truths),
    ]),
  });

export const next_test = ({
  plan,
  subject,
}: {
  plan: (subject: Subject, hours: number) => Promise<PlannedFiles | string>; // or why not
  subject: () => Subject;
}): NextTest => {
  const hours = element("select");
  for (const one of kHours) hours.add(new Option(words.hours(one), String(one)));
  hours.value = "12";
  const answer = element("div", { "aria-live": "polite" });
  const start = button(words.plan, words.plan_title, () => void ask());
  const box = element(
    "details",
    { class: "live-plan" },
    element("summary", {}, words.next_test),
    element("p", { class: "about" }, words.next_test_about),
    element("div", { class: "buttons" }, element("label", { class: "choice" }, element("span", {}, words.longest), hours), start),
    answer,
  );
  box.hidden = true;
  let pictures: string[] = [];

  const ask = async (): Promise<void> => {
    start.disabled = true;
    const planned = await plan(subject(), Number(hours.value));
    start.disabled = false;
    for (const url of pictures) URL.revokeObjectURL(url);
    pictures = [];
    if (typeof planned === "string") return answer.replaceChildren(element("p", {}, planned));
    const drawn = planned.files.find(({ name }) => name === "plan.svg");
    const parts: HTMLElement[] = [element("p", {}, planned.plan.sentence)];
    if (planned.plan.tests.length > 0) parts.push(tests_table(planned.plan.tests));
    if (drawn) {
      const url = URL.createObjectURL(new Blob([new Uint8Array(drawn.bytes)], { type: "image/svg+xml" }));
      pictures.push(url);
      parts.push(element("img", { src: url, alt: words.plan_picture, class: "plan" }));
    }
    const files = planned.files.map(({ name, bytes }) => button(name, words.save_file(name), () => save(name, new Blob([new Uint8Array(bytes)]))));
    if (files.length > 0) parts.push(element("div", { class: "buttons" }, ...files));
    answer.replaceChildren(...parts);
  };

  return {
    element: box,
    show(found) {
      box.hidden = found.next_test === null;
      answer.replaceChildren();
    },
    open() {
      box.hidden = false;
      box.open = true;
      start.focus();
      box.scrollIntoView({ block: "nearest" });
    },
  };
};
