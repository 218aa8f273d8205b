// The interface of a figure for pointer and keys.
import type { Signal } from "@preact/signals-core";
import type { Heights, Range, State } from "../picture";
import type { Brush } from "./charts";

export interface View {
  box: HTMLElement; // of the chart
  whole(): Range | null; // of the x axis; null: this picture does not zoom
  window(): Range | null;
  stretch(): Range | null; // that is selected
  selecting(): boolean; // a drag selects a stretch, as with shift held
  x_at(px: number): number; // of a pixel from the left of the box
  y_at(axis: number, px: number): number; // from the top
  plot_at(x_px: number, y_px: number): number | null; // the number of its y axis; null: of none
  heights(): Heights | null;
  see(window: Range | null): void; // null: all, of the heights too
  see_heights(heights: Heights): void;
  select(stretch: Range | null, done: boolean): void;
  brush(kind: Brush): void; // what a drag draws
}

// The interface between a figure and its page: light or dark, and the common window of figures over time.

export interface PageState {
  states: Map<string, Signal<State>>; // of its figures, by their names
  dark(): boolean;
  time_window(): Range | null;
  time_whole(): Range | null; // of all figures over time that are drawn
  see_time(window: Range | null): void;
  say(text: string): void; // to those who listen
}
