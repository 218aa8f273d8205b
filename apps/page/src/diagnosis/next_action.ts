// What to do next after a diagnosis, as the program proposes it, and how a button says it.
import { parameter_name, plain_name } from "../machine_errors/error_names";
import type { PageAction } from "../picture";
import type { Diagnosed, NextAction } from "../report";
import { rmse_shown } from "../drawing/theme";
import { t } from "../texts/texts";

export type Proposed = Extract<PageAction, NextAction>;

const kActions: readonly string[] = ["add", "try", "free", "plan"];

// null: nothing is to do, or an older program does not say it.
export const next_action_of = ({ next_action: next }: Diagnosed): Proposed | null =>
  next && kActions.includes(next.action) ? (next as Proposed) : null;

// Of a button: what it does, and the RMSE that it leaves where that is known.
export const next_label = ({ action, effects, parameters, promised_rmse_um }: Proposed): string => {
  const promised = promised_rmse_um === null ? "" : t.live_next_promise({ rmse: rmse_shown(promised_rmse_um) });
  const names = effects.map((effect) => plain_name(effect, 60)).join(", ");
  switch (action) {
    case "add":
      return t.live_next_add({ effects: names }) + promised;
    case "try":
      return t.live_next_try({ effects: names }) + promised;
    case "free":
      return t.live_next_free({ parameters: parameters.map(({ effect, parameter }) => `${parameter_name(parameter)} (${plain_name(effect, 60)})`).join(", ") }) + promised;
    case "plan":
      return t.diagnosis_next_plan;
  }
};
