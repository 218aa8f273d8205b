// How large the error is now, and was before the last change.
import { element } from "../elements/elements";
import type { Num } from "../report";
import { shown } from "../drawing/theme";
import { t } from "../texts/texts";

export interface Fall {
  element: HTMLElement;
  show(of: { before: Num; now: Num; floor: Num; moved: boolean }): void;
}

const decimals_of = (value: Num): number => (value !== null && value > 0 ? Math.min(4, Math.max(2, 2 - Math.floor(Math.log10(value)))) : 2);

export const fall_shown = (): Fall => {
  const now = element("strong", { class: "rmse" });
  const beside = element("span", { class: "beside" });
  const bar_before = element("span", { class: "bar before" });
  const bar_now = element("span", { class: "bar now" });
  const mark = element("span", { class: "bar floor" });
  const all = element("div", { class: "live-fall" }, now, beside, element("div", { class: "bars", "aria-hidden": "true" }, bar_before, bar_now, mark));
  return {
    element: all,
    show({ before, now: value, floor, moved }) {
      const decimals = decimals_of(value);
      const most = Math.max(before ?? 0, value ?? 0) || 1;
      now.textContent = t.live_rmse({ value: shown(value, decimals) });
      beside.textContent = [
        ...(before === null ? [] : [moved ? t.live_rmse_at_optimum({ value: shown(before, decimals) }) : t.live_rmse_before({ value: shown(before, decimals) })]),
        ...(floor === null ? [] : [t.live_floor({ value: shown(floor, decimals) })]),
      ].join(", ");
      bar_before.hidden = before === null;
      mark.hidden = floor === null;
      all.dataset.beside = before === null ? "nothing" : moved ? "optimum" : "before";
      bar_before.style.setProperty("--share", String((before ?? 0) / most));
      bar_now.style.setProperty("--share", String((value ?? 0) / most));
      mark.style.setProperty("--share", String(Math.min(1, (floor ?? 0) / most)));
    },
  };
};
