// A series of many rows: a temperature and a displacement, a reading a second.
import { closeSync, openSync, writeSync } from "node:fs";

export const long_series = (path, rows) => {
  const file = openSync(path, "w");
  writeSync(file, "time_s,T_a_degC,y_um\n");
  for (let begin = 0; begin < rows; begin += 10_000) {
    const lines = Array.from({ length: Math.min(10_000, rows - begin) }, (_, k) => {
      const i = begin + k;
      const [warm, moved] = [20 + 5 * Math.sin(i / 9e4) + 0.1 * Math.sin(i * 1.7), 30 * Math.cos(i / 7e4) + Math.sin(i * 2.3)];
      return `${i},${warm.toFixed(3)},${moved.toFixed(3)}`;
    });
    writeSync(file, `${lines.join("\n")}\n`);
  }
  closeSync(file);
  return path;
};
