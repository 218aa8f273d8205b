// The first screen: the verdict in one sentence, a button with what to do next, and the picture that proves it. Of several
// of a kind, as targets, that with most to say, and a choice for the others.
import { element, select_of, text_in } from "../elements/elements";
import type { Figure } from "../figure/figure";
import { folded } from "./folded";
import type { First, Next, State } from "../picture";
import type { Shared } from "./shared";
import { clamped, first_sentence } from "../drawing/text";
import type { Message } from "../texts/messages";
import { english, said, type Sentence, sentence_text, t } from "../texts/texts";

export interface Proved {
  first: First;
  figure: Figure | undefined; // undefined: a table proves it
  proof: readonly HTMLElement[]; // the picture with what stands beside it, or the table
}

// A sentence of the summary.
export interface Concluded {
  text: string;
  messages: readonly Message[] | undefined;
}

const said_of = ({ text, messages }: Concluded): Sentence => said(text, messages);

// The rest of what the program concludes; the verdict itself may be told with its target before it.
const rest_of = (summary: readonly Concluded[], concluded: string, { unfolded }: Shared): HTMLElement[] => {
  const rest = summary.filter(({ text }) => text !== concluded && !text.endsWith(`: ${concluded}`));
  if (rest.length === 0) return [];
  const head = rest.length === 1 ? t.page_one_more : t.page_more({ n: rest.length });
  return [folded("summary", unfolded, [head], rest.map((one) => text_in("p", said_of(one))))];
};

const panel_of = ({ first, figure, proof }: Proved, shared: Shared): { element: HTMLElement; concluded: () => string } => {
  const verdict = element("div", { class: "verdict" });
  const next = next_step(shared);
  let shown = "";
  let concluded = "";
  const show = (chosen: State["chosen"]): void => {
    const now = first.conclusion(chosen);
    const text = sentence_text(now.verdict);
    const sentence = first_sentence(text);
    const before = now.before ?? [];
    const also = sentence_text(now.also ?? "");
    const { made_with = "" } = now;
    const all = [made_with, ...before.map(sentence_text), text, also].join("\n");
    if (all !== shown) {
      const above = before.map((one) => {
        const paragraph = text_in("p", one);
        paragraph.className = "before";
        return paragraph;
      });
      const below = text_in("p", typeof now.also === "object" ? english(first_sentence(also)) : first_sentence(also));
      below.className = "also";
      const made = made_with === "" ? [] : [element("p", { class: "made-with", title: made_with }, made_with)];
      verdict.replaceChildren(...made, ...above, text_in("p", typeof now.verdict === "string" ? sentence : english(sentence)), ...(also === "" ? [] : [below]));
    }
    shown = all;
    concluded = now.concluded ?? text;
    next.show(now.next);
  };
  if (figure) figure.watch(({ chosen }) => show(chosen));
  else show({});
  return {
    element: element("div", { class: "panel" }, element("div", { class: "conclusion" }, verdict, next.element), ...proof),
    concluded: () => concluded,
  };
};

const chooser = (all: readonly Proved[], panels: readonly HTMLElement[]): HTMLElement[] => {
  if (all.length < 2) return [];
  const labels = all.map(({ first }, k) => [String(k), clamped(first.label ?? "", 80)] as const);
  const show = (value: string): void => panels.forEach((one, k) => (one.hidden = value !== String(k)));
  return [select_of(all[0]?.first.kind ?? "", labels, show).label];
};

export const first_screen = (
  proved: readonly Proved[],
  summary: readonly Concluded[],
  shared: Shared,
): HTMLElement[] => {
  const [one] = proved;
  if (!one) {
    return summary.length === 0
      ? []
      : [element("section", { class: "first", "aria-label": t.page_verdict }, ...summary.map((one) => text_in("p", said_of(one))))];
  }
  const panels = proved.map((each) => panel_of(each, shared));
  panels.forEach((panel, k) => (panel.element.hidden = k > 0));
  const elements = panels.map((panel) => panel.element);
  const wide = !one.figure || one.proof.some((part) => part.classList.contains("side-by-side"));
  return [
    element(
      "section",
      { class: wide ? "first wide" : "first", "aria-label": t.page_verdict },
      ...chooser(proved, elements),
      ...elements,
      ...rest_of(summary, panels[0]?.concluded() ?? "", shared),
    ),
  ];
};

// The button that says what to do next. It copies the command, and says so; where the page itself can do it, it does.

const kMessage_ms = 4000;

const selected = (text: HTMLElement): void => {
  const range = document.createRange();
  range.selectNodeContents(text);
  const selection = getSelection();
  selection?.removeAllRanges();
  selection?.addRange(range);
};

// A page from a file may not be let at the clipboard: then the command is selected, and a key copies it.
const copied = async (text: HTMLElement): Promise<boolean> => {
  try {
    await navigator.clipboard.writeText(text.textContent ?? "");
    return true;
  } catch {
    selected(text);
    return document.execCommand("copy");
  }
};

export interface NextStep {
  element: HTMLElement;
  show(next: Next): void;
}

export const next_step = (shared: Shared): NextStep => {
  let text: HTMLElement = element("p", { class: "why" });
  const command = element("code", { class: "command", tabindex: "0" });
  const message = element("span", { class: "told", role: "status" });
  const button = element("button", { type: "button", class: "act" });
  let awaited = 0;
  let act: (() => void) | null | undefined;
  const tell = (what: string): void => {
    clearTimeout(awaited);
    message.textContent = what;
    awaited = setTimeout(() => (message.textContent = ""), kMessage_ms);
  };
  button.addEventListener("click", () => {
    if (shared.doing) act?.();
    else
      void copied(command).then((done) => {
        tell(done ? t.page_copied : t.page_press_to_copy);
        button.dataset.copied = String(done);
      });
  });
  const show = ({ label, text: reason = "", command: typed, action }: Next): void => {
    const why = text_in("p", reason);
    why.className = "why";
    why.hidden = sentence_text(reason) === "";
    text.replaceWith(why);
    text = why;
    command.textContent = typed;
    command.hidden = shared.doing !== undefined;
    button.textContent = label;
    button.title = shared.doing ? "" : t.page_copies;
    act = shared.doing?.(action);
    button.hidden = act === null;
  };
  const made = element("div", { class: "next" }, text, element("div", { class: "do" }, button, command, message));
  return { element: made, show };
};
