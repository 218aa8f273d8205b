// Commands that the program and the engine of the page are both given, on the same files under the same names.
// { words, writes, long, external }: `writes` are files that are compared too; a long one runs with BALLBAR_ALL_SAME=1.
import { readdirSync } from "node:fs";
import { join } from "node:path";

const json = (line) => [...line.split(" "), "--json"];
const run = (line, more = {}) => ({ words: json(line), ...more });
const long = (line) => run(line, { long: true });

const kArcs = "sample-runs/two-arcs-he2015";
const kHuang = "sample-runs/spindle-rotation-huang2022";
const kHidden = "sample-runs/hidden-effect/01";
const kRecord = "sample-runs/spindle-46h";
const kTests = "sample-runs/qc20-style-b5r";
const kBatches = "sample-runs/batches-tan2024";
const kRuns = "sample-runs/compensation";
const kLogs = "sample-runs/foreign-logs";

// Files that are made for it, with the sample runs.
export const made_files = {
  "trace.toml": 'format = "ballbar-model 1"\nlevel = "recording"\n\n[[effect]]\nname = "circle"\n',
};

// Of the sample run and its model.
const of_model = (data, model, { quick = false, target = "" } = {}) => {
  const rest = `${data} --model ${model}${target}`;
  const at = quick ? run : long;
  return [run(`check ${rest}`), run(`predict ${rest}`), run(`report ${rest} --no-diagnosis`), at(`${data.endsWith(".b5r") ? "errors" : "diagnose"} ${rest}`), at(`report ${rest}`)];
};

