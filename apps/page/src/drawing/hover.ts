// The text under the mouse: where, and the value of each curve there. Drawn text, so names are shown as they are.
import { shown } from "./theme";

type Series = Record<string, unknown>;

export interface Hover {
  x: number; // place of x in a point
  y: number;
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
const value_near = (series: Series, at: number, { x, y, turn }: Hover): number | null => {
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
    let apart = Math.abs(place - at);
    if (turn) apart = Math.min(apart, Math.abs(360 - apart));
    if (apart < nearest) {
      nearest = apart;
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

const hit = (items: readonly Series[], { y }: Hover): Found[] =>
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

export const hover_text =
  (hover: Hover) =>
  (hovered: unknown): string => {
    const items = (Array.isArray(hovered) ? hovered : [hovered]) as Series[];
    const place = items[0]?.["axisValue"] ?? values_of(items[0]?.["value"])[hover.x];
    const at = Number(place ?? NaN);
    if (!Number.isFinite(at)) return "";
    const found = hover.drawn ? near(at, hover) : hit(items, hover);
    const decimals = decimals_of(found);
    const lines = evenly(found, hover.most ?? 14).map(
      (one) => `${one.marker}${one.name}   ${shown(one.value, decimals)} ${hover.unit}`,
    );
    return [hover.head(at), ...lines].join("\n");
  };
