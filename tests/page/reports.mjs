// Reports of sample runs, made by the program in a temporary folder that is removed at the end.
import { execFile, execFileSync } from "node:child_process";
import { cpSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { promisify } from "node:util";

export const program = process.env.BALLBAR_PROGRAM;
const runs = process.env.BALLBAR_SAMPLE_RUNS;
if (!program || !runs) throw new Error("expected BALLBAR_PROGRAM and BALLBAR_SAMPLE_RUNS in the environment, as ctest sets them");

export const folder = mkdtempSync(join(tmpdir(), "ballbar-page-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

export const of_run = (...path) => join(runs, ...path);

const execute = promisify(execFile);

// The page of `ballbar report ARGUMENTS`.
export const report = async (name, ...options) => {
  const out = join(folder, `${name}.html`);
  await execute(program, ["report", ...options, "--out", out], { maxBuffer: 1 << 28 });
  return out;
};

export const json_of = (...options) =>
  JSON.parse(execFileSync(program, [...options, "--json"], { maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] }));

export const run = (...options) => execFileSync(program, options, { stdio: ["ignore", "pipe", "pipe"], maxBuffer: 1 << 28 });

export const two_arcs = () => report("two-arcs", of_run("two-arcs-he2015"), "--model", of_run("two-arcs-he2015", "model.toml"));

// With a ledger of two rows.
export const hidden_effect = async () => {
  const copy = join(folder, "hidden-effect");
  cpSync(of_run("hidden-effect", "01"), copy, { recursive: true });
  const [data, model] = [join(copy, "data.csv"), join(copy, "model.toml")];
  run("add", "lagged_expansion:temperature=T_room_degC", data, "--model", model);
  return report("hidden-effect", data, "--model", model);
};

// A ledger that `add --auto` grew; its model is in `grown_model`.
export const grown_model = join(folder, "grown.toml");
export const grown = async () => {
  const data = of_run("spindle-46h", "measured.csv");
  const target = ["--target", "ch1_um"];
  await execute(program, ["add", "--auto", data, "--model", of_run("spindle-46h", "speed.toml"), ...target, "--out", grown_model]);
  return report("grown", data, "--model", grown_model, ...target, "--no-diagnosis");
};

export const history = async () => {
  const out = join(folder, "history.html");
  await execute(program, ["history", of_run("machine-history"), "--tolerance", "backlash_a_pos=5", "--out", out]);
  return out;
};

export const batch = () => {
  const model = join(folder, "batch.json");
  run("train", of_run("batches-tan2024", "runs.csv"), "--target", "y_um", "--for", of_run("batches-tan2024", "test1.csv"), "--out", model);
  return report("batch", of_run("batches-tan2024", "test1.csv"), "--model", model);
};
