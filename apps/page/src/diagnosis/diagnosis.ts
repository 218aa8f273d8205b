// Which effect the model lacks, or that the data cannot tell: a section for each target.
import { candidate_table, posterior_table } from "./diagnosis_tables";
import { candidates_picture } from "./candidates";
import { coherence_picture } from "./coherence";
import { next_action_of, next_label } from "./next_action";
import { ledger_steps, not_known, type Step } from "./steps";
import type { Next, Picture, Section } from "../picture";
import { command_of, data_files, model_options } from "../drawing/command";
import { best_set, set_name } from "./ranking";
import type { Checked, Diagnosed, Num, Report } from "../report";
import { plain } from "../drawing/text";
import { plain_name } from "../machine_errors/error_names";
import { shown } from "../drawing/theme";
import { said_of, verdict_of } from "./verdict";
import { waterfall } from "./waterfall";
import { with_without_picture } from "./with_without";
import { english, named, said, said_after, type Sentence, t } from "../texts/texts";

const predicted_text = ({ predicted, predicted_by }: Diagnosed): Sentence[] => {
  if (predicted_by) {
    const { columns, left_out_um, model_left_out_um: model_um } = predicted_by;
    const said = { by: columns.map((column) => plain(column, 44)).join(", "), left_out: shown(left_out_um, 2) };
    return [model_um === null ? t.diagnosis_predicted_by(said) : t.diagnosis_predicted_by_and_model({ ...said, model: shown(model_um, 2) })];
  }
  if (!predicted) return [];
  const { expected_um, today_um, constant_um, better } = predicted;
  const errors = { expected: shown(expected_um, 2), today: shown(today_um, 2), constant: shown(constant_um, 2) };
  if (better) return [t.diagnosis_predicted(errors)];
  const hardly = (expected_um ?? Infinity) < Math.min(today_um ?? Infinity, constant_um ?? Infinity);
  return [hardly ? t.diagnosis_hardly_predicted(errors) : t.diagnosis_not_predicted(errors)];
};

const sentences_of = (found: Diagnosed): Sentence[] => {
  const reasons = found.reasons.length > 0 && found.verdict !== "nothing";
  return [
    verdict_of(found),
    t.diagnosis_verdict({ verdict: named(t.verdicts, found.verdict) }),
    ...(found.hint === "" ? [] : [said(found.hint, found.hint_message)]),
    ...(found.next_test_text === "" ? [] : [said_after(t.diagnosis_to_decide, found.next_test_text, found.next_test_text_message)]),
    ...predicted_text(found),
    ...(reasons ? [t.diagnosis_why, ...found.reasons.map((reason, k) => said_after("–", reason, found.reasons_message?.[k]))] : []),
  ];
};

// Effects with one reason together, as on the terminal.
const by_reason = (untestable: Diagnosed["untestable"]): Sentence[] => {
  const of_reason = new Map<string, Diagnosed["untestable"]>();
  for (const one of untestable) of_reason.set(one.why, [...(of_reason.get(one.why) ?? []), one]);
  return [...of_reason].map(([why, all]) => said_after(`${all.map(({ effect }) => plain_name(effect, 60)).join(", ")}:`, why, all[0]?.why_message));
};

const lists_of = (found: Diagnosed): NonNullable<Section["lists"]> =>
  [
    { title: t.diagnosis_untestable, items: by_reason(found.untestable) },
    {
      title: t.diagnosis_not_searched,
      items: found.not_searched.map(({ effect, choices_of_columns: all, searched }) =>
        t.diagnosis_not_searched_one({ effect, left: all - searched, all }),
      ),
    },
  ].filter(({ items }) => items.length > 0);

// The revisions that a ledger has of it. `last`: what its RMSE was by the last of them, where that is another.
const history_of = (report: Report, found: Diagnosed): { steps: Step[]; last_um: Num } => {
  const steps = report.ledger ? ledger_steps(report.ledger, found.target) : [];
  const last_um = steps.at(-1)?.rmse_um ?? null;
  if (last_um === null || found.rmse_um === null) return { steps: [], last_um: null };
  return Math.abs(last_um - found.rmse_um) <= 0.01 * found.rmse_um ? { steps, last_um: null } : { steps: [], last_um };
};

// From the model as it is, with its history where a ledger leads to it, to the set that is drawn.
const fall_steps = (found: Diagnosed, history: readonly Step[]): Step[] => {
  const best = best_set(found);
  const accepted = set_name(found) !== "closest";
  const now: Step = {
    label: t.diagnosis_now,
    short: t.diagnosis_now_short,
    rmse_um: found.rmse_um,
    from_um: null,
    floor_um: found.floor_um,
    held_out_um: best.length === 1 ? (best[0]?.held_out_before_um ?? null) : null,
    proposed: false,
  };
  const left_out = best.map((candidate) => candidate.held_out_after_um);
  const proposed: Step[] = best.length === 0 ? [] : [
    {
      label: accepted ? t.diagnosis_with_best : t.diagnosis_closest_set_label,
      short: accepted ? t.diagnosis_best_short : t.diagnosis_closest_short,
      rmse_um: found.rmse_after_um,
      from_um: found.rmse_um,
      floor_um: found.floor_um,
      held_out_um: new Set(left_out).size === 1 ? (left_out[0] ?? null) : null,
      proposed: true,
    },
  ];
  return [...(history.length > 0 ? history : [now]), ...proposed];
};

