// A ballbar test on one sheet of A4, to hand over: what was measured and with what, the circle with one of the errors,
// ISO 230-4 against the limits of the file, the errors, and room for a signature. The same drawing is printed by a
// browser and written as PDF.
import { line_at, paragraph_at, sheet_of, table_at, text_at } from "./drawing";
import { error_tests, type ErrorTest } from "../machine_errors/error_curves";
import { errors_table, stated_table } from "../machine_errors/error_tables";
import { verdict_of } from "../machine_errors/machine_errors";
import { errors_picture } from "../machine_errors/errors_pictures";
import { initial_state, svg_file } from "../figure/still";
import { micrometres, plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { iso_of, limit_text } from "../machine_errors/summary";
import type { FitPart, Report, Result } from "../report";
import { result_name } from "../recordings/recording_tables";
import { sentence_text, t } from "../texts/texts";

export const kSheet_px = { width: 794, height: 1123 } as const; // A4 at 96 to the inch

const kMargin = 42;
export const kLeft = kMargin;
export const kRight = kSheet_px.width - kMargin;
export const kAcross = kRight - kLeft;
const kPicture_px = 400; // on the sheet
const kDrawn_px = 540; // as it is drawn: its text is smaller than on a screen
const kMost_rows = 26;
const kRed = "#b00020";
const kYear_s = 365.25 * 86400;

// More than a year before the test: makers calibrate ballbars for a year.
export const calibration_ran_out = (calibrated: string, started_s: number | undefined): boolean => {
  const day_s = Date.parse(calibrated.slice(0, 10)) / 1000;
  return started_s !== undefined && Number.isFinite(day_s) && started_s - day_s > kYear_s;
};

type Row = readonly [string, string];

const started_of = (test: ErrorTest): number | undefined => {
  const started_s = test.part.file?.["started_s"];
  return typeof started_s === "number" ? started_s : undefined;
};

// When the tests were, where their files state it: the first, and the last of several.
export const started_text = (report: Report): string => {
  const all = error_tests(report).flatMap((test) => started_of(test) ?? []).sort((a, b) => a - b);
  const said = [all[0], all[all.length - 1]].flatMap((started_s) => {
    const started = new Date(1000 * (started_s ?? NaN));
    return Number.isNaN(started.getTime()) ? [] : started.toISOString().slice(0, 16).replace("T", " ");
  });
  return [...new Set(said)].join(" – ");
};

// The calibration that ran out; empty where it holds, or is not stated.
const late_text = (test: ErrorTest): string => {
  const calibrated = String(test.part.file?.["last_calibrated"] ?? "");
  return calibration_ran_out(calibrated, started_of(test)) ? t.handover_late({ calibrated: plain(calibrated, 20) }) : "";
};

// What the file states, machine and operator even where it does not: they are filled in by hand.
const head_rows = (test: ErrorTest): Row[] => {
  const file = test.part.file ?? {};
  const stated = (stated_table(test)[0]?.rows ?? []).map(([name = "", value = ""]): Row => [name, value]);
  const blank = (["machine", "operator"] as const).filter((key) => file[key] === undefined);
  const [first] = test.recordings;
  const feeds = test.recordings.map(
    ({ direction, feed_mm_per_min }) => `${direction ?? ""} ${shown(feed_mm_per_min === null ? null : feed_mm_per_min, 0)}`,
  );
  return [
    ...blank.map((key): Row => [t.stated[key], ""]),
    ...stated,
    [
      t.recordings_circle,
      t.handover_circle_of({
        plane: first?.plane ?? "",
        length: shown(first?.nominal_length_mm),
        arc: shown(first?.arc_deg, 0),
        readings: test.recordings.map(({ readings }) => readings).join(" + "),
      }),
    ],
    [t.handover_feeds, `${feeds.join(", ")} mm/min`],
    [t.handover_files, test.part.files.join(", ")],
  ];
};

const head_at = (report: Report, test: ErrorTest): { svg: string; below: number } => {
  const rows = head_rows(test);
  const half = Math.ceil(rows.length / 2);
  const step = 14.5;
  const top = 86;
  const column = kAcross / 2;
  const each = rows.map(([name, value], k) => {
    const x = kLeft + (k < half ? 0 : column);
    const y = top + (k % half) * step;
    const words = text_at(x + 118, y, plain(value, Math.floor((column - 122) / 5.7)), { size_px: 10 });
    const blank = value === "" ? line_at(x + 118, y + 2, x + column - 20) : "";
    return text_at(x, y, plain(name, 24), { size_px: 10, fill: "#444" }) + words + blank;
  });
  return {
    svg:
      text_at(kLeft, 34, t.handover_title, { size_px: 10, fill: "#444" }) +
      text_at(kLeft, 55, plain(report.title, 56), { size_px: 17, bold: true }) +
      line_at(kLeft, 64, kRight, "#000") +
      each.join(""),
    below: top + half * step,
  };
};

const uncertainty_text = (test: ErrorTest): string => {
  const each = test.recordings.map(({ direction, sigma_circularity_um }) => `${direction ?? ""} ± ${shown(sigma_circularity_um, 2)} µm`);
  return t.handover_uncertainty({ each: each.join(", ") });
};

const kJudgements = { pass: "#00662b", warning: "#8a5a00", fail: kRed } as const;

const iso_at = (fit: FitPart, test: ErrorTest, x: number, y: number): { svg: string; below: number } => {
  const { rows } = iso_of(fit, test);
  const labels = rows.map((row) => result_name(row).replace(/ µm$/, ""));
  const any = rows.some(({ judgement }) => judgement);
  const judged = (row: Result): string[] => [limit_text(row), row.judgement ? t.judgements[row.judgement] : "–"];
  const table = table_at(
    x,
    y + 18,
    kRight - x,
    ["", "µm", ...(any ? [t.handover_limit, ""] : [])],
    rows.map((row, k) => [labels[k] ?? "", shown(row.ours, row.decimals), ...(any ? judged(row) : [])]),
    9,
    (row, column) => (column === 3 && rows[row]?.judgement ? kJudgements[rows[row].judgement] : undefined),
  );
  const notes = [
    ...(any ? [] : [t.handover_no_limits]),
    ...test.part.tolerances,
    uncertainty_text(test),
  ];
  let below = table.below + 4;
  let svg = text_at(x, y, "ISO 230-4", { size_px: 12, bold: true }) + table.svg;
  for (const note of notes.slice(0, 6)) {
    const one = paragraph_at(x, below, kRight - x, micrometres(note), 4, { size_px: 9, fill: "#333" });
    svg += one.svg;
    below = one.below + 2;
  }
  return { svg, below };
};

const picture_at = (test: ErrorTest, error: string | undefined, x: number, y: number): { svg: string; below: number } => {
  const picture = errors_picture([test]);
  const initial = initial_state(picture, false, kDrawn_px);
  const chosen = error === undefined ? initial.chosen : { ...initial.chosen, error };
  const off = picture.toggles({ chosen }).filter(({ on }) => !on);
  const state = { ...initial, chosen, hidden: new Set(off.map(({ key }) => key)) };
  const size = `width="${kDrawn_px}" height="${kDrawn_px}"`;
  const placed = `x="${x}" y="${y.toFixed(1)}" width="${kPicture_px}" height="${kPicture_px}"`;
  return { svg: svg_file(picture, state, kDrawn_px, kDrawn_px).trim().replace(size, placed), below: y + kPicture_px };
};

const errors_at = (test: ErrorTest, y: number): { svg: string; below: number } => {
  const table = errors_table(test);
  const rows = table.rows.slice(0, kMost_rows);
  const drawn = table_at(kLeft, y + 17, kAcross, table.heading, rows, 8.5);
  const more = table.rows.length - rows.length;
  return {
    svg:
      text_at(kLeft, y, table.title, { size_px: 12, bold: true }) +
      drawn.svg +
      (more > 0 ? text_at(kLeft, drawn.below, t.handover_more({ n: more }), { size_px: 8.5, fill: "#444" }) : ""),
    below: drawn.below + 12,
  };
};

export const foot_at = (report: Report): string => {
  const y = kSheet_px.height - 58;
  const third = kAcross / 3;
  const field = (k: number, name: string): string =>
    line_at(kLeft + k * third, y, kLeft + (k + 1) * third - 24, "#000") + text_at(kLeft + k * third, y + 12, name, { size_px: 9, fill: "#444" });
  return (
    field(0, t.handover_name) +
    field(1, t.handover_date) +
    field(2, t.handover_signature) +
    text_at(kLeft, y + 32, plain(t.page_made({ by: report.made_by, on: report.made_on }), 100), { size_px: 8.5, fill: "#666" })
  );
};

// Nothing where the report is not of one ballbar test. `error`: that the picture shows; undefined: the largest.
export const handover_sheet = (report: Report, error?: string): string | null => {
  const [test, ...others] = error_tests(report);
  if (!test || others.length > 0 || !report.fit) return null;
  const head = head_at(report, test);
  const late = paragraph_at(kLeft, head.below + 4, kAcross, late_text(test), 1, { size_px: 10, bold: true, fill: kRed });
  const verdict = paragraph_at(kLeft, late.below + 10, kAcross, micrometres(sentence_text(verdict_of(test))), 3, { size_px: 10.5, bold: true });
  const middle = verdict.below + 4;
  const picture = picture_at(test, error, kLeft - 8, middle);
  const iso = iso_at(report.fit, test, kLeft + kPicture_px + 8, middle + 22);
  const errors = errors_at(test, Math.max(picture.below, iso.below) + 18);
  const drawn = [head, late, verdict, picture, iso, errors].map(({ svg }) => svg).join("");
  return sheet_of(kSheet_px.width, kSheet_px.height, drawn + foot_at(report));
};
