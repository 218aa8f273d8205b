// The model as a list: each effect with its curve, and each of its parameters under a slider.
import type { Setting } from "./runs";
import { decimated, extent } from "../drawing/columns";
import { button, element, svg_element } from "../elements/elements";
import type { Checked, Num, Parameter } from "../report";
import { is_scaled, kConstant, key_of } from "./fit_picture";
import { parameter_name, plain_name } from "../machine_errors/error_names";
import { plain, unit_shown } from "../drawing/text";
import { t } from "../texts/texts";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import type { Engine } from "../engine";
import { type ByValue, by_value } from "./by_value";
import type { Values } from "./history_of_steps";

export interface ModelList {
  element: HTMLElement;
  renew(checked: Checked): void; // of another fit: values, sigmas, curves
  draw(checked: Checked): void; // the curves, as the sliders have them
  values(): ReadonlyMap<string, number>; // by key_of
  gains(): ReadonlySet<string>;
  settings(): Setting[]; // all of them, where one whose curve does not scale was moved
  moved(): boolean;
  moved_values(): Values;
  put(values: Values): void; // these are moved, the others where the fit has them
  back(): void;
  slider(effect: string): Slider | undefined; // the first of it
}

const unit_of = (unit: string): string => unit_shown(plain(unit, 20)).replace(/\bum\b/g, "µm");

// The actions on the list.
export interface ModelListOf {
  catalogue: Catalogue;
  begin(): void; // a slider will be moved, or a value typed
  changed(): void;
  hold(one: Parameter, value: number): void;
  free(one: Parameter): void;
  remove(effect: string): void;
}

export const model_list = ({ catalogue, begin, changed, ...of }: ModelListOf): ModelList => {
  const list = element("ul", { class: "live-model" });
  const sliders = new Map<string, { one: Parameter; slider: Slider; number: ByValue }>();
  const curves = new Map<string, HTMLElement>();
  let fitted: Checked | null = null;
  let shape = ""; // of the list: which effects and parameters it has

  const optimum_of = (one: Parameter, value: number): Optimum => {
    const known = catalogue.parameter(one.effect ?? "", one.name);
    return {
      label: parameter_name(one.name),
      typed: plain(one.name, 60),
      of: plain_name(one.effect ?? "", 60),
      unit: unit_of(one.unit),
      value,
      sigma: one.sigma,
      lower: known?.lower ?? null,
      upper: known?.upper ?? null,
    };
  };
  const value_of = (one: Parameter, optimum: Optimum): Parameters<ByValue["renew"]>[0] => ({
    ...optimum,
    held: one.state === "held",
    can_hold: one.name !== kConstant,
  });
  const show_numbers = (): void => {
    for (const { one, slider, number } of sliders.values()) number.show(slider.value(), slider.value() !== one.value);
  };
  const begin_with = (slider: Slider): void => {
    for (const other of sliders.values()) if (other.slider !== slider) other.slider.rest();
    begin();
  };
  // A slider with its number; `one` is what the list has of it when it is used.
  const row_of = (one: Parameter): HTMLElement => {
    const key = key_of(one);
    const optimum = optimum_of(one, one.value ?? 0);
    const now = (): Parameter => sliders.get(key)?.one ?? one;
    const slider: Slider = slider_of(optimum, () => begin_with(slider), changed);
    const number = by_value(value_of(one, optimum), (value) => slider.move(value), () => of.hold(now(), slider.value()), () => of.free(now()));
    sliders.set(key, { one, slider, number });
    return element("div", { class: "parameter" }, slider.element, number.element);
  };
  const head_of = (effect: string, curve: HTMLElement): HTMLElement => {
    const name = plain_name(effect, 80) || t.live_model;
    const head = element("div", { class: "effect" }, element("bdi", { title: plain(effect, 200) }, name), curve);
    if (effect === "" || effect === kConstant_effect) return head;
    const remove = button("×", t.hands_remove_title({ effect: name }), () => of.remove(effect));
    remove.className = "remove";
    remove.setAttribute("aria-label", t.hands_remove_title({ effect: name }));
    head.append(remove);
    return head;
  };
  const draw = (checked: Checked): void => {
    show_numbers();
    const { contributions } = checked.series;
    const [least, largest] = extent(contributions.map(({ values_um }) => values_um));
    const ends = least <= largest ? ([least, largest] as const) : ([0, 1] as const);
    for (const { effect, values_um } of contributions) curves.get(effect)?.replaceChildren(small_curve(values_um, ends));
  };
  const moved = (): boolean => [...sliders.values()].some(({ one, slider }) => slider.value() !== one.value);

  return {
    element: list,
    renew(checked) {
      fitted = checked;
      // Circles of recordings are fitted to what is left in any case.
      const free = checked.parameters.filter(
        ({ value, effect, name }) => value !== null && (checked.level === "series" || catalogue.parameter(effect ?? "", name)),
      );
      const now = JSON.stringify(free.map(key_of));
      if (now === shape) {
        for (const one of free) {
          const known = sliders.get(key_of(one));
          if (!known || one.value === null) continue;
          known.one = one;
          known.slider.renew(optimum_of(one, one.value));
          known.number.renew(value_of(one, optimum_of(one, one.value)));
        }
      } else {
        shape = now;
        sliders.clear();
        curves.clear();
        const by_effect = new Map<string, Parameter[]>();
        for (const one of free) by_effect.set(one.effect ?? "", [...(by_effect.get(one.effect ?? "") ?? []), one]);
        list.replaceChildren(
          ...[...by_effect].map(([effect, parameters]) => {
            const curve = element("span", { class: "curve" });
            curves.set(effect, curve);
            return element("li", {}, head_of(effect, curve), ...parameters.map(row_of));
          }),
        );
      }
      draw(checked);
    },
    draw,
    values: () => new Map([...sliders].map(([key, { slider }]) => [key, slider.value()])),
    gains() {
      const all = fitted?.parameters ?? [];
      const is_gain = ({ effect, name }: Parameter): boolean =>
        name === kConstant || catalogue.parameter(effect ?? "", name)?.kind === "gain";
      return new Set(all.filter(is_gain).map(key_of));
    },
    settings() {
      const checked = fitted;
      if (!checked) return [];
      const all = [...sliders.values()];
      const gains = this.gains();
      if (!all.some(({ one, slider }) => slider.value() !== one.value && !is_scaled(checked, one, gains))) return [];
      // One stays free, for a fit has to have something to fit; its curve is then scaled as well.
      const free = all.find(({ one }) => one.state !== "held" && is_scaled(checked, one, gains));
      const held = all.filter((each) => each !== free);
      return held.map(({ one, slider }) => ({ effect: one.effect ?? "", parameter: one.name, value: slider.value() }));
    },
    moved,
    moved_values: () =>
      new Map([...sliders].flatMap(([key, { one, slider }]) => (slider.value() === one.value ? [] : [[key, slider.value()] as const]))),
    put(values) {
      for (const [key, { slider }] of sliders) slider.put(values.get(key) ?? null);
    },
    back() {
      for (const { slider } of sliders.values()) slider.back();
      if (fitted) draw(fitted);
    },
    slider: (effect) => [...sliders.values()].find(({ one }) => one.effect === effect)?.slider,
  };
};

