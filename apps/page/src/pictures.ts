// The pictures without a page: outside a browser this draws each as a file.
import type { Picture, State } from "./picture";
import type { Report } from "./report";
import { sections_of } from "./sections";
import { handover_sheet, kSheet_px } from "./handover/handover";
import { thermal_sheet } from "./handover/thermal_sheet";
import { kErrors_picture } from "./machine_errors/errors_pictures";
import { initial_state, kCaption_px, sheet, svg_file } from "./figure/still";

interface Drawn {
  name: string;
  title: string;
  svg: string;
}
type Answer = { drawn: Drawn[] } | { option: string; found: string; expected: string[] };

// "KEY=VALUE" by what the page lists: the value's label, or the value itself.
const choose = (picture: Picture, state: State, assignment: string): State | Answer => {
  const at = assignment.indexOf("=");
  const key = assignment.slice(0, Math.max(at, 0));
  const { choices = [] } = picture;
  const choice = choices.find((one) => one.key === key);
  if (!choice) {
    return { option: "--choose", found: assignment, expected: choices.map((one) => `${one.key}=...`) };
  }
  const value = choice.values.find((one) => [one.label, one.value].includes(assignment.slice(at + 1)));
  if (!value) {
    return { option: "--choose", found: assignment, expected: choice.values.map((one) => `${key}=${one.label}`) };
  }
  const chosen = { ...state.chosen, [key]: value.value };
  const off = picture.toggles({ chosen }).filter((toggle) => !toggle.on);
  return { ...state, chosen, hidden: new Set(off.map((toggle) => toggle.key)) };
};

// As it is at first, with these choices.
const state_with = (picture: Picture, width_px: number, choices: readonly string[]): State | Answer =>
  choices.reduce<State | Answer>(
    (state, assignment) => ("look" in state ? choose(picture, state, assignment) : state),
    initial_state(picture, false, width_px),
  );

const pictures_of = (report: Report): Picture[] => sections_of(report).flatMap(({ pictures = [] }) => pictures);

// The pictures of these names, all where there is none; `choices` are for each of them. Where one is not there, what is.
const draw = (report: Report, names: readonly string[], choices: readonly string[], width_px: number): Answer => {
  const all = pictures_of(report);
  const unknown = names.find((name) => !all.some((picture) => picture.name === name));
  if (unknown !== undefined) {
    return { option: "--picture", found: unknown, expected: all.map((picture) => picture.name) };
  }
  const drawn: Drawn[] = [];
  for (const picture of all.filter(({ name }) => names.length === 0 || names.includes(name))) {
    const state = state_with(picture, width_px, choices);
    if (!("look" in state)) return state;
    const svg = svg_file(picture, state, width_px, picture.height_px + kCaption_px);
    drawn.push({ name: picture.name, title: picture.title, svg });
  }
  return { drawn };
};

// All of them in one file, under the report's conclusions.
const draw_sheet = (report: Report, width_px: number): Answer => {
  const pictures = pictures_of(report);
  return { drawn: [{ name: "sheet", title: report.title, svg: sheet(report.summary, pictures, width_px) }] };
};

// One test on a sheet of A4 for `--format pdf`; none where the report is of no test or several. `choices`: "error=NAME".
const draw_handover = (report: Report, choices: readonly string[]): Answer => {
  const pictures = pictures_of(report);
  const picture = pictures.find(({ name }) => name === kErrors_picture);
  if (!picture) {
    const thermal = thermal_sheet(report, pictures);
    return { drawn: thermal === null ? [] : [{ name: "handover", title: report.title, svg: thermal }] };
  }
  const state = state_with(picture, kSheet_px.width, choices);
  if (!("look" in state)) return state;
  const svg = handover_sheet(report, state.chosen["error"]);
  return { drawn: svg === null ? [] : [{ name: "handover", title: report.title, svg }] };
};

(globalThis as unknown as Record<string, unknown>)["ballbar_pictures"] = { draw, draw_handover, draw_sheet };
