// The interactive model: what is done with it, one change after the other, with undo and redo.
import { batch } from "@preact/signals-core";
import type { Proposed } from "../diagnosis/next_action";
import { plain } from "../drawing/text";
import type { Figure } from "../figure/figure";
import type { PageState } from "../figure/view";
import type { Diagnosed, Report } from "../report";
import { said, type Sentence, t } from "../texts/texts";
import { looked_at, posterior_in } from "./candidates";
import type { Catalogue } from "./catalogue";
import type { ModelState, Step, Stretch } from "./history_of_steps";
import { type LoopView, loop_view } from "./loop_view";
import { type HandChange, Interrupted, type Part, reason, Refused, type Runs, set_key, type Subject, type Work } from "./runs";
import { time_spoken } from "./spoken";
import { of_target, store_of } from "./store";

const kShort_ms = 60_000; // a search that takes less is repeated automatically when the model changes
const kUnseen_ms = 150;

export interface LoopOf {
  subject: Subject;
  targets: readonly string[]; // to choose from
  runs: Runs;
  work: Work;
  catalogue: Catalogue;
  page: PageState;
  bytes_of(path: string): Promise<Uint8Array>;
  put(path: string, bytes: Uint8Array): Promise<void>;
  has_unit(target: string): boolean;
  state_unit(): void; // the dialogue of the columns
  across(gap_s: number, search: boolean): void; // opens the data again, interpolated over gaps of this length; and searches
  add_figure(figure: Figure): void;
  changed(report: Report, subject: Subject): void; // the page below is to be drawn anew
}

export interface Loop {
  element(): HTMLElement;
  figures(): readonly Figure[]; // on the page
  proves(): boolean; // whether it has the picture that the first screen needs
  show(report: Report): void;
  rewrite(): void; // in another language
  refused(why: unknown): void; // why it has no fit, and what may be done
  search(): Promise<void>;
  // An unsupported addition is shown and reverted, unless keep.
  add(effects: readonly string[], keep?: boolean): Promise<void>;
  undo(): Promise<void>; // of whatever was done last
  redo(): Promise<void>;
  act(next: Proposed): void;
  find(target?: string): void; // what is missing
  diagnosed(): Diagnosed | null; // of the model as it is
  to_optimum(): void;
  first_slider: LoopView["slider"];
}

class Unsupported extends Error {}

// Once the browser has shown what was drawn; in a tab that is not seen it shows nothing.
const painted = (): Promise<void> =>
  new Promise((done) => {
    const late = setTimeout(done, kUnseen_ms);
    // In the first frame it is drawn, and seen when the next begins.
    requestAnimationFrame(() =>
      requestAnimationFrame(() => {
        clearTimeout(late);
        setTimeout(done);
      }),
    );
  });

