// How a deviation is drawn on a circle. The circle of the nominal length is drawn to scale, and a deviation of 1 um as
// long as `magnification` um of it would be: at 1000 times, 10 um on a bar of 100 mm are a tenth of the circle's radius.
// So the radial axis is one of deviations, linear, with -nominal / magnification at the middle of the picture.
import { clean, round_down, round_up } from "../drawing/niceness";

export interface RadialScale {
  magnification: number;
  middle_um: number; // deviation at the middle of the picture
  outside_um: number; // and at its edge
  rings_um: number[]; // where the scale rings are, from the inside
  ring_step_um: number;
}

export const magnifications = [100, 200, 500, 1000, 2000, 5000, 10000, 20000, 50000] as const;

// Share of the picture's radius that the deviations take, at most, where the magnification is chosen automatically.
const kShare = 0.4;

export const radial_scale = (
  least_um: number,
  largest_um: number,
  nominal_um: number,
  chosen: number | null,
): RadialScale => {
  const least = Math.min(0, least_um);
  const largest = Math.max(0, largest_um);
  const span = Math.max(largest - least, 1e-3);
  const magnification = chosen ?? round_down(nominal_um / (span / kShare - largest), [1, 1.5, 2, 3, 5, 7]);
  const middle_um = -nominal_um / magnification;
  const seen = largest - Math.max(least, middle_um);
  const step = round_up(Math.max(seen, -middle_um * 0.06) / 4);
  const outside_um = clean(Math.max(1, Math.ceil(largest / step)) * step);
  const rings_um: number[] = [];
  for (let k = Math.floor(Math.max(least, middle_um) / step); k * step <= outside_um * (1 + 1e-9); ++k) {
    if (k * step > middle_um + 0.3 * step) rings_um.push(clean(k * step));
  }
  return { magnification, middle_um, outside_um, rings_um, ring_step_um: step };
};

// The angle at which the rings' names hide least of curves that cover `angles_deg` (any turn): about the middle of the
// widest gap, else anywhere, but always between two spokes, which are 30 deg apart.
export const free_angle_deg = (angles_deg: readonly number[]): number => {
  const seen = new Array<boolean>(36).fill(false);
  for (const angle of angles_deg) seen[Math.floor((((angle % 360) + 360) % 360) / 10) % 36] = true;
  let best = { from: 0, length: 0 };
  for (let from = 0; from < 36; ++from) {
    let length = 0;
    while (length < 36 && !seen[(from + length) % 36]) ++length;
    if (length > best.length) best = { from, length };
  }
  const middle = best.length >= 4 ? (best.from + best.length / 2) * 10 : 75;
  return (Math.round((middle - 15) / 30) * 30 + 15) % 360;
};
