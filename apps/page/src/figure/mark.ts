// The mark of a curve in its legend. SVG elements with attributes only: the page allows no styles in its markup.
import type { Toggle } from "../picture";

const svg_name = "http://www.w3.org/2000/svg";

const shape = (tag: string, attributes: Readonly<Record<string, string>>): SVGElement => {
  const made = document.createElementNS(svg_name, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
};

const drawn = (mark: Toggle["mark"], colour: string): SVGElement => {
  const line = { x1: "1", y1: "6", x2: "23", y2: "6", stroke: colour, "stroke-width": "2.5" };
  switch (mark) {
    case "line":
      return shape("line", line);
    case "dashed":
      return shape("line", { ...line, "stroke-dasharray": "6 3.5" });
    case "dotted":
      return shape("line", { ...line, "stroke-dasharray": "2 2.5" });
    case "dot":
      return shape("circle", { cx: "12", cy: "6", r: "4", fill: colour });
    case "band":
      return shape("rect", { x: "1", y: "1", width: "22", height: "10", fill: colour, "fill-opacity": "0.35" });
    case "bar":
      return shape("rect", { x: "6", y: "1", width: "12", height: "10", fill: colour });
  }
};

export const mark_of = (toggle: Toggle, dark: boolean): SVGElement => {
  const svg = shape("svg", { width: "24", height: "12", viewBox: "0 0 24 12", "aria-hidden": "true" });
  svg.append(drawn(toggle.mark, toggle.colour(dark)));
  return svg;
};
