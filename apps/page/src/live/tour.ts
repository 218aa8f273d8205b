// A tour of one minute: each step points at a thing and does it. By keyboard too; Escape leaves.
import { button, element } from "../elements/elements";
import { t } from "../texts/texts";
import type { Loop } from "./loop";

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

// The steps of the tour, on the sample run with a hidden effect.

const frame = (): Promise<void> => new Promise((done) => requestAnimationFrame(() => done()));

const kSlide_frames = 40;

// Away from the optimum and back, as a hand would.
const slide = async (loop: Loop | null, effect: string): Promise<void> => {
  const slider = loop?.first_slider(effect);
  if (!slider) return;
  const value = slider.value();
  for (let k = 0; k <= kSlide_frames; ++k) {
    slider.move(value * (1 - 0.5 * Math.sin((Math.PI * k) / kSlide_frames)));
    await frame();
  }
  loop?.to_optimum();
};

export const tour_steps = ({ loop, saves }: { loop: () => Loop | null; saves: HTMLElement }): Step[] => {
  const part = (selector: string) => (): Element | null => loop()?.element().querySelector(selector) ?? null;
  const added = (): string => loop()?.diagnosed()?.candidates[0]?.label ?? "";
  let label = "";
  return [
    { text: t.live_tour_look, at: part(".picture") },
    {
      text: t.live_tour_search,
      at: part(".hand"),
      act: async () => {
        if (!loop()?.diagnosed()) await loop()?.search();
      },
    },
    {
      text: t.live_tour_add,
      at: part(".live-candidates"),
      act: async () => {
        label = added();
        if (label !== "") await loop()?.add([label]);
      },
    },
    { text: t.live_tour_fall, at: part(".live-fall") },
    { text: t.live_tour_slide, at: part(".live-model"), act: () => slide(loop(), label) },
    { text: t.live_tour_save, at: () => saves },
  ];
};
