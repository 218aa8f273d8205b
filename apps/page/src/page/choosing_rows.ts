// Rows of a table that choose something in a picture. Under the pointer, or focused, a row is shown for as long as it is;
// a click or Enter keeps it. The table is one stop of the tabulator, and the arrow keys go from row to row. Rows of what
// is chosen are marked.
import type { Choosing } from "../picture";
import type { Shared } from "./shared";

type Row = HTMLTableRowElement;

const of_key = (made: Row, key: string): Element | null | undefined => {
  switch (key) {
    case "ArrowUp":
      return made.previousElementSibling;
    case "ArrowDown":
      return made.nextElementSibling;
    case "Home":
      return made.parentElement?.firstElementChild;
    case "End":
      return made.parentElement?.lastElementChild;
    default:
      return null;
  }
};

// What is to be done with each row as it is made.
export const choosing_rows = (choose: Choosing, shared: Shared): ((made: Row, index: number) => void) => {
  let kept = ""; // chosen before a row was shown; counts while one is
  let shown = ""; // by a row; where something else is chosen by now, that is kept
  let hovered: string | null = null;
  let focused: string | null = null;
  let stop: Row | null = null; // of the tabulator

  const show = (change: () => void): void => {
    const figure = shared.figures.get(choose.picture);
    if (!figure) return;
    const chosen = (): string => figure.state().chosen[choose.key] ?? "";
    if ((hovered === null && focused === null) || chosen() !== shown) kept = chosen();
    change();
    figure.choose(choose.key, hovered ?? focused ?? kept);
    shown = chosen();
  };

  const rows: { made: Row; value: string }[] = [];
  const mark = ({ made, value }: { made: Row; value: string }, chosen: string | undefined): void => {
    if (value === chosen) made.setAttribute("aria-current", "true");
    else made.removeAttribute("aria-current");
  };
  shared.figures.get(choose.picture)?.watch(({ chosen }) => rows.forEach((row) => mark(row, chosen[choose.key])));

  // Of the space bar: a curve of the picture, where it has one now.
  const turn = (key: string): void => {
    const figure = shared.figures.get(choose.picture);
    if (figure) figure.turn(key, figure.state().hidden.has(key));
  };

  return (made, index) => {
    const value = choose.values[index] ?? "";
    rows.push({ made, value });
    mark({ made, value }, shared.figures.get(choose.picture)?.state().chosen[choose.key]);
    const keep = (): void => show(() => (kept = value));
    made.className = "chooses";
    made.tabIndex = stop ? -1 : 0;
    stop ??= made;
    made.addEventListener("pointerenter", () => show(() => (hovered = value)));
    made.addEventListener("pointerleave", () => show(() => (hovered = null)));
    made.addEventListener("focus", () => {
      if (stop) stop.tabIndex = -1;
      stop = made;
      made.tabIndex = 0;
      show(() => {
        focused = value;
        if (choose.focus_keeps) kept = value;
      });
    });
    made.addEventListener("blur", () => show(() => (focused = null)));
    made.addEventListener("click", keep);
    made.addEventListener("keydown", (event) => {
      if (event.target !== made || event.ctrlKey || event.metaKey || event.altKey) return;
      const other = of_key(made, event.key);
      if (event.key === "Enter") keep();
      else if (event.key === " " && choose.space) turn(choose.space);
      else if (other instanceof HTMLElement) other.focus();
      else return;
      event.preventDefault();
    });
  };
};
