// The model as a list: each effect with its curve, and each of its parameters under a slider.
import type { Setting } from "./runs";
import { decimated, extent } from "../drawing/columns";
import { element, svg_element } from "../elements/elements";
import type { Checked, Num, Parameter } from "../report";
import { is_scaled, kConstant, key_of } from "./fit_picture";
import { parameter_name, plain_name } from "../machine_errors/error_names";
import { plain, unit_shown } from "../drawing/text";
import { t } from "../texts/texts";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import type { Engine } from "../engine";

export interface ModelList {
  element: HTMLElement;
  renew(checked: Checked): void; // of another fit: values, sigmas, curves
  draw(checked: Checked): void; // the curves, as the sliders have them
  values(): ReadonlyMap<string, number>; // by key_of
  gains(): ReadonlySet<string>;
  settings(): Setting[]; // all of them, where one whose curve does not scale was moved
  moved(): boolean;
  back(): void;
  slider(effect: string): Slider | undefined; // the first of it
}

const unit_of = (unit: string): string => unit_shown(plain(unit, 20)).replace(/\bum\b/g, "µm");

export const model_list = (catalogue: Catalogue, changed: (key: string) => void): ModelList => {
  const list = element("ul", { class: "live-model" });
  const sliders = new Map<string, { one: Parameter; slider: Slider }>();
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
  const draw = (checked: Checked): void => {
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
            const rows = parameters.map((one) => {
              const slider = slider_of(optimum_of(one, one.value ?? 0), () => changed(key_of(one)));
              sliders.set(key_of(one), { one, slider });
              return slider.element;
            });
            const head = element("div", { class: "effect" }, element("bdi", { title: plain(effect, 200) }, plain_name(effect, 80) || t.live_model), curve);
            return element("li", {}, head, ...rows);
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
      const unscaled = [...sliders.values()].some(
        ({ one, slider }) => slider.value() !== one.value && !is_scaled(checked, one, this.gains()),
      );
      if (!unscaled) return [];
      // One stays free, for a fit has to have something to fit; its curve is then scaled as well.
      const free = [...sliders.values()].find(({ one }) => one.state !== "held" && is_scaled(checked, one, this.gains()));
      const held = [...sliders.values()].filter((each) => each !== free);
      return held.map(({ one, slider }) => ({
        effect: one.effect ?? "",
        parameter: one.name,
        value: slider.value(),
      }));
    },
    moved,
    back() {
      for (const { slider } of sliders.values()) slider.back();
      if (fitted) draw(fitted);
    },
    slider: (effect) => [...sliders.values()].find(({ one }) => one.effect === effect)?.slider,
  };
};

// A parameter to move by hand: where the optimum is, how wide a sigma, and how far it was moved.

const kSteps = 400;
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
  back(): void; // to the optimum
  renew(optimum: Optimum): void;
}

const range_of = ({ value, sigma, lower, upper }: Optimum): [number, number] => {
  const half = Math.max(kSigmas * (sigma ?? 0), 0.5 * Math.abs(value)) || 1;
  return [Math.max(lower ?? -Infinity, value - half), Math.min(upper ?? Infinity, value + half)];
};

export const slider_of = (first: Optimum, changed: () => void): Slider => {
  let optimum = first;
  let exact = true; // at the optimum, between two steps
  const input = element("input", { type: "range" });
  const band = element("span", { class: "band" });
  const mark = element("span", { class: "optimum" });
  const output = element("output");
  const name = element("span", { class: "name" });
  const track = element("span", { class: "track" }, band, mark, input);

  const value = (): number => (exact ? optimum.value : Number(input.value));
  const text = (): string => {
    const decimals = Math.min(9, decimals_for(optimum.value, optimum.sigma) + (exact ? 0 : 1));
    const number = exact && optimum.sigma !== null ? with_sigma(value(), optimum.sigma, decimals) : shown(value(), decimals);
    return optimum.unit === "1" ? number : `${number} ${optimum.unit}`;
  };
  const tell = (): void => {
    output.textContent = text();
    input.setAttribute("aria-valuetext", exact ? t.live_at_optimum({ value: text() }) : text());
    track.classList.toggle("moved", !exact);
  };
  const renew = (now: Optimum): void => {
    optimum = now;
    exact = true;
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
  input.addEventListener("input", () => {
    exact = false;
    tell();
    changed();
  });
  renew(first);
  return {
    element: element("label", { class: "slider" }, name, track, output),
    value,
    move(to) {
      input.value = String(to);
      exact = false;
      tell();
      changed();
    },
    back() {
      exact = true;
      input.value = String(optimum.value);
      tell();
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

interface Entry {
  name: string;
  parameters: { name: string; kind: "gain" | "shape"; lower: Num; upper: Num; meaning: string }[];
}

export type Known = Entry["parameters"][number];

export interface Catalogue {
  parameter(label: string, name: string): Known | undefined; // label: "lagged_expansion(T_room_degC)"
}

const name_in = (label: string): string => /^[A-Za-z_0-9]+/.exec(label)?.[0] ?? label;

export const catalogue_of = async (engine: Engine): Promise<Catalogue> => {
  const { out } = await engine.run(["effects", "--json"]);
  const all = JSON.parse(out) as Entry[] | { effects: Entry[] };
  const by_name = new Map((Array.isArray(all) ? all : all.effects).map((entry) => [entry.name, entry]));
  return {
    parameter: (label, name) => by_name.get(name_in(label))?.parameters.find((one) => one.name === name),
  };
};
