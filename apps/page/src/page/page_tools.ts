// What a reader may choose for the whole page: its language, light or dark.
import { button, element } from "../elements/elements";
import type { Shared } from "./shared";
import { language, languages, speak, t, when_spoken } from "../texts/texts";

export const page_tools = (shared: Shared): HTMLElement =>
  element("div", { class: "page-tools" }, language_choice(), appearance(shared));

// Light or dark: as the system has it, until the reader says otherwise. Paper is always light.

const kKey = "ballbar-theme";

// A page from a file may not be allowed to remember anything.
const remembered = (): string | null => {
  try {
    return localStorage.getItem(kKey);
  } catch {
    return null;
  }
};
const remember = (theme: string): void => {
  try {
    localStorage.setItem(kKey, theme);
  } catch {
    // then for this visit only
  }
};

// Returns the button that changes it.
export const appearance = (shared: Shared): HTMLButtonElement => {
  const system = matchMedia("(prefers-color-scheme: dark)");
  let asked = remembered();
  const apply = (): void => {
    const dark = asked === "dark" || (asked !== "light" && system.matches);
    document.documentElement.dataset["theme"] = dark ? "dark" : "light";
    change.textContent = dark ? t.page_light : t.page_dark;
    shared.look(dark);
  };
  const change = button(t.page_dark, t.page_light_or_dark, () => {
    asked = shared.dark() ? "light" : "dark";
    remember(asked);
    apply();
  });
  when_spoken(() => {
    change.title = t.page_light_or_dark;
    apply();
  });
  system.addEventListener("change", apply);
  addEventListener("beforeprint", () => shared.figures.forEach((figure) => figure.print()));
  addEventListener("afterprint", () => shared.figures.forEach((figure) => figure.printed()));
  apply();
  return change;
};

// The choice of the page's language. It is kept in the page alone, until it is closed.

export const language_choice = (): HTMLSelectElement => {
  const select = element("select", { class: "language" });
  for (const one of languages) select.add(new Option(one.name, one.language));
  select.addEventListener("change", () => {
    const chosen = languages.find((one) => one.language === select.value);
    if (chosen) speak(chosen.language);
  });
  const name = (): void => {
    select.setAttribute("aria-label", t.page_language);
    select.value = language;
  };
  when_spoken(name);
  name();
  return select;
};
