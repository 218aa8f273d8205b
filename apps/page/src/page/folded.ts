// Parts of the page that are folded until they are wanted: by a click or a key, by a link to them, or on paper. What is
// folded now is folded again when the page is opened the next time.
import { element } from "../elements/elements";

// id: of what a link may name.
export const folded = (id: string, head: readonly (Node | string)[], parts: readonly Node[]): HTMLDetailsElement => {
  const made = element("details", { class: "folded" }, element("summary", {}, ...head), ...parts);
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
