// The interactive model: its residual, its effects with sliders, possibly missing effects, undo and redo.
import { candidate_list, fall_shown, posterior_bars, type Promised } from "./candidates";
import { next_action_of, next_label, type Proposed } from "../diagnosis/next_action";
import { effect_search } from "./effect_search";
import { type ModelState, type Step, type Steps, steps_kept, type Stretch } from "./history_of_steps";
import { left_out_bar } from "./left_out";
import { type Catalogue, model_list } from "./model_list";
import { type HandChange, Interrupted, type Part, reason, Refused, type Runs, type Subject, type Work } from "./runs";
import { two_hypotheses } from "./two_hypotheses";
import { button, element, select_of } from "../elements/elements";
import { fit_picture, type Now, slid } from "./fit_picture";
import { type Figure, figure_of } from "../figure/figure";
import { next_test, type NextTestOf } from "./next_test";
import type { PageState } from "../figure/view";
import type { Candidate, Checked, Diagnosed, Report } from "../report";
import { micrometres, plain } from "../drawing/text";
import { rmse_shown } from "../drawing/theme";
import { time_spoken } from "./spoken";
import { english, language, type Sentence, sentence_text, t } from "../texts/texts";
import { plain_name } from "../machine_errors/error_names";
import { verdict_of } from "../diagnosis/verdict";
import { verdict_of as verdict_of_check } from "../model/model";

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
  plan: NextTestOf["plan"];
  steps?: Steps; // of a loop of the same data before this one
  has_unit(target: string): boolean;
  state_unit(): void; // the dialogue of the columns
  across(gap_s: number, search: boolean): void; // opens the data again, interpolated over gaps of this length; and searches
  add_figure(figure: Figure): void;
  changed(report: Report, subject: Subject): void; // the page below is to be drawn anew
}

