// What an effect adds, as small as a word. Of many rows the extremes of each stretch are drawn.
import { decimated } from "../drawing/decimate";
import type { Num } from "../report";

const kWidth = 120;
const kHeight = 26;
const svg_name = "http://www.w3.org/2000/svg";

const path_of = (values: readonly Num[], [least, largest]: readonly [number, number]): string => {
  const high = largest - least || 1;
  const points = decimated(
    values.map((_, i) => i),
    values,
    null,
    kWidth,
  );
  return points
    .map(([i, value]) => {
      const x = (kWidth * i) / Math.max(1, values.length - 1);
      return value === null ? "" : `${x.toFixed(1)},${(kHeight - 1 - ((value - least) / high) * (kHeight - 2)).toFixed(1)}`;
    })
    .filter((point) => point !== "")
    .join(" ");
};

export const extent_of = (columns: readonly (readonly Num[])[]): [number, number] => {
  let least = Infinity;
  let largest = -Infinity;
  for (const values of columns) {
    for (const value of values) {
      if (value === null) continue;
      if (value < least) least = value;
      if (value > largest) largest = value;
    }
  }
  return least <= largest ? [least, largest] : [0, 1];
};

export const small_curve = (values: readonly Num[], extent: readonly [number, number]): SVGElement => {
  const svg = document.createElementNS(svg_name, "svg");
  for (const [name, value] of Object.entries({ viewBox: `0 0 ${kWidth} ${kHeight}`, class: "small-curve", "aria-hidden": "true" })) {
    svg.setAttribute(name, value);
  }
  const line = document.createElementNS(svg_name, "polyline");
  line.setAttribute("points", path_of(values, extent));
  svg.append(line);
  return svg;
};