const fall_picture = (report: Report, found: Diagnosed, name: string): Picture[] => {
  const history = history_of(report, found);
  const steps = fall_steps(found, history.steps);
  if (steps.length < 2) return [];
  const effects = best_set(found).length;
  const accepted = set_name(found) !== "closest";
  const last = shown(history.last_um, 3);
  return [
    waterfall({
      name,
      title: effects > 0 && !accepted ? t.diagnosis_fall_title_closest : t.diagnosis_fall_title,
      caption: t.diagnosis_falling,
      about: [
        t.diagnosis_no_evidence,
        effects === 0 ? t.diagnosis_fall_none : accepted ? t.diagnosis_fall_hollow : t.diagnosis_fall_closest,
        ...not_known(steps),
        ...(history.last_um === null ? [] : [t.diagnosis_fall_left_out({ last, now: shown(found.rmse_um, 3) })]),
      ].join(" "),
      steps,
    }),
  ];
};

// "named: lagged_expansion(T_room_degC), P 0.99; RMSE 0.553 → 0.210 µm"
const result_of = (found: Diagnosed): string => {
  if (found.not_diagnosed !== undefined) return t.diagnosis_not_diagnosed;
  const best = best_set(found);
  const set = best.map(({ label }) => plain_name(label, 50)).join(", ");
  const [verdict, rmse] = [named(t.verdicts, found.verdict), shown(found.rmse_um, 3)];
  return set === ""
    ? t.diagnosis_result({ verdict, rmse })
    : t.diagnosis_result_of({ verdict, set, rmse: `${rmse} → ${shown(found.rmse_after_um, 3)}` });
};

// What is found is more than what is open, and that more than nothing; then the larger fall.
const says_of = (found: Diagnosed): number => {
  if (found.not_diagnosed !== undefined) return -20; // below the models
  const certain = { named: 6, probable: 5, equivalent: 5, driver: 4, unexplained: 3, nothing: 2, untestable: 1 };
  const fall = found.rmse_um && found.rmse_after_um !== null ? 1 - found.rmse_after_um / found.rmse_um : 0;
  return certain[found.verdict] + Math.min(0.9, Math.max(0, fall));
};

const next_of = (report: Report, found: Diagnosed): Next => {
  const action = next_action_of(found);
  if (action && action.action !== "plan") {
    return { label: next_label(action), text: said(found.hint, found.hint_message), command: found.command, action };
  }
  const options = [...model_options(report), "--target", found.target];
  return found.verdict === "nothing"
    ? { label: t.diagnosis_next_where, command: command_of("check", data_files(report), options), action: report.check ? { action: "show", section: "model" } : null }
    : { label: t.diagnosis_next_plan, text: said(found.hint, found.hint_message), command: command_of("plan", data_files(report), options), action };
};

const section_of = (report: Report, found: Diagnosed, checked: Checked | undefined, number: string): Section => {
  const section = {
    id: `diagnosis${number}`,
    heading: t.diagnosis_lacks({ target: plain(found.target, 60) }),
    result: result_of(found),
    says: says_of(found),
  };
  if (found.not_diagnosed !== undefined) {
    return { ...section, sentences: [english(found.not_diagnosed)] };
  }
  const [over_residual, with_without] = [`candidates${number}`, `with-without${number}`];
  const left_out = checked?.level === "recording" ? t.diagnosis_left_out_recordings : t.diagnosis_left_out_cycles;
  return {
    ...section,
    sentences: sentences_of(found),
    command: found.command,
    above: found.verdict === "untestable" ? [] : [posterior_table(found)],
    tables: found.candidates.length > 0 ? [candidate_table(found, left_out, checked ? over_residual : null)] : [],
    first: checked && {
      picture: with_without,
      kind: t.model_target,
      label: plain(found.target, 60),
      conclusion: () => ({ ...said_of(found), concluded: found.sentence, next: next_of(report, found) }),
    },
    pictures: [
      ...(checked
        ? [with_without_picture(report, checked, found, with_without), candidates_picture(report, checked, found, over_residual)]
        : []),
      ...fall_picture(report, found, `fall${number}`),
      ...(found.coherence && found.coherence.effects.length > 1
        ? [coherence_picture(found.coherence, `coherence${number}`)]
        : []),
    ],
    lists: lists_of(found),
  };
};

export const diagnosis_sections = (report: Report): Section[] => {
  const targets = report.diagnose?.targets ?? [];
  return targets.map((found, k) => {
    const checked = report.check?.targets.find((one) => one.target === found.target);
    return section_of(report, found, checked, targets.length > 1 ? `-${k + 1}` : "");
  });
};
