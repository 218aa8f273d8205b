"""Tables of many tests: lazy, incremental, whole whatever befalls."""
import importlib.util
import json
import os
import pickle
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import ballbar

if importlib.util.find_spec("dask") is None:
    print("Passed over: Dask is not installed.")
    sys.exit(0)

import pandas  # noqa: E402
from ballbar import _fleet_rows, fleet  # noqa: E402
from ballbar._fleet_rows import errors_table  # noqa: E402

SAMPLE = "sample-runs/machine-history"


def plant(folder, machines=3, tests=4):
    """Tests of other days: what has the same numbers of the same moment is a copy."""
    sources = [pathlib.Path(path).read_text(encoding="utf-8-sig") for path in fleet.files_of(SAMPLE)]
    for machine in range(machines):
        os.makedirs(f"{folder}/m{machine}")
        for k in range(tests):
            text = re.sub("(?<=<DATE_STARTED>)\\d{4}", f"{2000 + machine}", sources[k % len(sources)])
            text = re.sub("(?<=<DATE_STARTED>\\d{4})\\d{4}", f"{k // 28 % 12 + 1:02}{k % 28 + 1:02}", text)
            with open(f"{folder}/m{machine}/{k:03}.b5r", "w", encoding="utf-8-sig") as file:
                file.write(text)


def simulated(folder):
    subprocess.run([os.environ["BALLBAR"], "simulate", "sample-runs/fleet/fleet.toml", "--out", folder], stdout=subprocess.DEVNULL, check=True)


def said_by_the_program(*files):
    """The tests of `ballbar errors --json`, by file."""
    done = subprocess.run([os.environ["BALLBAR"], "errors", "--show", "table", "--json", *files], stdout=subprocess.PIPE, check=True)
    return {test["file"]: test for test in json.loads(done.stdout)["tests"]}


