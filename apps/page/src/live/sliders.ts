// A parameter to move by hand: where the optimum is, how wide a sigma, and how far it was moved.
import { element } from "../elements/elements";
import type { Num } from "../report";
import { shown } from "../drawing/theme";
import { decimals_for, with_sigma } from "../drawing/with_sigma";
import { t } from "../texts/texts";

const kSteps = 400;
const kSigmas = 6; // to either side at least

export interface Optimum {
  label: string; // of the parameter
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
  const told = element("output");
  const name = element("span", { class: "name" });
  const track = element("span", { class: "track" }, band, mark, input);

  const value = (): number => (exact ? optimum.value : Number(input.value));
  const text = (): string => {
    const decimals = Math.min(9, decimals_for(optimum.value, optimum.sigma) + (exact ? 0 : 1));
    const number = exact && optimum.sigma !== null ? with_sigma(value(), optimum.sigma, decimals) : shown(value(), decimals);
    return optimum.unit === "1" ? number : `${number} ${optimum.unit}`;
  };
  const tell = (): void => {
    told.textContent = text();
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
    element: element("label", { class: "slider" }, name, track, told),
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
