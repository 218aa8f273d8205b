"""Results are the program's JSON to the last bit."""
import json
import os
import pathlib
import subprocess
import tempfile
import unittest

import ballbar as bb

PROGRAM = os.environ["BALLBAR"]
RUNS = "sample-runs"
HE = f"{RUNS}/two-arcs-he2015"
MODEL = f"{HE}/model.toml"
HIDDEN = f"{RUNS}/hidden-effect/01"


def program(*words):
    done = subprocess.run([PROGRAM, *words, "--json"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def numbers(array):
    return [None if one != one else one for one in array.tolist()]


def without_names(keys):
    return {key: value for key, value in keys.items() if key not in ("file", "files", "command", "next_test", "title", "data")}


class Same(unittest.TestCase):
    def same(self, result, *words):
        expected = program(*words)
        found = result.to_dict()
        if isinstance(expected, list):
            expected = {"effects": expected}
        self.assertEqual(json.dumps(found, default=numbers), json.dumps(expected))

    def same_but_for_commands(self, result, *words):
        """A model of Python has no file that a command could name: what to do next is ``model + found.best``."""
        found, expected = result.to_dict(), program(*words)
        self.assertEqual(json.dumps(without_names(found)), json.dumps(without_names(expected)))
        self.assertEqual(found["command"], "")
        if found["next_test"]:
            self.assertEqual(found["next_test"]["text"], expected["next_test"]["text"])

    def test_measure(self):
        b5r = f"{RUNS}/qc20-style-b5r/00.b5r"
        self.same(bb.circles(b5r), "fit", b5r)
        self.same(bb.circles([b5r, f"{RUNS}/qc20-style-b5r/01.b5r"], polar=True), "fit", b5r, f"{RUNS}/qc20-style-b5r/01.b5r", "--polar")
        self.same(bb.machine_errors(b5r), "errors", b5r)
        self.same(bb.history(f"{RUNS}/machine-history", tolerance={"backlash_a_pos": 5}), "history", f"{RUNS}/machine-history", "--tolerance", "backlash_a_pos=5")
        self.same(bb.drift(HE, reference_s=3840.0), "drift", HE, "--reference", "3840")
        self.same(bb.drift(f"{HE}/five-probe.csv", from_plane_1_mm=25.0), "drift", f"{HE}/five-probe.csv", "--from-plane-1", "25")
        self.same(bb.compare(HE), "compare", HE)
        self.same(bb.import_log(f"{RUNS}/foreign-logs/warmup.csv"), "import", f"{RUNS}/foreign-logs/warmup.csv")
        logs = [f"{RUNS}/foreign-logs/probes.csv", f"{RUNS}/foreign-logs/control.csv"]
        self.same(bb.import_log(logs), "import", *logs)

    def test_model(self):
        model = bb.Model.load(MODEL)
        fit = model.fit(HE)
        self.same(fit, "check", HE, "--model", MODEL)
        self.same_but_for_commands(fit.diagnose(), "diagnose", HE, "--model", MODEL)
        self.same(fit.could(), "could", HE, "--model", MODEL)
        tested = fit.test("expansion(T_room_degC)")
        self.same(tested, "add", "expansion(T_room_degC)", HE, "--model", MODEL, "--dry-run")
        self.assertEqual((model + bb.Expansion("T_room_degC")).fit(HE).compare(fit), tested)
        self.same(model.fit(HE, white=True, hold={"constant.constant_um": 1.5}), "check", HE, "--model", MODEL, "--white", "--set", "constant.constant_um=1.5")
        self.same(model.fit(HE, robust=True), "check", HE, "--model", MODEL, "--robust")
        both = model.with_target(["y_um", "z_um"]).fit_all(HE)
        expected = program("check", HE, "--model", MODEL, "--target", "y_um", "--target", "z_um")["targets"]
        self.assertEqual([one.to_dict() for one in both.values()], expected)
        self.same(bb.could(HE, effect="expansion(T_room_degC)", amplitude_um=2.0, model=MODEL), "could", "expansion(T_room_degC)", HE, "--amplitude-um", "2", "--model", MODEL)
        self.same(bb.predict(HE, model=MODEL), "predict", HE, "--model", MODEL)
        self.same(bb.predict(HE, model=model), "predict", HE, "--model", MODEL)
        self.same(bb.effects(), "effects")

    def test_a_table_is_its_file(self):
        table, model = bb.read(f"{HIDDEN}/data.csv"), bb.Model.load(f"{HIDDEN}/model.toml")
        of_file, of_table = model.fit(f"{HIDDEN}/data.csv"), model.fit(table)
        self.assertEqual(of_file.to_dict(), of_table.to_dict())
        a, b = of_file.diagnose(), of_table.diagnose()
        self.assertEqual(without_names(a.to_dict()), without_names(b.to_dict()))
        self.assertEqual(a.best, b.best)
        self.assertEqual(b.command, "")
        self.same_but_for_commands(of_file.diagnose(), "diagnose", f"{HIDDEN}/data.csv", "--model", f"{HIDDEN}/model.toml")
        predicted = of_file.predict()
        expected = program("predict", f"{HIDDEN}/data.csv", "--model", f"{HIDDEN}/model.toml")
        self.assertEqual(predicted["y_um"].tolist(), expected["y_model_um"])
        self.assertEqual(of_file.fitted.tolist(), expected["y_model_um"])
        self.assertEqual(of_file.residuals.tolist(), expected["y_residual_um"])
        self.assertEqual(predicted.iloc[:, 2].tolist(), expected["y_1_lagged_expansion_um"])

    def test_the_rest(self):
        spindle = f"{RUNS}/spindle-rotation-huang2022"
        self.same(bb.compensate(model=f"{spindle}/mean-point.toml", on=spindle, to="z"), "compensate", "--model", f"{spindle}/mean-point.toml", "--to", "z", "--on", spindle)
        self.same(bb.report(f"{RUNS}/qc20-style-b5r/00.b5r"), "report", f"{RUNS}/qc20-style-b5r/00.b5r")
        runs, job = f"{RUNS}/batches-tan2024/runs.csv", f"{RUNS}/batches-tan2024/test1.csv"
        with tempfile.TemporaryDirectory() as folder:
            self.same(bb.train(runs, target="y_um", out=f"{folder}/a.json"), "train", runs, "--target", "y_um", "--out", f"{folder}/b.json")
            self.assertEqual(pathlib.Path(folder, "a.json").read_bytes(), pathlib.Path(folder, "b.json").read_bytes())
            found = bb.simulate(f"{RUNS}/qc20-style-b5r/machine.toml", out=f"{folder}/a", b5r=True)
            self.assertEqual(found.tests, 6)
            self.assertEqual(pathlib.Path(folder, "a", "00.b5r").read_bytes(), pathlib.Path(RUNS, "qc20-style-b5r", "00.b5r").read_bytes())
            hidden = bb.simulate(out=f"{folder}/hidden", hidden=True, n=1)
            self.assertTrue(pathlib.Path(folder, "hidden").is_dir(), hidden)
        self.same(bb.train(runs, for_=job, target="y_um"), "train", runs, "--for", job, "--target", "y_um")
        self.assertEqual(bb.train(runs, for_=bb.read(job), target="y_um").ranked, bb.train(runs, for_=job, target="y_um").ranked)


if __name__ == "__main__":
    unittest.main()
