// The loop with the hand: what a model leaves, its effects under sliders, what may be missing, and a step forth and back.
import { candidate_list, fall_shown, posterior_bars, type Promised } from "./candidates";
import { type Catalogue, model_list } from "./model_list";
import { added_by, Interrupted, type Part, reason, type Runs, type Subject, words_of, type Work } from "./runs";
import { button, element, select_of } from "../elements/elements";
import { fit_picture, type Now, slid } from "./fit_picture";
import { type Figure, figure_of } from "../figure/figure";
import { next_test, type NextTestOf } from "./next_test";
import type { PageState } from "../figure/view";
import type { Candidate, Checked, Diagnosed, Report } from "../report";
import { micrometres, plain } from "../drawing/text";
import { english, language, type Sentence, sentence_text, t } from "../texts/texts";
import { plain_name } from "../machine_errors/error_names";
import { verdict_of } from "../diagnosis/verdict";
import { verdict_of as verdict_of_check } from "../model/model";

const kShort_ms = 60_000; // a search that is made anew by itself when the model is another

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
  changed(report: Report, subject: Subject): void; // the page below is to be drawn anew
}

export interface Loop {
  element: HTMLElement;
  subject(): Subject;
  figure(): Figure | null;
  proves(): boolean; // whether it has the picture that the first screen needs
  show(report: Report): void;
  search(): Promise<void>;
  // What the data do not support is shown and taken back, but for keep.
  add(effects: readonly string[], keep?: boolean): Promise<void>;
  undo(): Promise<void>;
  redo(): Promise<void>;
  act(command: string): boolean; // whether it did what the command line says
  diagnosed(): Diagnosed | null; // of the model as it is
  to_optimum(): void;
  first_slider(effect: string): ReturnType<ReturnType<typeof model_list>["slider"]>;
}

