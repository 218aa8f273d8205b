// The numbers of a picture as a table, created when it is opened.
import { rows_of } from "./files";
import { button, details_of, element, table_of } from "../elements/elements";
import type { Numbers, Range } from "../picture";
import { shown } from "../drawing/theme";
import { t } from "../texts/texts";
import { extent } from "../drawing/columns";
import { capital, split_name, words } from "../drawing/text";

const kRows = 200;

const rows_from = (numbers: Numbers): string[][] =>
  Array.from({ length: Math.min(kRows, rows_of(numbers)) }, (_, row) =>
    numbers.columns.map(({ values }) => {
      const value = values[row] ?? null;
      return typeof value === "string" ? value : shown(value);
    }),
  );

export interface NumbersTable {
  element: HTMLDetailsElement;
  update(): void;
}

export const numbers_table = (title: string, numbers: () => Numbers): NumbersTable => {
  const body = element("div");
  const details = details_of("numbers", t.figure_numbers, body);
  let shown_last: Numbers | null = null;
  const update = (): void => {
    if (!details.open) return;
    const all = numbers();
    if (all === shown_last) return;
    shown_last = all;
    const rows = rows_of(all);
    const heading = all.columns.map((column) => column.name);
    const note = rows > kRows ? t.figure_first_rows({ shown: kRows, rows }) : t.figure_rows({ rows });
    body.replaceChildren(table_of({ title, heading, rows: rows_from(all) }), element("p", { class: "note" }, note));
  };
  details.addEventListener("toggle", update);
  return { element: details, update };
};

// A stretch of the x axis, from and to, with what the numbers are within it.

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
  const to_it = button(t.figure_zoom, t.figure_zoom_title, zoom);
  const fields = element(
    "div",
    { class: "fields" },
    element("label", {}, `${t.figure_from} `, from),
    element("label", {}, `${t.figure_to} `, to),
    unit,
    to_it,
    button(t.figure_clear, t.figure_clear_title, () => select(null)),
  );
  const result = element("div");
  const panel = element("div", { class: "stretch" }, fields, result);
  panel.hidden = true;

  let shown_last: [Range | null, Numbers] | null = null;
  const update = (stretch: Range | null, open: boolean, numbers: () => Numbers): void => {
    panel.hidden = !open && !stretch;
    to_it.disabled = stretch === null;
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

// Statistics of the numbers of a picture within an interval of its x axis.

export interface Statistics {
  name: string;
  n: number;
  mean: number;
  deviation: number | null; // standard deviation, of n - 1
  least: number;
  largest: number;
  change: number; // last minus first
}

// One entry a column of numbers with a value in the stretch. The first column is x; of standard deviations there is
// nothing to say.
export const statistics_within = (numbers: Numbers, stretch: readonly [number, number]): Statistics[] => {
  const x = numbers.columns[0]?.values ?? [];
  const inside: number[] = [];
  x.forEach((value, row) => {
    if (typeof value === "number" && value >= stretch[0] && value <= stretch[1]) inside.push(row);
  });
  return numbers.columns.slice(1).flatMap(({ name, values }) => {
    if (/(^|_)sigma(_|$)/.test(name)) return [];
    const known = inside.flatMap((row) => values[row] ?? []).filter((value) => typeof value === "number");
    const [first, last] = [known[0], known.at(-1)];
    if (first === undefined || last === undefined) return [];
    const n = known.length;
    const mean = known.reduce((sum, value) => sum + value / n, 0);
    const squares = known.reduce((sum, value) => sum + (value - mean) ** 2, 0);
    const [least, largest] = extent([known]);
    return [{ name, n, mean, deviation: n > 1 ? Math.sqrt(squares / (n - 1)) : null, least, largest, change: last - first }];
  });
};
