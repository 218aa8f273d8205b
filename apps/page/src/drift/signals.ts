// What was measured and recorded, as the files have it: raw data.
import { extent } from "../drawing/columns";
import { command_of, data_files, report_command } from "../drawing/command";
import type { First, Picture, Range, Section } from "../picture";
import type { Column, Report } from "../report";
import { started_of } from "../report";
import { capital, clamped, plain, slug, split_name, words } from "../drawing/text";
import { minutes, rounded, shown, time_text } from "../drawing/theme";
import { named as named_of, t } from "../texts/texts";
import { time_curves, type TimeCurve, type TimeCurves } from "./time_curves";
import { whole_min } from "../drawing/axes";

const counted = (n: number, text: (counted: { n: number }) => string): string[] => (n === 0 ? [] : [text({ n })]);

// "5 measured columns, 16 temperatures, 1 speed over 27 h 44 min"
const result_of = (signals: readonly Signal[], span_min: number): string => {
  const rest = signals.filter((signal) => !measured(signal));
  const of = (unit: string): number => rest.filter(({ column }) => column.unit === unit).length;
  const [warm, speeds] = [of("degC"), of("rpm")];
  const all = [
    ...counted(signals.length - rest.length, t.drift_count_measured),
    ...counted(warm, t.drift_count_temperatures),
    ...counted(speeds, t.drift_count_speeds),
    ...counted(rest.length - warm - speeds, t.drift_count_others),
  ];
  return t.drift_signals_result({ counts: all.join(", "), time: time_text(span_min, 0) });
};

// "y changes most: by 31.7 µm, from -0.2 to 31.5"
const most_moved = (signals: readonly Signal[]): string | null => {
  let most: { signal: Signal; least: number; largest: number } | null = null;
  for (const signal of signals) {
    const [least, largest] = extent([signal.column.values]);
    if (largest > least && largest - least > (most ? most.largest - most.least : 0)) most = { signal, least, largest };
  }
  if (!most) return null;
  const { signal, least, largest } = most;
  const { quantity, unit } = split_name(signal.column.name);
  const [range, from, to] = [largest - least, least, largest].map((value) => rounded(value, 3));
  return t.drift_moves_most({ what: words(plain(quantity, 40)), range: `${range} ${unit}`, from: from ?? "", to: to ?? "" });
};

export const signals_section = (report: Report): Section[] => {
  const signals = signals_of(report);
  if (signals.length === 0) return [];
  const whole = whole_of(report);
  const pictures = [...measured_pictures(report, signals, whole), ...signal_pictures(report, signals, whole)];
  const any_measured = signals.some(measured);
  const moved = most_moved(signals.filter(measured));
  const result = result_of(signals, (whole[1] - whole[0]) / 1.03);
  const first = (picture: string): First => ({
    picture,
    conclusion: () => ({
      verdict: moved ?? t.drift_sentence({ text: result }),
      next: {
        label: any_measured ? t.drift_next : t.drift_signals_next,
        command: any_measured ? report_command(data_files(report)) : command_of("could", data_files(report)),
        action: { action: any_measured ? "find" : "columns" },
      },
    }),
  });
  return [
    {
      id: "signals",
      heading: any_measured ? t.drift_measured_and_signals : t.drift_signals,
      result,
      sentences: report.signals.flatMap(({ rows, time_s }) => (rows === undefined ? [] : [t.drift_thinned({ shown: shown(time_s.length, 0), rows: shown(rows, 0) })])),
      first: pictures[0] && first(pictures[0].name),
      pictures,
    },
  ];
};

// What was recorded beside the drift: one picture a unit, each column on the clock of its file.

interface Signal {
  column: Column;
  time_min: readonly number[];
  run: { number: number; source: string } | null; // where another file has a column of this name
}

const kind_of = (unit: string): Pick<TimeCurves, "name" | "title" | "quantity"> => {
  switch (unit) {
    case "degC":
      return { name: "temperatures", title: t.drift_temperatures, quantity: t.drift_quantity_temperature };
    case "rpm":
      return { name: "speed", title: t.drift_speed, quantity: t.drift_quantity_speed };
    default:
      return { name: `signals-${slug(unit)}`, title: t.drift_signals_in({ unit: clamped(unit, 20) }), quantity: t.drift_quantity_signal };
  }
};

// A column of a measured quantity, such as a displacement of a plain series.
const measured = ({ column }: Signal): boolean => column.role === "measured";

