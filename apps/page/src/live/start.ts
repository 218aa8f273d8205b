// The first screen without data: where files are dropped or chosen, sample runs, a tour, and what was here before.
import { chosen_of, type Dropped } from "./dropped_files";
import { button, element } from "../elements/elements";
import type { Sample } from "../engine";
import { plain } from "../drawing/text";
import { t } from "../texts/texts";

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
    return element("li", {}, open, element("span", {}, one.title));
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
