// The choices and switches of a picture. The switches are its legend.
import { button, element, select_of, svg_element } from "../elements/elements";
import type { Choice, Picture, Slider, State, Toggle } from "../picture";
import { clamped } from "../drawing/text";
import { t } from "../texts/texts";

export interface Controls {
  element: HTMLElement;
  update(state: State, drawn?: boolean): void; // not drawn yet: sliders wait
}

type Change = (keys: readonly string[], on: boolean) => void;
type Switches = ReadonlyMap<string, HTMLElement>; // by the key of the curve

const switch_of = (toggle: Toggle, dark: boolean, change: (on: boolean) => void, alone: () => void): HTMLElement => {
  const box = element("input", { type: "checkbox", "data-curve": toggle.key });
  box.addEventListener("change", () => change(box.checked));
  const all = element("label", { class: "toggle", title: t.figure_alone_title }, box, mark_of(toggle, dark), element("bdi", {}, clamped(toggle.label, 120)));
  all.addEventListener("dblclick", alone);
  return all;
};

// Curves of one kind under its name, with buttons that switch them all.
const group_of = (name: string, toggles: readonly Toggle[], switches: Switches, change: Change): HTMLElement => {
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
    ...toggles.flatMap(({ key }) => switches.get(key) ?? []),
  );
};

const legend_of = (toggles: readonly Toggle[], switches: Switches, change: Change): HTMLElement[] => {
  const names = [...new Set(toggles.flatMap(({ group }) => group ?? []))];
  return names.length > 0
    ? names.map((name) => group_of(name, toggles.filter(({ group }) => group === name), switches, change))
    : [...switches.values()];
};

// A numeric choice: its slider, the number, and a button for the automatic value.
const kSteps = 100; // of the slider, a decade

interface Chooser {
  label: HTMLElement;
  update(state: State, drawn: boolean): void;
}

// Two digits: a number that is read.
export const within_slider = ({ least, most }: Slider, value: number): string =>
  String(Number(Math.min(most, Math.max(least, value)).toPrecision(2)));

const slider_of = (choice: Choice, slider: Slider, choose: (value: string) => void): Chooser => {
  const at = (value: number): number => Math.round(kSteps * Math.log10(value / slider.least));
  const input = element("input", { type: "range", min: "0", max: String(at(slider.most)), step: "1" });
  input.addEventListener("input", () => choose(within_slider(slider, slider.least * 10 ** (Number(input.value) / kSteps))));
  const told = element("output", {});
  const [by_itself] = choice.values;
  const back = button(by_itself?.label ?? "", "", () => choose(choice.initial));
  return {
    label: element("span", { class: "choice magnify" }, element("label", {}, element("span", {}, choice.label), " ", input), told, back),
    update({ chosen }, drawn) {
      if (!drawn) return; // drawing may take long
      const now = slider.now(chosen);
      input.value = String(at(now));
      told.textContent = slider.text(now);
      input.setAttribute("aria-valuetext", slider.text(now));
      back.disabled = (chosen[choice.key] ?? choice.initial) === choice.initial;
    },
  };
};

const chooser_of = (choice: Choice, choose: (value: string) => void): Chooser => {
  if (choice.slider) return slider_of(choice, choice.slider, choose);
  const values = choice.values.map(({ value, label }) => [value, clamped(label, 120)] as const);
  const { label, select } = select_of(choice.label, values, choose);
  return { label, update: ({ chosen }) => void (select.value = chosen[choice.key] ?? choice.initial) };
};

const used_by_key = (legend: HTMLElement): HTMLElement[] => [...legend.querySelectorAll<HTMLElement>("input, button")];

const alike = (a: readonly Toggle[], b: readonly Toggle[]): boolean =>
  a.length === b.length && a.every(({ key, label, mark, group }, k) => key === b[k]?.key && label === b[k].label && mark === b[k].mark && group === b[k].group);

export const controls_of = (
  picture: Picture,
  choose: (key: string, value: string) => void,
  change: Change,
): Controls => {
  const choices = (picture.choices ?? []).map((choice) => chooser_of(choice, (value) => choose(choice.key, value)));
  const legend = element("div", { class: "legend", role: "group", "aria-label": t.figure_curves });
  let shown: { dark: boolean; toggles: readonly Toggle[] } | null = null;
  let state: State;
  // This one, or all again where it is the only one.
  const alone = (toggles: readonly Toggle[], key: string): void => {
    const others = toggles.map((one) => one.key).filter((one) => one !== key);
    change(others, others.every((one) => state.hidden.has(one)));
    change([key], true);
  };
  const write = (toggles: readonly Toggle[], dark: boolean): void => {
    const focused = used_by_key(legend).findIndex((one) => one === document.activeElement);
    const switches = new Map(toggles.map((one) => [one.key, switch_of(one, dark, (on) => change([one.key], on), () => alone(toggles, one.key))]));
    legend.replaceChildren(...legend_of(toggles, switches, change));
    used_by_key(legend)[focused]?.focus();
  };
  const update = (now: State, drawn = true): void => {
    state = now;
    for (const choice of choices) choice.update(now, drawn);
    const toggles = picture.toggles(now);
    const { dark } = now.look;
    if (shown?.dark !== dark || !alike(shown.toggles, toggles)) write(toggles, dark);
    shown = { dark, toggles };
    for (const box of legend.querySelectorAll<HTMLInputElement>("input")) box.checked = !now.hidden.has(box.dataset["curve"] ?? "");
  };
  const all = element("div", { class: "controls" }, element("div", { class: "choices" }, ...choices.map(({ label }) => label)), legend);
  return { element: all, update };
};

// The mark of a curve in its legend.

const drawn = (mark: Toggle["mark"], colour: string): SVGElement => {
  const line = { x1: "1", y1: "6", x2: "23", y2: "6", stroke: colour, "stroke-width": "2.5" };
  switch (mark) {
    case "line":
      return svg_element("line", line);
    case "dashed":
      return svg_element("line", { ...line, "stroke-dasharray": "6 3.5" });
    case "dotted":
      return svg_element("line", { ...line, "stroke-dasharray": "2 2.5" });
    case "dot":
      return svg_element("circle", { cx: "12", cy: "6", r: "4", fill: colour });
    case "band":
      return svg_element("rect", { x: "1", y: "1", width: "22", height: "10", fill: colour, "fill-opacity": "0.35" });
    case "bar":
      return svg_element("rect", { x: "6", y: "1", width: "12", height: "10", fill: colour });
  }
};

export const mark_of = (toggle: Toggle, dark: boolean): SVGElement => {
  const svg = svg_element("svg", { width: "24", height: "12", viewBox: "0 0 24 12", "aria-hidden": "true" });
  svg.append(drawn(toggle.mark, toggle.colour(dark)));
  return svg;
};
