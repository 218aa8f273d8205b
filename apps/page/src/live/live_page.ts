// The page below the live part: drawn anew for each report, in the place of the one before.
import { appearance } from "../page/appearance";
import { element } from "../elements/elements";
import type { Inside } from "../shell";
import type { Loop } from "./loop";
import type { PageState } from "../figure/page_state";
import type { Report } from "../report";
import { report_page } from "../shell";
import { shared_by_figures, type Shared } from "../page/shared";

// What the page does for its live part.
export interface LivePage {
  state: PageState; // of the page as it is drawn now
  show(report: Report, loop: Loop | null): void; // in the place of the one before; a loop stands for the first screen
  clear(): void;
  on_command(act: (command: string) => void): void; // what a button does that says a command
  given: Report | null; // with which the page was made
  page_with(report: Report, inside: Inside | null): string; // a page of a report, as a file
}

export type Open = (
  report: Report,
  shared: Shared,
  theme: HTMLElement,
  by_hand: { element: HTMLElement; proves: boolean } | null,
) => { parts: HTMLElement[]; draw(): void };

export const live_page = (voice: HTMLElement, given: Report | null, open: Open): LivePage & { shared: Shared } => {
  const place = element("div", { class: "live-report" });
  document.body.append(place);
  let shared = shared_by_figures(voice);
  // One that stays, of whatever report is drawn.
  const state: Shared = {
    get figures() {
      return shared.figures;
    },
    dark: () => shared.dark(),
    time_window: () => shared.time_window(),
    time_whole: () => shared.time_whole(),
    add: (figure) => shared.add(figure),
    see_time: (window) => shared.see_time(window),
    hover_time: (x) => shared.hover_time(x),
    look: (dark) => shared.look(dark),
    say: (text) => shared.say(text),
    act: (command) => act(command),
  };
  let act: (command: string) => void = () => undefined;
  const theme = appearance(state);
  place.append(theme);

  const open_folds = (): Set<string> =>
    new Set([...place.querySelectorAll("section[id]:has(> details[open])")].map(({ id }) => id));

  return {
    state,
    shared: state,
    given,
    show(report, loop) {
      const folds = open_folds();
      const { dark, window } = { dark: shared.dark(), window: shared.time_window() };
      const focused = document.activeElement;
      const scroll = scrollY;
      const kept = loop?.figure();
      for (const figure of shared.figures.values()) if (figure !== kept) figure.leave();
      shared = shared_by_figures(voice);
      shared.look(dark);
      shared.see_time(window);
      const { parts, draw } = open(report, state, theme, loop && { element: loop.element, proves: loop.proves() });
      place.replaceChildren(...parts);
      if (kept) shared.add(kept);
      for (const id of folds) document.getElementById(id)?.querySelector(":scope > details")?.setAttribute("open", "");
      draw();
      scrollTo({ top: scroll, behavior: "instant" });
      if (focused instanceof HTMLElement && focused.isConnected) focused.focus({ preventScroll: true });
    },
    on_command(act_now) {
      act = act_now;
    },
    clear() {
      for (const figure of shared.figures.values()) figure.leave();
      shared = shared_by_figures(voice);
      place.replaceChildren(theme);
    },
    page_with: (report, inside) => report_page(document, report, inside),
  };
};
