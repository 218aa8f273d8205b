// What the figures of a page have in common: light or dark, the window of those over time, and what a reader chose in each,
// which outlives them: in another language, or with another model, they are made anew.
import type { Figure } from "../figure/figure";
import { without_turns } from "../drawing/text";
import type { PageState } from "../figure/view";
import type { PageAction, Range } from "../picture";

export interface Shared extends PageState {
  readonly figures: ReadonlyMap<string, Figure>;
  unfolded: Set<string>; // sections, by their ids
  add(figure: Figure): void;
  clear(but?: readonly Figure[]): void; // the page goes on without its figures, or with some of them
  forget(): void; // what was chosen: other data will be shown
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
    states: new Map(),
    unfolded: new Set(),
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
    },
    forget() {
      this.states = new Map(); // those of before may still write theirs
      this.unfolded = new Set();
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
