// The ranked table of a machine's errors, and below it those of the circle.
import { error_name, unit_shown } from "./error_names";
import { kErrors_picture, kWithout } from "./errors_pictures";
import { circle_rows, type ErrorTest, ranked_errors, type RankedError } from "./error_curves";
import type { TextTable } from "../picture";
import type { MachineErrorRow } from "../report";
import { plain } from "../drawing/text";
import { decimals_for, shown, with_sigma } from "../drawing/theme";
import { named, t } from "../texts/texts";

const decimals_of = (row: MachineErrorRow): number => Math.min(4, decimals_for(row.value, row.sigma));

// A report of an older program does not say whether it is determined.
const is_open = ({ determined }: Partial<Pick<MachineErrorRow, "determined">>): boolean => determined === false;

const value_of = (row: MachineErrorRow): string =>
  is_open(row) ? t.errors_not_determined : with_sigma(row.value, row.sigma, decimals_of(row));

// Beside it, with as many decimals: the instrument prints no more than two.
const stored_value = (row: MachineErrorRow): string => shown(row.stored, Math.min(2, decimals_of(row)));

const stored = (row: MachineErrorRow): string =>
  row.stored === null || row.stored_rank === null ? stored_value(row) : `${stored_value(row)} (${row.stored_rank})`;

// What the instrument's software would say, with its rank.
const as_instrument = ({ as_instrument: software, unit }: MachineErrorRow, is_first: boolean): string => {
  if (!software) return "–";
  const value = shown(software.value, unit === "ms" ? 2 : 1);
  return is_first && software.rank !== null ? `${value} (${software.rank})` : value;
};

const rank_of = ({ rank, significant }: MachineErrorRow): string =>
  rank !== null ? String(rank) : significant === true ? "–" : t.errors_not_significant;

const yes_no = (value: boolean | null): string => (value === null ? "–" : value ? t.yes : t.no);

// What belongs to the effect stands in the first of its rows.
const cells_of = ({ first, rows }: RankedError, plane: string | undefined): string[][] =>
  rows.map((row, k) => [
    error_name(row.name, plane),
    value_of(row),
    unit_shown(row.unit),
    ...(k > 0
      ? ["", "", ""]
      : [
          shown(first.individual_circularity_um, 2),
          shown(first.share_percent, 1),
          rank_of(first),
        ]),
    as_instrument(row, k === 0),
    stored(row),
    ...(k > 0 ? ["", ""] : [yes_no(first.predicts_other_run), shown(first.circularity_without_um, 2)]),
  ]);

const kShare = 4; // its column

const choosing = (ranked: readonly RankedError[]): TextTable["choose"] => ({
  picture: kErrors_picture,
  key: "error",
  values: ranked.flatMap(({ effect, rows }) => rows.map(() => effect)),
  focus_keeps: true,
  space: kWithout,
});

const program_names = (ranked: readonly RankedError[]): string[] => ranked.flatMap(({ rows }) => rows.map(({ name }) => name));

const kRows = 8; // so that the page of an error is seen below them

// For the first screen: what each error is, and what mending it gains. What is not significant waits behind a button.
export const gains_table = ({ part, recordings }: ErrorTest): TextTable => {
  const ranked = ranked_errors(part);
  const plane = recordings[0]?.plane;
  const gain = ({ circularity_gain_um: um, circularity_gain_sigma_um: sigma }: MachineErrorRow): string =>
    typeof sigma === "number" ? with_sigma(um, sigma, Math.min(2, decimals_for(um, sigma))) : shown(um, 2);
  const most = Math.max(1e-9, ...ranked.map(({ first }) => first.circularity_gain_um ?? 0));
  const shares = ranked.flatMap(({ first, rows }) =>
    rows.map((_, k) => (k > 0 || first.rank === null || !((first.circularity_gain_um ?? 0) > 0) ? null : (first.circularity_gain_um ?? 0) / most)),
  );
  const significant = ranked.filter(({ first }) => first.rank !== null || first.significant === true);
  return {
    title: t.errors_table_title,
    heading: [t.errors_one, t.value, t.errors_gain, t.errors_g_without],
    rows: ranked.flatMap(({ first, rows }) =>
      rows.map((row, k) => [
        error_name(row.name, plane),
        is_open(row) ? value_of(row) : `${value_of(row)} ${unit_shown(row.unit)}`,
        ...(k > 0 ? ["", ""] : [first.significant === true ? gain(first) : t.errors_not_significant, shown(first.circularity_without_um, 2)]),
      ]),
    ),
    row_titles: program_names(ranked),
    choose: choosing(ranked),
    at_first: Math.min(kRows, Math.max(1, significant.reduce((count, { rows }) => count + rows.length, 0))),
    bars: { column: 2, shares },
  };
};

