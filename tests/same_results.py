"""Holds the results of one program against those of another: every JSON of the sample runs, number by number.

    python3 same_results.py OLD_PROGRAM NEW_PROGRAM SOURCE_FOLDER [WORDS]

Keys may have been renamed by the table below, and words of sentences with them; numbers must be the same to 1e-9 of
their size. WORDS chooses the commands that contain it. Exit status 1 where anything differs.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

old, new, source = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
chosen = sys.argv[4] if len(sys.argv) > 4 else ""
kTolerance = 1e-9

kRenamed = {  # old key: new key
    "evidence": "likelihood_ratio",
    "evidence_needed": "likelihood_ratio_needed",
    "smooth_evidence": "smooth_likelihood_ratio",
    "goes_with": "associations",
    "beats_fakes": "beats_surrogates",
    "best_fake_fall": "best_surrogate_fall",
    "best_fake_um": "best_surrogate_um",
    "fakes": "surrogates",
    "p_stay": "p_drop",
}
kGone = {"huang2022_table_3"}  # old keys that are no more

arcs, huang = "sample-runs/two-arcs-he2015", "sample-runs/spindle-rotation-huang2022"
hidden, record = "sample-runs/hidden-effect", "sample-runs/spindle-46h"
files = "sample-runs/qc20-style-b5r"
kTrace = 'format = "ballbar-model 1"\nlevel = "recording"\n\n[[effect]]\nname = "circle"\n'
kRoom = 'format = "ballbar-model 1"\ntarget = "%s"\n'
commands = [
    *(f"fit {files}/0{i}.b5r --json" for i in range(6)), f"fit --polar {files}/00.b5r --json",
    f"fit {files}/00.b5r --robust --json", f"fit {arcs}/00-a.csv {arcs}/00-c.csv --json",
    f"drift {arcs}/session.toml --json", f"drift {huang}/session.toml --json", f"drift {files} --json",
    f"drift {arcs}/five-probe.csv --from-plane-1 25 --json", f"drift {record}/measured.csv --json",
    f"compare {arcs}/session.toml --from-plane-1 0 --json", f"compare {arcs}/session.toml {arcs}/truth/truth.csv --json",
    f"preflight {arcs} --target y_um --json", f"preflight {huang} --json",
    f"preflight {record}/measured.csv --target ch3_um --json", f"preflight {files}/00.b5r --json",
    f"check {arcs} --model {arcs}/model.toml --json",
    f"check {record}/measured.csv --model {record}/ch3-ch4.toml --json",
    f"check {record}/measured.csv --model {record}/ch5.toml --json",
    f"check {record}/measured.csv --model {record}/ch1-ch2.toml --json",
    f"check {record}/measured.csv --model {record}/speed.toml --json",
    "check sample-runs/compensation/train.csv --model sample-runs/compensation/lagged.toml --json",
    f"check {hidden}/01/data.csv --model {hidden}/01/model.toml --json",
    f"check {files}/00.b5r --model trace.toml --json", f"check {files}/00.b5r --model trace.toml --robust --json",
    f"predict {arcs} --model {arcs}/model.toml --json",
    f"diagnose {arcs} --model {arcs}/model.toml --json",
    f"diagnose {hidden}/01/data.csv --model {hidden}/01/model.toml --json",
    f"diagnose {record}/measured.csv --model {record}/ch5.toml --json",
    f"diagnose {record}/measured.csv --model {record}/speed.toml --json",
    f"diagnose {files}/00.b5r --model trace.toml --json",
    f"try lagged_expansion:temperature=T16_degC {record}/measured.csv --model {record}/speed.toml --json",
    f"try lagged_expansion:temperature=T_room_degC {hidden}/01/data.csv --model {hidden}/01/model.toml --json",
    f"try squareness {files}/00.b5r --model trace.toml --json", f"try backlash {files}/00.b5r --model trace.toml --json",
    f"add lagged_expansion:temperature=T_room_degC {hidden}/01/data.csv --model kept.toml --out added.toml --json",
    "ledger --model added.toml --json",
    f"inject expansion:temperature=T_room_degC {hidden}/01/data.csv --model {hidden}/01/model.toml --json",
    "effects --json",
    "train sample-runs/batches-tan2024/runs.csv --target y_um --out all.json --json",
    "select sample-runs/batches-tan2024/runs.csv --target y_um --on sample-runs/batches-tan2024/test1.csv --json",
    "predict sample-runs/batches-tan2024/b23.csv --model all.json --json",
    "meanpoint sample-runs/temperature-images/jet.jpg --from-mm 190 --to-mm 520 --min-degC 28 --max-degC 44 --json",
    f"compensate --model {huang}/mean-point.toml --to z --on {huang}/session.toml --json",
    f"compensate --model {arcs}/model.toml --to y --on {arcs}/session.toml --json",
    f"simulate {arcs}/machine.toml --seed 7 --out made --json", "fit made/00-c.csv --json",
    f"blind score {hidden} --json",
    f"report {arcs} --model {arcs}/model.toml --format json --out -", f"report {files}/00.b5r --format json --out -",
    f"report {record}/measured.csv --model {record}/ch5.toml --format json --out -",
]


def results_of(program):
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "sample-runs").symlink_to(source / "sample-runs")
        (folder / "trace.toml").write_text(kTrace)
        (folder / "kept.toml").write_text((source / hidden / "01/model.toml").read_text())
        for command in commands:
            if chosen not in command:
                continue
            done = subprocess.run([program, *command.split()], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                                  text=True)
            try:
                yield command, json.loads(done.stdout)
            except ValueError:
                yield command, {"status": done.returncode, "said": done.stdout + done.stderr}


def words(text):
    """A sentence without what renaming touches: its numbers."""
    return re.findall(r"-?\d+(?:\.\d+)?", text)


def differences(a, b, place):
    if isinstance(a, dict) and isinstance(b, dict):
        a = {kRenamed.get(key, key): value for key, value in a.items() if key not in kGone}
        b = {kRenamed.get(key, key): value for key, value in b.items()}
        for key in a.keys() | b.keys():
            if key not in a or key not in b:
                yield f"{place}.{key}: only in the {'new' if key in b else 'old'} one"
            else:
                yield from differences(a[key], b[key], f"{place}.{key}")
    elif isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            yield f"{place}: {len(a)} and {len(b)} entries"
        for i, (one, other) in enumerate(zip(a, b)):
            yield from differences(one, other, f"{place}[{i}]")
    elif isinstance(a, str) and isinstance(b, str):
        if a != b and (" " not in a or words(a) != words(b)) and kRenamed.get(a, a) != b:
            yield f"{place}: {a!r} and {b!r}"
    elif isinstance(a, (int, float)) and isinstance(b, (int, float)) and not isinstance(a, bool):
        if not math.isclose(a, b, rel_tol=kTolerance, abs_tol=1e-12):
            yield f"{place}: {a!r} and {b!r}"
    elif a != b:
        yield f"{place}: {a!r} and {b!r}"


wrong = count = 0
for (command, before), (_, after) in zip(results_of(old), results_of(new)):
    found = sorted(differences(before, after, ""))
    count += 1
    wrong += bool(found)
    print("differs" if found else "same   ", command, flush=True)
    for line in found[:10]:
        print("   ", line)
print(f"{count} results, {wrong} differ")
sys.exit(1 if wrong or not count else 0)