class Lazy(unittest.TestCase):
    def test_rows_are_the_tests(self):
        table = fleet.errors(f"{SAMPLE}/**/*.b5r", files_of_a_partition=3)
        self.assertEqual(table.npartitions, 4)
        rows = table.compute()
        self.expect_the_numbers_of_the_program(rows, SAMPLE)
        self.assertTrue((rows["sha256"].str.len() == 64).all())

    def expect_the_numbers_of_the_program(self, rows, *files):
        expected = said_by_the_program(*files)
        self.assertEqual(sorted(rows["file"]), sorted(expected))
        for _, row in rows.iterrows():
            of_file = expected[row["file"]]
            for one in of_file["errors"]:
                unit = one["unit"].replace("/", "_per_")
                for key, column in (("value", f"{one['name']}_{unit}"), ("sigma", f"{one['name']}_{unit}_sigma")):
                    self.assertEqual(row[column], one[key], column) if one[key] is not None else self.assertTrue(pandas.isna(row[column]))
            for key, column in (("date", "date"), ("plane", "plane"), ("nominal_length_mm", "length_mm"), ("start_deg", "start_deg"), ("stored", "stored")):
                self.assertEqual(row[column], of_file[key], column)

    def test_every_error_has_a_column(self):
        for files in (SAMPLE, "sample-runs/qc20-style-b5r"):
            for test in said_by_the_program(files).values():
                for one in test["errors"]:
                    self.assertIn((one["name"], one["unit"].replace("/", "_per_")), fleet.ERRORS)

    def test_at_once(self):
        told = []
        for paths in (SAMPLE, f"{SAMPLE}/**/*.b5r", pathlib.Path(SAMPLE), fleet.files_of(SAMPLE)):
            rows = errors_table(paths, progress=lambda *said: told.append(said))
            self.expect_the_numbers_of_the_program(rows, SAMPLE)
        self.assertEqual(told[-1], (10, 10, "reading tests"))
        pandas.testing.assert_frame_equal(rows, fleet.errors(SAMPLE).compute(scheduler="synchronous").sort_values("file", ignore_index=True))
        with self.assertRaisesRegex(ballbar.BallbarError, "expected .b5r files below this folder, found none"):
            errors_table("sample-runs/hidden-effect/01")

    def test_faults_at_once(self):
        with tempfile.TemporaryDirectory() as folder:
            plant(folder, 1, 2)
            shutil.copy(f"{folder}/m0/000.b5r", f"{folder}/m0/copy.b5r")
            with open(f"{folder}/m0/zz.b5r", "w", encoding="utf-8") as file:
                file.write("<?xml version='1.0'?><nothing/>")
            rows = errors_table([folder, f"{folder}/none.b5r"]).set_index("file")
            self.assertEqual(int(rows["fault"].isna().sum()), 2)
            self.assertEqual(rows["fault"][f"{folder}/none.b5r"], f"{folder}/none.b5r: No such file or directory.")
            self.assertIn(f"found a copy of {folder}/m0/000.b5r", rows["fault"][f"{folder}/m0/copy.b5r"])
            for file in ("copy", "zz"):
                with self.assertRaisesRegex(ballbar.BallbarError, f"{file}.b5r:.* expected"):
                    errors_table(folder, strict=True)
                os.remove(f"{folder}/m0/{file}.b5r")
            self.assertEqual(len(errors_table(folder, strict=True)), 2)

    def test_at_once_without_dask(self):
        work = "import sys; from ballbar._fleet_rows import errors_table; errors_table(sys.argv[1]); print([name for name in sys.modules if 'dask' in name or 'distributed' in name])"
        done = subprocess.run([sys.executable, "-c", work, SAMPLE], stdout=subprocess.PIPE, text=True, check=True)
        self.assertEqual(done.stdout, "[]\n")

    def test_a_file_that_fails_is_a_row(self):
        with tempfile.TemporaryDirectory() as folder:
            plant(folder, 1, 2)
            with open(f"{folder}/m0/broken.b5r", "w", encoding="utf-8") as file:
                file.write("<?xml version='1.0'?><nothing/>")
            rows = fleet.errors([folder, f"{folder}/missing.b5r"]).compute().set_index("file")
            self.assertEqual(len(rows), 4)
            self.assertIn("expected", rows.loc[f"{folder}/m0/broken.b5r", "fault"])
            self.assertIn("No such file", rows.loc[f"{folder}/missing.b5r", "fault"])
            self.assertTrue(pandas.isna(rows.loc[f"{folder}/m0/000.b5r", "fault"]))

    def test_other_file_systems(self):
        import fsspec

        memory = fsspec.filesystem("memory")
        with open(fleet.files_of(SAMPLE)[0], "rb") as file:
            memory.pipe("/plant/a.b5r", file.read())
        rows = fleet.errors("memory://plant/*.b5r").compute(scheduler="synchronous")
        self.assertEqual(list(rows["file"]), ["memory:///plant/a.b5r"])
        self.assertGreater(rows["circularity_um"].iloc[0], 0.0)

    def test_diagnosed(self):
        data, path = "sample-runs/hidden-effect/01/data.csv", "sample-runs/hidden-effect/01/model.toml"
        model = ballbar.Model.load(path)
        expected = model.fit(data).diagnose()
        for asked in (path, model):
            rows = fleet.diagnose([data, "missing.csv"], asked).compute(scheduler="synchronous").set_index("file")
            self.assertEqual((rows["verdict"][data], rows["named"][data]), (expected.verdict, ", ".join(one.effect for one in expected.named)))
            self.assertEqual((rows["rmse_um"][data], rows["p_nothing"][data]), (expected.fit.rmse_um, expected.p_nothing))
            self.assertEqual(rows["fault"]["missing.csv"], "missing.csv: No such file or directory.")
        with self.assertRaisesRegex(ballbar.BallbarError, "target: expected the name of one column"):
            fleet.diagnose(data, model, target=["x_um", "y_um"])
        test = fleet.files_of(SAMPLE)[0]
        row = fleet.diagnose(test).compute(scheduler="synchronous").iloc[0]
        self.assertEqual(row["sentence"], ballbar.machine_errors(test).conclusion)
        row = fleet.diagnose(data).compute(scheduler="synchronous").iloc[0]
        self.assertEqual(row["fault"], f"{data}: expected a model or a target for a series, found neither; pass target=.")

    def test_trained(self):
        data = "sample-runs/hidden-effect/01/data.csv"
        with tempfile.TemporaryDirectory() as folder:
            (_, row), = fleet.train(data, "y_um", f"{folder}/models", few=True).compute(scheduler="synchronous").iterrows()
            again = ballbar.train(data, target="y_um", out=f"{folder}/again.json", effects=True, few=True)
            self.assertEqual(row["held_out_um"], again.forecasts.rmse_um)
            with open(row["model"], encoding="utf-8") as one, open(f"{folder}/again.json", encoding="utf-8") as other:
                self.assertEqual(one.read(), other.read())

    def test_names_that_are_patterns(self):
        with tempfile.TemporaryDirectory() as folder:
            plant(folder, 2, 2)
            os.rename(f"{folder}/m1/001.b5r", f"{folder}/m1/q[1].b5r")
            self.assertEqual(fleet.files_of(f"{folder}/m?/00[01].b5r"), [f"{folder}/m{name}.b5r" for name in ("0/000", "0/001", "1/000")])
            self.assertEqual(len(fleet.files_of(f"{folder}/m*")), 4)
            self.assertEqual(fleet.files_of(f"{folder}/m1/q[1].b5r"), [f"{folder}/m1/q[1].b5r"])
            self.assertEqual(len(fleet.files_of([folder, f"{folder}/../{os.path.basename(folder)}"])), 4)
            for name in ("q?", "foo://q/*"):
                with self.assertRaisesRegex(ballbar.BallbarError, "expected files, found"):
                    fleet.files_of(f"{folder}/{name}" if name == "q?" else name)
            os.rename(f"{folder}/m1/q[1].b5r", f"{folder}/-dash.b5r")
            before = os.getcwd()
            os.chdir(folder)
            try:
                rows = fleet.errors(["-dash.b5r"]).compute(scheduler="synchronous")
            finally:
                os.chdir(before)
            self.assertTrue(rows["fault"].isna().all())
            self.assertEqual(rows["file"].tolist(), ["-dash.b5r"])

    def test_faults_do_not_depend_on_partitions(self):
        with tempfile.TemporaryDirectory() as folder:
            plant(folder, 1, 2)
            for name in ("bad", "worse"):
                with open(f"{folder}/m0/{name}.b5r", "w", encoding="utf-8") as file:
                    file.write("<?xml version='1.0'?><nothing/>")
            with open(f"{folder}/m0/none.txt", "w", encoding="utf-8") as file:
                file.write("a letter")
            shutil.copy(f"{folder}/m0/000.b5r", f"{folder}/m0/copy.b5r")
            expected = fleet.errors(f"{folder}/m0/*", files_of_a_partition=100).compute(scheduler="synchronous")
            self.assertEqual(int(expected["fault"].notna().sum()), 3)
            self.assertNotIn("can be used", "".join(expected["fault"].dropna()))
            for size in (1, 2, 4):
                rows = fleet.errors(f"{folder}/m0/*", files_of_a_partition=size).compute(scheduler="synchronous")
                pandas.testing.assert_frame_equal(rows.sort_values("file", ignore_index=True), expected.sort_values("file", ignore_index=True))
            self.assertEqual(fleet.rank(expected).machines["tests"][0], 2)


