// Light or dark: as the system has it, until the reader says otherwise. Paper is light.
import { button } from "./elements";
import type { Shared } from "./shared";

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
  let printing = false;
  const apply = (): void => {
    const dark = asked === "dark" || (asked !== "light" && system.matches);
    document.documentElement.dataset["theme"] = dark ? "dark" : "light";
    change.textContent = dark ? "Light" : "Dark";
    shared.look(dark && !printing, printing);
  };
  const change = button("Dark", "Light or dark page", () => {
    asked = shared.dark() ? "light" : "dark";
    remember(asked);
    apply();
  });
  const paper = (on: boolean) => () => {
    printing = on;
    apply();
    for (const figure of shared.figures.values()) figure.paper();
  };
  system.addEventListener("change", apply);
  addEventListener("beforeprint", paper(true));
  addEventListener("afterprint", paper(false));
  apply();
  return change;
};
