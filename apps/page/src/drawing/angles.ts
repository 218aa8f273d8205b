// Angles of readings, in degrees.
import { extent } from "./columns";

// In 0 to 360.
export const within_turn = (angle_deg: number): number => ((angle_deg % 360) + 360) % 360;

// As the readings go, without jumps of a turn, so that an arc through 0 deg is drawn in one piece.
const without_jumps = (angle_deg: readonly number[]): number[] => {
  let turns = 0;
  return angle_deg.map((angle, i) => {
    const before = angle_deg[i - 1];
    if (before !== undefined) turns -= Math.round((angle - before) / 360);
    return angle + 360 * turns;
  });
};

// Halfway between the least and the largest.
const middle_of = (angles: readonly number[]): number => {
  const [least, largest] = extent([angles]);
  return least <= largest ? (least + largest) / 2 : 0;
};

const turned = (angles: readonly number[], turns: number): number[] =>
  turns === 0 ? [...angles] : angles.map((angle) => angle + 360 * turns);

// Least middle of an arc as it is drawn. Arcs and turns have theirs at multiples of 15 deg, away from here, so that noise
// does not choose the turn.
const kLeast_middle_deg = -70;

// Recordings that are drawn together, each without jumps, all on one turn: that of the first, the others where they
// overlap it most, whichever way they went.
export const unwrapped_together = (recordings: readonly (readonly number[])[]): number[][] => {
  const angles = recordings.map(without_jumps);
  const first = angles.find((one) => one.length > 0) ?? [];
  const middle = middle_of(first) - 360 * Math.floor((middle_of(first) - kLeast_middle_deg) / 360);
  return angles.map((one) => turned(one, Math.round((middle - middle_of(one)) / 360)));
};

// The reading nearest to an angle, on whatever turn; -1: there is none.
export const nearest_reading = (angle_deg: readonly number[], at_deg: number): number => {
  let nearest = -1;
  let least = Infinity;
  angle_deg.forEach((angle, i) => {
    const distance = Math.abs(within_turn(angle - at_deg + 180) - 180);
    if (distance < least) {
      least = distance;
      nearest = i;
    }
  });
  return nearest;
};

// The names of a plane's axes: of "ZX" they are Z, at 0 deg, and X, at 90 deg.
export const axes_of_plane = (plane: string | undefined): [string, string] => {
  const found = /^([XYZ])([XYZ])$/.exec(plane ?? "");
  return [found?.[1] ?? "A", found?.[2] ?? "B"];
};
