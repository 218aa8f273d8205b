// The model as a list: each effect with its curve, and each of its parameters under a slider.
import type { Catalogue } from "./catalogue";
import type { Setting } from "./commands";
import { element } from "../elements/elements";
import type { Checked, Num, Parameter } from "../report";
import { is_scaled, kConstant, key_of } from "./slid";
import { slider_of, type Optimum, type Slider } from "./sliders";
import { extent_of, small_curve } from "./small_curve";
import { plain } from "../drawing/text";
import { unit_shown } from "../drawing/units";
import { t } from "../texts/texts";

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
      label: plain(one.name.replace(/_(um|s|per)(_.*)?$/, "").replaceAll("_", " "), 40) || plain(one.name, 40),
      of: plain(one.effect ?? "", 60),
      unit: unit_of(one.unit),
      value,
      sigma: one.sigma,
      lower: known?.lower ?? null,
      upper: known?.upper ?? null,
    };
  };
  const draw = (checked: Checked): void => {
    const { contributions } = checked.series;
    const extent = extent_of(contributions.map(({ values_um }) => values_um.map((value): Num => value)));
    for (const { effect, values_um } of contributions) curves.get(effect)?.replaceChildren(small_curve(values_um, extent));
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
            const head = element("div", { class: "effect" }, element("bdi", {}, plain(effect, 80) || t.live_model), curve);
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
