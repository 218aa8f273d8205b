// The page: the verdict and what proves it, then the sections, folded.
import { shared_by_figures } from "./page/shared";
import { one_sheet } from "./page/one_sheet";
import { page_tools } from "./page/page_tools";
import { details_of, element, text_in } from "./elements/elements";
import { canvas_of } from "./figure/charts";
import { drawn } from "./figure/still";
import { type Concluded, first_screen, type Proved } from "./page/first_screen";
import type { Section } from "./picture";
import type { Report } from "./report";
import { ranked_sections } from "./sections";
import { section_of } from "./page/section";
import { engine_of } from "./engine";
import { live_page, type Open } from "./live/live_page";
import { open_live } from "./live/open_live";
import { language_of, said, speak, t, when_spoken } from "./texts/texts";

// A session has a file or two a test; a list that long is opened if wanted.
const files_of = (files: readonly string[]): HTMLElement => {
  const list = element(
    "p",
    { class: "files", tabindex: "0" },
    ...files.flatMap((file) => [element("bdi", {}, file), " "]),
  );
  return files.length <= 3 ? list : details_of("files-of", t.page_from_files({ files: files.length }), list);
};

// The program's own in the page's language; one that a person wrote as it is.
const title_of = ({ title, title_message }: Report): string => {
  const text = said(title, title_message);
  return typeof text === "string" ? text : title;
};

const concluded_of = ({ summary, summary_message }: Report): Concluded[] => summary.map((text, k) => ({ text, messages: summary_message?.[k] }));

const header_of = (report: Report, wide: boolean): HTMLElement =>
  element(
    "header",
    wide ? { class: "wide" } : {},
    text_in("h1", title_of(report)),
    files_of(report.files),
    element("p", { class: "made" }, t.page_made({ by: report.made_by, on: report.made_on })),
  );

const contents_of = (sections: readonly Section[], ...tools: readonly HTMLElement[]): HTMLElement =>
  element(
    "nav",
    { "aria-label": t.page_contents },
    element(
      "ul",
      {},
      ...sections.map(({ id, heading }) => element("li", {}, element("a", { href: `#${id}` }, heading))),
    ),
    ...tools,
  );

// The data that `report` embedded in the page; null: it has none. A live page asks the program (live).
const embedded_report = (): Report | null => {
  const text = document.getElementById("report")?.textContent;
  if (!text) return null;
  const report = JSON.parse(text) as Report;
  if (report.format !== "ballbar-report 1") throw new Error(t.page_no_report({ format: String(report.format) }));
  return report;
};

const voice = element("div", { class: "voice", role: "status", "aria-live": "polite" });

// `by_hand`: of a live page, what stands on the first screen; `proves`: it does so in the place of the report's own, but
// for a drift, which is what its session was recorded for.
const open: Open = (report, shared, tools, by_hand) => {
  const { first, all } = ranked_sections(report);
  const drifts = report.drift !== undefined || report.five_probe !== undefined;
  const own = !by_hand?.proves || (drifts && first[0]?.id === "drift");
  const made = all.map((section) => ({ section, ...section_of(section, own && first.includes(section), shared) }));
  const proved = made.flatMap(({ section, figure, proof }): Proved[] =>
    section.first && proof.length > 0 ? [{ first: section.first, figure, proof }] : [],
  );
  // A section whose only table is on the first screen has nothing to unfold.
  const shown = made.filter(({ section: { first, lists = [] }, proof }) => !first?.table || proof.length === 0 || lists.some(({ items }) => items.length > 0));
  const main = element(
    "main",
    {},
    ...(own ? first_screen(proved, by_hand?.proves ? [] : concluded_of(report), shared) : []),
    ...(by_hand ? [by_hand.element] : []),
    ...shown.map((one) => one.element),
  );
  // Where there is no picture, as of a file that stores results alone, the only section is what there is to see.
  if (proved.length === 0 && made.length === 1) made[0]?.element.querySelector("details")?.setAttribute("open", "");
  const sheet = one_sheet(report, first[0], shared);
  return {
    parts: [
      ...(sheet ? [sheet.sheet] : []),
      contents_of(shown.map(({ section }) => section), ...(sheet ? [sheet.print] : []), tools),
      header_of(report, first[0]?.companion !== undefined || first[0]?.first?.table !== undefined || by_hand?.proves === true),
      main,
    ],
    // What is on the screen is drawn at once; the rest when it comes near.
    draw: () => proved.forEach(({ figure }) => figure?.draw_now()),
  };
};

const kSoon_ms = 200; // the first screen is drawn by then

// Browsers compile a function when it is first called: a first page is drawn before there is one to show, and let go.
const warm_up = (report: Report): void => {
  const shared = shared_by_figures(element("div"));
  const { first, all } = ranked_sections(report);
  const made = all.map((section) => ({ section, ...section_of(section, first.includes(section), shared) }));
  for (const { section, figure, proof } of made) {
    if (!section.first || !figure) continue;
    first_screen([{ first: section.first, figure, proof }], concluded_of(report), shared);
    const state = figure.state();
    const look = { ...state.look, width_px: 640, height_px: 520 };
    canvas_of(drawn(figure.picture, { ...state, look }), look.width_px, look.height_px, 1);
  }
};

// For reading values back, as the tests of the page do.
const ready = (shared: object): void => {
  Object.defineProperty(window, "ballbar", { value: shared });
  document.documentElement.dataset["ready"] = "1";
};

speak(language_of(navigator.languages));
try {
  const engine = engine_of(document);
  const given = embedded_report();
  document.body.append(voice);
  if (engine) {
    const page = live_page(voice, given, open);
    const warm = (report: string): void => {
      if (!page.shown()) warm_up(JSON.parse(report) as Report);
    };
    void engine.warmed.then((report) => setTimeout(warm, kSoon_ms, report));
    void open_live(engine, page).then(() => ready(Object.assign(Object.create(page.shared), { engine })));
  } else {
    if (!given) throw new Error(t.page_no_data);
    const place = element("div", { class: "report" });
    document.body.append(place);
    const shared = shared_by_figures(voice);
    const tools = page_tools(shared);
    const show = (): void => {
      const { parts, draw } = open(given, shared, tools, null);
      place.replaceChildren(...parts);
      draw();
    };
    show();
    when_spoken(() => {
      const top = scrollY;
      shared.clear();
      show();
      scrollTo({ top, behavior: "instant" });
    });
    ready(shared);
  }
} catch (error) {
  document.body.append(element("p", { role: "alert" }, t.page_cannot_be_shown({ why: String(error) })));
  throw error;
}
