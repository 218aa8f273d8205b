// The page: conclusions first, then the sections.
import { appearance } from "./page/appearance";
import { element, text_in } from "./elements/elements";
import type { Section } from "./picture";
import type { Report } from "./report";
import { section_of } from "./page/section";
import { sections_of } from "./sections";
import { shared_by_figures, type Shared } from "./page/shared";
import { embedded } from "./source";

// A session has a file or two a test; a list that long is opened if wanted.
const files_of = (files: readonly string[]): HTMLElement => {
  const list = element(
    "p",
    { class: "files", tabindex: "0" },
    ...files.flatMap((file) => [element("bdi", {}, file), " "]),
  );
  return files.length <= 3 ? list : element("details", {}, element("summary", {}, `From ${files.length} files`), list);
};

// Short above a section that is to be seen on the first screen.
const header_of = (report: Report, short: boolean): HTMLElement =>
  element(
    "header",
    short ? { class: "short" } : {},
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

const summary_of = (report: Report): HTMLElement =>
  element(
    "section",
    { class: "summary", "aria-label": "Summary" },
    ...report.summary.map((text) => text_in("p", text)),
  );

const open = (report: Report): Shared => {
  const voice = element("div", { class: "voice", role: "status", "aria-live": "polite" });
  const shared = shared_by_figures(voice);
  const sections = sections_of(report);
  const parts = sections.map((section) => section_of(section, shared));
  const main = element("main", {}, summary_of(report), ...parts);
  const short = sections[0]?.beside !== undefined;
  document.body.append(contents_of(sections, appearance(shared)), header_of(report, short), main, voice);
  // What is on the screen is drawn at once; the rest when it comes near.
  for (const figure of shared.figures.values()) {
    if (figure.element.getBoundingClientRect().top < innerHeight) figure.draw_now();
  }
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
