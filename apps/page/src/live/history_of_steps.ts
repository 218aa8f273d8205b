// The history of the user's steps. Each step stores the state before it, so that undo and redo cover all kinds of
// steps.

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
  const behind: Step[] = [];
  const ahead: Step[] = [];
  return {
    record(before) {
      behind.push(before);
      ahead.length = 0;
    },
    async undo(put, otherwise) {
      const step = behind.at(-1) ?? otherwise;
      if (!step) return false;
      const now = await put(step);
      behind.pop();
      ahead.push(now);
      return true;
    },
    async redo(put) {
      const step = ahead.at(-1);
      if (!step) return false;
      const now = await put(step);
      ahead.pop();
      behind.push(now);
      return true;
    },
    count: () => behind.length,
    can_redo: () => ahead.length > 0,
  };
};
