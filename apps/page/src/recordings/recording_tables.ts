// Results of the recordings: what was fitted, and what the instrument's file stores beside it.
import type { TextTable } from "../picture";
import { labels_of } from "./recording_groups";
import type { FitPart, Num, Recording, Result, StoredAlone } from "../report";
import { plain, unit_shown } from "../drawing/text";
import { shown, with_sigma } from "../drawing/theme";
import { named, t } from "../texts/texts";

const scaled = (value: Num | undefined, by: number): Num => (typeof value === "number" ? value * by : null);

const circle_row = (label: string, one: Recording): string[] => [
  label,
  plain(one.plane ?? "–", 8),
  shown(one.arc_deg, 1),
  String(one.readings),
  with_sigma(one.centre_a_um, one.sigma_centre_a_um, 2),
  with_sigma(one.centre_b_um, one.sigma_centre_b_um, 2),
  with_sigma(one.radius_mm, scaled(one.sigma_radius_um, 1e-3), 5),
  with_sigma(one.circularity_um, one.sigma_circularity_um, 2),
  shown(one.rms_um, 2),
];

const circles_table = (circles: readonly Recording[], choose: TextTable["choose"]): TextTable => ({
  title: t.recordings_circles,
  heading: [
    t.recordings_one, t.recordings_plane, t.recordings_arc, t.recordings_readings, t.recordings_centre_a,
    t.recordings_centre_b, t.recordings_radius, "G µm", t.recordings_rms,
  ],
  rows: labels_of(circles).map((label, k) => circle_row(label, circles[k] as Recording)),
  ...(choose ? { choose } : {}),
});

const axial_row = (label: string, one: Recording): string[] => [
  label,
  String(one.readings),
  with_sigma(one.length_mm, scaled(one.sigma_length_um, 1e-3), 5),
  shown(one.rms_um, 2),
];

const axial_table = (axial: readonly Recording[], choose: TextTable["choose"]): TextTable => ({
  title: t.recordings_axials,
  heading: [t.recordings_one, t.recordings_readings, t.recordings_length, t.recordings_rms],
  rows: labels_of(axial).map((label, k) => axial_row(label, axial[k] as Recording)),
  ...(choose ? { choose } : {}),
});

export const result_name = ({ key, label }: Result): string => (Object.hasOwn(t.results, key) ? named(t.results, key) : plain(label.trim(), 60));

type Results = FitPart["results"][number];

const has_stored = (results: Results): boolean => results.rows.some((row) => row.stored !== null);
const of_a_recording = (results: Results): boolean => results.rows.some(({ key }) => key === "centre_a_um");

// The instrument prints one digit less.
const stored_text = (row: Result | undefined): string => (row ? shown(row.stored, Math.max(0, row.decimals - 1)) : "–");

// Few: a row a quantity, as the terminal has it. Many of the same quantities: a row for each of them.
const table_of = (group: readonly Results[]): TextTable => {
  const first = group[0]?.rows ?? [];
  const labels = first.map(result_name);
  const stored = group.some(has_stored);
  const title = of_a_recording(group[0] as Results)
    ? t.recordings_and_stored
    : t.recordings_both_directions;
  const names = group.map((results) => plain(results.of, 60));
  if (group.length <= 2) {
    return {
      title,
      heading: [t.recordings_quantity, ...names.flatMap((name) => (stored ? [name, t.recordings_stored] : [name]))],
      rows: labels.map((label, k) => [
        label,
        ...group.flatMap((results) => {
          const row = results.rows[k];
          const ours = shown(row?.ours, row?.decimals);
          return stored ? [ours, stored_text(row)] : [ours];
        }),
      ]),
    };
  }
  return {
    title,
    heading: ["", ...labels.flatMap((label) => (stored ? [label, t.recordings_stored] : [label]))],
    rows: group.map((results, k) => [
      names[k] ?? "",
      ...results.rows.flatMap((row) => {
        const ours = shown(row.ours, row.decimals);
        return stored ? [ours, stored_text(row)] : [ours];
      }),
    ]),
  };
};

const result_tables = (fit: FitPart): TextTable[] => {
  const groups = new Map<string, Results[]>();
  for (const results of fit.results) {
    // Without stored values the table of circles says it all.
    if (of_a_recording(results) && !has_stored(results)) continue;
    const key = results.rows.map(({ label }) => label).join("\n");
    groups.set(key, [...(groups.get(key) ?? []), results]);
  }
  return [...groups.values()].map(table_of);
};

// As the file writes it.
const as_stored = (value: Num): string => shown(value, Math.min(6, (String(value).split(".")[1] ?? "").length));

const stored_alone_table = ({ file, stored }: StoredAlone): TextTable => ({
  title: t.recordings_stored_alone({ file: plain(file, 60) }),
  heading: [t.recordings_quantity, t.recordings_stored, "", ""],
  rows: stored.map((one) => [plain(one.name, 60), as_stored(one.value), unit_shown(one.unit), plain(one.of, 60)]),
});

export const recording_tables = (
  fit: FitPart,
  circles: readonly Recording[],
  axial: readonly Recording[],
  choose: { circle: TextTable["choose"]; axial: TextTable["choose"] },
): TextTable[] => [
  ...(circles.length > 0 ? [circles_table(circles, choose.circle)] : []),
  ...(axial.length > 0 ? [axial_table(axial, choose.axial)] : []),
  ...result_tables(fit),
  ...(fit.stored_alone ?? []).map(stored_alone_table),
];
