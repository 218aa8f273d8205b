// What a regression over batches predicts for the job, and whether the job is like its batches.
import { prediction_picture, range_picture, weights_picture } from "./batch_pictures";
import { command_of, data_files } from "../drawing/command";
import type { Next, Section } from "../picture";
import type { BatchPart, Report } from "../report";
import { plain } from "../drawing/text";
import { shown } from "../drawing/theme";
import { english, type Sentence, t } from "../texts/texts";

// As `ballbar predict` says it.
const agreement = (batch: BatchPart): string[] => {
  let squares = 0;
  let within = 0;
  let n = 0;
  batch.measured_um?.forEach((value, i) => {
    const predicted_um = batch.predicted_um[i] ?? null;
    if (value === null || predicted_um === null) return;
    squares += (value - predicted_um) ** 2;
    within += Math.abs(value - predicted_um) <= (batch.half_width_um[i] ?? -1) ? 1 : 0;
    n += 1;
  });
  if (n === 0) return [];
  const rmse = shown(Math.sqrt(squares / n), 2);
  return [t.batch_agreement({ rmse, percent: shown((100 * within) / n, 0) })];
};

const verdict_of = (batch: BatchPart): Sentence => {
  const [warning] = batch.warnings;
  if (warning !== undefined) return english(warning);
  return agreement(batch)[0] ?? t.batch_by_method({ target: plain(batch.target, 60), method: batch.method });
};

const next_of = (report: Report): Next => ({
  label: t.batch_next,
  command: command_of("predict", data_files(report), ["--model", report.files.find((file) => file.endsWith(".json")) ?? "model.json", "--out", "predicted.csv"]),
  action: { action: "predict" },
});

export const batch_section = (report: Report): Section[] => {
  const { batch } = report;
  if (!batch) return [];
  const weights = batch.batches.map(({ weight }) => weight);
  const has_weights = weights.some((weight) => weight !== weights[0]);
  return [
    {
      id: "batch",
      heading: t.batch_heading({ target: plain(batch.target, 60) }),
      result: agreement(batch)[0] ?? t.batch_count({ n: batch.batches.length }),
      first: {
        picture: "batch",
        conclusion: () => ({ verdict: verdict_of(batch), next: next_of(report) }),
      },
      sentences: [
        t.batch_by({ target: plain(batch.target, 60), method: batch.method, batches: batch.batches.length }),
        ...agreement(batch),
        ...batch.warnings.map(english),
      ],
      tables: [
        {
          title: t.batch_table,
          heading: [t.batch_one, t.batch_weight],
          rows: batch.batches.map(({ name, weight }) => [name, shown(weight, 2)]),
        },
      ],
      pictures: [prediction_picture(batch), range_picture(batch), ...(has_weights ? [weights_picture(batch)] : [])],
    },
  ];
};
