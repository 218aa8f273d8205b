// The first screen without data: where files are dropped or chosen, sample runs, a tour, and what was here before.
import { chosen_of, type Dropped, dropped_of } from "./files";
import { button, element, text_in } from "../elements/elements";
import type { Sample } from "../engine";
import { plain } from "../drawing/text";
import { named, t } from "../texts/texts";

const kName = "ballbar";

export interface StartOf {
  samples: readonly Sample[];
  take(files: readonly Dropped[]): void;
  sample(sample: Sample): void;
  tour: (() => void) | null;
}

// Opens the choice of the browser: of files, or of a folder with all in it.
export const choosing = (label: string, title: string, folder: boolean, take: (files: readonly Dropped[]) => void): HTMLElement => {
  const input = element("input", { type: "file", multiple: "", hidden: "", ...(folder ? { webkitdirectory: "" } : {}) });
  input.addEventListener("change", () => {
    take(chosen_of(input));
    input.value = "";
  });
  return element("span", { class: "choosing" }, input, button(label, title, () => input.click()));
};

// The same of files, without a button of its own: called while a click is handled.
export const file_chooser = (take: (files: readonly Dropped[]) => void): (() => void) => {
  const input = element("input", { type: "file", multiple: "", hidden: "", "aria-label": t.change_choose_after });
  input.addEventListener("change", () => {
    take(chosen_of(input));
    input.value = "";
  });
  document.body.append(input);
  return () => input.click();
};

export const start_of = ({ samples, take, sample, tour }: StartOf): HTMLElement => {
  const zone = element(
    "div",
    { class: "drop" },
    element("p", { class: "here" }, t.live_drop_here),
    element("p", { class: "note" }, t.live_drop_more),
    element("div", { class: "buttons" }, choosing(t.live_choose_files, "", false, take), choosing(t.live_choose_folder, "", true, take)),
  );
  const tries = samples.map((one) => {
    const open = button(plain(one.name, 40), "", () => sample(one));
    return element("li", {}, open, text_in("span", named(t.live_sample_titles, one.title)));
  });
  return element(
    "section",
    { class: "live-start", "aria-label": t.live_drop_here },
    element("h1", {}, kName),
    element("p", {}, t.live_says),
    zone,
    element("p", { class: "note" }, t.live_private),
    ...(tries.length > 0
      ? [
          element("h2", {}, t.live_samples),
          element("ul", { class: "samples" }, ...tries),
          ...(tour ? [element("div", { class: "buttons" }, button(t.live_tour, "", tour))] : []),
        ]
      : []),
  );
};

// What the whole page hears: files that are dropped anywhere, and the keys of the loop.

// A key typed into a field is the field's, until it says that it is done.
const is_typed = ({ target }: Event): boolean => target instanceof HTMLElement && target.matches("input:not([type=range]):not([type=checkbox]):not([data-done]), textarea");

export interface Heard {
  take(files: readonly Dropped[]): void;
  undo(): void;
  redo(): void;
  stop(): void;
}

export const listen = ({ take, undo, redo, stop }: Heard): void => {
  let over = 0;
  const hovered = (by: number): void => {
    over = Math.max(0, over + by);
    document.documentElement.classList.toggle("dropping", over > 0);
  };
  const files_in = ({ dataTransfer }: DragEvent): boolean => dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragenter", (event) => files_in(event) && hovered(1));
  addEventListener("dragleave", (event) => files_in(event) && hovered(-1));
  addEventListener("dragover", (event) => files_in(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!event.dataTransfer || !files_in(event)) return;
    event.preventDefault();
    over = 0;
    hovered(0);
    void dropped_of(event.dataTransfer).then(take);
  });
  addEventListener("keydown", (event) => {
    if (event.key === "Escape") stop();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || is_typed(event)) return;
    const key = event.key.toLowerCase();
    if (key === "z" && !event.shiftKey) undo();
    else if (key === "y" || key === "z") redo();
    else return;
    event.preventDefault();
  });
};
