// What a reader chose, zoomed, switched off and unfolded, for when the page is written anew in another language.
import type { Shared } from "./shared";

const unfolded = "section[id]:has(> details[open])";

// Returns what brings it back, once the new page stands in the place of the old one.
export const kept_view = (before: Shared): ((after: Shared) => void) => {
  const states = [...before.figures].map(([name, figure]) => ({ name, state: figure.state() }));
  const ids = [...document.querySelectorAll(unfolded)].map(({ id }) => id);
  const [window, dark, top] = [before.time_window(), before.dark(), scrollY];
  return (after) => {
    for (const id of ids) document.getElementById(id)?.querySelector(":scope > details")?.setAttribute("open", "");
    for (const { name, state } of states) after.figures.get(name)?.take(state);
    after.see_time(window);
    after.look(dark);
    scrollTo({ top, behavior: "instant" });
  };
};
