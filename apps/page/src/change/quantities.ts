// Names of what two tests are compared in, and which of it is told first.
import { error_name } from "../machine_errors/error_names";
import type { QuantityDifference } from "../report";
import { named, t } from "../texts/texts";

export const quantity_name = (name: string, plane: string): string => {
  const [, axis] = /^scale_([xyz])$/.exec(name) ?? [];
  return axis === undefined ? error_name(named(t.change_quantities, name), plane) : t.change_scale({ axis: axis.toUpperCase() });
};

// The circularity, what differs clearly, and what one of the tests shows.
export const is_told = ({ name, clear, shown, of_set_up }: QuantityDifference): boolean =>
  !of_set_up && (name === "circularity" || clear === true || (shown && name !== "global_scale" && name !== "residual_rms"));
