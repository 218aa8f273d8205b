// What of a picture can be chosen and switched off. The switches are its legend.
import { element } from "../elements/elements";
import { mark_of } from "./mark";
import type { Choice, Picture, State, Toggle } from "../picture";
import { clamped } from "../drawing/text";

export interface Controls {
  element: HTMLElement;
  update(state: State): void;
}

const select_of = (
  choice: Choice,
  choose: (value: string) => void,
): { label: HTMLElement; select: HTMLSelectElement } => {
  const select = element("select");
  for (const { value, label } of choice.values) select.add(new Option(clamped(label, 120), value));
  select.addEventListener("change", () => choose(select.value));
  return { label: element("label", { class: "choice" }, element("span", {}, choice.label), select), select };
};

const switch_of = (toggle: Toggle, state: State, change: (on: boolean) => void): HTMLElement => {
  const box = element("input", { type: "checkbox" });
  box.checked = !state.hidden.has(toggle.key);
  box.addEventListener("change", () => change(box.checked));
  return element(
    "label",
    { class: "toggle" },
    box,
    mark_of(toggle, state.look.dark),
    element("bdi", {}, clamped(toggle.label, 120)),
  );
};

export const controls_of = (
  picture: Picture,
  choose: (key: string, value: string) => void,
  change: (key: string, on: boolean) => void,
): Controls => {
  const choices = picture.choices.map((choice) => ({
    choice,
    ...select_of(choice, (value) => choose(choice.key, value)),
  }));
  const legend = element("div", { class: "legend", role: "group", "aria-label": "Curves" });
  let shown = "";
  const update = (state: State): void => {
    for (const { choice, select } of choices) select.value = state.chosen[choice.key] ?? choice.initial;
    const toggles = picture.toggles(state);
    // Made anew only where they differ, for a switch in use must keep the focus.
    const now = JSON.stringify([state.look.dark, toggles, toggles.map((toggle) => state.hidden.has(toggle.key))]);
    if (now === shown) return;
    shown = now;
    const focused = [...legend.children].findIndex((one) => one.contains(document.activeElement));
    legend.replaceChildren(...toggles.map((toggle) => switch_of(toggle, state, (on) => change(toggle.key, on))));
    legend.children[focused]?.querySelector("input")?.focus();
  };
  const all = element("div", { class: "controls" }, ...choices.map(({ label }) => label), legend);
  return { element: all, update };
};
