"""Tables of many tests: lazy, incremental, whole whatever befalls."""
import importlib.util
import os
import pathlib
import re
import shutil
import signal
import sys
import tempfile
import unittest
from unittest import mock

import ballbar

if importlib.util.find_spec("dask") is None:
    print("Passed over: Dask is not installed.")
    sys.exit(0)

import pandas  # noqa: E402
from ballbar import fleet, fleet_table  # noqa: E402

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


class Lazy(unittest.TestCase):
    def test_rows_are_the_tests(self):
        table = fleet.errors(f"{SAMPLE}/**/*.b5r", files_of_a_partition=3)
        self.assertEqual(table.npartitions, 4)
        rows = table.compute()
        expected = {test.file: test for test in ballbar.errors(SAMPLE).tests}
        self.assertEqual(sorted(rows["file"]), sorted(expected))
        for _, row in rows.iterrows():
            for one in expected[row["file"]].errors:
                unit = one.unit.replace("/", "_per_")
                self.assertEqual(row[f"{one.name}_{unit}"], one.value, one.name)
        self.assertTrue((rows["sha256"].str.len() == 64).all())

    def test_every_error_has_a_column(self):
        for files in (SAMPLE, "sample-runs/qc20-style-b5r"):
            for test in ballbar.errors(files).tests:
                for one in test.errors:
                    self.assertIn((one.name, one.unit.replace("/", "_per_")), fleet.ERRORS)

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

    def test_diagnosed_and_trained(self):
        data, model = "sample-runs/hidden-effect/01/data.csv", "sample-runs/hidden-effect/01/model.toml"
        rows = fleet.diagnose([data, "missing.csv"], model).compute(scheduler="synchronous").set_index("file")
        self.assertEqual(rows.loc[data, "verdict"], ballbar.diagnose(data, model).verdict)
        self.assertEqual(rows.loc["missing.csv", "fault"], "missing.csv: No such file or directory.")
        with self.assertRaisesRegex(ballbar.BallbarError, "target: expected the name of one column"):
            fleet.diagnose(data, model, target=["x_um", "y_um"])
        with tempfile.TemporaryDirectory() as folder:
            (_, row), = fleet.train(data, "y_um", f"{folder}/models", few=True).compute(scheduler="synchronous").iterrows()
            again = ballbar.train(data, "y_um", f"{folder}/again.json", effects=True, few=True)
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
            self.assertEqual(fleet.ranked(expected).machines[0].tests, 2)


class Stories(unittest.TestCase):
    def test_the_sample_plant(self):
        with tempfile.TemporaryDirectory() as scratch:
            ballbar.simulate("sample-runs/fleet/fleet.toml", f"{scratch}/plant")
            done = fleet.update(f"{scratch}/plant", f"{scratch}/table")
            found = fleet.ranked(done.table, page=f"{scratch}/plant.html", title="plant")
            with open(f"{scratch}/plant.html", encoding="utf-8") as file:
                self.assertIn("mill-26", file.read())
        kinds = {machine.machine: {one.kind for one in machine.findings} for machine in found.machines if len(machine.findings)}
        for machine, kind in {"mill-04": "trend", "mill-11": "step", "mill-19": "season", "mill-26": "replaced_part", "mill-33": "instrument"}.items():
            self.assertIn(kind, kinds.get(machine, set()), machine)
        self.assertLessEqual(len(kinds), 7)
        self.assertIn("mill-26", repr(found))


@unittest.skipUnless(importlib.util.find_spec("distributed"), "Dask's distributed is not installed")
class Cluster(unittest.TestCase):
    def test_a_worker_is_killed(self):
        from dask.distributed import Client, LocalCluster

        with tempfile.TemporaryDirectory() as scratch:
            folder = f"{scratch}/plant"
            os.makedirs(folder)
            plant(folder, 6, 60)
            with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
                killed = []

                def kill(done, of):
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
                with mock.patch.object(fleet_table, "_PATIENCE_S", 1):
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

                def gone(done, of):
                    cluster.scale(0)
                    cluster.close()

                with mock.patch.object(fleet_table, "_PATIENCE_S", 2):
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