class Ranked(unittest.TestCase):
    def test_the_sample_plant(self):
        with tempfile.TemporaryDirectory() as scratch:
            simulated(f"{scratch}/plant")
            done = fleet.update(f"{scratch}/plant", f"{scratch}/table")
            found = fleet.rank(done.table, page=f"{scratch}/plant.html", title="plant")
            with open(f"{scratch}/plant.html", encoding="utf-8") as file:
                self.assertIn("mill-26", file.read())
            said = subprocess.run([os.environ["BALLBAR"], "history", "--json", f"{scratch}/plant"], stdout=subprocess.PIPE, check=True)
        kinds = {machine: set(of_machine) for machine, of_machine in found.findings.groupby("machine")["kind"]}
        for machine, kind in {"mill-04": "trend", "mill-11": "step", "mill-19": "season", "mill-26": "replaced_part", "mill-33": "instrument"}.items():
            self.assertIn(kind, kinds.get(machine, set()), machine)
        self.assertLessEqual(len(kinds), 7)
        self.assertIn("mill-26", repr(found))
        program = json.loads(said.stdout)["machines"]
        for key in ("machine", "need", "reason", "findings", "tolerances"):
            self.assertEqual([one[key] for one in found.to_dict()["machines"]], [one[key] for one in program])
        self.assertEqual(list(found.machines["machine"]), [one["machine"] for one in program])
        of_program = [(one["machine"], finding) for one in program for finding in one["findings"]]
        self.assertEqual(len(found.findings), len(of_program))
        for (_, row), (machine, finding) in zip(found.findings.iterrows(), of_program):
            self.assertEqual((row["machine"], row["quantities"]), (machine, len(finding["quantities"])))
            self.assertEqual((str(row["from"].date()), str(row["to"].date())), (finding["from"], finding["to"]))
            for key in ("kind", "p_value", "q_value", "sentence", "remedy"):
                self.assertEqual(row[key], finding[key])
            for key in ("quantity", "plane", "size", "sigma", "unit"):
                self.assertEqual(row[key], finding["quantities"][0][key])
        again = pickle.loads(pickle.dumps(found))
        pandas.testing.assert_frame_equal(again.findings, found.findings)
        self.assertEqual((again.text, again.to_dict()), (found.text, found.to_dict()))
        self.assertEqual(found._repr_html_().count("mill-26"), found.text.count("mill-26"))
        with self.assertRaises(AttributeError):
            found.finding
        with self.assertRaises(AttributeError):
            found.findings = None

    def test_two_plants(self):
        table = self.table_of("plantA/mill-01", "plantB/mill-01", machine="mill-01")
        with self.assertWarnsRegex(ballbar.BallbarWarning, "mill-01: .* below plantA/mill-01 and below plantB/mill-01.*machine=lambda"):
            self.assertEqual(fleet.rank(table).machines["machine"].tolist(), ["mill-01"])
        self.expect_machines(table, ["plantA/mill-01", "plantB/mill-01"], lambda path: path.parts[-3:-1])
        self.expect_machines(table, ["mill-01"], lambda path: path.parts[-2])
        stated = self.table_of("plantA/mill-01/2025", "plantB/mill-01/2026", "plantA/mill-02", "plantB/mill-02", machine=None)
        stated["machine"] = [path.split("/")[1] for path in stated["file"]]
        with self.assertWarnsRegex(ballbar.BallbarWarning, "so it is with 1 names more"):
            fleet.rank(stated)

    def test_nothing_to_rank(self):
        table = self.table_of("plantA/mill-01", machine="mill-01")
        table["fault"] = "of all"
        found = fleet.rank(table)
        self.assertEqual((len(found.machines), len(found.findings), found.faults), (0, 0, 8))
        self.assertEqual([str(found.findings[name].dtype) for name in ("from", "size", "q_value")], ["datetime64[ns]", "float64", "float64"])

    def test_one_plant(self):
        for folders, machine in ((["plant/2024", "plant/2025"], "mill-01"), (["plant/mill-01/2024", "plant/mill-01/2025/XY"], "mill-01"), (["mill-01"], "mill-01")):
            self.expect_machines(self.table_of(*folders, machine=machine), ["mill-01"], None)
        self.expect_machines(self.table_of("s3://plantA/mill-01", "s3://plantB/mill-01", machine="mill-01"), ["plantA/mill-01", "plantB/mill-01"], lambda path: path.parts[-3:-1])

    def test_names_that_are_none(self):
        table = self.table_of("plantA/mill-01", machine="mill-01")
        for named in (3, (), "", ("a", ""), ["a"]):
            with self.assertRaisesRegex(ballbar.BallbarError, "machine: expected a text or a tuple of texts for plantA/mill-01/0.b5r, found"):
                fleet.rank(table, machine=lambda path, named=named: named)

    def table_of(self, *folders, machine):
        """Eight tests a folder, of other days."""
        one = errors_table(fleet.files_of(SAMPLE)[0])
        rows = pandas.concat([one.assign(file=f"{folder}/{k}.b5r", machine=machine, date=f"20{10 + place}-0{1 + k}-01T00:00:00", circularity_um=k)
                              for place, folder in enumerate(folders) for k in range(8)], ignore_index=True)
        return rows

    def expect_machines(self, table, names, machine):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertEqual(sorted(fleet.rank(table, machine=machine).machines["machine"]), names)


