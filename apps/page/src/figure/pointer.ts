// Mouse, pen and fingers on a chart: a drag moves, two fingers or the wheel zoom, a double click shows all, a drag with
// shift selects a stretch. The wheel alone scrolls the page until the chart has the focus.
import type { Range } from "../picture";
import type { View } from "./view";
import { ordered, panned, zoomed } from "./window";

interface Drag {
  kind: "move" | "select" | "pinch";
  from_px: number; // where it began, from the left of the box
  from: number; // the same on the x axis
  window: Range | null; // then
  apart_px: number; // two fingers, then
}

export const listen_to_pointer = (view: View): void => {
  const { box } = view;
  const down = new Map<number, number>(); // pointers that are down, from the left of the box
  let drag: Drag | null = null;

  const x_px = (event: MouseEvent): number => event.clientX - box.getBoundingClientRect().left;
  const y_px = (event: MouseEvent): number => event.clientY - box.getBoundingClientRect().top;
  const middle = (): number => [...down.values()].reduce((sum, px) => sum + px, 0) / Math.max(1, down.size);
  const apart = (): number => Math.max(20, Math.max(...down.values()) - Math.min(...down.values()));

  const begin = (kind: Drag["kind"]): void => {
    drag = { kind, from_px: middle(), from: view.x_at(middle()), window: view.window(), apart_px: apart() };
  };

  box.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !view.whole() || !view.in_plot(x_px(event), y_px(event))) return;
    down.set(event.pointerId, x_px(event));
    box.setPointerCapture(event.pointerId);
    if (down.size > 1) begin("pinch");
    else begin(event.shiftKey || view.selecting() ? "select" : "move");
  });

  box.addEventListener("pointermove", (event) => {
    const inside = view.in_plot(x_px(event), y_px(event));
    const whole = view.whole();
    if (!whole) return;
    view.hover(inside ? view.x_at(x_px(event)) : null);
    if (!drag || !down.has(event.pointerId)) return;
    down.set(event.pointerId, x_px(event));
    const [from, to] = drag.window ?? whole;
    switch (drag.kind) {
      case "select":
        if (Math.abs(middle() - drag.from_px) > 2) view.select(ordered(drag.from, view.x_at(middle())), false);
        break;
      case "move": {
        // Per pixel as it was when the drag began, for the axis moves under the pointer.
        const plot_px = (view.x_at(1) - view.x_at(0)) * (drag.from_px - middle());
        if (drag.window) view.see(panned(drag.window, whole, plot_px));
        break;
      }
      case "pinch":
        if (to > from) view.see(zoomed(drag.window, whole, drag.from, apart() / drag.apart_px));
        break;
    }
  });

  const end = (event: PointerEvent): void => {
    if (!down.has(event.pointerId)) return;
    if (drag?.kind === "select" && Math.abs(middle() - drag.from_px) > 2) {
      view.select(ordered(drag.from, view.x_at(middle())), true);
    }
    down.delete(event.pointerId);
    drag = null;
    if (down.size > 0) begin("move");
  };
  box.addEventListener("pointerup", end);
  box.addEventListener("pointercancel", end);
  box.addEventListener("pointerleave", () => view.hover(null));

  box.addEventListener("dblclick", () => view.see(null));

  box.addEventListener(
    "wheel",
    (event) => {
      const whole = view.whole();
      const asked = event.ctrlKey || event.metaKey || document.activeElement === box;
      if (!whole || !asked || !view.in_plot(x_px(event), y_px(event))) return;
      // All is seen already: a focused chart gives the wheel back to the page.
      if (!view.window() && event.deltaY > 0 && !event.ctrlKey && !event.metaKey) return;
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 16 : 1;
      const factor = Math.exp(-Math.max(-200, Math.min(200, event.deltaY * lines)) * 0.003);
      view.see(zoomed(view.window(), whole, view.x_at(x_px(event)), factor));
    },
    { passive: false },
  );
};
