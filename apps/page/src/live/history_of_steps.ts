// The history of the user's steps. Each step stores the state before it, so that undo and redo cover all kinds of
// steps.
import { signal } from "@preact/signals-core";

export type Values = ReadonlyMap<string, number>; // of sliders that were moved from the fit

// An interval of time whose readings are not fitted.
export interface Stretch {
  from_s: number;
  to_s: number;
}

export interface ModelState {
  model: string; // path
  text: Uint8Array | null; // of the file; null: as the program takes its last revision back
  left_out: readonly Stretch[];
}

export interface Step {
  sliders: Values;
  state?: ModelState; // absent: sliders alone were moved
}

// Restores a step, and returns the state that it replaces.
export type PutBack = (step: Step) => Promise<Step>;

export interface Steps {
  record(before: Step): void; // records a new step; clears redo
  undo(put: PutBack, otherwise?: Step): Promise<boolean>; // otherwise: where nothing was done yet; false: there was nothing
  redo(put: PutBack): Promise<boolean>;
  count(): number;
  can_redo(): boolean;
}

export const steps_kept = (): Steps => {
  const behind = signal<readonly Step[]>([]);
  const ahead = signal<readonly Step[]>([]);
  // From the end of one list to the end of the other.
  const move = async (from: typeof behind, to: typeof behind, put: PutBack, otherwise?: Step): Promise<boolean> => {
    const step = from.peek().at(-1) ?? otherwise;
    if (!step) return false;
    const now = await put(step);
    from.value = from.peek().slice(0, -1);
    to.value = [...to.peek(), now];
    return true;
  };
  return {
    record(before) {
      behind.value = [...behind.peek(), before];
      ahead.value = [];
    },
    undo: (put, otherwise) => move(behind, ahead, put, otherwise),
    redo: (put) => move(ahead, behind, put),
    count: () => behind.value.length,
    can_redo: () => ahead.value.length > 0,
  };
};
