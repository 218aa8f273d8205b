// Reads an SVG file as a person does who has a ruler: marks and lines in pixels, and from the numbers written at the
// axes what they mean.

// { texts: [{ text, x, y, anchor }], paths: [{ stroke, fill, x, y, points }], polygons: [{ fill, points }] }, all in
// pixels of the whole drawing; x, y of a path is its middle. `page` shows it, so it must be one that a browser can.
export const drawing = async (page, path) => {
  await page.goto(`file://${path}`);
  return page.evaluate(() => {
    if (document.documentElement.localName !== "svg") throw new Error("no SVG");
    const placed = (one, x, y) => {
      const at = new DOMPoint(x, y).matrixTransform(one.getScreenCTM());
      return [at.x, at.y];
    };
    const middle = (one) => {
      const { x, y, width, height } = one.getBBox();
      const [px, py] = placed(one, x + width / 2, y + height / 2);
      return { x: px, y: py };
    };
    const points = (one) =>
      [...one.getAttribute("d").matchAll(/[ML]\s*(-?[\d.]+(?:e-?\d+)?)[ ,](-?[\d.]+(?:e-?\d+)?)/g)].map(([, x, y]) =>
        placed(one, Number(x), Number(y)),
      );
    const all = (name) => [...document.querySelectorAll(name)].filter((one) => !one.closest("defs"));
    return {
      texts: all("text").map((one) => ({ text: one.textContent, anchor: one.getAttribute("text-anchor"), ...middle(one) })),
      paths: all("path").map((one) => ({
        stroke: one.getAttribute("stroke"),
        fill: one.getAttribute("fill"),
        legend: one.getAttribute("ecmeta_ssr_type") === "legend",
        points: points(one),
        ...middle(one),
      })),
      polygons: all("polygon").map((one) => ({
        fill: one.getAttribute("fill"),
        points: [...one.points].map(({ x, y }) => placed(one, x, y)),
      })),
    };
  });
};

const number = (text) => (/^[+−-]?[\d,.]+$/.test(text) ? Number(text.replace("−", "-").replaceAll(",", "")) : NaN);

// From pixel to value by least squares through the numbers at an axis, which must all lie on it.
const through = (labels, what) => {
  if (labels.length < 2) throw new Error(`${what}: ${labels.length} numbers`);
  const mean = (of) => labels.reduce((sum, one) => sum + of(one), 0) / labels.length;
  const [px, value] = [mean((one) => one[0]), mean((one) => one[1])];
  const slope = mean((one) => (one[0] - px) * (one[1] - value)) / mean((one) => (one[0] - px) ** 2);
  for (const one of labels) {
    const beside_px = (one[1] - value) / slope - (one[0] - px);
    if (Math.abs(beside_px) > 1) throw new Error(`${what}: ${one[1]} is written ${beside_px} pixels beside its place`);
  }
  return { at: (at_px) => value + slope * (at_px - px), per_px: Math.abs(slope) };
};

// The axes of the first plot, or of one below it; the numbers of a y axis are written upwards.
export const axes = ({ texts }, plot = 0) => {
  const numbers = texts.map((one) => ({ ...one, value: number(one.text) })).filter((one) => Number.isFinite(one.value));
  const across = numbers.filter((one) => one.anchor === "middle");
  const lowest = Math.max(...across.map((one) => one.y));
  const columns = [];
  for (const one of numbers.filter((one) => one.anchor === "end")) {
    const column = columns[columns.length - 1];
    if (column && one.y < column[column.length - 1].y) column.push(one);
    else columns.push([one]);
  }
  return {
    x: through(across.filter((one) => lowest - one.y < 2).map((one) => [one.x, one.value]), "x axis"),
    y: through((columns[plot] ?? []).map((one) => [one.y, one.value]), "y axis"),
  };
};

// Of a magnified circle: { place: (angle_deg, value_um) => [x, y] in pixels, per_px }. Its ring of the nominal length is
// the line of 121 points; numbers are written at the rings, along a ray, and must lie on them.
export const polar = ({ paths, texts }) => {
  const rings = paths.filter((one) => one.points.length === 121);
  if (rings.length !== 1) throw new Error(`${rings.length} rings of the nominal length`);
  const [{ x, y, points }] = rings;
  const nominal_px = Math.hypot(points[0][0] - x, points[0][1] - y);
  const named = texts
    .map((one) => ({ value: /^[+-]\d+(\.\d+)?$/.test(one.text) ? Number(one.text) : NaN, px: Math.hypot(one.x - x, one.y - y) }))
    .filter(({ value, px }) => Number.isFinite(value) && px > 30);
  if (named.length < 2) throw new Error(`${named.length} numbers at the rings`);
  const most = named.reduce((a, b) => (a.value > b.value ? a : b));
  const per_px = most.value / (most.px - nominal_px);
  for (const { value, px } of named) {
    if (Math.abs(nominal_px + value / per_px - px) > 1.5) throw new Error(`${value} is written ${px} from the middle`);
  }
  return {
    per_px,
    place: (angle_deg, value_um) => {
      const [t, r] = [(angle_deg * Math.PI) / 180, nominal_px + value_um / per_px];
      return [x + r * Math.cos(t), y - r * Math.sin(t)];
    },
  };
};

// The marks of a colour as [x, value, ...], in the order drawn.
export const marks = ({ paths }, { x, y }, colour) =>
  paths.filter((one) => one.fill === colour && !one.legend).map((one) => [x.at(one.x), y.at(one.y)]);

// The lines of a colour, that of the most points first, else in the order drawn.
export const lines = ({ paths }, { x, y }, colour) =>
  paths
    .filter((one) => one.stroke === colour && !one.legend)
    .sort((a, b) => b.points.length - a.points.length)
    .map(({ points }) => points.map(([px, py]) => [x.at(px), y.at(py)]));
