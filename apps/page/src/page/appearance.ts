// Light or dark: as the system has it, until the reader says otherwise. Paper is always light.
import { button } from "../elements/elements";
import type { Shared } from "./shared";
import { t, when_spoken } from "../texts/texts";

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
