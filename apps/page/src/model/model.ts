// A fitted model, target by target: what it leaves and where, what each effect adds, and how each answers.
import { against_choice, residual_against_picture } from "./residual_against_picture";
import { contributions_picture } from "./contributions_picture";
import { model_fit_picture } from "./model_fit_picture";
import { parameter_table, sigma_notes, step_table, where_table, worst_first } from "./model_tables";
import type { Next, Picture, Section, TextTable } from "../picture";
import { command_of, data_files, model_options } from "../drawing/command";
import type { Checked, Report } from "../report";
import { steps_picture } from "./steps_picture";
import { strands_of } from "../drawing/strands";
import { plain, slug } from "../drawing/text";
import { shown } from "../drawing/theme";
import { all_said, said, type Sentence, t } from "../texts/texts";

// A row of the table of misfits chooses the axis that it speaks of.
const choose_axis = (checked: Checked, picture: string): TextTable["choose"] => {
  const { values, initial } = against_choice(checked);
  const named = worst_first(checked.where).map(({ what }) => {
    const column = /^(angle|quadrant)\b/.test(what) ? "angle_deg" : what;
    return values.find((value) => value.column === column)?.value ?? initial;
  });
  return { picture, key: "against", values: named };
};

const times_floor = ({ rmse_um, floor_um }: Checked): string =>
  rmse_um !== null && floor_um ? t.model_times_floor({ times: shown(rmse_um / floor_um, 1) }) : "";

const result_of = (checked: Checked): string =>
  t.model_result({ rmse: shown(checked.rmse_um, 3), times: times_floor(checked), parameters: checked.parameters.length });

export const verdict_of = (checked: Checked): Sentence => said(checked.sentences[0] ?? result_of(checked), checked.messages?.[0]);

const diagnose_next = (report: Report, { target }: Checked): Next => ({
  label: t.model_find,
  command: report.machine_errors
    ? command_of("errors", data_files(report), model_options(report))
    : command_of("diagnose", data_files(report), [...model_options(report), "--target", target]),
  action: report.machine_errors ? { action: "show", section: "machine-errors" } : { action: "find", target },
});

const section_of = (report: Report, checked: Checked, id: string): Section => {
  const against = `${id}-residual`;
  const strands = strands_of(checked);
  const pictures: Picture[] = [
    model_fit_picture(report, checked, strands, `${id}-fit`),
    residual_against_picture(report, checked, strands, against),
    ...(checked.series.contributions.length > 0 ? [contributions_picture(report, checked, strands, `${id}-effects`)] : []),
    ...(checked.steps.length > 0 ? [steps_picture(checked, `${id}-steps`)] : []),
  ];
  return {
    id,
    heading: t.model_of({ target: plain(checked.target, 60) }),
    result: result_of(checked),
    first: {
      picture: `${id}-fit`,
      kind: t.model_target,
      label: plain(checked.target, 60),
      conclusion: () => ({ verdict: verdict_of(checked), concluded: checked.sentences[0], next: diagnose_next(report, checked) }),
    },
    sentences: [
      ...all_said(checked.sentences, checked.messages),
      ...(checked.floor_text === "" ? [] : [said(checked.floor_text, checked.floor_text_message)]),
      ...all_said(checked.remarks, checked.remarks_message),
    ],
    tables: [...where_table(checked, choose_axis(checked, against)), ...parameter_table(checked), ...step_table(checked)],
    pictures,
    lists: sigma_notes(report, checked), // the page shows lists below the tables
  };
};

export const model_sections = (report: Report): Section[] => {
  const targets = (report.check?.targets ?? []).filter((checked) => checked.series.time_s.length > 0);
  const ids = targets.map((checked) => `model-${slug(checked.target)}`);
  return targets.map((checked, k) =>
    section_of(report, checked, ids.indexOf(ids[k] ?? "") === k ? (ids[k] ?? "model") : `${ids[k]}-${k + 1}`),
  );
};
