// What of a picture can be chosen and switched off. The switches are its legend.
import { button, element } from "../elements/elements";
import { mark_of } from "./mark";
import type { Choice, Picture, State, Toggle } from "../picture";
import { clamped } from "../drawing/text";
import { t } from "../texts/texts";

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

type Change = (keys: readonly string[], on: boolean) => void;

// Curves of one kind under its name, with buttons that switch them all.
const group_of = (name: string, toggles: readonly Toggle[], state: State, change: Change): HTMLElement => {
  const keys = toggles.map(({ key }) => key);
  const all = (label: string, on: boolean): HTMLButtonElement => {
    const made = button(label, "", () => change(keys, on));
    made.setAttribute("aria-label", t.figure_group_all({ group: name, all: label }));
    return made;
  };
  return element(
    "div",
    { class: "group", role: "group", "aria-label": name },
    element("span", { class: "of" }, name),
    all(t.figure_all, true),
    all(t.figure_group_none, false),
    ...toggles.map((toggle) => switch_of(toggle, state, (on) => change([toggle.key], on))),
  );
};

const switches_of = (toggles: readonly Toggle[], state: State, change: Change): HTMLElement[] => {
  const names = [...new Set(toggles.flatMap(({ group }) => group ?? []))];
  return names.length > 0
    ? names.map((name) => group_of(name, toggles.filter(({ group }) => group === name), state, change))
    : toggles.map((toggle) => switch_of(toggle, state, (on) => change([toggle.key], on)));
};

const used_by_key = (legend: HTMLElement): HTMLElement[] => [...legend.querySelectorAll<HTMLElement>("input, button")];

export const controls_of = (
  picture: Picture,
  choose: (key: string, value: string) => void,
  change: Change,
): Controls => {
  const choices = picture.choices.map((choice) => ({
    choice,
    ...select_of(choice, (value) => choose(choice.key, value)),
  }));
  const legend = element("div", { class: "legend", role: "group", "aria-label": t.figure_curves });
  let shown = "";
  const update = (state: State): void => {
    for (const { choice, select } of choices) select.value = state.chosen[choice.key] ?? choice.initial;
    const toggles = picture.toggles(state);
    // Made anew only where they differ, for a switch in use must keep the focus.
    const now = JSON.stringify([state.look.dark, toggles, toggles.map((toggle) => state.hidden.has(toggle.key))]);
    if (now === shown) return;
    shown = now;
    const focused = used_by_key(legend).findIndex((one) => one === document.activeElement);
    legend.replaceChildren(...switches_of(toggles, state, change));
    used_by_key(legend)[focused]?.focus();
  };
  const all = element("div", { class: "controls" }, ...choices.map(({ label }) => label), legend);
  return { element: all, update };
};