// A parameter with a slider: shows the optimum, sigma and the present value.

const kConstant_effect = "constant";
const kSteps = 400;
const kPause_ms = 1000; // key presses within this time are one step
const kSigmas = 6; // to either side at least

export interface Optimum {
  label: string; // of the parameter
  typed: string; // its name in the program
  of: string; // the effect
  unit: string;
  value: number;
  sigma: Num;
  lower: Num; // bounds of the catalogue
  upper: Num;
}

export interface Slider {
  element: HTMLElement;
  value(): number;
  move(value: number): void; // as a hand does
  put(value: number | null): void; // there, and nobody is told; null: to the optimum
  back(): void; // to the optimum
  rest(): void; // what is moved next is another step
  renew(optimum: Optimum): void;
}

const range_of = ({ value, sigma, lower, upper }: Optimum): [number, number] => {
  const half = Math.max(kSigmas * (sigma ?? 0), 0.5 * Math.abs(value)) || 1;
  return [Math.max(lower ?? -Infinity, value - half), Math.min(upper ?? Infinity, value + half)];
};

// begin: before each step, which is one drag, one typed value, or keys soon after one another.
export const slider_of = (first: Optimum, begin: () => void, changed: () => void): Slider => {
  let optimum = first;
  let at: number | null = null; // where it was moved to; null: at the optimum, between two steps
  let in_step = false;
  let is_down = false;
  let last_ms = 0;
  const input = element("input", { type: "range" });
  const band = element("span", { class: "band" });
  const mark = element("span", { class: "optimum" });
  const output = element("output");
  const name = element("span", { class: "name" });
  const track = element("span", { class: "track" }, band, mark, input);

  const value = (): number => at ?? optimum.value;
  const text = (): string => {
    const decimals = Math.min(9, decimals_for(optimum.value, optimum.sigma) + (at === null ? 0 : 1));
    const number = at === null && optimum.sigma !== null ? with_sigma(value(), optimum.sigma, decimals) : shown(value(), decimals);
    return optimum.unit === "1" ? number : `${number} ${optimum.unit}`;
  };
  const tell = (): void => {
    output.textContent = text();
    input.setAttribute("aria-valuetext", at === null ? t.live_at_optimum({ value: text() }) : text());
    track.classList.toggle("moved", at !== null);
  };
  const renew = (now: Optimum): void => {
    optimum = now;
    at = null;
    in_step = false;
    const [from, to] = range_of(now);
    const share = (at: number): number => Math.min(1, Math.max(0, to > from ? (at - from) / (to - from) : 0.5));
    input.min = String(from);
    input.max = String(to);
    input.step = String((to - from) / kSteps || 1);
    input.value = String(now.value);
    input.disabled = !(to > from);
    input.setAttribute("aria-label", `${now.of}: ${now.label}`);
    name.textContent = now.label;
    name.title = now.typed;
    track.style.setProperty("--optimum", String(share(now.value)));
    track.style.setProperty("--from", String(share(now.value - (now.sigma ?? 0))));
    track.style.setProperty("--to", String(share(now.value + (now.sigma ?? 0))));
    band.hidden = now.sigma === null;
    tell();
  };
  const go = (to: number, as_one: boolean): void => {
    if (!as_one || !in_step) begin();
    in_step = as_one;
    at = to;
    tell();
    changed();
  };
  const put = (to: number | null): void => {
    at = to;
    in_step = false;
    input.value = String(to ?? optimum.value);
    tell();
  };
  input.addEventListener("pointerdown", () => {
    is_down = true;
    in_step = false;
  });
  for (const up of ["pointerup", "pointercancel"]) input.addEventListener(up, () => (is_down = false));
  input.addEventListener("input", () => {
    const now_ms = performance.now();
    if (!is_down && now_ms - last_ms > kPause_ms) in_step = false;
    last_ms = now_ms;
    go(Number(input.value), true);
  });
  renew(first);
  return {
    element: element("label", { class: "slider" }, name, track, output),
    value,
    move(to) {
      input.value = String(to);
      go(to, false);
    },
    put,
    back: () => put(null),
    rest() {
      in_step = false;
    },
    renew,
  };
};

