// What was measured and recorded, as the files have it: raw data.
import { command_of, data_files } from "../drawing/command";
import type { First, Section } from "../picture";
import type { Report } from "../report";
import { measured_pictures, signal_pictures, signals_of, whole_of, type Signal } from "./signals";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { split_name, words } from "../drawing/units";
import { t } from "../texts/texts";

const counted = (n: number, text: (counted: { n: number }) => string): string[] => (n === 0 ? [] : [text({ n })]);

// "5 measured columns, 16 temperatures, 1 speed over 1664 min"
const result_of = (signals: readonly Signal[], span_min: number): string => {
  const measured = signals.filter(({ column }) => column.role === "measured").length;
  const rest = signals.filter(({ column }) => column.role !== "measured");
  const of = (unit: string): number => rest.filter(({ column }) => column.unit === unit).length;
  const [warm, speeds] = [of("degC"), of("rpm")];
  const all = [
    ...counted(measured, t.drift_count_measured),
    ...counted(warm, t.drift_count_temperatures),
    ...counted(speeds, t.drift_count_speeds),
    ...counted(rest.length - warm - speeds, t.drift_count_others),
  ];
  return t.drift_signals_result({ counts: all.join(", "), minutes: shown(span_min, 0) });
};

// "y changes most: by 31.7 µm, from -0.2 to 31.5"
const most_moved = (signals: readonly Signal[]): string | null => {
  let most: { signal: Signal; least: number; largest: number } | null = null;
  for (const signal of signals) {
    let [least, largest] = [Infinity, -Infinity];
    for (const value of signal.column.values) {
      if (value === null) continue;
      least = Math.min(least, value);
      largest = Math.max(largest, value);
    }
    if (largest > least && largest - least > (most ? most.largest - most.least : 0)) most = { signal, least, largest };
  }
  if (!most) return null;
  const { signal, least, largest } = most;
  const { quantity, unit } = split_name(signal.column.name);
  const [range, from, to] = [largest - least, least, largest].map((value) => shown(Number(value.toPrecision(3))));
  return t.drift_moves_most({ what: words(plain(quantity, 40)), range: `${range} ${unit}`, from: from ?? "", to: to ?? "" });
};

export const signals_section = (report: Report): Section[] => {
  const signals = signals_of(report);
  if (signals.length === 0) return [];
  const whole = whole_of(report);
  const pictures = [...measured_pictures(report, signals, whole), ...signal_pictures(report, signals, whole)];
  const measured = signals.some(({ column }) => column.role === "measured");
  const moved = most_moved(signals.filter(({ column }) => column.role === "measured"));
  const result = result_of(signals, (whole[1] - whole[0]) / 1.03);
  const first = (picture: string): First => ({
    picture,
    kind: "",
    label: "",
    told: () => ({
      verdict: moved ?? t.drift_sentence({ text: result }),
      next: {
        label: measured ? t.drift_next : t.drift_signals_next,
        text: "",
        command: measured
          ? command_of("report", data_files(report), ["--diagnose", "--out", "page.html"])
          : command_of("could", data_files(report)),
      },
    }),
  });
  return [
    {
      id: "signals",
      heading: measured ? t.drift_measured_and_signals : t.drift_signals,
      result,
      ...(pictures[0] ? { first: first(pictures[0].name) } : {}),
      sentences: [],
      tables: [],
      pictures,
    },
  ];
};
