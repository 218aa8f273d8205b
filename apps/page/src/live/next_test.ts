// The run of the machine that would decide the open question. It takes long and is therefore started by a button.
import { button, details_of, element, select_of, table_of, text_in } from "../elements/elements";
import type { Diagnosed, Plan } from "../report";
import type { PlannedFiles } from "./runs";
import { save } from "../figure/files";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { duration_spoken } from "./spoken";
import { said, sentence_text, t } from "../texts/texts";
import type { Store } from "./store";

export interface NextTest {
  element: HTMLDetailsElement;
  offer(found: Diagnosed): void;
  show(): void; // the plan
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

export const next_test = (store: Store, plan: () => void): NextTest => {
  const { select: hours, label: hours_label } = select_of(
    t.live_longest,
    kHours.map((one) => [String(one), t.live_hours({ count: one })]),
    (value) => (store.plan_hours.value = Number(value)),
  );
  hours.value = String(store.plan_hours.peek());
  const takes = element("span");
  const answer = element("div", { "aria-live": "polite" });
  const start = button(t.live_plan, t.live_plan_title, plan);
  const box = details_of(
    "live-plan",
    t.live_next_test,
    element("p", { class: "about" }, t.live_next_test_about, " ", takes),
    element("div", { class: "buttons" }, hours_label, start),
    answer,
  );
  box.hidden = true;

  const parts_of = ({ plan, files }: PlannedFiles): HTMLElement[] => {
    const drawn = files.find(({ name }) => name === "plan.svg");
    const parts: HTMLElement[] = [text_in("p", said(plan.sentence, plan.message))];
    if (plan.tests.length > 0) parts.push(tests_table(plan.tests));
    if (drawn) {
      const url = URL.createObjectURL(new Blob([new Uint8Array(drawn.bytes)], { type: "image/svg+xml" }));
      const image = element("img", { src: url, alt: t.live_plan_picture, class: "plan" });
      image.addEventListener("load", () => URL.revokeObjectURL(url));
      parts.push(image);
    }
    const saves = files.map(({ name, bytes }) => button(name, t.live_save_file({ name }), () => save(name, new Blob([new Uint8Array(bytes)]))));
    if (saves.length > 0) parts.push(element("div", { class: "buttons" }, ...saves));
    return parts;
  };

  return {
    element: box,
    offer(found) {
      box.hidden = found.next_test === null;
      const ms = kSearches * store.took_ms.peek();
      takes.textContent = ms > 0 ? t.live_takes({ duration: duration_spoken(ms) }) : t.live_takes_long;
    },
    show() {
      const plan = store.plan.now.value;
      start.disabled = store.planning.value;
      answer.replaceChildren(...(plan === null ? [] : typeof plan === "function" ? [element("p", {}, plan())] : parts_of(plan)));
    },
    open() {
      box.hidden = false;
      box.open = true;
      start.focus();
      box.scrollIntoView({ block: "nearest" });
    },
  };
};
