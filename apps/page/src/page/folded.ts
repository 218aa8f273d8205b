// Parts of the page that are folded until they are wanted: by a click or a key, by a link to them, or on paper. What is
// folded now is folded again when the page is opened the next time.
import { element, kept_open } from "../elements/elements";

interface Fold {
  id: string;
  made: HTMLDetailsElement;
  closed: boolean; // before it was printed
}

// Those of the page as it is: one that was drawn anew has let its former ones go.
const folds = new Set<Fold>();
const each = (act: (fold: Fold) => void): void => {
  for (const fold of folds) {
    if (fold.made.isConnected) act(fold);
    else folds.delete(fold);
  }
};
const meant = (link: string | null | undefined): void =>
  each(({ id, made }) => {
    if (link === `#${id}`) made.open = true;
  });

if (typeof document !== "undefined") {
  document.addEventListener("click", ({ target }) => {
    if (target instanceof Element) meant(target.closest("a")?.getAttribute("href"));
  });
  addEventListener("hashchange", () => meant(location.hash));
  addEventListener("beforeprint", () =>
    each((fold) => {
      fold.closed = !fold.made.open;
      fold.made.open = true;
    }),
  );
  addEventListener("afterprint", () =>
    each((fold) => {
      if (fold.closed) fold.made.open = false;
    }),
  );
}

// id: of what a link may name.
export const folded = (id: string, unfolded: Set<string>, head: readonly (Node | string)[], parts: readonly Node[]): HTMLDetailsElement => {
  const made = kept_open(element("details", { class: "folded" }, element("summary", {}, ...head), ...parts), id, unfolded);
  if (location.hash === `#${id}`) made.open = true;
  folds.add({ id, made, closed: false });
  return made;
};
