// What is seen of the interactive model: its verdict, residual, sliders and possibly missing effects, from the store.
import { effect, signal } from "@preact/signals-core";
import { next_label } from "../diagnosis/next_action";
import { micrometres, plain } from "../drawing/text";
import { rmse_shown } from "../drawing/theme";
import { button, element, kept_open, select_of } from "../elements/elements";
import { type Figure, figure_of } from "../figure/figure";
import type { PageState } from "../figure/view";
import { plain_name } from "../machine_errors/error_names";
import type { Range } from "../picture";
import type { Checked, Report } from "../report";
import { language, type Sentence, sentence_text, t } from "../texts/texts";
import { candidate_list, fall_shown, posterior_bars } from "./candidates";
import type { Catalogue } from "./catalogue";
import { effect_search } from "./effect_search";
import { fit_picture, type Now } from "./fit_picture";
import type { Stretch } from "./history_of_steps";
import { left_out_bar } from "./left_out";
import { type ModelList, model_list } from "./model_list";
import { next_test } from "./next_test";
import type { HandChange } from "./runs";
import { time_spoken } from "./spoken";
import type { Store } from "./store";
import { two_hypotheses } from "./two_hypotheses";

export interface LoopViewOf {
  store: Store;
  targets: readonly string[]; // to choose from
  catalogue: Catalogue;
  page: PageState;
  plan(): void; // the next test
  has_unit(target: string): boolean;
  state_unit(): void;
  add_figure(figure: Figure): void;
  across(): void; // fits across gaps of the length that the store has
  next(): void; // does what is proposed
  choose(target: string): void;
  search(): void;
  undo(): void;
  redo(): void;
  to_optimum(): void;
  begin(): void; // of a step of sliders
  slid(): void;
  add(effects: readonly string[], keep?: boolean): void;
  promise(effects: readonly (readonly string[])[]): void;
  change(change: HandChange): void;
  leave_out(left_out: readonly Stretch[]): void;
  compare(labels: readonly string[]): void;
}

export interface LoopView {
  element: HTMLElement;
  figures(): readonly Figure[];
  slider: ModelList["slider"];
  open_plan(): void;
  focus_undo(): void;
  select_nothing(): void; // in the picture
  leave(): void;
}

const write = (place: HTMLElement, text: Sentence): void => {
  place.textContent = micrometres(sentence_text(text));
  place.lang = typeof text === "string" ? language : "en";
};

