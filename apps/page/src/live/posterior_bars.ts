// How probable each effect is as far as the search has come. The program tells it in lines of JSON.
import { element } from "../elements/elements";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { t } from "../texts/texts";

const kBars = 6;

interface Posterior {
  posterior: { label: string; p: number }[];
  p_nothing: number;
}

const posterior_in = (line: string): Posterior | null => {
  if (!line.startsWith("{")) return null;
  try {
    const read = JSON.parse(line) as Partial<Posterior>;
    return Array.isArray(read.posterior) ? { posterior: read.posterior, p_nothing: Number(read.p_nothing ?? 0) } : null;
  } catch {
    return null; // half a line
  }
};

export const bar_of = (label: string, p: number): HTMLElement => {
  const bar = element("span", { class: "p" });
  bar.style.setProperty("--share", String(Math.min(1, Math.max(0, p))));
  return element("li", {}, bar, element("bdi", {}, plain(label, 60)), element("span", { class: "number" }, shown(p, 2)));
};

export interface PosteriorBars {
  element: HTMLElement;
  tell(line: string): void;
  clear(): void;
}

export const posterior_bars = (): PosteriorBars => {
  const list = element("ul", { class: "live-posterior", "aria-label": t.live_posterior });
  list.hidden = true;
  return {
    element: list,
    tell(line) {
      const now = posterior_in(line);
      if (!now) return;
      const most = [...now.posterior].sort((a, b) => b.p - a.p).slice(0, kBars);
      list.replaceChildren(...most.map(({ label, p }) => bar_of(label, p)), bar_of(t.live_nothing_missing, now.p_nothing));
      list.hidden = false;
    },
    clear() {
      list.hidden = true;
      list.replaceChildren();
    },
  };
};
