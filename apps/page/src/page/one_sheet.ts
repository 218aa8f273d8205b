// The sheet to hand over, for paper alone: it stands first in print, and by itself where its button asked for it. Of one
// ballbar test it is the test's; of all else it has what the first screen has. Its picture is as it is on the page.
import { button, element } from "../elements/elements";
import { handover_sheet, kSheet_px } from "../handover/handover";
import { section_sheet } from "../handover/section_sheet";
import { thermal_sheet } from "../handover/thermal_sheet";
import { sections_of } from "../sections";
import type { Section, State } from "../picture";
import { kErrors_picture } from "../machine_errors/errors_pictures";
import type { Report } from "../report";
import type { Shared } from "./shared";
import { t } from "../texts/texts";

const kSettled_ms = 1000; // after a choice: it takes a while to draw, and is seen on paper alone

export interface OneSheet {
  sheet: HTMLElement;
  print: HTMLElement; // its button
}

const as_address = (svg: string): string => `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;

// `first`: the section of the first screen; nothing where it has no picture. The figures of the page are there already.
export const one_sheet = (report: Report, first: Section | undefined, shared: Shared): OneSheet | null => {
  const name = first?.first?.picture;
  if (!first || name === undefined) return null;
  const figure = shared.figures.get(name);
  const drawing = (state: State | undefined): string | null =>
    (name === kErrors_picture ? handover_sheet(report, state?.chosen["error"]) : null) ??
    (first.id === "drift" || first.id === "signals" ? thermal_sheet(report, sections_of(report).flatMap(({ pictures = [] }) => pictures)) : null) ??
    section_sheet(report, first, state, shared.asked ?? "");
  const image = element("img", { alt: t.handover, width: String(kSheet_px.width), height: String(kSheet_px.height) });
  const draw = (): void => {
    image.src = as_address(drawing(figure?.state()) ?? "");
  };
  let waiting = 0;
  figure?.watch(() => {
    clearTimeout(waiting);
    waiting = window.setTimeout(draw, kSettled_ms);
  });
  const root = document.documentElement;
  const print = button(t.handover, t.handover_about, () => {
    draw();
    void image.decode().then(() => {
      root.dataset["print"] = "handover";
      window.print();
      delete root.dataset["print"];
    });
  });
  return { sheet: element("div", { class: "handover" }, image), print };
};
