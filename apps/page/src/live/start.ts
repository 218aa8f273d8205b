// The first screen without data: where files are dropped or chosen, sample runs, a tour, and what was here before.
import { chosen_of, type Dropped } from "./dropped_files";
import { button, element } from "../elements/elements";
import type { Sample } from "../engine";
import { plain } from "../drawing/text";
import { words } from "./words";

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

export const start_of = ({ samples, take, sample, tour }: StartOf): HTMLElement => {
  const zone = element(
    "div",
    { class: "drop" },
    element("p", { class: "here" }, words.drop_here),
    element("p", { class: "note" }, words.drop_more),
    element("div", { class: "buttons" }, choosing(words.choose_files, "", false, take), choosing(words.choose_folder, "", true, take)),
  );
  const tries = samples.map((one) => {
    const open = button(plain(one.name, 40), "", () => sample(one));
    return element("li", {}, open, element("span", {}, one.title));
  });
  return element(
    "section",
    { class: "live-start", "aria-label": words.drop_here },
    element("h1", {}, words.title),
    zone,
    element("p", { class: "note" }, words.private),
    ...(tries.length > 0
      ? [
          element("h2", {}, words.samples),
          element("ul", { class: "samples" }, ...tries),
          ...(tour ? [element("div", { class: "buttons" }, button(words.tour, "", tour))] : []),
        ]
      : []),
  );
};
