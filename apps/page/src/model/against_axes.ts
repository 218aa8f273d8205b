// What a residual can be drawn against: the time, every column of the data that varies, and what the model says.
import { worst_first } from "./model_tables";
import type { Checked, Num } from "../report";
import { plain } from "../drawing/text";
import { minutes } from "../drawing/theme";
import { split_name, unit_shown, words } from "../drawing/units";
import { t } from "../texts/texts";

export interface AgainstAxis {
  value: string; // of the choice
  label: string;
  column: string; // name, as in the numbers
  name: string; // of the axis, with its unit
  unit: string;
  values: readonly Num[];
}

const varies = (values: readonly Num[]): boolean => {
  const first = values.find((value) => value !== null);
  return values.some((value) => value !== null && value !== first);
};

const axes_of = (checked: Checked): AgainstAxis[] => {
  const { series } = checked;
  const in_s = checked.level === "recording";
  const time = in_s ? series.time_s : series.time_s.map(minutes);
  const unit = in_s ? "s" : "min";
  const columns = series.inputs
    .filter((column) => varies(column.values))
    .map((column, k): AgainstAxis => {
      const { quantity } = split_name(column.name);
      const written = unit_shown(plain(column.unit, 16));
      const name = plain(words(quantity), 60);
      return {
        value: `input${k}`,
        label: name,
        column: column.name,
        name: written ? t.model_in_unit({ name, unit: written }) : name,
        unit: written,
        values: column.values,
      };
    });
  return [
    { value: "time", label: t.model_time, column: "time", name: t.model_time_in({ unit }), unit, values: time },
    ...columns,
    {
      value: "model",
      label: t.model_says,
      column: "model_um",
      name: t.model_axis,
      unit: "µm",
      values: series.predicted_um,
    },
  ];
};

// At first the axis along which the model fails most.
export const against_choice = (checked: Checked): { values: AgainstAxis[]; initial: string } => {
  const values = axes_of(checked);
  const worst = worst_first(checked.where).map(({ what }) =>
    values.find(({ column, value }) => column === what && value !== "time"),
  );
  const usual = values.find(({ column }) => column === "angle_deg") ?? values.find(({ unit }) => unit === "°C");
  return { values, initial: (worst.find((one) => one) ?? usual ?? values[0])?.value ?? "time" };
};
