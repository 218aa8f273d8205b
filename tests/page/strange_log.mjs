// A log with all that a diagnosis sets aside and says first: a column with gaps, a sensor at the end of its range, readings
// far from all others, and jumps of the target. Beside these, the room's temperature drives the target, which also drifts
// slowly without a cause. A row a minute.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { folder, json_of, report } from "./reports.mjs";

const kRows = 700;
const kFar = [120, 431];
const kJumps = [[150, 5], [270, 5], [390, -5], [520, 5]]; // row, um

// The same each time: between -1 and 1, without a pattern that a model has.
const noise = (i) => (Math.sin(i * i) + Math.sin(1.7 * i * i + 1) + Math.sin(2.9 * i * i + 2)) / 3;

const row_of = (i) => {
  const room = 21 + 1.5 * Math.sin(i / 80);
  const wall = Math.min(25.6, 20 + 6 * (1 - Math.exp(-i / 200)) + 0.6 * Math.sin(i / 37));
  const door = i < 6 ? "" : String(Number(Math.floor(i / 90) % 3 === 1));
  const slow = -9 * Math.exp(-i / 180) + 2 * Math.sin(i / 130 + 1);
  const jumps = kJumps.filter(([row]) => i >= row).reduce((sum, [, size]) => sum + size, 0);
  const z = 1.5 * (room - 21) + slow + jumps + 0.3 * noise(i) + (kFar.includes(i) ? 40 : 0);
  return [60 * i, room.toFixed(3), wall.toFixed(2), door, z.toFixed(3)].join(",");
};

const path = join(folder, "strange.csv");
const written = () => {
  writeFileSync(path, `${["time_s,T_room_degC,T_wall_degC,door,z_um", ...Array.from({ length: kRows }, (_, i) => row_of(i))].join("\n")}\n`);
  return path;
};

export const strange_log = () => report("strange", written(), "--diagnose");
export const strange_diagnosis = () => json_of("diagnose", written());
