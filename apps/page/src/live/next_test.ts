// The run of the machine that would decide the open question. It takes long and is therefore started by a button.
import { last_part } from "./files";
import { button, details_of, element, select_of, table_of, text_in } from "../elements/elements";
import type { Diagnosed, Plan } from "../report";
import { answer_of, plan_words, reason, type Runs, type Subject, type Work } from "./runs";
import { save } from "../figure/files";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { duration_spoken } from "./spoken";
import { said, sentence_text, t } from "../texts/texts";
import type { Engine } from "../engine";

export interface PlannedFiles {
  plan: Plan;
  files: readonly { name: string; bytes: Uint8Array }[];
}

export interface NextTest {
  element: HTMLElement;
  show(found: Diagnosed): void;
  open(): void;
}

const kSearches = 60; // simulated tests are diagnosed, about
const kHours = [4, 8, 12, 24];

const tests_table = (tests: Plan["tests"]): HTMLElement =>
  table_of({
    title: t.live_tests,
    heading: [t.live_test, t.live_test_hours, t.live_p_right, t.live_p_some, t.live_p_wrong, t.live_simulated],
    rows: tests.map((one) => [
      plain(sentence_text(said(one.test, one.test_message)), 60),
      shown(one.hours),
      `${shown(one.p_right, 2)} ± ${shown(one.p_right_sigma, 2)}`,
      shown(one.p_part, 2),
      shown(one.p_wrong, 2),
      String(one.truths),
    ]),
  });

export interface NextTestOf {
  plan: (subject: Subject, hours: number) => Promise<PlannedFiles | string>; // or why not
  subject: () => Subject;
  took_ms: () => number; // the last search; 0: there was none
}

export const next_test = ({ plan, subject, took_ms }: NextTestOf): NextTest => {
  const { select: hours, label: hours_label } = select_of(
    t.live_longest,
    kHours.map((one) => [String(one), t.live_hours({ count: one })]),
  );
  hours.value = "12";
  const takes = element("span");
  const answer = element("div", { "aria-live": "polite" });
  const start = button(t.live_plan, t.live_plan_title, () => void ask());
  const box = details_of(
    "live-plan",
    t.live_next_test,
    element("p", { class: "about" }, t.live_next_test_about, " ", takes),
    element("div", { class: "buttons" }, hours_label, start),
    answer,
  );
  box.hidden = true;
  const say_duration = (): void => {
    const ms = kSearches * took_ms();
    takes.textContent = ms > 0 ? t.live_takes({ duration: duration_spoken(ms) }) : t.live_takes_long;
  };
  let pictures: string[] = [];

  const ask = async (): Promise<void> => {
    start.disabled = true;
    const planned = await plan(subject(), Number(hours.value));
    start.disabled = false;
    for (const url of pictures) URL.revokeObjectURL(url);
    pictures = [];
    if (typeof planned === "string") return answer.replaceChildren(element("p", {}, planned));
    const drawn = planned.files.find(({ name }) => name === "plan.svg");
    const parts: HTMLElement[] = [text_in("p", said(planned.plan.sentence, planned.plan.message))];
    if (planned.plan.tests.length > 0) parts.push(tests_table(planned.plan.tests));
    if (drawn) {
      const url = URL.createObjectURL(new Blob([new Uint8Array(drawn.bytes)], { type: "image/svg+xml" }));
      pictures.push(url);
      parts.push(element("img", { src: url, alt: t.live_plan_picture, class: "plan" }));
    }
    const files = planned.files.map(({ name, bytes }) => button(name, t.live_save_file({ name }), () => save(name, new Blob([new Uint8Array(bytes)]))));
    if (files.length > 0) parts.push(element("div", { class: "buttons" }, ...files));
    answer.replaceChildren(...parts);
  };

  return {
    element: box,
    show(found) {
      box.hidden = found.next_test === null;
      say_duration();
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

// A plan of the program, with the files that it wrote.

export const planned_with =
  (engine: Engine, work: Work, runs: Runs): NextTestOf["plan"] =>
  async (subject, hours) => {
    try {
      const folder = runs.free_name("plans", "plan");
      const plan = answer_of<Plan>(await work.run(plan_words(subject, hours, folder), { what: () => t.live_planning }));
      const paths = engine.list().flatMap(({ path }) => (path.startsWith(`${folder}/`) ? [path] : []));
      const files = await Promise.all(paths.map(async (path) => ({ name: last_part(path), bytes: await engine.get(path) })));
      return { plan, files };
    } catch (error) {
      return reason(error);
    }
  };
