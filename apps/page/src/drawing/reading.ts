// What stands beside the pointer over a picture of time: when, and of each curve the value with its uncertainty.
import { shown } from "./theme";
import { decimals_for, with_sigma } from "./with_sigma";
import { t } from "../texts/texts";

interface Item {
  seriesName?: string;
  marker?: unknown;
  value?: unknown; // [x, value] or [x, value, sigma]
}

const kLines = 24; // more do not fit

const place = (item: Item, k: number): number | null => {
  const value = Array.isArray(item.value) ? (item.value as unknown[])[k] : null;
  return typeof value === "number" && Number.isFinite(value) ? value : null;
};

const line_of = (item: Item, unit: string): string => {
  const [value, sigma] = [place(item, 1), place(item, 2)];
  const text = sigma === null ? shown(value) : with_sigma(value, sigma, Math.min(4, decimals_for(value, sigma)));
  return `${typeof item.marker === "string" ? item.marker : ""}${item.seriesName ?? ""}  ${text} ${unit}`;
};

export const reading_in =
  (unit: string) =>
  (hovered: unknown): string => {
    const items = (Array.isArray(hovered) ? (hovered as Item[]) : [hovered as Item]).filter(
      (item) => item.seriesName && place(item, 1) !== null,
    );
    const time_min = items[0] ? place(items[0], 0) : null;
    if (time_min === null) return "";
    const rest = items.length > kLines ? [t.hover_more({ more: items.length - kLines })] : [];
    return [`${shown(time_min)} min`, ...items.slice(0, kLines).map((item) => line_of(item, unit)), ...rest].join("\n");
  };
