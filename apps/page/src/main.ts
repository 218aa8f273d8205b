// The page: the verdict and what proves it, then the sections, folded.
import { appearance } from "./page/appearance";
import { element, text_in } from "./elements/elements";
import { first_screen, type Proved } from "./page/first_screen";
import type { Section } from "./picture";
import type { Report } from "./report";
import { ranked_sections } from "./sections";
import { section_of } from "./page/section";
import { shared_by_figures, type Shared } from "./page/shared";
import { embedded } from "./source";

// A session has a file or two a test; a list that long is opened if wanted.
const files_of = (files: readonly string[]): HTMLElement => {
  const list = element(
    "p",
    { class: "files", tabindex: "0" },
    ...files.flatMap((file) => [element("bdi", {}, file), " "]),
  );
  return files.length <= 3 ? list : element("details", { class: "files-of" }, element("summary", {}, `From ${files.length} files`), list);
};

const header_of = (report: Report): HTMLElement =>
  element(
    "header",
    {},
    text_in("h1", report.title),
    files_of(report.files),
    element("p", { class: "made" }, `Made by ${report.made_by} on ${report.made_on}.`),
  );

const contents_of = (sections: readonly Section[], theme: HTMLElement): HTMLElement =>
  element(
    "nav",
    { "aria-label": "Contents" },
    element(
      "ul",
      {},
      ...sections.map(({ id, heading }) => element("li", {}, element("a", { href: `#${id}` }, heading))),
    ),
    theme,
  );

const open = (report: Report): Shared => {
  const voice = element("div", { class: "voice", role: "status", "aria-live": "polite" });
  const shared = shared_by_figures(voice);
  const { first, all } = ranked_sections(report);
  const made = all.map((section) => ({ section, ...section_of(section, first.includes(section), shared) }));
  const proved = made.flatMap(({ section, figure, proof }): Proved[] =>
    section.first && figure ? [{ first: section.first, figure, proof }] : [],
  );
  const main = element("main", {}, ...first_screen(proved, report.summary, shared), ...made.map((one) => one.element));
  document.body.append(contents_of(all, appearance(shared)), header_of(report), main, voice);
  // What is on the screen is drawn at once; the rest when it comes near.
  for (const { figure } of proved) figure.draw_now();
  return shared;
};

try {
  const shared = open(embedded(document).report());
  // For reading values back, as the tests of the page do.
  Object.defineProperty(window, "ballbar", { value: Object.freeze({ figures: shared.figures }) });
  document.documentElement.dataset["ready"] = "1";
} catch (error) {
  document.body.append(element("p", { role: "alert" }, `This page cannot be shown: ${String(error)}`));
  throw error;
}
