// Which effect the model lacks, or that the data cannot tell: a section for each target.
import { companion_table, candidate_table } from "./candidate_tables";
import { candidates_picture } from "./candidates";
import { coherence_picture } from "./coherence";
import { no_evidence, no_evidence_of_several, not_known } from "./falls";
import { ledger_steps } from "./ledger_steps";
import type { Picture, Section } from "../picture";
import { ranked_candidates, ranked_companions } from "./ranking";
import type { Checked, Diagnosed, Num, Report } from "../report";
import { plain } from "../drawing/text";
import type { Step } from "./step";
import { waterfall } from "./waterfall";

const sentences_of = (found: Diagnosed): string[] => {
  const reasons =
    found.reasons.length > 0 && found.verdict !== "nothing"
      ? ["Why it is not named, or not all of it:", ...found.reasons.map((reason) => `– ${reason}`)]
      : [];
  return [found.verdict_text, ...reasons, found.next_test_text].filter((sentence) => sentence !== "");
};

// Effects with one reason together, as on the terminal.
const by_reason = (untestable: Diagnosed["untestable"]): string[] => {
  const effects_of = new Map<string, string[]>();
  for (const { effect, why } of untestable) effects_of.set(why, [...(effects_of.get(why) ?? []), effect]);
  return [...effects_of].map(([why, effects]) => `${effects.join(", ")}: ${why}`);
};

const lists_of = (found: Diagnosed): NonNullable<Section["lists"]> => {
  const same_curve = found.candidates
    .filter((candidate) => candidate.also_drawn_by.length > 0)
    .map(
      ({ also_drawn_by, label }) =>
        `${also_drawn_by.join(" and ")} would draw the same curve as ${label}: with what it adds to it at nothing.`,
    );
  return [
    { title: "The same curve by other effects", items: same_curve },
    { title: "Not testable here", items: by_reason(found.untestable) },
    {
      title: "Not searched",
      items: found.not_searched.map(
        (one) =>
          `${one.effect} on ${one.choices_of_columns - one.searched} of ${one.choices_of_columns} choices of columns`,
      ),
    },
  ].filter(({ items }) => items.length > 0);
};

const all_equal = (values: readonly Num[]): boolean => values.every((value) => value === values[0]);

// From the model as it is, with its history where a ledger leads to it, to the best set.
const fall_steps = (report: Report, found: Diagnosed): Step[] => {
  const best = found.candidates.filter((candidate) => candidate.in_best_set);
  const history = report.ledger ? ledger_steps(report.ledger, found.target) : [];
  const last = history.at(-1)?.rmse_um ?? null;
  const leads_here =
    last !== null && found.rmse_um !== null && Math.abs(last - found.rmse_um) <= 0.01 * found.rmse_um;
  const now: Step = {
    label: "the model now",
    short: "now",
    rmse_um: found.rmse_um,
    from_um: null,
    floor_um: found.floor_um,
    fake_fall: null,
    held_out_um: best.length === 1 ? (best[0]?.held_out_before_um ?? null) : null,
    proposed: false,
  };
  const left_out = best.map((candidate) => candidate.held_out_after_um);
  const proposed: Step[] = best.length === 0 ? [] : [
    {
      label: "with the best set",
      short: "best set",
      rmse_um: found.rmse_after_um,
      from_um: found.rmse_um,
      floor_um: found.floor_um,
      // A fake stands in the place of one effect, beside the others: of several, its fall does not begin here.
      fake_fall: best.length === 1 && found.best_fake_fall ? found.best_fake_fall : null,
      held_out_um: all_equal(left_out) ? (left_out[0] ?? null) : null,
      proposed: true,
    },
  ];
  return [...(leads_here ? history : [now]), ...proposed];
};

const fall_picture = (report: Report, found: Diagnosed, name: string): Picture[] => {
  const steps = fall_steps(report, found);
  if (!steps.at(-1)?.proposed) return [];
  const effects = found.candidates.filter((candidate) => candidate.in_best_set).length;
  const first = effects > 1 ? no_evidence_of_several(effects, found.best_fake_fall) : no_evidence;
  return [
    waterfall({
      name,
      title: "How far the error falls",
      about:
        `${first} The hollow bar is not in the model. Whether an effect beats the fakes is judged with ` +
        `the memory of the noise, in the table.${not_known(steps, effects === 1)}`,
      steps,
    }),
  ];
};

const section_of = (report: Report, found: Diagnosed, checked: Checked | undefined, number: string): Section => {
  const section = {
    id: `diagnosis${number}`,
    heading: `What the model of ${plain(found.target, 60)} lacks`,
  };
  if (found.not_diagnosed !== undefined) {
    return { ...section, sentences: [found.not_diagnosed], tables: [], pictures: [] };
  }
  const candidates = ranked_candidates(found);
  const companions = ranked_companions(found);
  const over_residual = `candidates${number}`;
  const chooses = checked ? over_residual : null;
  const left_out = checked?.level === "recording" ? "recordings, or quarters of their sweeps," : "cycles";
  return {
    ...section,
    sentences: sentences_of(found),
    tables: [
      ...(candidates.length > 0 ? [candidate_table(found, left_out, chooses)] : []),
      ...(companions.length > 0 ? [companion_table(found, chooses)] : []),
    ],
    pictures: [
      ...(checked ? [candidates_picture(report, checked, candidates, companions, found.refit_um, over_residual)] : []),
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
