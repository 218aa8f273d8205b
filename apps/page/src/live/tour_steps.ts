// The steps of the tour, on the sample run with a hidden effect.
import type { Loop } from "./loop";
import type { Step } from "./tour";
import { t } from "../texts/texts";

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
  const part = (selector: string) => (): Element | null => loop()?.element.querySelector(selector) ?? null;
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
