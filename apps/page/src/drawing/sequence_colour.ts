// Colours of a sequence from first to last: viridis (S. van der Walt and N. Smith, 2015), whose lightness rises evenly, so
// that the order is seen with any colour vision and in grey. The end that is too near to the paper is left out.

const kBar_px = 120;

const viridis = [
  [68, 1, 84],
  [72, 40, 120],
  [62, 73, 137],
  [49, 104, 142],
  [38, 130, 142],
  [31, 158, 137],
  [53, 183, 121],
  [110, 206, 88],
  [181, 222, 43],
  [253, 231, 37],
] as const;

// `place` from 0, the first, to 1, the last.
export const sequence_colour = (place: number, dark: boolean): string => {
  const seen = dark ? 0.28 + 0.72 * place : 0.86 * place;
  const at = Math.min(Math.max(seen, 0), 1) * (viridis.length - 1);
  const k = Math.min(Math.floor(at), viridis.length - 2);
  const [low, high] = [viridis[k], viridis[k + 1]];
  if (!low || !high) return "#31688e";
  const mixed = low.map((value, i) => Math.round(value + (at - k) * ((high[i] ?? value) - value)));
  return `rgb(${mixed.join(",")})`;
};

// A bar of the scale with what its ends mean, at the right edge of a drawing, from `top_px` down.
export const sequence_bar = (
  first: string,
  last: string,
  dark: boolean,
  ink: string,
  font: string,
  top_px: number,
): Record<string, unknown> => {
  // Names of files may be long: each has its half of the bar.
  const half = { width: kBar_px / 2 - 4, overflow: "truncate", ellipsis: "…" };
  const name = { y: 12, fill: ink, fontSize: 11, fontFamily: font, ...half };
  return {
    type: "group",
    right: 20,
    top: top_px,
    silent: true,
    children: [
      {
        type: "rect",
        shape: { x: 0, y: 0, width: kBar_px, height: 8 },
        style: {
          fill: {
            type: "linear",
            x: 0,
            y: 0,
            x2: 1,
            y2: 0,
            colorStops: Array.from({ length: 11 }, (_, k) => ({ offset: k / 10, color: sequence_colour(k / 10, dark) })),
          },
        },
      },
      { type: "text", style: { ...name, text: first, x: 0 } },
      { type: "text", style: { ...name, text: last, x: kBar_px, align: "right" } },
    ],
  };
};
