// The page below the live part: redrawn for each report.
import { element } from "../elements/elements";
import { type Inside, report_page } from "../shell";
import type { Loop } from "./loop";
import type { Figure } from "../figure/figure";
import type { PageState } from "../figure/view";
import type { PageAction } from "../picture";
import type { Report } from "../report";
import { type Shared, shared_by_figures } from "../page/shared";
import { page_tools } from "../page/page_tools";

// The functions of the page for its live part.
export interface LivePage {
  state: PageState; // of the page as it is drawn now
  // In the place of the one before; a loop stands for the first screen. `again`: of the same data, so that what a
  // reader unfolded, zoomed and chose stays.
  show(report: Report, loop: Loop | null, again: boolean): void;
  forget(): void; // what a reader chose: other data will be shown
  made_with(options: string): void; // the report that is shown next
  shown(): boolean; // whether a report is, or was
  clear(): void;
  // What a button does; null: nothing, and the button is left out.
  on_action(doing: (action: PageAction | null) => (() => void) | null): void;
  add(figure: Figure): void; // one that the live part made
  given: Report | null; // with which the page was made
  page_with(report: Report, inside: Inside | null): string; // a page of a report, as a file
}

export type Open = (
  report: Report,
  shared: Shared,
  tools: HTMLElement,
  by_hand: { element: HTMLElement; proves: boolean } | null,
) => { parts: HTMLElement[]; draw(): void };

export const live_page = (voice: HTMLElement, given: Report | null, open: Open): LivePage & { shared: Shared } => {
  const place = element("div", { class: "live-report" });
  document.body.append(place);
  const shared = shared_by_figures(voice);
  shared.doing = () => null;
  const tools = page_tools(shared);
  place.append(tools);
  // Without a report the tools stand above all; else in its own line.
  const without_report = (on: boolean): void => void document.documentElement.classList.toggle("no-report", on);
  without_report(true);

  let shown = false;
  return {
    state: shared,
    shared,
    given,
    shown: () => shown,
    show(report, loop, again) {
      shown = true;
      const top = scrollY;
      const focused = document.activeElement;
      const kept = loop?.figures() ?? [];
      shared.clear(kept);
      const { parts, draw } = open(report, shared, tools, loop && { element: loop.element(), proves: loop.proves() });
      without_report(false);
      place.replaceChildren(...parts);
      draw();
      for (const figure of kept) shared.add(figure);
      if (again) scrollTo({ top, behavior: "instant" });
      if (focused instanceof HTMLElement && focused.isConnected) focused.focus({ preventScroll: true });
    },
    made_with(options) {
      shared.asked = options;
    },
    forget: () => shared.forget(),
    add: (figure) => shared.add(figure),
    on_action(doing) {
      shared.doing = doing;
    },
    clear() {
      shared.clear();
      without_report(true);
      place.replaceChildren(tools);
    },
    page_with: (report, inside) => report_page(document, report, inside),
  };
};
