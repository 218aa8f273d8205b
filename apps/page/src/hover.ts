// The text under the mouse: where, and the value of each curve there. Drawn text, so names are shown as they are.
import { shown } from "./theme";

interface Item {
  seriesName?: string;
  marker?: unknown;
  value?: unknown;
}

export interface Hover {
  x: number; // place of x in a point
  y: number;
  head: (x: number) => string;
  unit: string;
  most?: number; // lines; of more curves, evenly chosen ones
}

const number_at = (value: unknown, place: number): number | null => {
  const found = Array.isArray(value) ? (value as unknown[])[place] : null;
  return typeof found === "number" && Number.isFinite(found) ? found : null;
};

// Decimals that tell values of this size apart.
const decimals_of = (sizes: readonly number[]): number => {
  const largest = Math.max(0, ...sizes.map(Math.abs));
  return largest >= 1000 ? 0 : largest >= 100 ? 1 : largest >= 1 ? 2 : 3;
};

export const hover_text =
  ({ x, y, head, unit, most = 14 }: Hover) =>
  (hovered: unknown): string => {
    const items = (Array.isArray(hovered) ? hovered : [hovered]) as Item[];
    const known = items.filter((item) => number_at(item.value, y) !== null);
    const at = known.map((item) => number_at(item.value, x)).find((value) => value !== null);
    if (at === null || at === undefined) return "";
    const step = Math.max(1, (known.length - 1) / (most - 1));
    const chosen = known.length <= most ? known : Array.from({ length: most }, (_, k) => known[Math.round(k * step)]);
    const decimals = decimals_of(known.map((item) => number_at(item.value, y) ?? 0));
    const lines = chosen.map((item) => {
      const marker = typeof item?.marker === "string" ? item.marker : "";
      return `${marker}${item?.seriesName ?? ""}   ${shown(number_at(item?.value, y), decimals)} ${unit}`;
    });
    return [head(at), ...lines].join("\n");
  };
