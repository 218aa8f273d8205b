// A thermal test on one sheet of A4, to hand over: which test of ISO 230-3 it is and what its record lacks, the drift and
// the temperatures over time, the numbers, and room for what is filled in by hand and for a signature.
import { foot_at, kAcross, kLeft, kRight, kSheet_px, started_text } from "./handover";
import { type Block, line_at, paragraph_at, sheet_of, table_at, text_at } from "./drawing";
import { initial_state, svg_file } from "../figure/still";
import { words, micrometres, plain, unit_shown } from "../drawing/text";
import { decimals_for, minutes, shown, with_sigma } from "../drawing/theme";
import type { Picture } from "../picture";
import type { Report } from "../report";
import type { AxisSettling, DriftSheet, Num, ThermalTest } from "../results";
import { named, t } from "../texts/texts";

const kDrawn_px = 860; // as a picture is drawn: its text is smaller than on a screen
const kMost_rows = 8; // of a table
const kMost_temperatures = 6;
const kFoot_px = 96;

type Row = readonly [string, string];

const span_text = (time_s: Num): string => {
  if (time_s === null) return "–";
  const whole = Math.round(minutes(time_s));
  const [h, min] = [Math.floor(whole / 60), whole % 60];
  return [h > 0 ? `${h} h` : "", min > 0 || h === 0 ? `${min} min` : ""].filter((one) => one !== "").join(" ");
};

const speeds_text = ({ speeds }: ThermalTest): string => {
  const [least, most] = [speeds[0], speeds[speeds.length - 1]].map((one) => shown(one ?? null, 0));
  if (speeds.length === 0) return "–";
  return speeds.length > 5 ? `${least} … ${most} rpm (${speeds.length})` : `${speeds.map((one) => shown(one, 0)).join(", ")} rpm`;
};

const rows_of = (report: Report, { thermal_test: test }: DriftSheet): Row[] => {
  const moving: Row[] =
    (test.running_s ?? 0) > 0
      ? [
          ...(test.speeds.length > 0 && test.motion_unit === "rpm" ? [[t.thermal_speeds, speeds_text(test)] as const] : []),
          [t.thermal_running, span_text(test.running_s)],
          [t.thermal_rest_after, span_text(test.rest_after_s)],
        ]
      : [];
  return [
    [t.stated.machine, ""],
    [t.stated.operator, ""],
    [t.thermal_instrument, ""],
    [t.thermal_position, ""],
    [t.handover_recorded, started_text(report)],
    [t.handover_files, report.files.join(", ")],
    [t.thermal_duration, span_text(test.duration_s)],
    ...moving,
    ...(test.motion === "" ? [] : [[t.thermal_motion, test.motion] as const]),
  ];
};

const head_at = (report: Report, sheet: DriftSheet): Block => {
  const rows = rows_of(report, sheet);
  const half = Math.ceil(rows.length / 2);
  const [top, step, column] = [84, 14.5, kAcross / 2];
  const each = rows.map(([name, value], k) => {
    const [x, y] = [kLeft + (k < half ? 0 : column), top + (k % half) * step];
    const blank = value === "" ? line_at(x + 118, y + 2, x + column - 20) : "";
    return text_at(x, y, plain(name, 24), { size_px: 10, fill: "#444" }) + text_at(x + 118, y, plain(value, Math.floor((column - 122) / 5.7)), { size_px: 10 }) + blank;
  });
  const long = report.title.length > 56;
  const title = t.thermal_titles[sheet.thermal_test.kind as keyof typeof t.thermal_titles] ?? t.thermal_titles.unknown;
  return {
    svg:
      text_at(kLeft, 34, title, { size_px: 10, fill: "#444" }) +
      text_at(kLeft, 55, plain(report.title, long ? 88 : 56), { size_px: long ? 12 : 17, bold: true }) +
      line_at(kLeft, 64, kRight, "#000") +
      each.join(""),
    below: top + half * step,
  };
};

const estimate = (value: Num | undefined, sigma: Num | undefined): string =>
  typeof value !== "number" ? "–" : with_sigma(value, sigma ?? null, Math.min(2, decimals_for(value, sigma ?? null)));

const conclusion_of = ({ largest, thermal_test: { from_s } }: DriftSheet): string => {
  const all = largest.filter(({ axis }) => axis.startsWith("combined"));
  const [most] = all.length > 0 ? all : [...largest].sort((a, b) => Math.abs(drift_of(b) ?? 0) - Math.abs(drift_of(a) ?? 0));
  if (!most) return "";
  return t.thermal_largest({ axis: axis_name(most.axis), value: `${estimate(drift_of(most), sigma_of(most))} ${unit_shown(unit_of(most))}`, at: span_text(most.time_s - (from_s ?? 0)) });
};

// "drift_um" of a key that ends in the unit.
type Keyed = Record<string, unknown>;
const with_unit = (of: unknown, name: string): [string, Num] | null => {
  const key = Object.keys(of as Keyed).find((one) => new RegExp(`^${name}_(um|urad)$`).test(one));
  return key === undefined ? null : [key.slice(name.length + 1), (of as Keyed)[key] as Num];
};
const drift_of = (of: unknown): Num => with_unit(of, "drift")?.[1] ?? null;
const sigma_of = (of: unknown): Num => with_unit(of, "drift_sigma")?.[1] ?? null;
const unit_of = (of: unknown): string => with_unit(of, "drift")?.[0] ?? "um";
const axis_name = (axis: string): string => (axis.startsWith("combined") ? axis.replace("combined", t.thermal_combined) : words(axis));

