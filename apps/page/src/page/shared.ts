// What the figures of a page have in common: light or dark, and the window of those over time.
import type { Figure } from "../figure/figure";
import { without_turns } from "../drawing/text";
import type { PageState } from "../figure/view";
import type { PageAction, Range } from "../picture";

export interface Shared extends PageState {
  readonly figures: ReadonlyMap<string, Figure>;
  add(figure: Figure): void;
  clear(but?: readonly Figure[]): void; // the page goes on without its figures, or with some of them
  look(dark: boolean): void;
  // What does it on this page; null: nothing does, for these data. Where it is not there, commands are copied.
  doing?: (action: PageAction | null) => (() => void) | null;
  asked?: string; // the options that the report was made with, where they are known
}

export const shared_by_figures = (voice: HTMLElement): Shared => {
  const figures = new Map<string, Figure>();
  let dark = false;
  let time_window: Range | null = null;
  const over_time = (): Figure[] => [...figures.values()].filter((figure) => figure.picture.zoom === "time");

  return {
    figures,
    dark: () => dark,
    time_window: () => time_window,
    time_whole() {
      const wholes = over_time().flatMap((figure) => figure.whole() ?? []);
      return wholes.length > 0 ? [Math.min(...wholes), Math.max(...wholes)] : null;
    },
    add(figure) {
      figures.set(figure.picture.name, figure);
    },
    see_time(window) {
      time_window = window;
      for (const figure of over_time()) figure.redraw();
    },
    clear(but = []) {
      for (const figure of figures.values()) if (!but.includes(figure)) figure.leave();
      figures.clear();
      time_window = null;
    },
    look(dark_now) {
      dark = dark_now;
      for (const figure of figures.values()) figure.redraw();
    },
    say(text) {
      voice.textContent = without_turns(text);
    },
  };
};

// What a reader chose, zoomed, switched off and unfolded, for when the page is written anew in another language.

const unfolded = "section[id]:has(> details[open])";

// Returns what brings it back, once the new page stands in the place of the old one.
export const kept_view = (shared: Shared): (() => void) => {
  const states = [...shared.figures].map(([name, figure]) => ({ name, state: figure.state() }));
  const ids = [...document.querySelectorAll(unfolded)].map(({ id }) => id);
  const [window, top] = [shared.time_window(), scrollY];
  return () => {
    for (const id of ids) document.getElementById(id)?.querySelector(":scope > details")?.setAttribute("open", "");
    for (const { name, state } of states) {
      const figure = shared.figures.get(name);
      if (figure && figure.state() !== state) figure.take(state);
    }
    shared.see_time(window);
    scrollTo({ top, behavior: "instant" });
  };
};
