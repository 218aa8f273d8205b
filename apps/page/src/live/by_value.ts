// A parameter by its number: typed beside the slider, held there, or freed.
import { button, element } from "../elements/elements";
import type { Num } from "../report";
import { decimals_for } from "../drawing/theme";
import { t } from "../texts/texts";

export interface OfValue {
  label: string; // of the parameter
  of: string; // the effect
  value: number; // as fitted
  sigma: Num;
  lower: Num;
  upper: Num;
  held: boolean;
  can_hold: boolean;
}

export interface ByValue {
  element: HTMLElement;
  renew(now: OfValue): void; // of another fit
  show(value: number, moved: boolean): void; // as the slider has it
}

export const by_value = (first: OfValue, typed: (value: number) => void, hold: () => void, free: () => void): ByValue => {
  let now = first;
  const field = element("input", { type: "number", step: "any" });
  const hold_button = button(t.hands_hold, "", hold);
  const free_button = button(t.hands_free, "", free);
  const mark = element("span", { class: "held" }, t.hands_held);
  const all = element("div", { class: "by-value" }, field, hold_button, free_button, mark);

  // While it is typed in, its keys are its own; then Ctrl+Z is the page's again.
  const done = (is: boolean): void => {
    field.toggleAttribute("data-done", is);
  };
  done(true);
  field.addEventListener("input", () => done(false));
  field.addEventListener("change", () => {
    done(true);
    const value = Number(field.value);
    if (field.value === "" || !Number.isFinite(value)) return show(now.value, false);
    if (field.checkValidity()) typed(value);
    else field.reportValidity();
  });
  const show = (value: number, moved: boolean): void => {
    if (document.activeElement !== field || !moved) {
      const decimals = Math.min(9, decimals_for(now.value, now.sigma) + (moved ? 2 : 1));
      field.value = String(Number(value.toFixed(decimals)));
    }
    hold_button.hidden = !now.can_hold || (now.held && !moved);
    free_button.hidden = !now.held;
    mark.hidden = !now.held;
  };
  const renew = (next: OfValue): void => {
    now = next;
    field.setAttribute("aria-label", t.hands_value_of({ parameter: now.label, effect: now.of }));
    field.min = now.lower === null ? "" : String(now.lower);
    field.max = now.upper === null ? "" : String(now.upper);
    hold_button.title = t.hands_hold_title({ parameter: now.label });
    free_button.title = t.hands_free_title({ parameter: now.label });
    hold_button.setAttribute("aria-label", `${t.hands_hold}: ${now.label}, ${now.of}`);
    free_button.setAttribute("aria-label", `${t.hands_free}: ${now.label}, ${now.of}`);
    all.classList.toggle("is-held", now.held);
    show(now.value, false);
  };
  renew(first);
  return { element: all, renew, show };
};
