"""Results are the program's JSON to the last bit."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import ballbar

PROGRAM = os.environ["BALLBAR"]
RUNS = "sample-runs"
HE = f"{RUNS}/two-arcs-he2015"
MODEL = f"{HE}/model.toml"


def program(*words):
    done = subprocess.run([PROGRAM, *words, "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


class Same(unittest.TestCase):
    def same(self, result, *words):
        expected = program(*words)
        found = result.to_dict()
        if isinstance(expected, list):
            (found,) = found.values()
        self.assertEqual(json.dumps(found), json.dumps(expected))

    def test_measure(self):
        b5r = f"{RUNS}/qc20-style-b5r/00.b5r"
        self.same(ballbar.fit(b5r), "fit", b5r)
        self.same(ballbar.fit([b5r, f"{RUNS}/qc20-style-b5r/01.b5r"], polar=True), "fit", b5r, f"{RUNS}/qc20-style-b5r/01.b5r", "--polar")
        self.same(ballbar.errors(f"{RUNS}/machine-history"), "errors", f"{RUNS}/machine-history")
        self.same(ballbar.history(f"{RUNS}/machine-history", tolerance={"backlash_a_pos": 5}), "history", f"{RUNS}/machine-history", "--tolerance", "backlash_a_pos=5")
        self.same(ballbar.drift(HE, reference_s=3840.0), "drift", HE, "--reference", "3840")
        self.same(ballbar.drift(f"{HE}/five-probe.csv", from_plane_1_mm=25.0), "drift", f"{HE}/five-probe.csv", "--from-plane-1", "25")
        self.same(ballbar.compare(HE), "compare", HE)
        self.same(ballbar.import_log(f"{RUNS}/foreign-logs/warmup.csv"), "import", f"{RUNS}/foreign-logs/warmup.csv")
        logs = [f"{RUNS}/foreign-logs/probes.csv", f"{RUNS}/foreign-logs/control.csv"]
        self.same(ballbar.merge(logs), "import", *logs)

    def test_model(self):
        self.same(ballbar.effects(), "effects")
        self.same(ballbar.preflight(HE, target="y_um"), "could", HE, "--target", "y_um")
        self.same(ballbar.check(HE, MODEL), "check", HE, "--model", MODEL)
        self.same(ballbar.check(HE, ballbar.Model(MODEL), target=["y_um", "z_um"], white=True), "check", HE, "--model", MODEL, "--target", "y_um", "--target", "z_um", "--white")
        self.same(ballbar.diagnose(HE, MODEL), "diagnose", HE, "--model", MODEL)
        self.same(ballbar.errors(f"{RUNS}/qc20-style-b5r/00.b5r", ranked=True), "errors", f"{RUNS}/qc20-style-b5r/00.b5r")
        self.same(ballbar.try_effect("expansion(T_room_degC)", HE, MODEL), "add", "expansion(T_room_degC)", HE, "--model", MODEL, "--dry-run")
        self.same(ballbar.predict(HE, MODEL), "predict", HE, "--model", MODEL)
        self.same(ballbar.inject("expansion(T_room_degC)", HE, 2.0, model=MODEL), "could", "expansion(T_room_degC)", HE, "--amplitude-um", "2", "--model", MODEL)
        spindle = f"{RUNS}/spindle-rotation-huang2022"
        self.same(ballbar.compensate(f"{spindle}/mean-point.toml", spindle, to="z"), "compensate", "--model", f"{spindle}/mean-point.toml", "--to", "z", "--on", spindle)
        self.same(ballbar.report(f"{RUNS}/qc20-style-b5r/00.b5r"), "report", f"{RUNS}/qc20-style-b5r/00.b5r")

    def test_revisions(self):
        with tempfile.TemporaryDirectory() as folder:
            a, b = (pathlib.Path(folder) / name / "model.toml" for name in "ab")
            for path in (a, b):
                path.parent.mkdir()
                path.write_text(pathlib.Path(MODEL).read_text())
            added = ballbar.add("thermostat_cycle", HE, a).to_dict()
            expected = program("add", "thermostat_cycle", HE, "--model", str(b))
            self.assertEqual({**added, "written": ""}, {**expected, "written": ""})
            self.assertEqual(a.read_bytes(), b.read_bytes())
            self.same(ballbar.ledger(a), "ledger", "--model", str(b))
            ballbar.undo(a)
            program("undo", "--model", str(b))
            self.assertEqual(a.read_bytes(), b.read_bytes())

    def test_batches(self):
        runs, job = f"{RUNS}/batches-tan2024/runs.csv", f"{RUNS}/batches-tan2024/test1.csv"
        with tempfile.TemporaryDirectory() as folder:
            self.same(ballbar.train(runs, "y_um", f"{folder}/a.json"), "train", runs, "--target", "y_um", "--out", f"{folder}/b.json")
            self.assertEqual(pathlib.Path(folder, "a.json").read_bytes(), pathlib.Path(folder, "b.json").read_bytes())
        self.same(ballbar.select(runs, job, "y_um"), "train", runs, "--for", job, "--target", "y_um")

    def test_simulated(self):
        with tempfile.TemporaryDirectory() as folder:
            found = ballbar.simulate(f"{RUNS}/qc20-style-b5r/machine.toml", f"{folder}/a", b5r=True)
            self.assertEqual(found.tests, 6)
            self.assertEqual(pathlib.Path(folder, "a", "00.b5r").read_bytes(), pathlib.Path(RUNS, "qc20-style-b5r", "00.b5r").read_bytes())


if __name__ == "__main__":
    unittest.main()
