// What the program wrote on two machines, held together by tests/cli/same.py, which says what is the same.
import { spawnSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

const comparer = process.env.BALLBAR_SAME;
if (!comparer) throw new Error("expected BALLBAR_SAME in the environment: tests/cli/same.py");

// Lines that say where they differ, "" where they do not. The texts are written to `folder`.
export const differences = (folder, expected, came, tolerance = 1e-9) => {
  if (expected === came) return "";
  const paths = ["expected", "came"].map((name) => join(folder, `same-${name}`));
  [expected, came].forEach((text, k) => writeFileSync(paths[k], text));
  const { status, stdout, stderr } = spawnSync("python3", ["-B", comparer, ...paths, "--tolerance", String(tolerance)], { encoding: "utf8", maxBuffer: 1 << 28, env: { ...process.env, PYTHONUTF8: "1" } });
  if (status !== 0 && status !== 1) throw new Error(`${comparer} failed: ${stderr}`);
  if (status === 1 && stdout === "") throw new Error(`${comparer} failed: ${stderr}`);
  return stdout;
};
