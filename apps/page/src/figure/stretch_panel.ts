// A stretch of the x axis, from and to, with what the numbers are within it.
import { button, element } from "../elements/elements";
import type { Numbers, Range } from "../picture";
import { statistics_within } from "./statistics";
import { table_of } from "../elements/table";
import { capital } from "../drawing/text";
import { shown } from "../drawing/theme";
import { split_name, words } from "../drawing/units";
import { t } from "../texts/texts";

export interface StretchPanel {
  element: HTMLElement;
  update(stretch: Range | null, open: boolean, numbers: () => Numbers): void;
}

const heading = (): string[] => [
  t.recordings_quantity, t.unit, "n", t.figure_mean, t.figure_deviation, t.figure_least, t.figure_largest, t.figure_change,
];

const table = (stretch: Range, numbers: Numbers): HTMLElement => {
  const x = split_name(numbers.columns[0]?.name ?? "");
  const rows = statistics_within(numbers, stretch).map((one) => {
    const { quantity, unit } = split_name(one.name);
    const values = [one.mean, one.deviation, one.least, one.largest, one.change].map((value) => shown(value));
    return [words(quantity), unit, String(one.n), ...values];
  });
  const title = t.figure_stretch({
    quantity: capital(words(x.quantity)),
    from: shown(stretch[0]),
    to: shown(stretch[1]),
    unit: x.unit,
  });
  return rows.length > 0
    ? table_of({ title, heading: heading(), rows })
    : element("p", { class: "note" }, t.figure_stretch_empty({ stretch: title }));
};

export const stretch_panel = (select: (stretch: Range | null) => void, zoom: () => void): StretchPanel => {
  const from = element("input", { type: "number", step: "any" });
  const to = element("input", { type: "number", step: "any" });
  const unit = element("span", {});
  const read = (): void => {
    if (from.value === "" || to.value === "") return;
    const [a, b] = [Number(from.value), Number(to.value)];
    if (a < b) select([a, b]);
  };
  from.addEventListener("change", read);
  to.addEventListener("change", read);
  const fields = element(
    "div",
    { class: "fields" },
    element("label", {}, `${t.figure_from} `, from),
    element("label", {}, `${t.figure_to} `, to),
    unit,
    button(t.figure_zoom, t.figure_zoom_title, zoom),
    button(t.figure_clear, t.figure_clear_title, () => select(null)),
  );
  const result = element("div");
  const panel = element("div", { class: "stretch" }, fields, result);
  panel.hidden = true;

  let shown_last: [Range | null, Numbers] | null = null;
  const update = (stretch: Range | null, open: boolean, numbers: () => Numbers): void => {
    panel.hidden = !open && !stretch;
    if (panel.hidden) return;
    const all = numbers();
    if (shown_last?.[0] === stretch && shown_last[1] === all) return;
    shown_last = [stretch, all];
    unit.textContent = split_name(all.columns[0]?.name ?? "").unit;
    if (stretch && document.activeElement !== from) from.value = String(Number(stretch[0].toPrecision(6)));
    if (stretch && document.activeElement !== to) to.value = String(Number(stretch[1].toPrecision(6)));
    if (!stretch) from.value = to.value = "";
    result.replaceChildren(
      stretch
        ? table(stretch, all)
        : element("p", { class: "note" }, t.figure_how_to_select),
    );
  };
  return { element: panel, update };
};
