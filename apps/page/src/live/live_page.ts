// The page below the live part: drawn anew for each report, in the place of the one before.
import { element } from "../elements/elements";
import { type Inside, report_page } from "../shell";
import type { Loop } from "./loop";
import type { Figure } from "../figure/figure";
import type { PageState } from "../figure/view";
import type { Report } from "../report";
import { kept_view, type Shared, shared_by_figures } from "../page/shared";
import { page_tools } from "../page/page_tools";

// What the page does for its live part.
export interface LivePage {
  state: PageState; // of the page as it is drawn now
  // In the place of the one before; a loop stands for the first screen. `again`: of the same data, so that what a reader
  // unfolded, zoomed and chose stays.
  show(report: Report, loop: Loop | null, again: boolean): void;
  clear(): void;
  add(figure: Figure): void; // one that the live part made
  on_command(act: (command: string) => void): void; // what a button does that says a command
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
  shared.act = () => undefined;
  const tools = page_tools(shared);
  place.append(tools);

  return {
    state: shared,
    shared,
    given,
    show(report, loop, again) {
      const bring_back = kept_view(shared);
      const focused = document.activeElement;
      const kept = loop?.figures() ?? [];
      shared.clear(kept);
      const { parts, draw } = open(report, shared, tools, loop && { element: loop.element, proves: loop.proves() });
      place.replaceChildren(...parts);
      draw();
      if (again) bring_back();
      for (const figure of kept) shared.add(figure);
      if (focused instanceof HTMLElement && focused.isConnected) focused.focus({ preventScroll: true });
    },
    add: (figure) => shared.add(figure),
    on_command(act) {
      shared.act = act;
    },
    clear() {
      shared.clear();
      place.replaceChildren(tools);
    },
    page_with: (report, inside) => report_page(document, report, inside),
  };
};