export const errors_table = ({ part, recordings }: ErrorTest): TextTable => {
  const ranked = ranked_errors(part);
  const plane = recordings[0]?.plane;
  const most = Math.max(1e-9, ...ranked.map(({ first }) => first.share_percent ?? 0));
  return {
    title: t.errors_whole_table,
    heading: [
      t.errors_one, t.value, t.unit, "IC µm", t.errors_share, t.errors_rank, t.errors_instrument_rank,
      t.errors_stored_rank, t.errors_predicts, t.errors_g_without,
    ],
    rows: ranked.flatMap((one) => cells_of(one, plane)),
    row_titles: program_names(ranked),
    choose: choosing(ranked),
    bars: {
      column: kShare,
      shares: ranked.flatMap(({ first, rows }) =>
        rows.map((_, k) => (k > 0 || first.share_percent === null ? null : first.share_percent / most)),
      ),
    },
  };
};

export const circle_table = ({ part, recordings }: ErrorTest): TextTable[] => {
  const rows = circle_rows(part);
  if (rows.length === 0) return [];
  return [
    {
      title: t.errors_set_up,
      heading: ["", t.value, t.unit, t.errors_stored],
      rows: rows.map((row) => [
        error_name(row.name, recordings[0]?.plane),
        value_of(row),
        unit_shown(row.unit),
        stored_value(row),
      ]),
    },
  ];
};

const stated_text = (key: string, value: string | number): string[] => {
  if (key === "started_s" && typeof value === "number") {
    const started = new Date(1000 * value); // on the machine's own clock
    return [t.stated.started, Number.isNaN(started.getTime()) ? "–" : started.toISOString().slice(0, 16).replace("T", " ")];
  }
  const [name, unit] = /^(.*)_mm_per_min$/.test(key) ? [key.slice(0, -"_mm_per_min".length), " mm/min"] : [key, ""];
  return [plain(named(t.stated, name).replaceAll("_", " "), 60), `${typeof value === "number" ? shown(value) : plain(value, 200)}${unit}`];
};

// "VMC 3 · 2026-01-15 08:00 · XY, bar of 100 mm · 2000 mm/min · calibrated 2025-03-02"
export const made_with = ({ part, recordings }: ErrorTest): string => {
  const { machine = "", started_s, last_calibrated = "" } = part.file ?? {};
  const feeds = [...new Set(recordings.flatMap(({ feed_mm_per_min }) => (feed_mm_per_min ? [shown(feed_mm_per_min, 0)] : [])))];
  return [
    plain(machine, 60),
    started_s === undefined ? "" : (stated_text("started_s", started_s)[1] ?? ""),
    ...(recordings[0]?.plane && part.nominal_length_mm ? [t.errors_made_bar({ plane: recordings[0].plane, length: shown(part.nominal_length_mm, 0) })] : []),
    feeds.length === 0 ? "" : `${feeds.join(", ")} mm/min`,
    last_calibrated === "" ? "" : t.errors_made_calibrated({ date: plain(last_calibrated.slice(0, 10), 20) }),
  ]
    .filter((one) => one !== "")
    .join(" · ");
};

export const stated_table = ({ part }: ErrorTest): TextTable[] => {
  const rows = Object.entries(part.file ?? {}).map(([key, value]) => stated_text(key, value));
  return rows.length === 0 ? [] : [{ title: t.errors_stated, heading: ["", ""], rows }];
};
