// What the catalogue says of the parameters of an effect.
import type { Engine } from "../engine";
import type { Num } from "../report";

interface Entry {
  name: string;
  parameters: { name: string; kind: "gain" | "shape"; lower: Num; upper: Num; meaning: string }[];
}

export type Known = Entry["parameters"][number];

export interface Catalogue {
  parameter(label: string, name: string): Known | undefined; // label: "lagged_expansion(T_room_degC)"
}

const name_in = (label: string): string => /^[A-Za-z_0-9]+/.exec(label)?.[0] ?? label;

export const catalogue_of = async (engine: Engine): Promise<Catalogue> => {
  const { out } = await engine.run(["effects", "--json"]);
  const all = JSON.parse(out) as Entry[] | { effects: Entry[] };
  const by_name = new Map((Array.isArray(all) ? all : all.effects).map((entry) => [entry.name, entry]));
  return {
    parameter: (label, name) => by_name.get(name_in(label))?.parameters.find((one) => one.name === name),
  };
};
