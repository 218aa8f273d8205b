// Angles of readings, in degrees.

// In 0 to 360.
export const within_turn = (angle_deg: number): number => ((angle_deg % 360) + 360) % 360;

// As the readings go, without jumps of a turn, so that an arc through 0 deg is drawn in one piece. The turn is the one
// that puts the middle reading nearest to 0 to 360.
export const unwrapped = (angle_deg: readonly number[]): number[] => {
  let turns = 0;
  const angles = angle_deg.map((angle, i) => {
    const before = angle_deg[i - 1];
    if (before !== undefined) turns -= Math.round((angle - before) / 360);
    return angle + 360 * turns;
  });
  const middle = angles[angles.length >> 1] ?? 0;
  const shift = 360 * Math.floor(middle / 360);
  return shift === 0 ? angles : angles.map((angle) => angle - shift);
};

// The reading nearest to an angle, on whatever turn; -1: there is none.
export const nearest_reading = (angle_deg: readonly number[], at_deg: number): number => {
  let nearest = -1;
  let least = Infinity;
  angle_deg.forEach((angle, i) => {
    const apart = Math.abs(within_turn(angle - at_deg + 180) - 180);
    if (apart < least) {
      least = apart;
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
