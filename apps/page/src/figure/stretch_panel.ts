// A stretch of the x axis, from and to, with what the numbers are within it.
import { button, element } from "../elements/elements";
import type { Numbers, Range } from "../picture";
import { statistics_within } from "./statistics";
import { table_of } from "../elements/table";
import { capital } from "../drawing/text";
import { shown } from "../drawing/theme";
import { split_name, words } from "../drawing/units";

export interface StretchPanel {
  element: HTMLElement;
  update(stretch: Range | null, open: boolean, numbers: () => Numbers): void;
}

const heading = ["quantity", "unit", "n", "mean", "standard deviation", "least", "largest", "change, first to last"];

const table = (stretch: Range, numbers: Numbers): HTMLElement => {
  const x = split_name(numbers.columns[0]?.name ?? "");
  const rows = statistics_within(numbers, stretch).map((one) => {
    const { quantity, unit } = split_name(one.name);
    const values = [one.mean, one.deviation, one.least, one.largest, one.change].map((value) => shown(value));
    return [words(quantity), unit, String(one.n), ...values];
  });
  const title = `${capital(words(x.quantity))} from ${shown(stretch[0])} to ${shown(stretch[1])} ${x.unit}`;
  return rows.length > 0 ? table_of({ title, heading, rows }) : element("p", { class: "note" }, `${title}: no values.`);
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
    element("label", {}, "From ", from),
    element("label", {}, "to ", to),
    unit,
    button("Zoom to it", "Show only this stretch", zoom),
    button("Clear", "Clear the stretch (Escape)", () => select(null)),
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
        : element("p", { class: "note" }, "Drag over the picture, or type where it begins and ends."),
    );
  };
  return { element: panel, update };
};