export const loop_of = ({ subject: first, targets, runs, work, catalogue, page, ...of }: LoopOf): Loop => {
  const store = store_of(first, catalogue);
  const { subject, report, fitted, found, moved, steps, told } = store;

  const tell = (error: unknown): void => {
    told.value = () => reason(error);
    if (error instanceof Refused) void offer_across();
  };
  // Where a column has too long a gap to be interpolated.
  const offer_across = async (): Promise<void> => {
    const gap = await runs.gap(subject.peek()).catch(() => null);
    if (!gap) return;
    const gap_s = Math.ceil((gap.to_s ?? 0) - (gap.from_s ?? 0));
    batch(() => {
      told.value = () => t.live_gap({ column: plain(gap.signal, 60), from: time_spoken(gap.from_s ?? 0), length: time_spoken(gap_s) });
      store.gap_s.value = gap_s;
    });
  };

  const attempt = async (work_of: () => Promise<void>): Promise<void> => {
    ++store.busy.value;
    try {
      await work_of();
    } catch (error) {
      tell(error);
    } finally {
      --store.busy.value;
    }
  };
  // One change after the other: of two at once the second would stop the first between the file and its fit.
  let changes = 0;
  let last_change: Promise<void> = Promise.resolve();
  const changing = (act: () => Promise<void>): Promise<void> => {
    ++changes;
    last_change = last_change.then(() => attempt(act)).finally(() => {
      if (--changes === 0) promise_first();
    });
    return last_change;
  };
  // A search may take minutes. What else runs is soon done, and goes on.
  const stop_search = (): void => {
    if (store.search.peek() === "running") work.stop();
  };
  let last_search: { subject: Subject } | null = null;
  const search_again = (): void => {
    const took_ms = store.took_ms.peek();
    if (took_ms < kShort_ms) void loop.search();
  };

  // One run at a time; of what was moved meanwhile the last counts.
  let computing = false;
  const compute = async (): Promise<void> => {
    if (computing) return;
    computing = true;
    let asked;
    do {
      asked = store.settings.peek();
      const fit = fitted.peek();
      if (asked.length === 0 || !fit) {
        store.computed_there.set(null);
        break;
      }
      try {
        const answer = await runs.set(subject.peek(), asked);
        const checked = of_target(answer.check?.targets, subject.peek().target);
        if (checked) store.computed_there.set({ ...checked, floor_um: fit.floor_um }, fit);
      } catch (error) {
        if (!(error instanceof Interrupted)) told.value = () => reason(error);
      }
    } while (asked !== store.settings.peek());
    computing = false;
  };
  const record_sliders = (): void => steps.record({ sliders: moved.now.peek() });
  const to_optimum = (): void => {
    if (moved.now.peek().size > 0) record_sliders();
    moved.set(new Map());
    store.computed_there.set(null);
  };

  // One after the other, until the model is another: each takes a moment, and none is stopped, for what stops a call
  // makes the program forget what it has computed.
  const promise = async (wanted: readonly (readonly string[])[]): Promise<void> => {
    const [of_found, of_subject] = [found.peek(), subject.peek()];
    const is_current = (): boolean => found.peek() === of_found && subject.peek() === of_subject && changes === 0;
    let came = false;
    for (const effects of wanted) {
      if (!is_current()) return;
      if (store.promised.now.peek().has(set_key(effects))) continue;
      try {
        const rmse_um = await runs.rmse_with(of_subject, effects);
        came = true;
        if (found.peek() === of_found) store.promised.set(new Map([...store.promised.now.peek(), [set_key(effects), rmse_um]]));
      } catch (error) {
        if (error instanceof Interrupted) return;
      }
    }
    if (came && is_current()) tell_page();
  };
  const promise_first = (): void => {
    const of_it = found.peek();
    if (of_it) void promise(looked_at(of_it));
  };

  const tell_page = (): void => {
    const shown = store.report_shown.peek();
    if (shown) of.changed(shown, subject.peek());
  };
  // The report with these parts; of another model nothing is known of what is missing.
  const with_part = (part: Part, of_same_model: boolean): Report => {
    const { diagnose, ledger, ...rest } = report.peek() as Report;
    const same = of_same_model ? { ...(diagnose && { diagnose }), ...(ledger && { ledger }) } : {};
    return { ...rest, ...same, ...part };
  };
  // The report here, without the page below.
  const show_here = (next: Report): void => {
    const [before, diagnosed] = [report.peek(), found.peek()];
    batch(() => {
      report.value = next;
      const checked = fitted.peek();
      if (checked && subject.peek().target === "" && targets.length > 1) subject.value = { ...subject.peek(), target: checked.target };
    });
    if (found.peek() !== diagnosed && changes === 0) promise_first();
    if (before === null || before.check !== next.check) void renew_choices();
  };

  // Step by step, the fit first. If a step is stopped or fails, the model is unchanged.
  const change_model = async (...parts: (() => Promise<Part>)[]): Promise<void> => {
    stop_search(); // of the model before
    const [of_before, was, report_before] = [subject.peek(), fitted.peek(), report.peek()];
    const model = of_before.model === "" ? null : await of.bytes_of(of_before.model);
    try {
      for (const part of parts) {
        show_here(with_part(await part(), false));
        await painted(); // the page below is long: first the new picture
        tell_page();
      }
    } catch (error) {
      subject.value = of_before;
      if (model) await of.put(of_before.model, model);
      await runs.take_back(of_before).catch(() => undefined); // it may be gone with what was stopped
      if (report_before && report.peek() !== report_before) loop.show(report_before);
      throw error;
    }
    const has_same_rows = was?.series.time_s.length === fitted.peek()?.series.time_s.length;
    store.before.set(has_same_rows ? was : null);
    search_again();
  };

  // The effects that can be added to the present model.
  const renew_choices = async (): Promise<void> => {
    const of_fit = fitted.peek();
    const choices = await runs.choices(subject.peek()).catch(() => null); // stopped, for another model
    if (choices) store.choices.set(choices, of_fit);
  };

  const state_now = async (): Promise<ModelState> => {
    const { model, left_out } = subject.peek();
    return { model, text: model === "" ? null : await of.bytes_of(model), left_out };
  };
  const step_now = async (): Promise<Step> => ({ sliders: moved.now.peek(), state: await state_now() });

  // Restores a step: sliders at once, another model or other rows with their fit.
  const put_back = async (step: Step): Promise<Step> => {
    const was: Step = step.state ? await step_now() : { sliders: moved.now.peek() };
    const { state } = step;
    if (state) {
      await change_model(async () => {
        if (state.text) await of.put(state.model, state.text);
        else if (state.model !== "") await runs.undo(state.model);
        subject.value = { ...subject.peek(), model: state.model, left_out: state.left_out };
        return runs.fitted(subject.peek());
      });
    }
    moved.set(step.sliders);
    void compute();
    return was;
  };
  // As `ballbar undo` takes back what an earlier day added.
  const step_of_ledger = (): Step => ({ sliders: new Map(), state: { model: subject.peek().model, text: null, left_out: subject.peek().left_out } });

  // What they would change; the model stays.
  const tried = (effects: readonly string[]): Promise<void> =>
    attempt(async () => {
      store.trying.value = true;
      const sentence = await runs.try(subject.peek(), effects).finally(() => (store.trying.value = false));
      store.refusal.set({ sentence, effects, tried: true });
    });
  const change = (by_hand: HandChange): Promise<void> =>
    changing(async () => {
      const was = await step_now();
      let sentence_of_it = (): Sentence => "";
      await change_model(
        () => runs.change(subject.peek(), by_hand),
        async () => {
          const { sentence, message, ledger } = await runs.revise(subject.peek(), subject.peek().model, true);
          sentence_of_it = () => said(sentence, message);
          return ledger ? { ledger } : {};
        },
      );
      steps.record(was);
      told.value = sentence_of_it;
    });
  const leave_out = (left_out: readonly Stretch[]): Promise<void> =>
    changing(async () => {
      const was = await step_now();
      await change_model(async () => {
        subject.value = { ...subject.peek(), left_out };
        return runs.fitted(subject.peek());
      });
      view.select_nothing();
      steps.record(was);
      const n = fitted.peek()?.series.time_s.length ?? 0;
      told.value = () => (left_out.length > 0 ? t.hands_left_out_now({ n }) : t.hands_all_in({ n }));
    });
  // An answer is of what was asked, whatever is shown when it comes.
  const plan = async (): Promise<void> => {
    const of_found = found.peek();
    store.planning.value = true;
    const planned = await runs.plan(subject.peek(), store.plan_hours.peek()).catch((error: unknown) => () => reason(error));
    batch(() => {
      store.planning.value = false;
      store.plan.set(planned, of_found);
    });
  };
  const compare = async (labels: readonly string[]): Promise<void> => {
    const of_fit = fitted.peek();
    store.both.set(null);
    store.comparing.value = true;
    await attempt(async () => {
      stop_search();
      store.both.set(await runs.compare(subject.peek(), labels.map((label) => (label === "" ? [] : [label]))), of_fit);
    });
    store.comparing.value = false;
    if (!found.peek() && store.took_ms.peek() > 0) search_again();
  };
  const choose = (target: string): void => {
    subject.value = { ...subject.peek(), target };
    if (subject.peek().model !== "") void attempt(async () => loop.show(await runs.report(subject.peek())));
  };

  const loop: Loop = {
    element: () => view.element,
    figures: () => view.figures(),
    proves: () => fitted.peek() !== null,
    show(next) {
      show_here(next);
      tell_page();
    },
    rewrite() {
      view.leave();
      view = written();
      tell_page();
    },
    refused: tell,
    search: () =>
      attempt(async () => {
        const of_subject = subject.peek();
        const mine = { subject: of_subject };
        last_search = mine;
        store.search.value = "running";
        store.posterior.value = null;
        try {
          const began = performance.now();
          const part = await runs.search(of_subject, (line) => {
            if (last_search === mine) store.posterior.value = posterior_in(line) ?? store.posterior.peek();
          });
          if (last_search !== mine) return;
          store.took_ms.value = performance.now() - began;
          store.search.value = "done";
          store.posterior.value = null;
          if (of_subject !== subject.peek()) return;
          const fit = fitted.peek();
          const of_fit = fit && (of_subject.target === "" || fit.target === of_subject.target) ? {} : await runs.fitted(of_subject);
          if (last_search !== mine || of_subject !== subject.peek()) return;
          batch(() => {
            show_here(with_part({ ...of_fit, ...part }, true));
            if (found.peek()) told.value = null; // then it is the verdict
          });
          tell_page();
        } catch (error) {
          if (last_search !== mine) return;
          const stopped = error instanceof Interrupted;
          store.search.value = stopped ? "stopped" : "failed";
          if (!stopped || changes > 0) store.posterior.value = null; // one that is stopped keeps what it has
          throw error;
        }
      }),
    async add(effects, keep = false) {
      if (changes > 0) return; // pressed twice
      store.candidate.set(null);
      await changing(async () => {
        const folder = (subject.peek().data[0] ?? "").replace(/\/[^/]*$/, "");
        const model = subject.peek().model || runs.free_name(folder, "model.toml");
        const was = await step_now();
        let sentence_of_it = (): Sentence => "";
        try {
          await change_model(
            () => runs.add(subject.peek(), effects),
            async () => {
              const { sentence, message, kept, ledger } = await runs.revise(subject.peek(), model, keep);
              sentence_of_it = () => said(sentence, message);
              if (!kept) throw new Unsupported();
              subject.value = { ...subject.peek(), model };
              return ledger ? { ledger } : {};
            },
          );
        } catch (error) {
          if (!(error instanceof Unsupported)) throw error;
          return store.refusal.set({ sentence: sentence_of_it, effects, tried: false });
        }
        steps.record({ ...was, state: { left_out: subject.peek().left_out, text: null, ...was.state, model } });
        view.focus_undo(); // the button that was pressed is gone
        told.value = sentence_of_it;
      });
    },
    undo: () =>
      changing(async () => {
        if (!store.can_undo.peek()) return;
        await steps.undo(put_back, step_of_ledger());
        told.value = () => t.live_undone;
      }),
    redo: () =>
      changing(async () => {
        if (await steps.redo(put_back)) told.value = () => t.live_redone;
      }),
    act({ action, effects, parameters }) {
      switch (action) {
        case "add":
          return void loop.add(effects, true);
        case "try":
          return void tried(effects);
        case "free":
          return void change({ freed: parameters.map(({ effect, parameter, start }) => ({ effect, parameter, value: start ?? 0 })) });
        case "plan":
          return view.open_plan();
      }
    },
    find(target) {
      const now = subject.peek();
      if (target !== undefined && target !== now.target && targets.includes(target)) {
        stop_search(); // of the other target
        subject.value = { ...now, target };
      } else if (store.search.peek() === "running" && last_search?.subject === now) return;
      void loop.search();
    },
    diagnosed: () => found.peek(),
    to_optimum,
    first_slider: (effect) => view.slider(effect),
  };
  const written = (): LoopView =>
    loop_view({
      store, targets, catalogue, page, to_optimum, choose,
      plan: () => void plan(),
      compare: (labels) => void compare(labels),
      has_unit: of.has_unit,
      state_unit: of.state_unit,
      add_figure: of.add_figure,
      across: () => of.across(store.gap_s.peek(), !["", "done"].includes(store.search.peek())),
      next() {
        const action = store.next.peek();
        if (action) loop.act(action);
      },
      search() {
        told.value = null;
        void loop.search();
      },
      undo: () => void loop.undo(),
      redo: () => void loop.redo(),
      begin: record_sliders,
      slid: () => void compute(),
      add: (effects, keep) => void loop.add(effects, keep),
      promise: (effects) => void promise(effects),
      change: (by_hand) => void change(by_hand),
      leave_out: (left_out) => void leave_out(left_out),
    });
  let view = written();
  return loop;
};
