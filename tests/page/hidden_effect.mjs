// The sample run hidden-effect: five inputs and what they move, with a model that lacks an effect.
import { readFileSync } from "node:fs";
import { join } from "node:path";

export const hidden_effect = (sample_runs) => join(sample_runs, "hidden-effect", "01");

// Its first rows, as a file.
export const first_rows = (sample_runs, count) => {
  const lines = readFileSync(join(hidden_effect(sample_runs), "data.csv"), "utf8").split("\n");
  const head = lines.findIndex((line) => line.startsWith("time_s"));
  return lines.slice(0, head + 1 + count).join("\n") + "\n";
};
