// What a figure knows of the page that it is on, and tells it: light or dark, and the window of those over time.
import type { Range } from "../picture";

export interface PageState {
  dark(): boolean;
  time_window(): Range | null;
  time_whole(): Range | null; // of all figures over time that are drawn
  see_time(window: Range | null): void;
  hover_time(x: number | null): void;
  say(text: string): void; // to those who listen
}
