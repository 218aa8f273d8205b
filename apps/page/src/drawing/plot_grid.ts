// Where the plot is in its picture: the same left and right edge in all pictures over time, and above it as much room
// as the legend of a still picture needs.
import type { Look } from "../picture";

export const kLeft_px = 64;
export const kRight_px = 20;
export const kBottom_px = 46;

const kLetter_px = 7; // about, of the legend's font
const kMark_px = 46;

export const top_px = (look: Look, labels: readonly string[]): number => {
  if (!look.still) return 12;
  const room_px = Math.max(100, look.width_px - 40);
  let rows = 1;
  let used_px = 0;
  for (const label of labels) {
    const wide_px = kMark_px + kLetter_px * label.length;
    if (used_px > 0 && used_px + wide_px > room_px) {
      rows += 1;
      used_px = 0;
    }
    used_px += wide_px;
  }
  return 14 + 24 * rows;
};
