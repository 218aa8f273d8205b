// The same figure test after test, over each other: how the circle drifts. Colours run from the first test to the last,
// lines grow wider, and the first and the last carry their names.
import { unwrapped_together } from "../drawing/angles";
import { difference, first_at } from "../drawing/columns";
import { kept_readings, picked } from "./recording_curves";
import type { Choice, Numbers, State, Toggle } from "../picture";
import { type Group, labels_of } from "./recording_groups";
import type { Num, Recording } from "../report";
import { colours, font, minutes, sequence_bar, sequence_colour, time_text, toggle } from "../drawing/theme";
import { t } from "../texts/texts";

export const kStretches = 180; // of a recording, up to four points each
const kMost_toggles = 24;

export interface Test {
  key: string;
  name: string;
  recording: Recording;
  place: number; // in the sequence, 0 to 1
  width_px: number;
  angle_deg: number[];
  value_um: Num[];
}

// Where each stands between first and last: by time where times are known and differ, else by order.
export const places_of = (recordings: readonly Recording[]): number[] => {
  const times = recordings.map((recording) => recording.time_s);
  const [first, last] = [times[0] ?? NaN, times[times.length - 1] ?? NaN];
  const by_time = times.every((time) => time !== null) && last > first;
  return times.map((time, k) =>
    by_time ? ((time ?? 0) - first) / (last - first) : k / Math.max(1, recordings.length - 1),
  );
};

export const times_named = (recordings: readonly Recording[]): string[] => {
  const times = recordings.map((recording) => recording.time_s);
  const known = times.every((time) => time !== null) && new Set(times).size === times.length;
  return known ? times.map((time) => time_text(minutes(time ?? 0), 0)) : labels_of(recordings);
};

export const quantity_choice = (initial: "deviation" | "change"): Choice => ({
  key: "quantity",
  label: t.recordings_drawn,
  values: [
    { value: "deviation", label: t.recordings_deviation },
    { value: "change", label: t.recordings_change },
    { value: "residual", label: t.recordings_residual },
  ],
  initial,
});

// Of a curve at other angles, on whatever turn, by straight lines between readings; null outside of them and in a gap of
// more than 5 deg.
const at_angles = (angle_deg: readonly number[], value_um: readonly Num[], at_deg: readonly number[]): Num[] => {
  const order = angle_deg.map((_, i) => i).sort((a, b) => (angle_deg[a] ?? 0) - (angle_deg[b] ?? 0));
  const [first, last] = [order[0], order[order.length - 1]];
  if (first === undefined || last === undefined) return at_deg.map(() => null);
  const [least, largest] = [angle_deg[first] ?? 0, angle_deg[last] ?? 0];
  // From the last reading of a turn on to the first.
  const closed = largest - least < 360;
  const x = closed ? [largest - 360, ...picked(angle_deg, order), least + 360] : picked(angle_deg, order);
  const y = picked(value_um, closed ? [last, ...order, first] : order);
  const at = (angle: number): Num => {
    const after = first_at(x, angle);
    const [x0, x1, y0, y1] = [x[Math.max(0, after - 1)], x[after], y[Math.max(0, after - 1)], y[after]];
    if (x1 === undefined || x0 === undefined || y0 === null || y0 === undefined || y1 === null || y1 === undefined)
      return null;
    if (x1 === angle || x1 === x0) return x1 === angle ? y1 : null;
    return x1 - x0 > 5 ? null : y0 + ((y1 - y0) * (angle - x0)) / (x1 - x0);
  };
  return at_deg.map((angle) => at(angle) ?? at(angle + 360) ?? at(angle - 360));
};

// Every test of the chosen group in the chosen quantity, all its readings.
export const tests_of = (groups: readonly Group[], chosen: State["chosen"]): Test[] => {
  const recordings = (groups.find((group) => group.value === chosen["group"]) ?? groups[0])?.of ?? [];
  const places = places_of(recordings);
  const names = times_named(recordings);
  const first = recordings[0]?.trace;
  const angles = unwrapped_together(recordings.map(({ trace }) => trace?.angle_deg ?? []));
  return recordings.map((recording, k) => {
    const { trace } = recording;
    const angle_deg = angles[k] ?? [];
    const deviation = trace?.deviation_um ?? [];
    const place = places[k] ?? 0;
    let value_um: Num[] = chosen["quantity"] === "residual" ? (trace?.residual_um ?? []) : deviation;
    if (chosen["quantity"] === "change") {
      value_um = difference(deviation, at_angles(angles[0] ?? [], first?.deviation_um ?? [], angle_deg));
    }
    return { key: `test${k}`, name: names[k] ?? "", recording, place, width_px: 1 + 1.2 * place, angle_deg, value_um };
  });
};

export const subsampled = (test: Test, stretches = kStretches): Test => {
  const kept = kept_readings(test.value_um, stretches);
  return { ...test, angle_deg: picked(test.angle_deg, kept), value_um: picked(test.value_um, kept) };
};

// One switch a test; of very many tests a list of switches would be no legend, and the colour bar has to do.
export const toggles_of_tests = (tests: readonly Pick<Test, "key" | "name" | "place">[]): Toggle[] =>
  tests.length > kMost_toggles
    ? []
    : tests.map(({ key, name, place }) => toggle(key, name, (dark) => sequence_colour(place, dark), "line"));

export const bar_of_tests = (tests: readonly { name: string }[], { look: { dark } }: State, top_px: number): Record<string, unknown>[] =>
  tests.length < 2
    ? []
    : [sequence_bar(tests[0]?.name ?? "", tests.at(-1)?.name ?? "", dark, colours(dark).faint, font, top_px)];

// The readings of many tests in one table: a row a reading, one test after the other.

export const test_numbers = (tests: readonly Test[], quantity: string): Numbers => ({
  columns: [
    { name: "angle_deg", values: tests.flatMap((test) => test.angle_deg) },
    { name: `${quantity || "deviation"}_um`, values: tests.flatMap((test) => test.value_um) },
    { name: "test", values: tests.flatMap((test) => test.angle_deg.map(() => test.name)) },
    {
      name: "test_time_min",
      values: tests.flatMap(({ angle_deg, recording: { time_s } }) =>
        angle_deg.map(() => (time_s === null ? null : minutes(time_s))),
      ),
    },
  ],
});
