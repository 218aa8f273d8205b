// The sheet to hand over, for paper alone: it stands first in print, and by itself where its button asked for it. The error
// in its picture is the one that is chosen on the page.
import { button, element } from "../elements/elements";
import { handover_sheet, kSheet_px } from "../handover/handover";
import { kErrors_picture } from "../machine_errors/errors_pictures";
import type { Report } from "../report";
import type { Shared } from "./shared";
import { t } from "../texts/texts";

const kSettled_ms = 300; // after a choice

export interface OneSheet {
  sheet: HTMLElement;
  print: HTMLElement; // its button
}

const as_address = (svg: string): string => `data:image/svg+xml;charset=utf-8,${encodeURIComponent(svg)}`;

// Nothing where the report is not of one ballbar test. The figures of the page are there already.
export const one_sheet = (report: Report, shared: Shared): OneSheet | null => {
  if (handover_sheet(report) === null) return null;
  const image = element("img", { alt: t.handover, width: String(kSheet_px.width), height: String(kSheet_px.height) });
  let drawn: string | undefined;
  const draw = (error: string | undefined): void => {
    if (image.src !== "" && error === drawn) return;
    drawn = error;
    image.src = as_address(handover_sheet(report, error) ?? "");
  };
  let waiting = 0;
  shared.figures.get(kErrors_picture)?.watch(({ chosen }) => {
    clearTimeout(waiting);
    waiting = window.setTimeout(() => draw(chosen["error"]), kSettled_ms);
  });
  const root = document.documentElement;
  const print = button(t.handover, t.handover_about, () => {
    draw(shared.figures.get(kErrors_picture)?.state().chosen["error"]);
    void image.decode().then(() => {
      root.dataset["print"] = "handover";
      window.print();
      delete root.dataset["print"];
    });
  });
  return { sheet: element("div", { class: "handover" }, image), print };
};
