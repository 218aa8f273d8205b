// What the whole page hears: files that are dropped anywhere, and the keys of the loop.
import { dropped_of, type Dropped } from "./dropped_files";

// A key typed into a field is the field's.
const is_typed = ({ target }: Event): boolean => target instanceof HTMLElement && target.matches("input:not([type=range]):not([type=checkbox]), textarea");

export interface Heard {
  take(files: readonly Dropped[]): void;
  undo(): void;
  redo(): void;
  stop(): void;
}

export const listen = ({ take, undo, redo, stop }: Heard): void => {
  let over = 0;
  const hovered = (by: number): void => {
    over = Math.max(0, over + by);
    document.documentElement.classList.toggle("dropping", over > 0);
  };
  const files_in = ({ dataTransfer }: DragEvent): boolean => dataTransfer?.types.includes("Files") ?? false;
  addEventListener("dragenter", (event) => files_in(event) && hovered(1));
  addEventListener("dragleave", (event) => files_in(event) && hovered(-1));
  addEventListener("dragover", (event) => files_in(event) && event.preventDefault());
  addEventListener("drop", (event) => {
    if (!event.dataTransfer || !files_in(event)) return;
    event.preventDefault();
    over = 0;
    hovered(0);
    void dropped_of(event.dataTransfer).then(take);
  });
  addEventListener("keydown", (event) => {
    if (event.key === "Escape") stop();
    if (!(event.ctrlKey || event.metaKey) || event.altKey || is_typed(event)) return;
    const key = event.key.toLowerCase();
    if (key === "z" && !event.shiftKey) undo();
    else if (key === "y" || key === "z") redo();
    else return;
    event.preventDefault();
  });
};
