// A value with its standard deviation, as the tables of ballbar print it: "12.01 ± 1.33".
import type { Num } from "../report";
import { shown } from "./theme";

export const with_sigma = (value: Num | undefined, sigma: Num | undefined, decimals: number): string =>
  typeof value !== "number"
    ? "–"
    : `${shown(value, decimals)} ± ${typeof sigma === "number" ? shown(sigma, decimals) : "?"}`;

// Decimals so that the standard deviation has two digits; without one, so that the value has four.
export const decimals_for = (value: Num | undefined, sigma: Num | undefined): number => {
  const by = (size: number, digits: number): number =>
    Math.min(9, Math.max(0, digits - 1 - Math.floor(Math.log10(size))));
  if (typeof sigma === "number" && sigma > 0 && Number.isFinite(sigma)) return by(sigma, 2);
  if (typeof value === "number" && value !== 0 && Number.isFinite(value)) return by(Math.abs(value), 4);
  return 2;
};
