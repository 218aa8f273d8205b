// A picture: data in, drawing out, nothing kept. What can change while it is looked at is in the State; figure.ts holds
// that, and draws anew when it changes. The same drawing is shown on the page, saved as a file and printed.
import type { EChartsCoreOption } from "echarts/core";
import type { NextAction, Num } from "./report";
import type { Sentence } from "./texts/texts";

// How it is drawn. still: for a file or paper, without controls, with a legend of its own.
export interface Look {
  dark: boolean;
  width_px: number;
  height_px: number;
  still: boolean;
}

// Of an x axis: from, to.
export type Range = readonly [number, number];

export interface State {
  look: Look;
  chosen: Readonly<Record<string, string>>; // of the choices, by key
  hidden: ReadonlySet<string>; // toggles that are off, by key
  window: Range | null; // of the x axis, in the unit of the table's first column; null: all
  stretch: Range | null; // selected, same unit; still.ts adds its band
  heights: Heights | null; // of one y axis; null: all
}

// A part of the y axis with this number.
export interface Heights {
  axis: number;
  range: Range;
}

// One of several: a recording, an axis to plot against.
export interface Choice {
  key: string;
  label: string;
  values: readonly { value: string; label: string }[];
  initial: string;
  slider?: Slider; // any number within it is a value too
}

// A choice of a number, in equal steps of its logarithm.
export interface Slider {
  least: number;
  most: number;
  now: (chosen: State["chosen"]) => number; // that is drawn, where none is chosen too
  text: (value: number) => string;
}

// A curve that can be switched off; the legend.
export interface Toggle {
  key: string;
  label: string;
  colour: (dark: boolean) => string;
  mark: "line" | "dashed" | "dotted" | "dot" | "band" | "bar";
  on: boolean; // at first
  quiet?: boolean; // off at first on the page, where a click brings it; a file drawn without the page has it
  group?: string; // heading of those that are switched together; all toggles of a picture have one, or none
}

// The numbers behind a picture: what is saved as CSV, read out, and taken for the statistics of a stretch. The first
// column is the x axis; names end in their units, as in all files of ballbar.
export interface Numbers {
  columns: { name: string; values: readonly (Num | string)[] }[];
}

export interface Picture {
  name: string; // of its file: "drift", "recording-1"
  title: string;
  caption: string; // what is seen, on one line: at most about 90 characters
  about?: string; // the rest, behind a button; also what a reader hears who does not see
  height_px: number;
  rows_of_text?: boolean; // as high on a narrow screen: it would not be readable lower
  in_window?: boolean; // lower where the window is, so that it is seen whole below the head of the page
  // "time": x is time in minutes, and the window is shared by all such pictures; "own": zooms by itself.
  zoom: "time" | "own" | "none";
  choices?: readonly Choice[];
  toggles: (state: Pick<State, "chosen">) => readonly Toggle[];
  draw: (state: State) => EChartsCoreOption;
  numbers: (state: State) => Numbers;
}

// A table of text, shown below the sentences.
export interface TextTable {
  title: string;
  about?: string; // what the columns mean, behind a button
  heading: readonly string[];
  rows: readonly (readonly string[])[];
  // Rows that, hovered or focused, choose something in a picture of the same section.
  choose?: Choosing;
  row_titles?: readonly string[]; // seen where the pointer rests on a row
  at_first?: number; // rows; the others behind a button
  // An action a row, which its first cell does on a page that can.
  acts?: { title: string; actions: readonly PageAction[] };
  // Two rows that are ticked are compared, the earlier with the later, on a page that can.
  pairs?: { label: string; title: string; tests: readonly { files: readonly string[]; plane: string; date: string }[] };
  marks?: { column: number; of: readonly ("pass" | "warning" | "fail" | "")[] }; // a row each, seen as a coloured dot too
  // Shares of the largest, 0 to 1, drawn below the text of a column's cells.
  bars?: { column: number; shares: readonly Num[] };
}

export interface Choosing {
  picture: string;
  key: string; // of the choice
  values: readonly string[]; // one a row
  focus_keeps?: boolean; // what the focus came to stays chosen when it goes
  space?: string; // key of a toggle that the space bar switches
}

export interface List {
  title: string;
  items: readonly Sentence[];
}

// What stands beside a picture and below both, and tells of what is chosen in the picture.
export interface Companion {
  picture: string;
  key: string; // of the choice that it tells of
  above?: TextTable; // the same for all
  notes: (chosen: string) => Notes;
  page?: (chosen: State["chosen"]) => Leaf | null; // below its table, of all that is chosen; null: nothing is
}

// What is known of a thing that is chosen: its name, and paragraphs, each under a word.
export interface Leaf {
  title: string;
  summary: Sentence;
  parts: readonly { name: string; text: Sentence }[];
}

export interface Notes {
  table: TextTable;
  sentences: readonly Sentence[]; // below, as the rest
  lists: readonly List[];
  tables: readonly TextTable[];
}

// What a button does on a page with the program.
export type PageAction =
  | (NextAction & { action: "add" | "try" | "free" | "plan" }) // as the program proposes
  | { action: "find"; target?: string } // what is missing
  | { action: "show"; section: string }
  | { action: "open"; files: readonly string[] } // a test alone
  | { action: "compare"; before: readonly string[]; after: readonly string[] }
  | { action: "trend" } // of all tests over time
  | { action: "test_again" } // a later test of the same machine
  | { action: "columns" } // how a log is read
  | { action: "predict" };

// What to do next.
export interface Next {
  label: string; // of its button, a few words
  text?: Sentence; // a sentence beside it
  command: string; // to paste, on a page without the program
  action: PageAction | null; // on one with it; null: there is no button
}

// What a section has for the first screen, if it is the one with most to say.
export interface First {
  picture?: string; // of the section: what proves the verdict
  table?: TextTable; // the same, where it is no picture
  kind?: string; // of what several sections can be chosen there: "Target"
  label?: string; // of this one: "y_um"
  conclusion: (chosen: State["chosen"]) => Conclusion; // of what is chosen in the picture
}

export interface Conclusion {
  made_with?: string; // above all, on one line: machine, date, feed
  before?: readonly Sentence[]; // above it, in smaller letters: what it does not rest on
  verdict: Sentence;
  also?: Sentence; // below it, in smaller letters
  concluded?: string; // the program's sentence that the verdict is
  next: Next;
}

export interface Section {
  id: string;
  heading: string;
  result: string; // what is in it, on one line with its number: stands beside the heading while the section is folded
  says?: number; // how much it has to say among sections of its kind, 0 where it is left out; see sections.ts
  first?: First;
  sentences?: readonly Sentence[];
  command?: string; // to copy, below the first sentence
  above?: readonly TextTable[]; // tables above the pictures
  tables?: readonly TextTable[];
  pictures?: readonly Picture[];
  lists?: readonly List[];
  companion?: Companion;
}
