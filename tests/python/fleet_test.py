"""Tables of many tests: lazy, incremental, whole whatever befalls."""
import importlib.util
import json
import os
import pathlib
import re
import resource
import signal
import subprocess
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
        data = [f"sample-runs/hidden-effect/0{k}/data.csv" for k in (1, 2)]
        rows = fleet.diagnose(data, "sample-runs/hidden-effect/01/model.toml").compute(scheduler="synchronous")
        self.assertEqual(rows["verdict"].iloc[0], ballbar.diagnose(data[0], "sample-runs/hidden-effect/01/model.toml").verdict)


class Kept(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.plant, self.table = f"{self.scratch.name}/plant", f"{self.scratch.name}/table"
        os.makedirs(self.plant)
        plant(self.plant)

    def tearDown(self):
        self.scratch.cleanup()

    def another(self, name, year=2029):
        with open(f"{self.plant}/m0/000.b5r", encoding="utf-8-sig") as file:
            text = re.sub("(?<=<DATE_STARTED>)\\d{4}", f"{year}", file.read())
        with open(f"{self.plant}/m0/{name}", "w", encoding="utf-8-sig") as file:
            file.write(text)

    def test_only_what_is_new_is_read(self):
        first = fleet.update(self.plant, self.table)
        self.assertEqual((first.read, first.kept, first.faults, len(first.table)), (12, 0, 0, 12))
        again = fleet.update(self.plant, self.table)
        self.assertEqual((again.read, again.kept), (0, 12))
        pandas.testing.assert_frame_equal(again.table, first.table)
        self.another("new.b5r")
        with open(f"{self.plant}/m1/001.b5r", "a", encoding="utf-8") as file:
            file.write("<!-- changed -->")
        os.remove(f"{self.plant}/m2/003.b5r")
        third = fleet.update(self.plant, self.table)
        self.assertEqual((third.read, third.kept, third.gone, len(third.table)), (2, 10, 1, 12))
        pandas.testing.assert_frame_equal(fleet.read(self.table), third.table)
        whole = fleet.update(self.plant, self.table + "-anew").table
        pandas.testing.assert_frame_equal(whole, third.table)

    def test_many_parts_become_one(self):
        for k in range(45):
            self.another(f"more{k:02}.b5r", 2030 + k)
            fleet.update(self.plant, self.table)
        self.assertLess(len(os.listdir(self.table)), 45)
        self.assertEqual(len(fleet.read(self.table)), 57)

    def test_a_full_disk(self):
        before = fleet.update(self.plant, self.table).table
        self.another("new.b5r")
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
        try:
            with self.assertRaisesRegex(ballbar.BallbarError, "could not be written: .*; it is as it was"):
                fleet.update(self.plant, self.table)
        finally:
            resource.setrlimit(resource.RLIMIT_FSIZE, limits)
        pandas.testing.assert_frame_equal(fleet.read(self.table), before)
        self.assertEqual(len(fleet.update(self.plant, self.table).table), 13)

    def test_a_file_that_changes_while_it_is_read(self):
        changed = f"{self.plant}/m1/000.b5r"
        work = fleet_table._error_rows

        def and_then_changes(files, storage):
            rows = work(files, storage)
            if len(files) > 1:
                with open(changed, "a", encoding="utf-8") as file:
                    file.write("<!-- written while it was read -->")
            return rows

        with mock.patch.object(fleet_table, "_error_rows", and_then_changes):
            found = fleet.update(self.plant, self.table)
        self.assertTrue(found.complete)
        anew = fleet.errors([changed]).compute(scheduler="synchronous")
        self.assertEqual(found.table.set_index("file").loc[changed, "sha256"], anew["sha256"].iloc[0])

    def test_another_folder_is_not_touched(self):
        os.makedirs(self.table)
        with open(f"{self.table}/thesis.txt", "w", encoding="utf-8") as file:
            file.write("years")
        with self.assertRaisesRegex(ballbar.BallbarError, "new or empty"):
            fleet.update(self.plant, self.table)
        self.assertEqual(os.listdir(self.table), ["thesis.txt"])

    def test_a_broken_index(self):
        fleet.update(self.plant, self.table)
        with open(f"{self.table}/table.json", "w", encoding="utf-8") as file:
            file.write("{")
        with self.assertRaisesRegex(ballbar.BallbarError, "table.json: expected format"):
            fleet.update(self.plant, self.table)


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
            again = fleet.update(folder, f"{scratch}/table")
            self.assertTrue(again.complete)
            self.assertEqual((len(again.table), again.kept), (120, found.read))


if __name__ == "__main__":
    unittest.main()
