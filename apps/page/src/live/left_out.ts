// Rows to leave out of the fit, selected by dragging in the picture, and how to include them again.
import { button, element } from "../elements/elements";
import type { Stretch } from "./history_of_steps";
import type { Range } from "../picture";
import { colours, shown } from "../drawing/theme";
import { t } from "../texts/texts";

export interface LeftOutBar {
  element: HTMLElement;
  show(left_out: readonly Stretch[], selected: Range | null, can: boolean): void; // selected: in minutes
}

const ends_of = ({ from_s, to_s }: Stretch): { from: string; to: string } => ({ from: shown(from_s / 60, 0), to: shown(to_s / 60, 0) });

export const left_out_bar = (ask: () => void, leave_out: (stretch: Stretch) => void, restore: (stretch: Stretch) => void): LeftOutBar => {
  const bar = element("div", { class: "live-left-out buttons" });
  const begin = button(t.hands_leave_out, t.hands_leave_out_title, () => {
    ask();
    hint.hidden = false;
  });
  const hint = element("span", { class: "note", role: "status" }, t.hands_drag_now);
  hint.hidden = true;
  let stretch: Stretch | null = null;
  const fit = button("", t.hands_leave_out_title, () => {
    if (stretch) leave_out(stretch);
  });
  fit.className = "act";
  const chips = element("span", { class: "chips" });
  bar.append(begin, hint, fit, chips);
  return {
    element: bar,
    show(left_out, selected, can) {
      bar.hidden = !can;
      stretch = selected ? { from_s: Math.round(selected[0] * 60), to_s: Math.round(selected[1] * 60) } : null;
      fit.hidden = !stretch;
      begin.hidden = stretch !== null;
      if (stretch) {
        hint.hidden = true;
        fit.textContent = t.hands_leave_out_these(ends_of(stretch));
      }
      chips.replaceChildren(
        ...left_out.map((one) => {
          const chip = button(`${t.hands_left_out}: ${t.hands_stretch(ends_of(one))} ×`, t.hands_restore(ends_of(one)), () => restore(one));
          chip.className = "chip";
          return chip;
        }),
      );
    },
  };
};

// Its shade in both grids, and an x axis that goes as far.
export const with_left_out = (drawn: Record<string, unknown>, left_out: readonly Stretch[], dark: boolean, whole: boolean): Record<string, unknown> => {
  if (left_out.length === 0) return drawn;
  const minutes = left_out.map(({ from_s, to_s }) => [from_s / 60, to_s / 60] as const);
  const bands = [0, 1].map((grid) => ({
    type: "line",
    name: t.hands_left_out,
    data: [],
    silent: true,
    xAxisIndex: grid,
    yAxisIndex: grid,
    tooltip: { show: false },
    markArea: {
      silent: true,
      itemStyle: { color: colours(dark).faint, opacity: 0.28 },
      label: { show: grid === 0, position: "insideTop", color: colours(dark).ink, fontSize: 11 },
      data: minutes.map(([from, to]) => [{ xAxis: from, name: t.hands_left_out }, { xAxis: to }]),
    },
  }));
  const farther = (axis: unknown): unknown => {
    const { min, max } = axis as { min?: unknown; max?: unknown };
    if (!whole || typeof min !== "number" || typeof max !== "number") return axis;
    return { ...(axis as object), min: Math.min(min, ...minutes.map(([from]) => from)), max: Math.max(max, ...minutes.map(([, to]) => to)) };
  };
  const { series, xAxis } = drawn;
  return {
    ...drawn,
    series: [...bands, ...(Array.isArray(series) ? series : [])],
    xAxis: Array.isArray(xAxis) ? xAxis.map(farther) : xAxis,
  };
};
