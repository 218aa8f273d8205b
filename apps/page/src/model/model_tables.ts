// Where a model fails, its parameters, and what its effects answer to a step.
import type { Section, TextTable } from "../picture";
import type { Checked, Parameter, Report } from "../report";
import { plain } from "../drawing/text";
import { minutes, shown } from "../drawing/theme";
import { unit_shown } from "../drawing/units";
import { decimals_for, with_sigma } from "../drawing/with_sigma";

const kMost_rows = 20;

type Misfit = Checked["where"][number];

const percent = (share: number | null): string => (share === null ? "–" : shown(100 * share, 0));

const misfit_row = (misfit: Misfit): string[] => [
  plain(misfit.what, 50),
  plain(misfit.from === misfit.to ? misfit.from : `${misfit.from} to ${misfit.to}`, 60),
  String(misfit.n),
  with_sigma(misfit.bias_um, misfit.bias_sigma_um, decimals_for(misfit.bias_um, misfit.bias_sigma_um)),
  shown(misfit.rmse_um, 3),
  percent(misfit.share),
];

// By the size of what is left there, the largest first.
export const worst_first = (where: readonly Misfit[]): Misfit[] =>
  [...where].sort((a, b) => (b.rmse_um ?? 0) - (a.rmse_um ?? 0)).slice(0, kMost_rows);

export const where_table = (checked: Checked, choose: TextTable["choose"]): TextTable[] => {
  const rows = worst_first(checked.where).map(misfit_row);
  if (rows.length === 0) return [];
  const title =
    rows.length < checked.where.length
      ? `Where it fails: the ${rows.length} worst of ${checked.where.length}`
      : "Where it fails, worst first";
  return [
    {
      title,
      heading: ["by", "where", "rows", "bias µm", "RMSE µm", "% of the misfit"],
      rows,
      ...(choose ? { choose } : {}),
    },
  ];
};

const parameter_row = (one: Parameter): string[] => {
  const decimals = decimals_for(one.value, one.sigma);
  const held = one.state !== undefined && one.state !== "free";
  return [
    plain(one.effect ?? "–", 60),
    plain(one.name, 60),
    held && one.sigma === null ? shown(one.value) : with_sigma(one.value, one.sigma, decimals),
    unit_shown(plain(one.unit, 20)).replace(/\bum\b/g, "µm"),
    plain(one.state ?? "", 20),
  ];
};

export const parameter_table = (checked: Checked): TextTable[] =>
  checked.parameters.length === 0
    ? []
    : [
        {
          title: "Parameters, ± one sigma",
          heading: ["effect", "parameter", "value", "unit", "state"],
          rows: checked.parameters.map(parameter_row),
        },
      ];

// Beside the table of circles: there the same centre may stand with another sigma.
export const sigma_notes = (report: Report, checked: Checked): NonNullable<Section["lists"]> => {
  const circles = report.fit?.recordings.some(({ kind }) => kind === "circle") ?? false;
  const sigmas = checked.parameters.some(({ sigma }) => sigma !== null);
  if (checked.level !== "recording" || !circles || !sigmas) return [];
  const note =
    "These sigmas are by the noise model of the diagnosis, so that they differ from those in the table of circles.";
  return [{ title: "About the sigmas of the parameters", items: [note] }];
};

// When an answer has made 63.2 % of its way to the end of the picture: the time constant of a body that follows by itself,
// about, because it has not come to rest there.
const way_made_s = (time_s: readonly number[], response_um: readonly (number | null)[]): number | null => {
  const last = response_um[response_um.length - 1];
  if (typeof last !== "number" || Math.abs(last) < 1e-9) return null;
  const at = response_um.findIndex((value) => typeof value === "number" && value / last >= 1 - Math.exp(-1));
  return at < 0 ? null : (time_s[at] ?? null);
};

export const step_table = (checked: Checked): TextTable[] =>
  checked.steps.length === 0
    ? []
    : [
        {
          title: "Answers to a step of the input",
          heading: ["effect", "input", "from", "to", "unit", "at the end of the picture µm", "63 % of that after min"],
          rows: checked.steps.map((step) => {
            const after_s = way_made_s(step.time_s, step.response_um);
            return [
              plain(step.effect, 60),
              plain(step.input, 40),
              shown(step.from),
              shown(step.to),
              unit_shown(plain(step.unit, 20)),
              shown(step.response_um[step.response_um.length - 1], 2),
              after_s === null ? "–" : after_s <= 0 ? "0" : shown(minutes(after_s), 1),
            ];
          }),
        },
      ];
