// Parts of a section that are folded until they are wanted: by a click, by a link to the section, or on paper.
import { element } from "../elements/elements";

export const folded = (id: string, parts: readonly HTMLElement[]): HTMLDetailsElement => {
  const made = element("details", {}, element("summary", {}, "Pictures and tables"), ...parts);
  const meant = (link: string | null | undefined): void => {
    if (link === `#${id}`) made.open = true;
  };
  document.addEventListener("click", ({ target }) => {
    if (target instanceof Element) meant(target.closest("a")?.getAttribute("href"));
  });
  addEventListener("hashchange", () => meant(location.hash));
  meant(location.hash);
  let closed = false; // before it was printed
  addEventListener("beforeprint", () => {
    closed = !made.open;
    made.open = true;
  });
  addEventListener("afterprint", () => {
    if (closed) made.open = false;
  });
  return made;
};
