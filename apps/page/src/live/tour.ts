// A tour of one minute: each step points at a thing and does it. By keyboard too; Escape leaves.
import { button, element } from "../elements/elements";
import { t } from "../texts/texts";

export interface Step {
  text: string;
  at: () => Element | null; // what it points at
  act?: () => Promise<void>; // done with the button that goes on
}

export const tour = (steps: readonly Step[]): { leave(): void } => {
  let k = 0;
  let pointed: Element | null = null;
  const text = element("p", { id: "tour-text" });
  const count = element("p", { class: "note" });
  const next = button(t.live_tour_next, "", () => void go());
  const end = button(t.live_tour_end, "", () => leave());
  const box = element(
    "div",
    { class: "live-tour", role: "dialog", "aria-label": t.live_tour, "aria-describedby": "tour-text" },
    count,
    text,
    element("div", { class: "buttons" }, next, end),
  );
  const point = (at: Element | null): void => {
    pointed?.classList.remove("pointed");
    pointed = at;
    pointed?.classList.add("pointed");
    pointed?.scrollIntoView({ block: "center", behavior: "instant" });
  };
  const show = (): void => {
    const step = steps[k];
    if (!step) return leave();
    box.dataset.step = String(k + 1);
    count.textContent = t.live_tour_step({ step: k + 1, all: steps.length });
    text.textContent = step.text;
    next.textContent = step.act ? t.live_tour_do : t.live_tour_next;
    next.hidden = k + 1 === steps.length && !step.act;
    point(step.at());
    (next.hidden ? end : next).focus({ preventScroll: true });
  };
  const go = async (): Promise<void> => {
    next.disabled = true;
    await steps[k]?.act?.();
    next.disabled = false;
    if (!box.isConnected) return;
    ++k;
    show();
  };
  const on_key = (event: KeyboardEvent): void => {
    if (event.key !== "Escape") return;
    event.stopPropagation();
    leave();
  };
  const leave = (): void => {
    point(null);
    box.remove();
    removeEventListener("keydown", on_key, true);
  };
  addEventListener("keydown", on_key, true);
  document.body.append(box);
  show();
  return { leave };
};
