// Two hypotheses side by side: the model as it is, or with an effect more, each fitted, with curves and figures; one is
// kept.
import { button, details_of, element, table_of } from "../elements/elements";
import { type Figure, figure_of } from "../figure/figure";
import { model_fit_picture } from "../model/model_fit_picture";
import { strands_of } from "../drawing/strands";
import type { PageState } from "../figure/view";
import type { HypothesesPart, Report } from "../report";
import { plain_name } from "../machine_errors/error_names";
import { can_be_typed } from "./runs";
import type { Store } from "./store";
import { shown } from "../drawing/theme";
import { named, t } from "../texts/texts";

const kOffered = 12; // candidates

export interface TwoHypothesesOf {
  store: Store;
  page: PageState;
  add_figure(figure: Figure): void; // of the page, as its others
  compare(labels: readonly string[]): void; // "": the model as it is
  keep(label: string): void;
}

export interface TwoHypotheses {
  element: HTMLDetailsElement;
  offer(): void; // what can be chosen
  show(): void; // what was compared
  beside(label: string): void; // as the other one
  figures(): readonly Figure[];
}

export const two_hypotheses = ({ store, page, add_figure, compare, keep }: TwoHypothesesOf): TwoHypotheses => {
  const selects = [t.hands_first, t.hands_second].map((name) => element("select", { "aria-label": name }));
  const chosen_now = (): string[] => selects.map(({ value }) => value);
  const answer = element("div", { class: "both", "aria-live": "polite" });
  const start = button(t.hands_compare, "", () => compare(chosen_now()));
  const box = details_of(
    "live-two",
    t.hands_two,
    element("p", { class: "about" }, t.hands_two_about),
    element("div", { class: "buttons" }, ...selects, start),
    answer,
  );
  let made: readonly Figure[] = [];

  const label_shown = (label: string): string => (label === "" ? t.hands_as_it_is : t.hands_with({ effect: plain_name(label, 60) }));
  for (const select of selects) select.addEventListener("change", () => store.set_beside.set({ ...store.set_beside.now.peek(), chosen: chosen_now() }));

  const figures_of = ({ hypotheses, p }: HypothesesPart): HTMLElement => {
    const rows = hypotheses.map(({ row }) => row);
    const line = (what: string, value: (row: (typeof rows)[number], k: number) => string): string[] => [what, ...rows.map(value)];
    return table_of({
      title: t.hands_figures,
      heading: ["", ...hypotheses.map(({ effects }) => label_shown(effects.join(", ")))],
      rows: [
        line("RMSE µm", (row) => shown(row.rmse_um, 3)),
        line(t.diagnosis_times_floor, (row) => shown(row.times_floor, 2)),
        line(t.diagnosis_left_out_um, (row) => shown(row.held_out_um, 3)),
        line(t.diagnosis_parameters, (row) => String(row.parameters)),
        line(t.hands_likelihood, (row, k) => ((hypotheses[k]?.effects.length ?? 0) === 0 ? "0" : shown(row.likelihood_ratio ?? null, 1))),
        line(t.hands_p_of_two, (_, k) => shown(p[k] ?? null, 3)),
        line(t.verdict, (row) => (row.verdict === "start" ? "" : named(t.verdicts, row.verdict))),
      ],
    });
  };

  const side_of = (report: Report, { effects, check: { targets } }: HypothesesPart["hypotheses"][number], k: number): HTMLElement => {
    const label = effects[0] ?? "";
    const checked = targets[0];
    const parts: HTMLElement[] = [element("h4", {}, element("bdi", {}, label_shown(label)))];
    if (checked) {
      const figure = figure_of({ ...model_fit_picture(report, checked, strands_of(checked), `hypothesis-${k + 1}`), height_px: 340 }, page);
      made = [...made, figure];
      parts.push(figure.element);
    }
    const take = button(label === "" ? t.hands_as_it_is : t.hands_keep, "", () => keep(label));
    take.setAttribute("aria-label", `${t.hands_keep}: ${label_shown(label)}`);
    return element("div", { class: "side" }, ...parts, element("div", { class: "buttons" }, take));
  };

  return {
    element: box,
    offer() {
      const candidates = store.found.value?.candidates ?? [];
      const { labels, chosen } = store.set_beside.now.value;
      const likely = candidates.filter(({ columns }) => can_be_typed(Object.values(columns))).slice(0, kOffered).map(({ label }) => label);
      const offered = [...new Set(["", ...likely, ...labels, ...chosen])];
      for (const [k, select] of selects.entries()) {
        select.replaceChildren(...offered.map((label) => new Option(label_shown(label), label)));
        select.value = chosen[k] ?? offered[offered.length > 2 ? k + 1 : k] ?? "";
      }
      const [one, other] = chosen_now();
      start.disabled = one === other || store.comparing.value;
      start.title = one === other ? t.hands_differ : "";
    },
    show() {
      const both = store.both.now.value;
      const report = store.report.peek();
      for (const figure of made) figure.leave();
      made = [];
      if (!both || !report) return answer.replaceChildren();
      const sides = both.hypotheses.map((one, k) => side_of(report, one, k));
      answer.replaceChildren(figures_of(both), element("div", { class: "sides" }, ...sides));
      for (const figure of made) {
        add_figure(figure);
        figure.redraw();
      }
    },
    beside(label) {
      const { labels } = store.set_beside.now.peek();
      const [first = ""] = chosen_now();
      store.set_beside.set({ labels: [...labels, label], chosen: [first === label ? "" : first, label] });
      box.open = true;
      box.scrollIntoView({ block: "nearest" });
      start.focus({ preventScroll: true });
    },
    figures: () => made,
  };
};
