// What the catalogue says of the parameters of an effect.
import type { Engine } from "../engine";
import type { Num } from "../report";

export interface CatalogueEntry {
  name: string;
  level: string;
  summary: string; // in a line
  inputs: { role: string; units: string[]; meaning: string }[];
  parameters: { name: string; kind: "gain" | "shape"; lower: Num; upper: Num; meaning: string }[];
}

export type Known = CatalogueEntry["parameters"][number];

export interface Catalogue {
  parameter(label: string, name: string): Known | undefined; // label: "lagged_expansion(T_room_degC)"
  entry(name: string, level: string): CatalogueEntry | undefined; // some are of both levels
}

const name_in = (label: string): string => /^[A-Za-z_0-9]+/.exec(label)?.[0] ?? label;

export const catalogue_of = async (engine: Engine): Promise<Catalogue> => {
  const { out } = await engine.run(["effects", "--json"]);
  const read = JSON.parse(out) as CatalogueEntry[] | { effects: CatalogueEntry[] };
  const all = Array.isArray(read) ? read : read.effects;
  const by_name = new Map(all.map((entry) => [entry.name, entry]));
  return {
    entry: (name, level) => all.find((entry) => entry.name === name && entry.level === level),
    parameter: (label, name) => by_name.get(name_in(label))?.parameters.find((one) => one.name === name),
  };
};
