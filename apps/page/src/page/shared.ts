// What the figures of a page have in common: light or dark, and the window of those over time.
import type { Figure } from "../figure/figure";
import { without_turns } from "../drawing/text";
import type { PageState } from "../figure/page_state";
import type { Range } from "../picture";

export interface Shared extends PageState {
  readonly figures: ReadonlyMap<string, Figure>;
  add(figure: Figure): void;
  look(dark: boolean): void;
  act?: (command: string) => void; // does what a command says; where it is not there, commands are copied
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
    hover_time(x) {
      for (const figure of over_time()) figure.point(x);
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

// One that stays the same, of whatever the page shows now.
export const shared_now = (now: () => Shared): Shared => ({
  get figures() {
    return now().figures;
  },
  dark: () => now().dark(),
  time_window: () => now().time_window(),
  time_whole: () => now().time_whole(),
  add: (figure) => now().add(figure),
  see_time: (window) => now().see_time(window),
  hover_time: (x) => now().hover_time(x),
  look: (dark) => now().look(dark),
  say: (text) => now().say(text),
});
