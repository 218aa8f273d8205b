// The curves of the picture of candidates: the residual, the best set, and the candidate that is chosen.
import { difference, sum } from "../drawing/columns";
import { curve, type Dash } from "../drawing/curve";
import type { Toggle } from "../picture";
import type { Ranked, SetName } from "./ranking";
import type { Num } from "../report";
import { colours, curve_colour, dashes } from "../drawing/theme";
import { t } from "../texts/texts";

// A candidate with what it adds that the model cannot make.
export interface Shown extends Ranked {
  values_um: readonly Num[];
}

type Points = readonly [number, Num][];

export interface Curve {
  toggle: Toggle;
  values_um: readonly Num[];
  series: (name: string, colour: string, points: Points) => Record<string, unknown>; // of ECharts
}

const lined =
  (dash: Dash, width_px: number): Curve["series"] =>
  (name, colour, points) =>
    curve(name, colour, dash, width_px, points);

// As a marker pen draws: below the other curves.
const highlighted: Curve["series"] = (name, colour, points) =>
  curve(name, colour, "solid", 8, points, { z: 1, lineStyle: { color: colour, width: 8, opacity: 0.4, cap: "round" } });

// Faint below the curve of a set; where there is none, it is what is looked at.
export const residual_curve = (residual_um: readonly Num[], below: boolean): Curve => ({
  toggle: {
    key: "residual",
    label: t.diagnosis_measured_less_model,
    colour: (dark) => (below ? colours(dark).faint : curve_colour(1, dark)),
    mark: "line",
    on: true,
  },
  values_um: residual_um,
  series: lined("solid", 1),
});

// Of the k-th effect of a set; the solid line is that of all together.
const dash_of = (k: number): Dash => dashes[1 + (k % (dashes.length - 1))] ?? "dashed";

// The set that is drawn, by the name that it may have: where it has several effects their sum, which is what stands for
// the residual, and each of them. What the model gives way by counts once, with the set.
export const best_curves = (best: readonly Shown[], refit_um: readonly Num[], named: SetName): Curve[] => {
  const strong = (label: string, values_um: readonly Num[]): Curve => ({
    toggle: { key: "best", label, colour: (dark) => curve_colour(1, dark), mark: "line", on: true },
    values_um,
    series: lined("solid", 2.2),
  });
  const [only, ...others] = best;
  if (!only) return [];
  if (others.length === 0) {
    const label = named === "best" ? only.name : t.diagnosis_only({ effect: only.name, set: t.diagnosis_closest_set_label });
    return [strong(label, sum([only.values_um, refit_um]))];
  }
  const each = best.map(
    (one, k): Curve => ({
      toggle: {
        key: `best-${one.key}`,
        label: one.name,
        colour: (dark) => curve_colour(k + 2, dark),
        mark: dash_of(k) === "dotted" ? "dotted" : "dashed",
        on: true,
      },
      values_um: one.values_um,
      series: lined(dash_of(k), 1.4),
    }),
  );
  const label = named === "best" ? t.diagnosis_best_set_together : t.diagnosis_closest_set_label;
  return [strong(label, sum([refit_um, ...best.map((one) => one.values_um)])), ...each];
};

// What is left without it is known only where it was fitted alone: in a set, its amplitude goes with the others.
export const chosen_curves = (one: Shown, residual_um: readonly Num[], refit_um: readonly Num[]): Curve[] => {
  const with_refit = sum([one.values_um, refit_um]);
  const colour = (dark: boolean): string => curve_colour(0, dark);
  return [
    {
      toggle: { key: "chosen", label: t.diagnosis_chosen({ effect: one.name }), colour, mark: "band", on: true },
      values_um: with_refit,
      series: highlighted,
    },
    ...(one.alone
      ? [
          {
            toggle: { key: "without", label: t.diagnosis_left_without, colour, mark: "dotted" as const, on: true },
            values_um: difference(residual_um, with_refit),
            series: lined("dotted", 1.1),
          },
        ]
      : []),
  ];
};