// What an effect adds, as small as a word. Of many rows the extremes of each stretch are drawn.

const kWidth = 120;
const kHeight = 26;

const path_of = (values: readonly Num[], [least, largest]: readonly [number, number]): string => {
  const high = largest - least || 1;
  const points = decimated(
    values.map((_, i) => i),
    values,
    null,
    kWidth,
  );
  return points
    .map(([i, value]) => {
      const x = (kWidth * i) / Math.max(1, values.length - 1);
      return value === null ? "" : `${x.toFixed(1)},${(kHeight - 1 - ((value - least) / high) * (kHeight - 2)).toFixed(1)}`;
    })
    .filter((point) => point !== "")
    .join(" ");
};

export const small_curve = (values: readonly Num[], extent: readonly [number, number]): SVGElement => {
  const svg = svg_element("svg", { viewBox: `0 0 ${kWidth} ${kHeight}`, class: "small-curve", "aria-hidden": "true" });
  svg.append(svg_element("polyline", { points: path_of(values, extent) }));
  return svg;
};

// What the catalogue says of the parameters of an effect.

export interface CatalogueEntry {
  name: string;
  level: string;
  summary: string; // in a line
  inputs: { role: string; units: string[]; meaning: string }[];
  parameters: { name: string; kind: "gain" | "shape"; lower: Num; upper: Num; meaning: string }[];
}

export type Known = CatalogueEntry["parameters"][number];

export interface Catalogue {
  parameter(label: string, name: string): Known | undefined; // label: "lagged_expansion(T_room_degC)"
  entry(name: string, level: string): CatalogueEntry | undefined; // some are of both levels
}

const name_in = (label: string): string => /^[A-Za-z_0-9]+/.exec(label)?.[0] ?? label;

export const catalogue_of = async (engine: Engine): Promise<Catalogue> => {
  const { out } = await engine.run(["effects", "--json"]);
  const read = JSON.parse(out) as CatalogueEntry[] | { effects: CatalogueEntry[] };
  const all = Array.isArray(read) ? read : read.effects;
  const by_name = new Map(all.map((entry) => [entry.name, entry]));
  return {
    entry: (name, level) => all.find((entry) => entry.name === name && entry.level === level),
    parameter: (label, name) => by_name.get(name_in(label))?.parameters.find((one) => one.name === name),
  };
};
