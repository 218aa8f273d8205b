// What was recorded beside the drift: one picture a unit, each column on the clock of its file.
import type { Picture, Range } from "../picture";
import type { Column, Report } from "../report";
import { clamped, plain, slug } from "../drawing/text";
import { minutes } from "../drawing/theme";
import { time_curves, type TimeCurve } from "./time_curves";
import { whole_min } from "../drawing/time_axis";
import { split_name, words } from "../drawing/units";
import { named as named_of, t } from "../texts/texts";

export interface Signal {
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
  return plain(told ? t.drift_with_role({ name: clamped(read, 40), role: named_of(t.roles, role) }) : read, 64);
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

const kFew = 8; // curves that can be told apart, and need no groups

// By role, in this order; then those that have another.
const roles = ["structure", "ambient", "coolant", "bearing", "mean_point", "housing", "bar", "load"];
const place_of = (role: string): number => (roles.includes(role) ? roles.indexOf(role) : roles.length);

// Columns that the verdict of any target names.
const named_columns = ({ diagnose }: Report): Set<string> =>
  new Set(
    (diagnose?.targets ?? []).flatMap((found) => {
      if (found.not_diagnosed !== undefined) return [];
      const driver = found.verdict === "driver" ? found.drivers.slice(0, 1).map(({ column }) => column) : [];
      return [...[...found.named, ...found.probable].flatMap(({ columns }) => Object.values(columns)), ...driver];
    }),
  );

// Many in groups: those of the verdict in front and on, the others by their role, and where there are such, off at first.
const grouped_by_role = (curves: readonly TimeCurve[], signals: readonly Signal[], named: ReadonlySet<string>): TimeCurve[] => {
  if (curves.length <= kFew) return [...curves];
  const some = curves.some(({ key }) => named.has(key));
  return curves
    .map((one, k) => {
      const { role } = signals[k]?.column ?? { role: "" };
      const front = named.has(one.key);
      const group = front ? t.drift_named_group : words(named_of(t.roles, plain(role, 30))) || t.drift_other_group;
      return { ...one, group, quiet: some && !front, place: front ? -1 : place_of(role) };
    })
    .sort((a, b) => a.place - b.place);
};

const grouped = (signals: readonly Signal[]): Map<string, Signal[]> => {
  const groups = new Map<string, Signal[]>();
  for (const signal of signals) groups.set(signal.column.unit, [...(groups.get(signal.column.unit) ?? []), signal]);
  return groups;
};

// Of all that a page has over time outside of a model, so that its pictures stand below one another.
export const whole_of = (report: Report): Range =>
  whole_min([
    ...(report.drift ? [report.drift.points.map(({ time_s }) => minutes(time_s))] : []),
    ...(report.five_probe ? [report.five_probe.time_s.map(minutes)] : []),
    ...report.signals.map(({ time_s }) => time_s.map(minutes)),
  ]);

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
      caption: t.drift_measured_caption,
      about: "",
      quantity: unit === "um" ? t.drift_quantity_displacement : t.drift_quantity_measured,
      unit,
      curves: curves_of(of),
      whole_min,
      height_px: 360,
    }),
  );

export const signal_pictures = (report: Report, signals: readonly Signal[], whole_min: Range): Picture[] =>
  [...grouped(signals.filter((signal) => !measured(signal)))].map(([unit, of]) => {
    return time_curves({
      ...kind_of(unit),
      caption: unit === "rpm" ? t.drift_speed_caption : t.drift_signals_caption,
      about: "",
      unit,
      curves: grouped_by_role(curves_of(of), of, named_columns(report)),
      whole_min,
      step: unit === "rpm",
      height_px: unit === "rpm" ? 200 : 280,
    });
  });
