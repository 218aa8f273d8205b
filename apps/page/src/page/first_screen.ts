// The first screen: the verdict in one sentence, a button with what to do next, and the picture that proves it. Of several
// of a kind, as targets, that with most to say, and a choice for the others.
import { element, text_in } from "../elements/elements";
import type { Figure } from "../figure/figure";
import { folded } from "./folded";
import { next_step } from "./next_step";
import type { First } from "../picture";
import type { Shared } from "./shared";
import { clamped, first_sentence } from "../drawing/text";
import { english, said_text, t } from "../texts/texts";

export interface Proved {
  first: First;
  figure: Figure;
  proof: readonly HTMLElement[]; // the picture with what stands beside it
}

// The rest of what the program concludes; the verdict itself may be told with its target before it.
const rest_of = (summary: readonly string[], told: string): HTMLElement[] => {
  const rest = summary.filter((one) => one !== told && !one.endsWith(`: ${told}`));
  if (rest.length === 0) return [];
  const head = rest.length === 1 ? t.page_one_more : t.page_more({ n: rest.length });
  return [folded("summary", [head], rest.map((text) => text_in("p", english(text))))];
};

const panel_of = ({ first, figure, proof }: Proved, shared: Shared): { element: HTMLElement; told: () => string } => {
  const verdict = element("div", { class: "verdict" });
  const next = next_step(shared);
  let shown = "";
  let told = "";
  figure.watch(({ chosen }) => {
    const now = first.told(chosen);
    const said = said_text(now.verdict);
    const sentence = first_sentence(said);
    if (said !== shown) verdict.replaceChildren(text_in("p", typeof now.verdict === "string" ? sentence : english(sentence)));
    shown = said;
    told = now.concluded ?? said;
    next.show(now.next);
  });
  return {
    element: element("div", { class: "panel" }, element("div", { class: "conclusion" }, verdict, next.element), ...proof),
    told: () => told,
  };
};

const chooser = (all: readonly Proved[], panels: readonly HTMLElement[]): HTMLElement[] => {
  if (all.length < 2) return [];
  const select = element("select");
  all.forEach(({ first }, k) => select.add(new Option(clamped(first.label, 80), String(k))));
  select.addEventListener("change", () => panels.forEach((one, k) => (one.hidden = select.value !== String(k))));
  return [element("label", { class: "choice" }, element("span", {}, all[0]?.first.kind ?? ""), select)];
};

export const first_screen = (proved: readonly Proved[], summary: readonly string[], shared: Shared): HTMLElement[] => {
  const [one] = proved;
  if (!one) {
    return summary.length === 0
      ? []
      : [element("section", { class: "first", "aria-label": t.page_verdict }, ...summary.map((text) => text_in("p", english(text))))];
  }
  const panels = proved.map((each) => panel_of(each, shared));
  panels.forEach((panel, k) => (panel.element.hidden = k > 0));
  const elements = panels.map((panel) => panel.element);
  const wide = one.proof.some((part) => part.classList.contains("side-by-side"));
  return [
    element(
      "section",
      { class: wide ? "first wide" : "first", "aria-label": t.page_verdict },
      ...chooser(proved, elements),
      ...elements,
      ...rest_of(summary, panels[0]?.told() ?? ""),
    ),
  ];
};
