// The model as a list: each effect with its curve, and each of its parameters under a slider.
import { effect } from "@preact/signals-core";
import { decimated, extent } from "../drawing/columns";
import { button, element, svg_element } from "../elements/elements";
import type { Num, Parameter } from "../report";
import { parameter_name, plain_name } from "../machine_errors/error_names";
import { plain, unit_shown } from "../drawing/text";
import { t } from "../texts/texts";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import { type ByValue, by_value } from "./by_value";
import type { Catalogue } from "./catalogue";
import type { Values } from "./history_of_steps";
import { kConstant, key_of } from "./slid";
import type { Store } from "./store";

export interface ModelList {
  element: HTMLElement;
  slider(effect: string): Slider | undefined; // the first of it
  leave(): void;
}

const kConstant_effect = "constant";

const unit_of = (unit: string): string => unit_shown(plain(unit, 20)).replace(/\bum\b/g, "µm");

// The actions on the list.
export interface ModelListOf {
  catalogue: Catalogue;
  store: Store;
  begin(): void; // a slider will be moved, or a value typed
  changed(): void;
  hold(one: Parameter, value: number): void;
  free(one: Parameter): void;
  remove(effect: string): void;
}

interface Row {
  one: Parameter | null; // null: it was never shown
  slider: Slider;
  number: ByValue;
}

export const model_list = ({ catalogue, store, begin, changed, ...of }: ModelListOf): ModelList => {
  const list = element("ul", { class: "live-model" });
  const rows = new Map<string, Row>();
  const curves = new Map<string, HTMLElement>();
  let shape = ""; // of the list: which effects and parameters it has

  const optimum_of = (one: Parameter): Optimum => {
    const known = catalogue.parameter(one.effect ?? "", one.name);
    return {
      label: parameter_name(one.name),
      typed: plain(one.name, 60),
      of: plain_name(one.effect ?? "", 60),
      unit: unit_of(one.unit),
      value: one.value ?? 0,
      sigma: one.sigma,
      lower: known?.lower ?? null,
      upper: known?.upper ?? null,
    };
  };
  const value_of = (one: Parameter): Parameters<ByValue["renew"]>[0] => ({
    ...optimum_of(one),
    held: one.state === "held",
    can_hold: one.name !== kConstant,
  });
  // One drag, one typed value, or keys soon after one another are one step, if nothing else was moved meanwhile.
  let last: { key: string; made: Values } | null = null;
  const go = (key: string, one: Parameter, to: number, goes_on: boolean): void => {
    const values = store.moved.now.peek();
    if (!goes_on || last?.key !== key || last.made !== values) begin();
    const made = new Map([...values].filter(([other]) => other !== key));
    if (to !== one.value) made.set(key, to);
    last = { key, made };
    store.moved.set(made);
    changed();
  };
  // A slider with its number; what is asked of it is of the fit that is shown then.
  const row_of = (first: Parameter): HTMLElement => {
    const key = key_of(first);
    const now = (): Parameter => rows.get(key)?.one ?? first;
    const slider: Slider = slider_of((to, goes_on) => go(key, now(), to, goes_on));
    const number = by_value(value_of(first), (value) => slider.move(value), () => of.hold(now(), slider.value()), () => of.free(now()));
    rows.set(key, { one: null, slider, number });
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
  const build = (free: readonly Parameter[]): void => {
    rows.clear();
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
  };

  const leave = effect(() => {
    const [free, moved, drawn] = [store.free.value, store.moved.now.value, store.drawn.value];
    const now = free.map(key_of).join("\n\n");
    if (now !== shape) build(free);
    shape = now;
    for (const one of free) {
      const row = rows.get(key_of(one));
      if (!row) continue;
      const at = moved.get(key_of(one)) ?? null;
      if (row.one !== one) {
        row.slider.renew(optimum_of(one));
        row.number.renew(value_of(one));
      }
      row.one = one;
      row.slider.put(at);
      row.number.show(at ?? one.value ?? 0, at !== null);
    }
    const contributions = drawn?.series.contributions ?? [];
    const [least, largest] = extent(contributions.map(({ values_um }) => values_um));
    const ends = least <= largest ? ([least, largest] as const) : ([0, 1] as const);
    for (const { effect, values_um } of contributions) curves.get(effect)?.replaceChildren(small_curve(values_um, ends));
  });
  return { element: list, leave, slider: (effect) => [...rows.values()].find(({ one }) => one?.effect === effect)?.slider };
};

// A parameter with a slider: shows the optimum, sigma and the present value.

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
  put(value: number | null): void; // there, and nobody is told; null: at the optimum
  renew(optimum: Optimum): void;
}

const range_of = ({ value, sigma, lower, upper }: Optimum): [number, number] => {
  const half = Math.max(kSigmas * (sigma ?? 0), 0.5 * Math.abs(value)) || 1;
  return [Math.max(lower ?? -Infinity, value - half), Math.min(upper ?? Infinity, value + half)];
};

// moved: where to, and whether that goes on with the drag or the keys before.
const slider_of = (moved: (to: number, goes_on: boolean) => void): Slider => {
  let optimum: Optimum = { label: "", typed: "", of: "", unit: "", value: 0, sigma: null, lower: null, upper: null };
  let at: number | null = null; // null: at the optimum
  let is_down = false;
  let last_ms = 0; // of a key; 0: what comes is another step
  const input = element("input", { type: "range" });
  const band = element("span", { class: "band" });
  const mark = element("span", { class: "optimum" });
  const output = element("output");
  const name = element("span", { class: "name" });
  const track = element("span", { class: "track" }, band, mark, input);

  const text = (): string => {
    const decimals = Math.min(9, decimals_for(optimum.value, optimum.sigma) + (at === null ? 0 : 1));
    const number = at === null && optimum.sigma !== null ? with_sigma(optimum.value, optimum.sigma, decimals) : shown(at ?? optimum.value, decimals);
    return optimum.unit === "1" ? number : `${number} ${optimum.unit}`;
  };
  input.addEventListener("pointerdown", () => {
    is_down = true;
    last_ms = 0;
  });
  for (const up of ["pointerup", "pointercancel"]) input.addEventListener(up, () => (is_down = false));
  input.addEventListener("input", () => {
    const now_ms = performance.now();
    const goes_on = last_ms > 0 && (is_down || now_ms - last_ms <= kPause_ms);
    last_ms = now_ms;
    moved(Number(input.value), goes_on);
  });
  return {
    element: element("label", { class: "slider" }, name, track, output),
    value: () => at ?? optimum.value,
    move(to) {
      last_ms = 0;
      moved(to, false);
    },
    put(to) {
      at = to;
      input.value = String(to ?? optimum.value);
      output.textContent = text();
      input.setAttribute("aria-valuetext", to === null ? t.live_at_optimum({ value: text() }) : text());
      track.classList.toggle("moved", to !== null);
    },
    renew(now) {
      optimum = now;
      const [from, to] = range_of(now);
      const share = (at: number): number => Math.min(1, Math.max(0, to > from ? (at - from) / (to - from) : 0.5));
      input.min = String(from);
      input.max = String(to);
      input.step = String((to - from) / kSteps || 1);
      input.disabled = !(to > from);
      input.setAttribute("aria-label", `${now.of}: ${now.label}`);
      name.textContent = now.label;
      name.title = now.typed;
      track.style.setProperty("--optimum", String(share(now.value)));
      track.style.setProperty("--from", String(share(now.value - (now.sigma ?? 0))));
      track.style.setProperty("--to", String(share(now.value + (now.sigma ?? 0))));
      band.hidden = now.sigma === null;
    },
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
