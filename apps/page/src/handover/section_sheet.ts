// What stands on the first screen, on one sheet of A4: the conclusion, its picture as it is on the screen, the numbers
// beside it, and what they come from.
import { foot_at, kLeft, kAcross, kRight, kSheet_px, started_text } from "./handover";
import { line_at, paragraph_at, sheet_of, table_at, text_at } from "./drawing";
import { initial_state, svg_file } from "../figure/still";
import { micrometres, plain } from "../drawing/text";
import type { Section, State, TextTable } from "../picture";
import type { Report } from "../report";
import { type Sentence, sentence_text, t } from "../texts/texts";

const kFoot_px = 110;
const kMost_rows = 16; // of a table
const kDrawn_px = 860; // as it is drawn: its text is smaller than on a screen
const kRound_px = 620; // likewise, of a picture that is a circle

const kRow_px = 12.8; // of a table's text of 9 px
const kTable_head_px = 60;

// What is looked at together on the page: beside the picture, else above and below it.
const tables_of = ({ companion, above = [], tables = [] }: Section, chosen: State["chosen"]): TextTable[] => {
  if (!companion) return [...above, ...tables];
  const { table } = companion.notes(chosen[companion.key] ?? "");
  return [...(companion.above ? [companion.above] : []), table];
};

// `asked`: the options that it was made with.
export const section_sheet = (report: Report, section: Section, now: State | undefined, asked: string): string | null => {
  const { first, pictures = [] } = section;
  const picture = pictures.find(({ name }) => name === first?.picture);
  if (!first || !picture) return null;
  const round = picture.in_window === true;
  const width_px = round ? kRound_px : kDrawn_px;
  const height_px = round ? kRound_px : Math.round(Math.min(0.62 * kDrawn_px, picture.height_px + 60));
  const state = now ?? initial_state(picture, false, width_px);
  const { before = [], verdict, also = "" } = first.conclusion(state.chosen);

  let drawn = text_at(kLeft, 34, plain(section.heading, 80), { size_px: 10, fill: "#444" });
  drawn += text_at(kLeft, 55, plain(report.title, 56), { size_px: 17, bold: true }) + line_at(kLeft, 64, kRight, "#000");
  let y = 82;
  const stated: [string, string][] = [
    [t.handover_files, plain(report.files.join(", "), 600)],
    [t.handover_recorded, started_text(report)],
    [t.handover_asked, plain(asked, 300)],
  ];
  for (const [name, value] of stated.filter(([, value]) => value !== "")) {
    const block = paragraph_at(kLeft + 90, y, kAcross - 90, value, 3, { size_px: 9.5 });
    drawn += text_at(kLeft, y, name, { size_px: 9.5, fill: "#444" }) + block.svg;
    y = block.below + 1;
  }
  y += 10;
  const further = sentence_text(verdict).includes(sentence_text(also)) ? "" : also;
  const said: [Sentence, boolean][] = [...before.map((one): [Sentence, boolean] => [one, false]), [verdict, true], [further, false]];
  for (const [text, bold] of said) {
    const block = paragraph_at(kLeft, y, kAcross, micrometres(sentence_text(text)), 5, { size_px: 11.5, bold });
    drawn += block.svg;
    y = block.below + (block.svg === "" ? 0 : 4);
  }

  const on_sheet_px = round ? 430 : kAcross;
  const high_px = (height_px * on_sheet_px) / width_px;
  const size = `width="${width_px}" height="${height_px}"`;
  const x = kLeft + (kAcross - on_sheet_px) / 2;
  drawn += svg_file(picture, state, width_px, height_px).trim()
    .replace(size, `x="${x.toFixed(1)}" y="${y.toFixed(1)}" width="${on_sheet_px}" height="${high_px.toFixed(1)}"`);
  y += high_px + 16;

  const end = kSheet_px.height - kFoot_px;
  for (const table of tables_of(section, state.chosen)) {
    const room = Math.floor((end - y - kTable_head_px) / kRow_px);
    if (room < 2) break;
    const rows = table.rows.slice(0, Math.min(room, kMost_rows, table.at_first ?? kMost_rows));
    const block = table_at(kLeft, y + 17, kAcross, table.heading, rows, 9);
    const more = table.rows.length - rows.length;
    drawn += text_at(kLeft, y, plain(table.title, 90), { size_px: 11, bold: true }) + block.svg;
    if (more > 0) drawn += text_at(kLeft, block.below, t.handover_more({ n: more }), { size_px: 8.5, fill: "#444" });
    y = block.below + (more > 0 ? 26 : 14);
  }
  return sheet_of(kSheet_px.width, kSheet_px.height, drawn + foot_at(report));
};