@unittest.skipUnless(importlib.util.find_spec("distributed"), "Dask's distributed is not installed")
class Cluster(unittest.TestCase):
    def test_diagnosed_with_an_effect_of_python(self):
        from dask.distributed import Client

        @ballbar.effect("square_of_a_rise", inputs={"temperature": "degC"}, gain="gain_um_per_K2")
        def square(time_s, temperature):
            return (temperature - temperature[0]) ** 2

        data = "sample-runs/hidden-effect/01/data.csv"
        model = ballbar.Model.load("sample-runs/hidden-effect/01/model.toml")
        expected = model.fit(data).diagnose(extra=[square])
        with Client(n_workers=1, threads_per_worker=1, dashboard_address=None) as client:
            row = fleet.diagnose(data, model, extra=[square]).compute(scheduler=client).iloc[0]
        self.assertEqual((row["verdict"], row["p_nothing"]), (expected.verdict, expected.p_nothing))
        self.assertTrue(pandas.isna(row["fault"]))

    def test_a_worker_is_killed(self):
        from dask.distributed import Client, LocalCluster

        with tempfile.TemporaryDirectory() as scratch:
            folder = f"{scratch}/plant"
            os.makedirs(folder)
            plant(folder, 6, 60)
            with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
                killed = []

                def kill(done, of, text):
                    if not killed:
                        killed.append(next(iter(client.run(os.getpid).values())))
                        os.kill(killed[0], signal.SIGKILL)

                found = fleet.update(folder, f"{scratch}/table", client=client, progress=kill)
            self.assertTrue(killed)
            self.assertTrue(found.complete, found.lacking)
            self.assertEqual(len(found.table), 360)
            self.assertEqual(found.faults, 0)

    def test_workers_in_another_folder_and_then_none(self):
        from dask.distributed import Client, LocalCluster

        before = os.getcwd()
        with tempfile.TemporaryDirectory() as scratch:
            os.makedirs(f"{scratch}/plant")
            plant(f"{scratch}/plant", 2, 3)
            with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
                client.run(os.chdir, "/")
                os.chdir(scratch)
                try:
                    found = fleet.update("plant", "table", client=client)
                    rows = fleet.errors("plant").compute(scheduler=client)
                finally:
                    os.chdir(before)
                self.assertEqual((found.complete, found.faults, len(found.table)), (True, 0, 6))
                self.assertTrue(rows["fault"].isna().all())
                cluster.scale(0)
                client.sync(cluster._correct_state)
                with mock.patch.object(_fleet_rows, "_PATIENCE_S", 1):
                    found = fleet.update(f"{scratch}/plant", f"{scratch}/other", client=client)
                self.assertEqual((found.read, set(found.lacking.values())), (0, {"the cluster has no worker"}))

    def test_the_scheduler_is_gone(self):
        from dask.distributed import Client, LocalCluster

        with tempfile.TemporaryDirectory() as scratch:
            folder = f"{scratch}/plant"
            os.makedirs(folder)
            plant(folder, 2, 60)
            with LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
                client = Client(cluster, timeout=5)
                found = None

                def gone(done, of, text):
                    cluster.scale(0)
                    cluster.close()

                with mock.patch.object(_fleet_rows, "_PATIENCE_S", 2):
                    found = fleet.update(folder, f"{scratch}/table", client=client, progress=gone)
                self.assertEqual(len(found.lacking) + found.read, 120)
                self.assertFalse(found.complete)
                self.assertEqual(len(found.table), found.read)
                client.close()
            again = fleet.update(folder, f"{scratch}/table")
            self.assertTrue(again.complete)
            self.assertEqual((len(again.table), again.kept), (120, found.read))


if __name__ == "__main__":
    unittest.main()