class Unsupported extends Error {}

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
  const forth: Uint8Array[] = []; // models that were taken back, the last one first to come again

  const sentence = element("p", { class: "said", role: "status", "aria-live": "polite" });
  const say = (text: Sentence): void => {
    sentence.textContent = micrometres(sentence_text(text));
    sentence.lang = typeof text === "string" ? language : "en";
  };
  // What to do next, where the program proposes a step.
  const next = button("", "", () => loop.act(found?.command ?? ""));
  next.className = "act";
  next.hidden = true;
  // What the data did not support, and was not kept; or what the model holds all the same.
  const refusal = element("p", { class: "refusal", role: "status" });
  refusal.hidden = true;
  const refuse = (text: Sentence, effects: readonly string[]): void => {
    const keep = button(t.live_keep, t.live_keep_title, () => void loop.add(effects, true));
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
  const list = model_list(catalogue, () => {
    draw();
    void computed();
  });
  const to_optimum = (): void => {
    list.back();
    base = fitted;
    draw();
  };
  const back = button(t.live_to_optimum, t.live_to_optimum_title, to_optimum);

  // One after the other, until the model is another: each takes a moment, and none is stopped, for what stops a call
  // makes the program forget what it has computed.
  let promising = 0;
  const promise = async (all: readonly Promised[]): Promise<void> => {
    const mine = ++promising;
    const of_subject = subject;
    for (const one of all) {
      if (mine !== promising || of_subject !== subject) return;
      try {
        one.show(await runs.rmse_with(of_subject, one.effects));
      } catch (error) {
        if (error instanceof Interrupted) return;
      }
    }
    if (mine === promising) all_promised();
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
    plan.element,
  );
  const all_promised = (): void => {
    all.dataset.promised = "true";
  };
  const all = element("section", { class: "live-loop wide", id: "loop", lang: language, "aria-label": t.live_loop }, element("div", { class: "verdict" }, refusal, sentence, next), element("div", { class: "by-hand" }, place, hand));

  const now = (): Now => ({
    report: report as Report,
    checked: (drawn ?? fitted) as Checked,
    before: list.moved() ? fitted : before,
    candidate,
  });
  // The same picture as long as it has the same rows, so that its zoom and its switches stay.
  const figure_now = (checked: Checked): void => {
    const rows = checked.series.time_s.length;
    if (made?.rows === rows) return made.figure.renew();
    made = { figure: figure_of(fit_picture(now), page), rows };
    place.replaceChildren(made.figure.element);
    made.figure.redraw();
  };

  const attempt = async (work_of: () => Promise<void>): Promise<void> => {
    ++attempts;
    all.setAttribute("aria-busy", "true");
    try {
      await work_of();
    } catch (error) {
      say(reason(error));
    } finally {
      if (--attempts === 0) all.removeAttribute("aria-busy");
      update();
    }
  };

  const update = (): void => {
    const revisions = report?.ledger?.rows.filter(({ target }) => target === subject.target || subject.target === "").length ?? 0;
    all.dataset.revisions = String(revisions);
    undo.disabled = revisions < 2;
    redo.disabled = forth.length === 0;
    search.disabled = work.busy();
  };

  const show_diagnosis = (of_it: Diagnosed | undefined): void => {
    found = of_it && of_it.not_diagnosed === undefined ? of_it : null;
    const effects = found?.command.startsWith("ballbar add ") ? added_by(found.command, subject) : [];
    next.hidden = effects.length === 0;
    next.textContent = t.live_add_named({ effects: effects.map((effect) => plain_name(effect, 60)).join(", ") });
    next.title = effects.join(", ");
    delete all.dataset.promised;
    ++promising;
    if (!found) return candidates.clear();
    const held = found.unsupported.map((effect) => plain_name(effect, 60)).join(", ");
    refusal.hidden = held === "";
    refusal.textContent = held === "" ? "" : t.live_unsupported({ effects: held });
    const promised = candidates.show(found);
    if (!work.busy()) void promise(promised);
    else void last_change.then(() => promise(promised));
    plan.show(found);
  };

  const tried = (effect: string): Promise<void> =>
    attempt(async () => {
      say(t.live_searching);
      say(english(await runs.try(subject, effect)));
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

  // Step by step, the fit first; where one is stopped, or cannot be made, the model is as it was.
  const change_model = async (...steps: (() => Promise<Part>)[]): Promise<void> => {
    ++promising;
    if (all.dataset.search === "running") work.stop(); // of the model before
    const [of_before, was, report_before] = [subject, fitted, report];
    const model = subject.model === "" ? null : await of.bytes_of(subject.model);
    try {
      for (const step of steps) loop.show(with_part(await step(), false));
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

  const loop: Loop = {
    element: all,
    subject: () => subject,
    figure: () => made?.figure ?? null,
    proves: () => fitted !== null,
    show(next) {
      report = next;
      const checked = of_target(next.check?.targets, subject.target);
      all.classList.toggle("no-model", !checked);
      all.classList.toggle("wide", checked !== undefined);
      asked.hidden = checked !== undefined;
      if (checked) {
        if (subject.target === "" && targets.length > 1) subject = { ...subject, target: checked.target };
        target_choice.value = checked.target;
        fitted = base = drawn = checked;
        list.renew(checked);
        figure_now(checked);
        draw();
        if (sentence.textContent === "") say(verdict_of_check(checked));
      }
      show_diagnosis(of_target(next.diagnose?.targets, subject.target));
      of.changed(next, subject);
      update();
    },
    search: () =>
      attempt(async () => {
        const of_subject = subject;
        candidates.clear();
        posterior.clear();
        search.disabled = true;
        all.dataset.search = "running";
        try {
          const began = performance.now();
          const part = await runs.search(subject, (line) => posterior.tell(line));
          took_ms = performance.now() - began;
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
        forth.length = 0;
        update();
        undo.focus({ preventScroll: true }); // the button that was pressed is gone
        say(english(sentence_of_it));
      });
    },
    undo: () =>
      changing(async () => {
        if (undo.disabled) return;
        const now_model = await of.bytes_of(subject.model);
        await change_model(async () => {
          await runs.undo(subject.model);
          return runs.fitted(subject);
        });
        forth.push(now_model);
        say(t.live_undone);
      }),
    redo: () =>
      changing(async () => {
        const model = forth.at(-1);
        if (!model) return;
        await change_model(async () => {
          await of.put(subject.model, model);
          return runs.fitted(subject);
        });
        forth.pop();
        say(t.live_redone);
      }),
    act(command) {
      const [verb, ...rest] = words_of(command);
      const effects = added_by(command, subject);
      const target = rest[rest.indexOf("--target") + 1];
      if (verb === "add" && effects.length > 0) void (rest.includes("--dry-run") ? tried(effects[0] ?? "") : loop.add(effects));
      else if (verb === "plan") plan.open();
      else if (verb === "diagnose" || verb === "errors" || (verb === "report" && rest.includes("--diagnose"))) {
        if (rest.includes("--target") && target !== undefined && targets.includes(target)) subject = { ...subject, target };
        target_choice.value = subject.target;
        void loop.search();
      } else return false;
      return true;
    },
    diagnosed: () => found,
    to_optimum,
    first_slider: (effect) => list.slider(effect),
  };
  return loop;
};