// Roles that say more than the name and the unit do.
const noteworthy_roles = ["ambient", "coolant", "bearing", "housing", "bar"];

const label_of = ({ column: { name, role }, run }: Signal): string => {
  const { quantity } = split_name(name);
  const has_role = noteworthy_roles.includes(role) && !quantity.includes(role);
  const read = words(quantity) + (run ? ` (${run.number})` : "");
  return plain(has_role ? t.drift_with_role({ name: clamped(read, 40), role: named_of(t.roles, role) }) : read, 64);
};

const curves_of = (signals: readonly Signal[]): TimeCurve[] =>
  signals.map((signal, k) => ({
    key: signal.run ? `run${signal.run.number}_${signal.column.name}` : signal.column.name,
    label: label_of(signal),
    time_min: signal.time_min,
    values: signal.column.values,
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
      const driver = found.verdict === "driver" ? found.drivers.filter(({ is_clear }) => is_clear).slice(0, 1).map(({ column }) => column) : [];
      return [...[...found.named, ...found.probable].flatMap(({ columns }) => Object.values(columns)), ...driver];
    }),
  );

// Many in groups: those of the verdict in front and on, the others by their run or role, and where there are such, off at
// first.
const in_groups = (curves: readonly TimeCurve[], signals: readonly Signal[], named: ReadonlySet<string>): TimeCurve[] => {
  if (curves.length <= kFew && !signals.some(({ run }) => run)) return [...curves];
  const some = signals.some(({ column }) => named.has(column.name));
  return curves
    .map((one, k) => {
      const { column, run } = signals[k] ?? { column: { name: "", role: "" }, run: null };
      const { role } = column;
      const front = named.has(column.name);
      const file = run ? `${run.number}: ${plain(run.source, 40)}` : "";
      const by_role = words(named_of(t.roles, plain(role, 30))) || t.drift_other_group;
      const group = front ? t.drift_named_group : file || by_role;
      return { ...one, group, quiet: some && !front, place: front ? -1 : place_of(role) };
    })
    .sort((a, b) => a.place - b.place);
};

// A picture of those in each unit.
const by_unit = (report: Report, signals: readonly Signal[], whole_min: Range, head: (unit: string) => Omit<TimeCurves, "unit" | "curves" | "whole_min">): Picture[] =>
  [...new Set(signals.map(({ column }) => column.unit))].map((unit) => {
    const of = signals.filter(({ column }) => column.unit === unit);
    return time_curves({ ...head(unit), unit, curves: in_groups(curves_of(of), of, named_columns(report)), whole_min, started: started_of(report) });
  });

// Of all that a page has over time outside of a model, so that its pictures stand below one another.
export const whole_of = (report: Report): Range =>
  whole_min([
    ...(report.drift ? [report.drift.points.map(({ time_s }) => minutes(time_s))] : []),
    ...(report.five_probe ? [report.five_probe.time_s.map(minutes)] : []),
    ...report.signals.map(({ time_s }) => time_s.map(minutes)),
  ]);

// Several runs have columns of the same names.
const signals_of = (report: Report): Signal[] => {
  const names = report.signals.flatMap(({ columns }) => columns.map(({ name }) => name));
  const several = new Set(names).size < names.length;
  return report.signals.flatMap(({ source, time_s, columns }, k) => {
    const time_min = time_s.map(minutes);
    return columns.map((column) => ({ column, time_min, run: several ? { number: k + 1, source } : null }));
  });
};

const measured_pictures = (report: Report, signals: readonly Signal[], whole_min: Range): Picture[] =>
  by_unit(report, signals.filter(measured), whole_min, (unit) => ({
    name: unit === "um" ? "measured" : `measured-${slug(unit)}`,
    title: unit === "um" ? t.drift_measured_displacements : unit === "" ? capital(t.measured) : t.drift_measured_in({ unit: clamped(unit, 20) }),
    caption: t.drift_measured_caption,
    quantity: unit === "um" ? t.drift_quantity_displacement : t.measured,
    height_px: 360,
  }));

const signal_pictures = (report: Report, signals: readonly Signal[], whole_min: Range): Picture[] =>
  by_unit(report, signals.filter((signal) => !measured(signal)), whole_min, (unit) => ({
    ...kind_of(unit),
    ...(unit === "rpm"
      ? { caption: t.drift_speed_caption, step: true, height_px: 200 }
      : { caption: t.drift_signals_caption, height_px: 280 }),
  }));
