// The page: conclusions first, then the sections.
import { appearance } from "./page/appearance";
import { element, text_in } from "./elements/elements";
import type { Section } from "./picture";
import type { Report } from "./report";
import { section_of } from "./page/section";
import { sections_of } from "./sections";
import { shared_by_figures, type Shared } from "./page/shared";
import { embedded } from "./source";
import { engine_in } from "./engine";
import { live_page } from "./live/live_page";
import { open_live } from "./live/open_live";

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

const voice = element("div", { class: "voice", role: "status", "aria-live": "polite" });

// `by_hand`: of a live page, what stands for the first screen.
const open = (report: Report, shared: Shared, theme: HTMLElement, by_hand: HTMLElement | null): HTMLElement[] => {
  const sections = sections_of(report);
  const parts = sections.map((section) => section_of(section, shared));
  const main = element("main", {}, ...(by_hand ? [by_hand] : []), summary_of(report), ...parts);
  const short = sections[0]?.beside !== undefined;
  return [contents_of(sections, theme), header_of(report, short), main];
};

// What is on the screen is drawn at once; the rest when it comes near.
const draw_first = (shared: Shared): void => {
  for (const figure of shared.figures.values()) {
    if (figure.element.getBoundingClientRect().top < innerHeight) figure.draw_now();
  }
};

// For reading values back, as the tests of the page do.
const ready = (shared: Pick<Shared, "figures">): void => {
  Object.defineProperty(window, "ballbar", { value: shared });
  document.documentElement.dataset["ready"] = "1";
};

try {
  const engine = engine_in(document);
  const source = embedded(document);
  document.body.append(voice);
  if (engine) {
    const page = live_page(voice, source.holds() ? source.report() : null, open, draw_first);
    void open_live(engine, page).then(() => ready({ get figures() { return page.shared().figures; } }));
  } else {
    const shared = shared_by_figures(voice);
    document.body.append(...open(source.report(), shared, appearance(shared), null));
    draw_first(shared);
    ready({ figures: shared.figures });
  }
} catch (error) {
  document.body.append(element("p", { role: "alert" }, `This page cannot be shown: ${String(error)}`));
  throw error;
}