export const of_sample_runs = [
  ...[0, 1, 2, 3, 4, 5].map((k) => run(`fit ${kTests}/0${k}.b5r`)),
  run(`fit --polar ${kTests}/00.b5r`),
  run(`fit ${kTests}/00.b5r --robust`),
  run(`report ${kTests}/00.b5r`),
  run(`report ${kTests}`),
  run(`report ${[0, 1, 2, 3, 4, 5].map((k) => `${kTests}/0${k}.b5r`).join(" ")}`),
  run(`drift ${kTests}`),
  run(`check ${kTests}/00.b5r --model trace.toml --robust`),
  run(`add --dry-run squareness ${kTests}/00.b5r --model trace.toml`),
  ...of_model(`${kTests}/00.b5r`, "trace.toml", { quick: true }),
  run(`could ${kTests}/00.b5r`),

  run(`fit ${kArcs}/00-a.csv ${kArcs}/00-c.csv`),
  run(`drift ${kArcs}/session.toml`),
  run(`drift ${kArcs}/five-probe.csv --from-plane-1 25`),
  run(`compare ${kArcs}/session.toml --from-plane-1 0`),
  run(`compare ${kArcs}/session.toml ${kArcs}/truth/truth.csv`),
  run(`report ${kArcs}/session.toml`),
  run(`report ${kArcs}/five-probe.csv --from-plane-1 25`),
  run(`could ${kArcs} --target y_um`),
  ...of_model(kArcs, `${kArcs}/model.toml`, { quick: true }),
  run(`compensate --model ${kArcs}/model.toml --to y --fit ${kArcs}/session.toml --on ${kArcs}/session.toml`),

  run(`drift ${kHuang}/session.toml`),
  run(`report ${kHuang}/session.toml`),
  run(`could ${kHuang}`),
  run(`predict ${kHuang}/session.toml --model ${kHuang}/mean-point.toml`),
  run(`report ${kHuang}/session.toml --model ${kHuang}/mean-point.toml`),
  run(`compensate --model ${kHuang}/mean-point.toml --to z --on ${kHuang}/session.toml`),

  ...of_model(`${kHidden}/data.csv`, `${kHidden}/model.toml`, { quick: true }),
  run(`report ${kHidden}/data.csv`),
  run(`could ${kHidden}/data.csv --model ${kHidden}/model.toml`),
  run(`report ${kHidden}/data.csv --model ${kHidden}/model.toml --no-diagnosis --set lagged_expansion(T_motor_degC).gain_um_per_K=5`),
  run(`add --dry-run lagged_expansion:temperature=T_room_degC ${kHidden}/data.csv --model ${kHidden}/model.toml`),
  run(`add lagged_expansion:temperature=T_room_degC ${kHidden}/data.csv --model ${kHidden}/model.toml --out added.toml`, { writes: ["added.toml"] }),
  run("ledger --model added.toml"),
  run(`check ${kHidden}/data.csv --model added.toml`),
  run(`report ${kHidden}/data.csv --model added.toml --no-diagnosis`),
  long(`could expansion:temperature=T_room_degC ${kHidden}/data.csv --model ${kHidden}/model.toml --amplitude-um 2`),

  run(`report ${kRecord}/measured.csv`),
  run(`drift ${kRecord}/measured.csv`),
  run(`could ${kRecord}/measured.csv --target ch3_um`),
  ...["ch1-ch2", "ch3-ch4", "ch5", "speed"].flatMap((model) => of_model(`${kRecord}/measured.csv`, `${kRecord}/${model}.toml`)),
  long(`add --dry-run lagged_expansion:temperature=T16_degC ${kRecord}/measured.csv --model ${kRecord}/speed.toml`),

  run(`history sample-runs/machine-history --tolerance backlash_a_pos=5`),

  run(`import ${kLogs}/warmup.csv --out warmup.csv`, { writes: ["warmup.csv"] }),
  run(`import ${kLogs}/control.csv --out control.csv`, { writes: ["control.csv"] }),
  run(`import ${kLogs}/probes.csv --out probes.csv`, { writes: ["probes.csv"] }),
  { words: ["import", `${kLogs}/control.csv`, `${kLogs}/probes.csv`, "--out", "merged.csv"], writes: ["merged.csv"] },
  run(`report ${kLogs}/warmup.csv`),
  long(`report ${kLogs}/warmup.csv --diagnose --target Taster_Y_um`),

  ...["model", "lagged"].flatMap((model) => of_model(`${kRuns}/train.csv`, `${kRuns}/${model}.toml`, { quick: model === "lagged" })),
  run(`report ${kRuns}/unseen.csv`),
  { words: ["compensate", "--model", `${kRuns}/lagged.toml`, "--fit", `${kRuns}/train.csv`, "--on", `${kRuns}/unseen.csv`, "--json"] },

  run(`train ${kBatches}/runs.csv --target y_um --out all.json`, { writes: ["all.json"] }),
  run(`train ${kBatches}/runs.csv --target y_um --for ${kBatches}/test1.csv --out test1.json`, { writes: ["test1.json"] }),
  run(`predict ${kBatches}/b23.csv --model all.json`),
  run(`predict ${kBatches}/test2.csv --model test1.json`),
  run(`report ${kBatches}/test1.csv --model test1.json`),

  run(`compensate --from-picture sample-runs/temperature-images/shaft.csv`),
  run("effects"),
  { words: ["effects", "--terms"] },
];

// Measured data that is not part of the product.
export const of_external = (folder) => {
  const csv_of = (name) => readdirSync(join(folder, name)).filter((file) => /^(?!runs).*\.csv$/.test(file)).map((file) => `external/${name}/${file}`);
  return [
    ...readdirSync(join(folder, "ballbar-b5r")).flatMap((file) => [
      run(`fit external/ballbar-b5r/${file}`),
      run(`report external/ballbar-b5r/${file}`),
      run(`check external/ballbar-b5r/${file} --model trace.toml`),
      long(`errors external/ballbar-b5r/${file} --model trace.toml`),
    ]),
    run("history external/ballbar-b5r"),
    ...csv_of("spindle-24krpm").flatMap((file) => [run(`report ${file}`), run(`could ${file} --target z_um`)]),
    long("report external/spindle-24krpm/set-02.csv --diagnose --target z_um"),
    long("report external/spindle-24krpm/set-04.csv --diagnose --target z_um"),
    ...csv_of("lathe-chamber").flatMap((file, k) => [{ ...run(`report ${file}`), long: k > 1 }, long(`report ${file} --diagnose --target z_um`)]),
    run("report external/spindle-46h/measured.csv"),
    ...["ch1-ch2", "ch3-ch4", "ch5", "speed"].map((model) => long(`check external/spindle-46h/measured.csv --model ${kRecord}/${model}.toml`)),
  ];
};
