// What was recorded beside the drift: one picture a unit, each column on the clock of its file.
import type { Picture, Range } from "../picture";
import type { Column, Report } from "../report";
import { clamped, plain, slug } from "../drawing/text";
import { minutes } from "../drawing/theme";
import { time_curves, type TimeCurve } from "./time_curves";
import { split_name, words } from "../drawing/units";
import { named, t } from "../texts/texts";

interface Signal {
  column: Column;
  time_min: readonly number[];
}

interface Kind {
  name: string;
  title: string;
  quantity: string;
}

const kind_of = (unit: string): Kind => {
  switch (unit) {
    case "degC":
      return { name: "temperatures", title: t.drift_temperatures, quantity: t.drift_quantity_temperature };
    case "rpm":
      return { name: "speed", title: t.drift_speed, quantity: t.drift_quantity_speed };
    default:
      return {
        name: `signals-${slug(unit)}`,
        title: t.drift_signals_in({ unit: clamped(unit, 20) }),
        quantity: t.drift_quantity_signal,
      };
  }
};

// A column of a measured quantity, such as a displacement of a plain series.
const measured = ({ column }: Signal): boolean => column.role === "measured";

// Roles that say more than the name and the unit do.
const told_roles = ["ambient", "coolant", "bearing", "housing", "bar"];

const label_of = ({ name, role }: Column): string => {
  const { quantity } = split_name(name);
  const told = told_roles.includes(role) && !quantity.includes(role);
  const read = words(quantity);
  return plain(told ? t.drift_with_role({ name: clamped(read, 40), role: named(t.roles, role) }) : read, 64);
};

const curves_of = (signals: readonly Signal[]): TimeCurve[] =>
  signals.map(({ column, time_min }, k) => ({
    key: column.name,
    label: label_of(column),
    time_min,
    values: column.values,
    colour: k % 8,
    dash: Math.floor(k / 8),
    on: true,
  }));

const grouped = (signals: readonly Signal[]): Map<string, Signal[]> => {
  const groups = new Map<string, Signal[]>();
  for (const signal of signals) groups.set(signal.column.unit, [...(groups.get(signal.column.unit) ?? []), signal]);
  return groups;
};

export const signals_of = (report: Report): Signal[] =>
  report.signals.flatMap(({ time_s, columns }) => {
    const time_min = time_s.map(minutes);
    return columns.map((column) => ({ column, time_min }));
  });

export const measured_pictures = (signals: readonly Signal[], whole_min: Range): Picture[] =>
  [...grouped(signals.filter(measured))].map(([unit, of]) =>
    time_curves({
      name: unit === "um" ? "measured" : `measured-${slug(unit)}`,
      title: unit === "um" ? t.drift_measured_displacements : t.drift_measured_in({ unit: clamped(unit, 20) }),
      about: "The measured columns as the file has them.",
      quantity: unit === "um" ? t.drift_quantity_displacement : t.drift_quantity_measured,
      unit,
      curves: curves_of(of),
      whole_min,
      height_px: 360,
    }),
  );

export const signal_pictures = (signals: readonly Signal[], whole_min: Range): Picture[] =>
  [...grouped(signals.filter((signal) => !measured(signal)))].map(([unit, of]) => {
    return time_curves({
      ...kind_of(unit),
      about: `Recorded beside the drift${unit === "rpm" ? "; a value holds until the next one" : ""}.`,
      unit,
      curves: curves_of(of),
      whole_min,
      step: unit === "rpm",
      height_px: unit === "rpm" ? 200 : 280,
    });
  });
