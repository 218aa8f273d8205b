// Keys on a focused chart. What they do is said in the hint below it.
import type { View } from "./view";
import { panned, zoomed } from "./window";

export const listen_to_keys = (view: View, step: (by: number) => void): void => {
  view.box.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey) return;
    if (act(event.key, event.altKey)) event.preventDefault();
  });

  const act = (key: string, alt: boolean): boolean => {
    if (key === "," || (alt && key === "ArrowLeft")) return (step(-1), true);
    if (key === "." || (alt && key === "ArrowRight")) return (step(1), true);
    const whole = view.whole();
    if (!whole || alt) return false;
    const window = view.window();
    const [from, to] = window ?? whole;
    switch (key) {
      case "+":
      case "=":
        view.see(zoomed(window, whole, (from + to) / 2, 1.5));
        return true;
      case "-":
      case "_":
        view.see(zoomed(window, whole, (from + to) / 2, 1 / 1.5));
        return true;
      case "ArrowLeft":
        view.see(panned(window, whole, -(to - from) / 8));
        return true;
      case "ArrowRight":
        view.see(panned(window, whole, (to - from) / 8));
        return true;
      case "Home":
      case "0":
        view.see(null);
        return true;
      case "Escape":
        view.select(null, true);
        return true;
      default:
        return false;
    }
  };
};