const stable_text = ({ is_small, stable }: AxisSettling): string => {
  if (is_small || stable?.time_s === 0) return t.thermal_from_start;
  if (!stable) return t.thermal_not_determined;
  const [time, sigma] = [minutes(stable.time_s), minutes(stable.sigma_s ?? 0)];
  const value = with_sigma(time, sigma, Math.min(2, decimals_for(time, sigma)));
  return stable.reached ? value : t.thermal_beyond({ value });
};

const numbers_of = (sheet: DriftSheet): { heading: string[]; rows: string[][]; more: number } => {
  const of_motion = Object.keys(sheet.ranges_in_motion).length > 0;
  const ranges = of_motion ? sheet.ranges_in_motion : sheet.ranges;
  const rows = sheet.largest.map((one) => {
    const range: unknown = ranges[one.axis] ?? {};
    const of = (name: string): string => estimate(with_unit(range, name)?.[1], with_unit(range, `${name}_sigma`)?.[1]);
    const settling = sheet.stability.find(({ axis }) => axis === one.axis);
    return [
      `${axis_name(one.axis)}, ${unit_shown(unit_of(one))}`,
      estimate(drift_of(one), sigma_of(one)),
      shown(minutes(one.time_s), 0),
      ...["first_60_min", "last_60_min", "total"].map(of),
      ...(sheet.stability.length > 0 ? [settling ? stable_text(settling) : "–"] : []),
    ];
  });
  const range = of_motion ? t.thermal_range_in_motion : t.thermal_range;
  return {
    heading: ["", t.thermal_largest_head, t.thermal_at_min, ...[t.thermal_first_hour, t.thermal_last_hour, t.thermal_total].map((one) => `${range} ${one}`), ...(sheet.stability.length > 0 ? [t.thermal_stable] : [])],
    rows: rows.length > kMost_rows ? [...rows.slice(0, kMost_rows - 1), ...rows.slice(-1)] : rows, // combined is the last
    more: Math.max(0, rows.length - kMost_rows),
  };
};

const temperatures_of = ({ thermal_test: { temperatures } }: DriftSheet): string[][] =>
  temperatures.slice(0, kMost_temperatures).map(({ column, role, first_degC: first, least_degC: least, largest_degC: most }) => [
    plain(column, 40) + (role === "ambient" ? ` (${named(t.roles, role)})` : ""),
    ...[first, least, most, (most ?? 0) - (least ?? 0)].map((one) => shown(one, 1)),
  ]);

const picture_at = (picture: Picture, y: number, high_px: number): Block => {
  const scale = kAcross / kDrawn_px;
  const height_px = Math.round(high_px / scale);
  const size = `width="${kDrawn_px}" height="${height_px}"`;
  const svg = svg_file(picture, initial_state(picture, false, kDrawn_px), kDrawn_px, height_px).trim();
  return { svg: svg.replace(size, `x="${kLeft}" y="${y.toFixed(1)}" width="${kAcross}" height="${high_px}"`), below: y + high_px };
};

// Nothing where the report has no thermal test. `pictures`: all of the page.
export const thermal_sheet = (report: Report, pictures: readonly Picture[]): string | null => {
  const sheet = report.thermal;
  const of = (names: readonly string[]): Picture[] => pictures.filter(({ name }) => names.includes(name)).slice(0, 1);
  const [drift] = [...of(["drift"]), ...of(["five-probe"]), ...pictures.filter(({ name }) => name.startsWith("measured"))];
  if (!sheet || !drift) return null;
  let { svg: drawn, below: y } = head_at(report, sheet);
  const put = (block: Block, gap_px: number): void => {
    drawn += block.svg;
    y = block.below + (block.svg === "" ? 0 : gap_px);
  };
  const { kind, temperatures: any } = sheet.thermal_test;
  const is_thermal = kind !== "unknown" || any.length > 0 || sheet.largest.length > 1; // one size alone may be that of parts
  const lacks = (is_thermal ? sheet.thermal_test.lacks : []).map((one) => named(t.thermal_lacks, one)).join("; ");
  y += 8;
  put(paragraph_at(kLeft, y, kAcross, micrometres(conclusion_of(sheet)), 2, { size_px: 11.5, bold: true }), 2);
  put(paragraph_at(kLeft, y, kAcross, lacks === "" ? "" : t.thermal_lacking({ what: lacks }), 2, { size_px: 10 }), 2);
  const others = [...of(["temperatures"]), ...(kind === "environment" ? [] : of(["speed"]))];
  put(picture_at(drift, y, 275), 4);
  for (const picture of others) put(picture_at(picture, y, picture.name === "speed" ? 140 : 180), 4);
  const { heading, rows, more } = numbers_of(sheet);
  y += 12;
  put(table_at(kLeft, y, kAcross, heading, rows, 8.5), more > 0 ? 0 : 6);
  if (more > 0) put(paragraph_at(kLeft, y, kAcross, t.handover_more({ n: more }), 1, { size_px: 8.5, fill: "#444" }), 6);
  const temperatures = temperatures_of(sheet).slice(0, Math.max(0, Math.floor((kSheet_px.height - kFoot_px - 24 - y) / 12.5) - 2));
  if (temperatures.length > 0)
    put(table_at(kLeft, y, kAcross, [t.thermal_temperature, t.thermal_first, t.thermal_least, t.thermal_most, t.thermal_difference], temperatures, 8.5), 4);
  put(paragraph_at(kLeft, y, kAcross, t.thermal_uncertainty, 2, { size_px: 8.5, fill: "#333" }), 0);
  return sheet_of(kSheet_px.width, kSheet_px.height, drawn + foot_at(report));
};
