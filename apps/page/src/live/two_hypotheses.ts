// Two hypotheses side by side: the model as it is, or with an effect more, each fitted, with curves and figures; one is
// kept.
import { button, details_of, element, table_of } from "../elements/elements";
import { type Figure, figure_of } from "../figure/figure";
import { model_fit_picture } from "../model/model_fit_picture";
import { strands_of } from "../drawing/strands";
import type { PageState } from "../figure/view";
import type { Candidate, HypothesesPart, Report } from "../report";
import { plain_name } from "../machine_errors/error_names";
import { can_be_typed } from "./runs";
import { shown } from "../drawing/theme";
import { named, t } from "../texts/texts";

const kOffered = 12; // candidates

export interface TwoHypothesesOf {
  page: PageState;
  add_figure(figure: Figure): void; // of the page, as its others
  report(): Report | null;
  compare(hypotheses: readonly (readonly string[])[]): Promise<HypothesesPart | null>; // null: it could not, which is said
  keep(label: string): void; // "": the model stays
}

export interface TwoHypotheses {
  element: HTMLElement;
  offer(candidates: readonly Candidate[]): void; // of the model as it is
  forget(): void; // what was compared is of another model
  beside(label: string): void; // as the other one
  figures(): readonly Figure[];
}

export const two_hypotheses = ({ page, add_figure, report, compare, keep }: TwoHypothesesOf): TwoHypotheses => {
  const [one, other] = [t.hands_first, t.hands_second].map((name) => element("select", { "aria-label": name })) as [HTMLSelectElement, HTMLSelectElement];
  const answer = element("div", { class: "both", "aria-live": "polite" });
  const start = button(t.hands_compare, "", () => void ask());
  const box = details_of(
    "live-two",
    t.hands_two,
    element("p", { class: "about" }, t.hands_two_about),
    element("div", { class: "buttons" }, one, other, start),
    answer,
  );
  let made: readonly Figure[] = [];
  let asked: readonly string[] = []; // that are no candidates

  const label_shown = (label: string): string => (label === "" ? t.hands_as_it_is : t.hands_with({ effect: plain_name(label, 60) }));
  const forget = (): void => {
    for (const figure of made) figure.leave();
    made = [];
    answer.replaceChildren();
  };
  const forget_all = (): void => {
    asked = [];
    forget();
  };
  const check = (): void => {
    start.disabled = one.value === other.value;
    start.title = start.disabled ? t.hands_differ : "";
  };
  const offer = (select: HTMLSelectElement, label: string): void => {
    if ([...select.options].every(({ value }) => value !== label)) select.add(new Option(label_shown(label), label));
  };
  for (const select of [one, other]) {
    offer(select, "");
    select.addEventListener("change", check);
  }
  check();

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

  const ask = async (): Promise<void> => {
    forget();
    start.disabled = true;
    const found = await compare([one.value, other.value].map((label) => (label === "" ? [] : [label])));
    check();
    const of_report = report();
    if (!found || !of_report) return;
    const sides = found.hypotheses.map(({ effects, check: { targets } }, k) => {
      const label = effects[0] ?? "";
      const checked = targets[0];
      const parts: HTMLElement[] = [element("h4", {}, element("bdi", {}, label_shown(label)))];
      if (checked) {
        const figure = figure_of({ ...model_fit_picture(of_report, checked, strands_of(checked), `hypothesis-${k + 1}`), height_px: 340 }, page);
        made = [...made, figure];
        parts.push(figure.element);
      }
      const take = button(label === "" ? t.hands_as_it_is : t.hands_keep, "", () => keep(label));
      take.setAttribute("aria-label", `${t.hands_keep}: ${label_shown(label)}`);
      parts.push(element("div", { class: "buttons" }, take));
      return element("div", { class: "side" }, ...parts);
    });
    answer.replaceChildren(figures_of(found), element("div", { class: "sides" }, ...sides));
    for (const figure of made) {
      add_figure(figure);
      figure.redraw();
    }
  };

  return {
    element: box,
    forget: forget_all,
    offer(candidates) {
      const kept = [one.value, other.value];
      const labels = ["", ...new Set([...candidates.filter(({ columns }) => can_be_typed(Object.values(columns))).slice(0, kOffered).map(({ label }) => label), ...asked])];
      for (const [k, select] of [one, other].entries()) {
        select.replaceChildren();
        for (const label of labels) offer(select, label);
        const before = kept[k] ?? "";
        select.value = answer.hasChildNodes() || (before !== "" && labels.includes(before)) ? before : (labels[labels.length > 2 ? k + 1 : k] ?? "");
      }
      check();
    },
    beside(label) {
      asked = [...asked, label];
      offer(one, label);
      offer(other, label);
      if (one.value === label) one.value = "";
      other.value = label;
      check();
      box.open = true;
      box.scrollIntoView({ block: "nearest" });
      start.focus({ preventScroll: true });
    },
    figures: () => made,
  };
};
