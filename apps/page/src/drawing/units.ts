// Units as people write them. Files spell them in ASCII at the end of a column's name: "T_room_degC".
import { named, t } from "../texts/texts";

const written = new Map(
  Object.entries({
    um: "µm",
    mm: "mm",
    degC: "°C",
    K: "K",
    rpm: "rpm",
    min: "min",
    s: "s",
    deg: "°",
    urad: "µrad",
    ppm: "ppm",
    um_per_K: "µm/K",
    A: "A",
    V: "V",
    W: "W",
    kW: "kW",
    Nm: "N m",
    N: "N",
    bar: "bar",
    percent: "%",
    lpm: "l/min",
  }),
);

export const unit_shown = (unit: string): string => written.get(unit) ?? unit;

// "T_room_degC" is the quantity T_room in °C; a name without a known unit has none.
export const split_name = (name: string): { quantity: string; unit: string } => {
  for (const unit of ["um_per_K", ...written.keys()]) {
    if (name.endsWith(`_${unit}`)) return { quantity: name.slice(0, -unit.length - 1), unit: unit_shown(unit) };
  }
  return { quantity: name, unit: "" };
};

// Words, for reading: "radius_change" is "radius change"; what files have as well is said in the language of the page.
export const words = (name: string): string => named(t.quantities, name).replaceAll("_", " ");