export const loop_view = ({ store, targets, catalogue, page, ...of }: LoopViewOf): LoopView => {
  const { subject, fitted, drawn, found } = store;
  const is_moved = (): boolean => store.moved.now.value.size > 0;

  // The verdict, and what to do next.
  const sentence = element("p", { class: "said", role: "status", "aria-live": "polite" });
  const next = button("", "", () => of.next());
  const across = button("", t.live_across_title, () => of.across());
  next.className = across.className = "act";
  // Where the target is of counts or steps, and all sizes are said in um.
  const of_unit = element("span");
  const no_unit = element("p", { class: "refusal" }, of_unit, " ", button(t.live_state_unit, "", () => of.state_unit()));
  // What the data did not support, and was not kept; or what the model holds all the same.
  const refusal = element("p", { class: "refusal", role: "status" });

  // The picture, and rows of it to leave out.
  let made: { figure: Figure; rows: number } | null = null;
  const stretch = signal<Range | null>(null); // selected in it
  const place = element("div", { class: "picture" });
  const rows = left_out_bar(
    () => made?.figure.ask_stretch(),
    (one) => of.leave_out([...subject.peek().left_out, one].sort((a, b) => a.from_s - b.from_s)),
    (one) => of.leave_out(subject.peek().left_out.filter((other) => other !== one)),
  );
  const now = (): Now => ({
    report: store.report.peek() as Report,
    checked: drawn.peek() as Checked,
    before: store.moved.now.peek().size > 0 ? fitted.peek() : store.before.now.peek(),
    candidate: store.candidate.now.peek(),
    left_out: subject.peek().left_out,
  });
  // The same figure as long as it has the same rows, so that its zoom and its switches stay.
  const draw = (checked: Checked): void => {
    const count = checked.series.time_s.length;
    if (made?.rows === count) return made.figure.renew();
    const last = made?.figure;
    const figure = figure_of(fit_picture(now), page);
    made = { figure, rows: count };
    if (last) figure.select(null);
    last?.leave();
    figure.watch(() => (stretch.value = figure.state().stretch));
    place.replaceChildren(figure.element);
    figure.redraw();
  };

  // The model by hand.
  const fall = fall_shown();
  const posterior = posterior_bars();
  const list = model_list({
    catalogue,
    store,
    begin: of.begin,
    changed: of.slid,
    hold: ({ effect = "", name }, value) => of.change({ held: [{ effect, parameter: name, value }] }),
    free: ({ effect = "", name, value }) => of.change({ freed: [{ effect, parameter: name, value: value ?? 0 }] }),
    remove: (label) => of.change({ removed: [label] }),
  });
  const candidates = candidate_list(store.unfolded, of.add, (one) => store.candidate.set(one), of.promise);
  const two = two_hypotheses({
    store,
    page,
    add_figure: of.add_figure,
    compare: of.compare,
    keep: (label) => (label === "" ? store.both.set(null) : of.add([label])),
  });
  const effects = effect_search({ word: store.word, catalogue, add: (label) => of.add([label]), beside: (label) => two.beside(label) });
  const plan = next_test(store, of.plan);
  for (const box of [two.element, effects.element, plan.element]) kept_open(box, box.className, store.unfolded);
  const target_list = targets.map((target) => [target, plain(target, 60)] as const);
  const { select: target_choice, label: target_label } = select_of(t.live_explained, target_list, of.choose);
  target_label.hidden = targets.length < 2;
  const search = button(t.live_search, t.live_search_title, of.search);
  const undo = button(t.live_undo, t.live_undo_title, of.undo);
  const redo = button(t.live_redo, t.live_redo_title, of.redo);
  const back = button(t.live_to_optimum, t.live_to_optimum_title, of.to_optimum);
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
  const all = element(
    "section",
    { class: "live-loop", id: "loop", lang: language, "aria-label": t.live_loop },
    element("div", { class: "verdict" }, no_unit, refusal, sentence, across, next),
    element("div", { class: "by-hand" }, element("div", {}, place, rows.element), hand),
    two.element,
  );

  const views: (() => void)[] = [
    () => {
      const text = store.sentence();
      if (sentence.textContent !== micrometres(sentence_text(text))) write(sentence, text); // what is said again is not heard
    },
    () => {
      const action = store.next.value;
      next.hidden = !action || action.action === "plan" || store.refusal.now.value?.tried === true; // a plan has a place of its own
      next.textContent = action ? next_label(action) : "";
      next.title = action?.effects.join(", ") ?? "";
      next.dataset.action = action?.action ?? "";
      next.dataset.rmse = rmse_shown(action?.promised_rmse_um ?? null);
      next.disabled = store.trying.value;
    },
    () => {
      across.hidden = store.gap_s.value === 0;
      across.textContent = t.live_across({ length: time_spoken(store.gap_s.value) });
    },
    () => {
      const target = fitted.value?.target ?? subject.value.target;
      no_unit.hidden = target === "" || of.has_unit(target);
      of_unit.textContent = t.live_no_unit({ column: plain(target, 60) });
    },
    () => {
      const refused = store.refusal.now.value;
      const held = (found.value?.unsupported ?? []).map((label) => plain_name(label, 60)).join(", ");
      refusal.hidden = !refused && held === "";
      if (!refused) return void (refusal.textContent = held === "" ? "" : t.live_unsupported({ effects: held }));
      const [label, title] = refused.tried ? [t.live_add_tried, t.live_add_tried_title] : [t.live_keep, t.live_keep_title];
      const why = element("span");
      write(why, refused.sentence());
      refusal.replaceChildren(why, " ", button(label, title, () => of.add(refused.effects, true)));
    },
    () => {
      const [by_hand, fit, moved] = [drawn.value, fitted.value, is_moved()];
      const before = store.before.now.value;
      void [store.candidate.now.value, subject.value.left_out]; // of the picture too
      all.classList.toggle("no-model", !fit);
      all.classList.toggle("wide", fit !== null);
      asked.hidden = fit !== null;
      if (!by_hand || !fit) return;
      fall.show({ before: moved ? fit.rmse_um : (before?.rmse_um ?? null), now: by_hand.rmse_um, floor: by_hand.floor_um, moved });
      draw(fit);
    },
    () => rows.show(subject.value.left_out, stretch.value, fitted.value?.level === "series"),
    () => void (target_choice.value = subject.value.target || (fitted.value?.target ?? "")),
    () => {
      candidates.show(store.search.value === "running" ? null : found.value);
      candidates.promise(store.promised.now.peek());
    },
    () => {
      if (found.value) plan.offer(found.value);
    },
    plan.show,
    two.offer,
    two.show,
    () => candidates.promise(store.promised.now.value),
    () => posterior.show(store.posterior.value),
    () => {
      const choices = store.choices.now.value;
      if (choices) effects.show(choices, fitted.value?.level ?? (subject.value.group.kind === "recordings" ? "recording" : "series"));
    },
    () => {
      all.dataset.search = store.search.value;
      all.dataset.revisions = String(store.revisions.value);
      all.dataset.steps = String(store.steps.count());
      if (store.busy.value > 0) all.setAttribute("aria-busy", "true");
      else all.removeAttribute("aria-busy");
      undo.disabled = !store.can_undo.value;
      redo.disabled = !store.steps.can_redo();
      back.disabled = !is_moved();
      search.disabled = store.busy.value > 0;
    },
  ];
  const leaves = [...views.map((view) => effect(view)), list.leave];

  const figures = (): Figure[] => [...(made ? [made.figure] : []), ...two.figures()];
  return {
    element: all,
    figures,
    slider: list.slider,
    open_plan: plan.open,
    focus_undo: () => undo.focus({ preventScroll: true }),
    select_nothing: () => made?.figure.select(null),
    leave() {
      for (const leave of leaves) leave();
      for (const figure of figures()) figure.leave(); // else its chart would stay linked
    },
  };
};
