// Where a model fails, its parameters, and what its effects answer to a step.
import type { Section, TextTable } from "../picture";
import type { Checked, Parameter, Report } from "../report";
import { plain, unit_shown } from "../drawing/text";
import { decimals_for, minutes, shown, with_sigma } from "../drawing/theme";
import { named, t, with_decimal_sign } from "../texts/texts";
import { plain_name, typed_name, typed_parameter } from "../machine_errors/error_names";

const kMost_rows = 20;

type Misfit = Checked["where"][number];

// "angle, CCW", or a column; a regime, or from where to where: "30 deg".
const place_name = (what: string): string => what.split(", ").map((part) => named(t.places, part)).join(", ");
const end_name = (end: string): string => with_decimal_sign(named(t.regimes, end).replace(/ deg$/, "°").replace(/ degC$/, " °C"));

const misfit_row = (misfit: Misfit): string[] => [
  plain(place_name(misfit.what), 50),
  plain(
    misfit.from === misfit.to
      ? end_name(misfit.from)
      : t.several_from_to({ from: end_name(misfit.from), to: end_name(misfit.to) }),
    60,
  ),
  String(misfit.n),
  with_sigma(misfit.bias_um, misfit.bias_sigma_um, decimals_for(misfit.bias_um, misfit.bias_sigma_um)),
  shown(misfit.rmse_um, 3),
  misfit.share === null ? "–" : shown(100 * misfit.share, 0),
];

// By the size of what is left there, the largest first.
export const worst_first = (where: readonly Misfit[]): Misfit[] =>
  [...where].sort((a, b) => (b.rmse_um ?? 0) - (a.rmse_um ?? 0)).slice(0, kMost_rows);

export const where_table = (checked: Checked, choose: TextTable["choose"]): TextTable[] => {
  const rows = worst_first(checked.where).map(misfit_row);
  if (rows.length === 0) return [];
  const all = checked.where.length;
  const title = rows.length < all ? t.model_where_worst({ rows: rows.length, all }) : t.model_where_title;
  return [{ title, heading: [t.model_by, t.model_where, t.model_rows, t.model_bias, "RMSE µm", t.model_share], rows, choose }];
};

const parameter_row = (one: Parameter): string[] => {
  const decimals = decimals_for(one.value, one.sigma);
  const held = one.state !== undefined && one.state !== "free";
  return [
    one.effect === "constant" ? plain_name(one.effect, 90) : typed_name(one.effect ?? "–", 90),
    typed_parameter(one.name),
    held && one.sigma === null ? shown(one.value) : with_sigma(one.value, one.sigma, decimals),
    unit_shown(plain(one.unit, 20)).replace(/\bum\b/g, "µm"),
    plain(named(t.states, one.state ?? ""), 20),
  ];
};

export const parameter_table = (checked: Checked): TextTable[] =>
  checked.parameters.length === 0
    ? []
    : [
        {
          title: t.model_parameters_title,
          heading: [t.model_effect, t.model_parameter, t.value, t.unit, t.model_state],
          rows: checked.parameters.map(parameter_row),
        },
      ];

// Beside the table of circles: there the same centre may stand with another sigma.
export const sigma_notes = (report: Report, checked: Checked): NonNullable<Section["lists"]> => {
  const circles = report.fit?.recordings.some(({ kind }) => kind === "circle") ?? false;
  const sigmas = checked.parameters.some(({ sigma }) => sigma !== null);
  if (checked.level !== "recording" || !circles || !sigmas) return [];
  return [{ title: t.model_sigmas_title, items: [t.model_sigmas_note] }];
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
          title: t.model_steps_table,
          heading: [
            t.model_effect, t.model_input, t.from, t.to, t.unit, t.model_at_the_end, t.model_after,
          ],
          rows: checked.steps.map((step) => {
            const after_s = way_made_s(step.time_s, step.response_um);
            return [
              typed_name(step.effect, 90),
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