export interface Loop {
  element: HTMLElement;
  subject(): Subject;
  steps: Steps;
  figures(): readonly Figure[]; // on the page
  proves(): boolean; // whether it has the picture that the first screen needs
  show(report: Report): void;
  refused(why: unknown): void; // why it has no fit, and what may be done
  search(): Promise<void>;
  // An unsupported addition is shown and reverted, unless keep.
  add(effects: readonly string[], keep?: boolean): Promise<void>;
  change(change: HandChange): Promise<void>; // by hand: an effect taken out, a parameter held or freed
  leave_out(left_out: readonly Stretch[]): Promise<void>; // the fit without these rows
  undo(): Promise<void>; // of whatever was done last
  redo(): Promise<void>;
  act(next: Proposed): void;
  find(target?: string): void; // what is missing
  diagnosed(): Diagnosed | null; // of the model as it is
  to_optimum(): void;
  first_slider(effect: string): ReturnType<ReturnType<typeof model_list>["slider"]>;
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

const of_target = <T extends { target: string }>(targets: readonly T[] | undefined, target: string): T | undefined =>
  targets?.find((one) => one.target === target) ?? targets?.[0];

export const loop_of = ({ subject: first, targets, runs, work, catalogue, page, ...of }: LoopOf): Loop => {
  let subject = first;
  let report: Report | null = null;
  let fitted: Checked | null = null; // as the program fitted it
  let base: Checked | null = null; // as the program computed it with the sliders as they were
  let drawn: Checked | null = null; // as it is drawn
  let before: Checked | null = null;
  let candidate: Candidate | null = null;
  let found: Diagnosed | null = null;
  let took_ms = 0; // the last search
  let attempts = 0; // at work, of which one may have begun within another
  let made: { figure: Figure; rows: number } | null = null;
  const steps = of.steps ?? steps_kept();

  const sentence = element("p", { class: "said", role: "status", "aria-live": "polite" });
  const say = (text: Sentence): void => {
    sentence.textContent = micrometres(sentence_text(text));
    sentence.lang = typeof text === "string" ? language : "en";
  };
  // What to do next, where the program proposes a step.
  const next = button("", "", () => {
    const action = found && next_action_of(found);
    if (action) loop.act(action);
  });
  next.className = "act";
  next.hidden = true;
  // Where a column has too long a gap to be interpolated.
  const across = button("", t.live_across_title, () => of.across(gap_s, wants_search));
  across.className = "act";
  across.hidden = true;
  let gap_s = 0;
  let wants_search = false; // and could not be searched
  const offer_across = async (): Promise<void> => {
    const gap = await runs.gap(subject).catch(() => null);
    if (!gap) return;
    gap_s = Math.ceil((gap.to_s ?? 0) - (gap.from_s ?? 0));
    say(t.live_gap({ column: plain(gap.signal, 60), from: time_spoken(gap.from_s ?? 0), length: time_spoken(gap_s) }));
    across.textContent = t.live_across({ length: time_spoken(gap_s) });
    across.hidden = false;
  };
  // Where the target is of counts or steps, and all sizes are said in um.
  const no_unit = element("p", { class: "refusal" }, element("span", {}), " ", button(t.live_state_unit, "", () => of.state_unit()));
  const show_unit = (target: string): void => {
    no_unit.hidden = target === "" || of.has_unit(target);
    no_unit.querySelector("span")?.replaceChildren(t.live_no_unit({ column: plain(target, 60) }));
  };
  const told = (error: unknown): void => {
    say(reason(error));
    if (error instanceof Refused) void offer_across();
  };
  // What the data did not support, and was not kept; or what the model holds all the same.
  const refusal = element("p", { class: "refusal", role: "status" });
  refusal.hidden = true;
  const refuse = (text: Sentence, effects: readonly string[], label = t.live_keep, title = t.live_keep_title): void => {
    const keep = button(label, title, () => void loop.add(effects, true));
    refusal.replaceChildren(element("span", { lang: typeof text === "string" ? language : "en" }, micrometres(sentence_text(text))), " ", keep);
    refusal.hidden = false;
  };
  const place = element("div", { class: "picture" });
  const fall = fall_shown();
  const posterior = posterior_bars();

  const draw = (): void => {
    if (!base || !fitted) return;
    drawn = slid(base, list.values(), list.gains());
    const moved = list.moved();
    fall.show({ before: moved ? fitted.rmse_um : (before?.rmse_um ?? null), now: drawn.rmse_um, floor: drawn.floor_um, moved });
    list.draw(drawn);
    back.disabled = !moved;
    made?.figure.renew();
  };

  // One run at a time; of what was moved meanwhile the last counts.
  let running = false;
  let again = false;
  const computed = async (): Promise<void> => {
    const settings = list.settings();
    if (settings.length === 0 || !fitted) {
      base = fitted;
      return draw();
    }
    if (running) {
      again = true;
      return;
    }
    running = true;
    const of_fit = fitted;
    try {
      const answer = await runs.set(subject, settings);
      const checked = of_target(answer.check?.targets, subject.target);
      if (checked && of_fit === fitted && list.moved()) base = { ...checked, floor_um: of_fit.floor_um };
    } catch (error) {
      if (!(error instanceof Interrupted)) say(reason(error));
    }
    running = false;
    draw();
    if (again) {
      again = false;
      await computed();
    }
  };
  const list = model_list({
    catalogue,
    begin: () => steps.record({ sliders: list.moved_values() }),
    changed() {
      draw();
      update();
      void computed();
    },
    hold: ({ effect = "", name }, value) => void loop.change({ held: [{ effect, parameter: name, value }] }),
    free: ({ effect = "", name, value }) => void loop.change({ freed: [{ effect, parameter: name, value: value ?? 0 }] }),
    remove: (effect) => void loop.change({ removed: [effect] }),
  });
  const to_optimum = (): void => {
    if (list.moved()) steps.record({ sliders: list.moved_values() });
    list.back();
    base = fitted;
    draw();
    update();
  };
  const back = button(t.live_to_optimum, t.live_to_optimum_title, to_optimum);

  // One after the other, until the model is another: each takes a moment, and none is stopped, for what stops a call
  // makes the program forget what it has computed.
  let promising = 0;
  const promise = async (all: readonly Promised[]): Promise<void> => {
    const mine = ++promising;
    const of_subject = subject;
    const known = new Map<string, number>(); // by label
    for (const one of all) {
      if (mine !== promising || of_subject !== subject) return;
      try {
        const rmse_um = await runs.rmse_with(of_subject, one.effects);
        one.show(rmse_um);
        if (one.effects.length === 1) known.set(one.effects[0] ?? "", rmse_um);
      } catch (error) {
        if (error instanceof Interrupted) return;
      }
    }
    if (mine !== promising) return;
    all_promised();
    show_promised(known);
  };
  // In the table of the candidates too.
  const show_promised = (known: ReadonlyMap<string, number>): void => {
    if (!report?.diagnose || known.size === 0) return;
    const with_rmse = (target: Diagnosed): Diagnosed => ({
      ...target,
      candidates: target.candidates.map((one) => ({ ...one, rmse_after_um: known.get(one.label) ?? one.rmse_after_um })),
    });
    const targets = report.diagnose.targets.map((target) => (target === found ? (found = with_rmse(target)) : target));
    report = { ...report, diagnose: { targets } };
    of.changed(report, subject);
  };
  // A search may take minutes. What else runs is soon done, and goes on.
  const stop_search = (): void => {
    if (all.dataset.search === "running") work.stop();
  };
  const candidates = candidate_list(
    (effects) => void loop.add(effects),
    (one) => {
      candidate = one;
      made?.figure.renew();
    },
    (opened) => void promise(opened),
  );
  const undo = button(t.live_undo, t.live_undo_title, () => void loop.undo());
  const redo = button(t.live_redo, t.live_redo_title, () => void loop.redo());
  const search = button(t.live_search, t.live_search_title, () => void loop.search());
  const two = two_hypotheses({
    page,
    add_figure: of.add_figure,
    report: () => report,
    async compare(hypotheses) {
      let both = null;
      await attempt(async () => {
        stop_search();
        both = await runs.compare(subject, hypotheses);
      });
      if (!found && took_ms > 0 && took_ms < kShort_ms) void loop.search();
      return both;
    },
    keep: (label) => void (label === "" ? two.forget() : loop.add([label])),
  });
  const effects = effect_search({ catalogue, add: (label) => void loop.add([label]), beside: (label) => two.beside(label) });
  const rows = left_out_bar(
    () => made?.figure.ask_stretch(),
    (stretch) => void loop.leave_out([...subject.left_out, stretch].sort((a, b) => a.from_s - b.from_s)),
    (stretch) => void loop.leave_out(subject.left_out.filter((one) => one !== stretch)),
  );
  const show_rows = (): void => rows.show(subject.left_out, made?.figure.state().stretch ?? null, fitted?.level === "series");
  const plan = next_test({ plan: of.plan, subject: () => subject, took_ms: () => took_ms });

  const target_list = targets.map((target) => [target, plain(target, 60)] as const);
  const { select: target_choice, label: target_label } = select_of(t.live_explained, target_list, (target) => {
    subject = { ...subject, target };
    before = null;
    if (subject.model !== "") void attempt(async () => loop.show(await runs.report(subject)));
  });
  target_choice.value = subject.target;
  target_label.hidden = targets.length < 2;

  const asked = element("div", {}, element("h3", {}, t.live_what_moves), element("p", { class: "about" }, t.live_what_moves_about));
  const hand = element(
    "div",
    { class: "hand" },
    asked,
    fall.element,
    element("div", { class: "buttons" }, target_label, search, undo, redo, back),
    posterior.element,
    candidates.element,
    element("h3", { class: "of-model" }, t.live_model),
    list.element,
    effects.element,
    plan.element,
  );
  const all_promised = (): void => {
    all.dataset.promised = "true";
  };
  const all = element("section", { class: "live-loop wide", id: "loop", lang: language, "aria-label": t.live_loop }, element("div", { class: "verdict" }, no_unit, refusal, sentence, across, next), element("div", { class: "by-hand" }, element("div", {}, place, rows.element), hand), two.element);

  const now = (): Now => ({
    report: report as Report,
    checked: (drawn ?? fitted) as Checked,
    before: list.moved() ? fitted : before,
    candidate,
    left_out: subject.left_out,
  });
  // The same picture as long as it has the same rows, so that its zoom and its switches stay.
  const figure_now = (checked: Checked): void => {
    const count = checked.series.time_s.length;
    if (made?.rows === count) return made.figure.renew();
    const last = made?.figure;
    made = { figure: figure_of(fit_picture(now), page), rows: count };
    if (last) made.figure.take({ ...last.state(), stretch: null });
    last?.leave();
    made.figure.watch(show_rows);
    place.replaceChildren(made.figure.element);
    made.figure.redraw();
  };

  const attempt = async (work_of: () => Promise<void>): Promise<void> => {
    ++attempts;
    all.setAttribute("aria-busy", "true");
    try {
      await work_of();
    } catch (error) {
      told(error);
    } finally {
      if (--attempts === 0) all.removeAttribute("aria-busy");
      update();
    }
  };

  const update = (): void => {
    const revisions = report?.ledger?.rows.filter(({ target }) => target === subject.target || subject.target === "").length ?? 0;
    all.dataset.revisions = String(revisions);
    all.dataset.steps = String(steps.count());
    undo.disabled = steps.count() === 0 && revisions < 2;
    redo.disabled = !steps.can_redo();
    back.disabled = !list.moved();
    search.disabled = work.busy();
  };

  const show_diagnosis = (of_it: Diagnosed | undefined): void => {
    found = of_it && of_it.not_diagnosed === undefined ? of_it : null;
    const action = found && next_action_of(found);
    next.hidden = !action || action.action === "plan"; // which has a place of its own
    next.textContent = action ? next_label(action) : "";
    next.title = action?.effects.join(", ") ?? "";
    next.dataset.action = action?.action ?? "";
    next.dataset.rmse = rmse_shown(action?.promised_rmse_um ?? null);
    delete all.dataset.promised;
    ++promising;
    two.offer(found?.candidates ?? []);
    if (!found) return candidates.clear();
    const held = found.unsupported.map((effect) => plain_name(effect, 60)).join(", ");
    refusal.hidden = held === "";
    refusal.textContent = held === "" ? "" : t.live_unsupported({ effects: held });
    const promised = candidates.show(found);
    if (!work.busy()) void promise(promised);
    else void last_change.then(() => promise(promised));
    plan.show(found);
  };

  // What they would change; the model stays.
  const tried = (effects: readonly string[]): Promise<void> =>
    attempt(async () => {
      next.disabled = true;
      const sentence_of_it = await runs.try(subject, effects).finally(() => (next.disabled = false));
      refuse(english(sentence_of_it), effects, t.live_add_tried, t.live_add_tried_title);
      next.hidden = true;
    });

  // One change after the other: of two at once the second would stop the first between the file and its fit.
  let changes = 0;
  let last_change: Promise<void> = Promise.resolve();
  const changing = (act: () => Promise<void>): Promise<void> => {
    ++changes;
    last_change = last_change.then(() => attempt(act)).finally(() => --changes);
    return last_change;
  };

  // The report with these parts; of another model nothing is known of what is missing.
  const with_part = (part: Part, of_same_model: boolean): Report => {
    const { diagnose, ledger, ...rest } = report as Report;
    const same = of_same_model ? { ...(diagnose && { diagnose }), ...(ledger && { ledger }) } : {};
    return { ...rest, ...same, ...part };
  };

  // The report here, without the page below.
  const show_here = (next: Report): void => {
    const same_fit = report !== null && report.check === next.check;
    report = next;
    const checked = of_target(next.check?.targets, subject.target);
    all.classList.toggle("no-model", !checked);
    show_unit(checked?.target ?? subject.target);
    all.classList.toggle("wide", checked !== undefined);
    asked.hidden = checked !== undefined;
    if (checked && checked !== fitted) {
      if (subject.target === "" && targets.length > 1) subject = { ...subject, target: checked.target };
      target_choice.value = checked.target;
      fitted = base = drawn = checked;
      list.renew(checked);
      figure_now(checked);
      draw();
      show_rows();
    }
    show_diagnosis(of_target(next.diagnose?.targets, subject.target));
    if (sentence.textContent === "" && fitted) say(found ? verdict_of(found, fitted) : verdict_of_check(fitted));
    update();
    if (same_fit) return;
    two.forget();
    void renew_choices();
  };

  // Step by step, the fit first. If a step is stopped or fails, the model is unchanged.
  const change_model = async (...parts: (() => Promise<Part>)[]): Promise<void> => {
    ++promising;
    stop_search(); // of the model before
    const [of_before, was, report_before] = [subject, fitted, report];
    const model = subject.model === "" ? null : await of.bytes_of(subject.model);
    try {
      for (const part of parts) {
        const next = with_part(await part(), false);
        show_here(next);
        await painted(); // the page below is long: first the new picture
        of.changed(next, subject);
      }
    } catch (error) {
      subject = of_before;
      if (model) await of.put(subject.model, model);
      await runs.take_back(subject).catch(() => undefined); // it may be gone with what was stopped
      if (report_before && report !== report_before) loop.show(report_before);
      throw error;
    }
    before = was && fitted && was.series.time_s.length === fitted.series.time_s.length ? was : null;
    draw();
    update();
    if (took_ms < kShort_ms) void loop.search();
  };

  // The effects that can be added to the present model.
  const renew_choices = async (): Promise<void> => {
    const of_fit = fitted;
    const level = of_fit?.level ?? (subject.group.kind === "recordings" ? "recording" : "series");
    const choices = await runs.choices(subject).catch(() => null); // stopped, for another model
    if (choices && of_fit === fitted) effects.show(choices, level);
  };

  const state_now = async (): Promise<ModelState> => ({
    model: subject.model,
    text: subject.model === "" ? null : await of.bytes_of(subject.model),
    left_out: subject.left_out,
  });
  const step_now = async (): Promise<Step> => ({ sliders: list.moved_values(), state: await state_now() });

  // Restores a step: sliders at once, another model or other rows with their fit.
  const put_back = async (step: Step): Promise<Step> => {
    const was: Step = step.state ? await step_now() : { sliders: list.moved_values() };
    const { state } = step;
    if (state) {
      await change_model(async () => {
        if (state.text) await of.put(state.model, state.text);
        else if (state.model !== "") await runs.undo(state.model);
        subject = { ...subject, model: state.model, left_out: state.left_out };
        return runs.fitted(subject);
      });
    }
    list.put(step.sliders);
    draw();
    void computed();
    return was;
  };
  // As `ballbar undo` takes back what an earlier day added.
  const step_of_ledger = (): Step => ({ sliders: new Map(), state: { model: subject.model, text: null, left_out: subject.left_out } });

  const loop: Loop = {
    element: all,
    subject: () => subject,
    steps,
    figures: () => [...(made ? [made.figure] : []), ...two.figures()],
    proves: () => fitted !== null,
    show(next) {
      show_here(next);
      of.changed(next, subject);
    },
    refused: told,
    search: () =>
      attempt(async () => {
        const of_subject = subject;
        wants_search = true;
        candidates.clear();
        posterior.clear();
        search.disabled = true;
        all.dataset.search = "running";
        try {
          const began = performance.now();
          const part = await runs.search(subject, (line) => posterior.tell(line));
          took_ms = performance.now() - began;
          wants_search = false;
          all.dataset.search = "done";
          posterior.clear();
          if (of_subject !== subject) return;
          if (fitted) loop.show(with_part(part, true));
          else loop.show(with_part({ ...(await runs.fitted(subject)), ...part }, true));
          if (found) say(verdict_of(found, fitted));
        } catch (error) {
          const stopped = error instanceof Interrupted;
          all.dataset.search = stopped ? "stopped" : "failed";
          if (!stopped || changes > 0) posterior.clear(); // one that is stopped keeps what it has
          throw error;
        }
      }),
    async add(effects, keep = false) {
      if (changes > 0) return; // pressed twice
      await changing(async () => {
        candidate = null;
        const folder = (subject.data[0] ?? "").replace(/\/[^/]*$/, "");
        const model = subject.model || runs.free_name(folder, "model.toml");
        const was = await step_now();
        let sentence_of_it = "";
        try {
          await change_model(
            () => runs.add(subject, effects),
            async () => {
              const { sentence, kept, ledger } = await runs.revise(subject, model, keep);
              sentence_of_it = sentence;
              if (!kept) throw new Unsupported();
              subject = { ...subject, model };
              return ledger ? { ledger } : {};
            },
          );
        } catch (error) {
          if (!(error instanceof Unsupported)) throw error;
          return refuse(english(sentence_of_it), effects);
        }
        steps.record({ ...was, state: { left_out: subject.left_out, text: null, ...was.state, model } });
        update();
        undo.focus({ preventScroll: true }); // the button that was pressed is gone
        say(english(sentence_of_it));
      });
    },
    change: (change) =>
      changing(async () => {
        const was = await step_now();
        let sentence_of_it = "";
        await change_model(
          () => runs.change(subject, change),
          async () => {
            const { sentence, ledger } = await runs.revise(subject, subject.model, true);
            sentence_of_it = sentence;
            return ledger ? { ledger } : {};
          },
        );
        steps.record(was);
        update();
        say(english(sentence_of_it));
      }),
    leave_out: (left_out) =>
      changing(async () => {
        const was = await step_now();
        await change_model(async () => {
          subject = { ...subject, left_out };
          return runs.fitted(subject);
        });
        made?.figure.select(null);
        steps.record(was);
        update();
        const n = fitted?.series.time_s.length ?? 0;
        say(left_out.length > 0 ? t.hands_left_out_now({ n }) : t.hands_all_in({ n }));
      }),
    undo: () =>
      changing(async () => {
        if (undo.disabled) return;
        await steps.undo(put_back, step_of_ledger());
        update();
        say(t.live_undone);
      }),
    redo: () =>
      changing(async () => {
        if (await steps.redo(put_back)) say(t.live_redone);
        update();
      }),
    act({ action, effects, parameters }) {
      switch (action) {
        case "add":
          return void loop.add(effects, true);
        case "try":
          return void tried(effects);
        case "free":
          return void loop.change({ freed: parameters.map(({ effect, parameter, start }) => ({ effect, parameter, value: start ?? 0 })) });
        case "plan":
          return plan.open();
      }
    },
    find(target) {
      if (target !== undefined && targets.includes(target)) subject = { ...subject, target };
      target_choice.value = subject.target;
      void loop.search();
    },
    diagnosed: () => found,
    to_optimum,
    first_slider: (effect) => list.slider(effect),
  };
  return loop;
};
