// The text under the mouse: where, and the value of each curve there. Drawn text, so names are shown as they are.
import type { Look, State, Toggle } from "../picture";
import { base, decimals_for, legend, shown, time_and_clock, tooltip, with_sigma } from "./theme";
import { t } from "../texts/texts";

type Series = Record<string, unknown>;

export interface Hover {
  x?: number; // place of x in a point, else 0
  y?: number; // else 1
  head: (x: number) => string;
  unit: string;
  // ECharts finds only the curves that have a point exactly there. Where curves have points of their own, give what is
  // drawn, and the nearest point of each series that is not silent is looked up.
  drawn?: readonly Series[];
  turn?: boolean; // x is an angle: 359.9 is near 0
  most?: number; // lines; of more curves, evenly chosen ones
}

interface Found {
  name: string;
  value: number;
  marker: string;
}

const values_of = (point: unknown): readonly unknown[] => {
  const value = Array.isArray(point) ? point : (point as { value?: unknown } | null)?.value;
  return Array.isArray(value) ? value : [];
};

// The value of the point nearest to `at`; null where there is none nearer than a sixtieth of the curve's length.
const value_near = (series: Series, at: number, { x = 0, y = 1, turn }: Hover): number | null => {
  let nearest = Infinity;
  let found: number | null = null;
  let least = Infinity;
  let largest = -Infinity;
  for (const point of (series["data"] as unknown[] | undefined) ?? []) {
    const values = values_of(point);
    const [place, value] = [values[x], values[y]];
    if (typeof place !== "number" || typeof value !== "number") continue;
    least = Math.min(least, place);
    largest = Math.max(largest, place);
    let distance = Math.abs(place - at);
    if (turn) distance = Math.min(distance, Math.abs(360 - distance));
    if (distance < nearest) {
      nearest = distance;
      found = value;
    }
  }
  return nearest <= Math.max((largest - least) / 60, 1e-9) ? found : null;
};

const near = (at: number, hover: Hover): Found[] =>
  (hover.drawn ?? []).flatMap((series) => {
    const value = series["silent"] === true || !series["name"] ? null : value_near(series, at, hover);
    return value === null ? [] : [{ name: String(series["hover_name"] ?? series["name"]), value, marker: "" }];
  });

const hit = (items: readonly Series[], { y = 1 }: Hover): Found[] =>
  items.flatMap((item) => {
    const value = values_of(item["value"])[y];
    const marker = typeof item["marker"] === "string" ? item["marker"] : "";
    return typeof value === "number" && Number.isFinite(value)
      ? [{ name: String(item["seriesName"] ?? ""), value, marker }]
      : [];
  });

// Decimals that tell values of this size apart.
const decimals_of = (found: readonly Found[]): number => {
  const largest = Math.max(0, ...found.map(({ value }) => Math.abs(value)));
  return largest >= 1000 ? 0 : largest >= 100 ? 1 : largest >= 1 ? 2 : 3;
};

const evenly = (found: readonly Found[], most: number): Found[] =>
  found.length <= most
    ? [...found]
    : Array.from({ length: most }, (_, k) => found[Math.round((k * (found.length - 1)) / (most - 1))]).filter(
        (one) => one !== undefined,
      );

const hover_text =
  (hover: Hover) =>
  (hovered: unknown): string => {
    const items = (Array.isArray(hovered) ? hovered : [hovered]) as Series[];
    const place = items[0]?.["axisValue"] ?? values_of(items[0]?.["value"])[hover.x ?? 0];
    const at = Number(place ?? NaN);
    if (!Number.isFinite(at)) return "";
    const found = hover.drawn ? near(at, hover) : hit(items, hover);
    const decimals = decimals_of(found);
    const lines = evenly(found, hover.most ?? 14).map(
      (one) => `${one.marker}${one.name}   ${shown(one.value, decimals)} ${hover.unit}`,
    );
    return [hover.head(at), ...lines].join("\n");
  };

// What stands beside the pointer over curves.
export const curves_tooltip = (look: Look, hover: Hover): Record<string, unknown> => ({
  ...tooltip(look),
  trigger: "axis",
  formatter: hover_text(hover),
});

// What all pictures of curves have: colours, a legend, and what the pointer reads.
export const curves_base = (state: State, toggles: readonly Toggle[], hover: Hover): Record<string, unknown> => ({
  ...base(state.look),
  legend: legend(state, toggles),
  tooltip: curves_tooltip(state.look, hover),
});

// What stands beside the pointer over a picture of time: when, and of each curve the value with its uncertainty.

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
  (unit: string, started?: string) =>
  (hovered: unknown): string => {
    const items = (Array.isArray(hovered) ? (hovered as Item[]) : [hovered as Item]).filter(
      (item) => item.seriesName && place(item, 1) !== null,
    );
    const time_min = items[0] ? place(items[0], 0) : null;
    if (time_min === null) return "";
    const rest = items.length > kLines ? [t.hover_more({ more: items.length - kLines })] : [];
    return [time_and_clock(time_min, started), ...items.slice(0, kLines).map((item) => line_of(item, unit)), ...rest].join("\n");
  };
