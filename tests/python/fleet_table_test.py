"""Tables that are kept: the same however they came to be, whole whatever befalls."""
import contextlib
import importlib.util
import io
import logging
import math
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
from unittest import mock

import ballbar
import pandas
from ballbar import _fleet_rows, fleet, fleet_table
from ballbar._progress import progress_or_tqdm
from fleet_test import plant, said_by_the_program


@contextlib.contextmanager
def without_rights():
    """Not root, who may read everything."""
    if os.geteuid() != 0:
        yield
        return
    os.seteuid(65534)
    try:
        yield
    finally:
        os.seteuid(0)


def write_log(path, direction, started):
    """A circle of one degree steps whose axes differ by 8 um."""
    angles = range(360) if direction == "CCW" else range(359, -1, -1)
    with open(path, "w", encoding="utf-8") as file:
        file.write('# format = "ballbar-log 1"\n# kind = "circle"\n# motion = "linear_axes"\n# plane = "XY"\n')
        file.write('# moving_ball = "spindle"\n# nominal_length_mm = 100.0\n# feed_mm_per_min = 1000.0\n')
        file.write(f'# direction = "{direction}"\n# started = {started}\ntime_s,angle_deg,length_mm\n')
        for i, angle in enumerate(angles):
            noise = 1e-4 * math.sin(12.9898 * (i + (direction == "CW") * 360)) * 0.3
            file.write(f"{0.1 * i:.3f},{angle},{100 + 0.004 * math.cos(2 * math.radians(angle)) + noise:.6f}\n")


class Progress(unittest.TestCase):
    def said(self, is_terminal, progress=None, pause_s=0.0):
        """What standard error shows."""
        stream = io.StringIO()
        stream.isatty = lambda: is_terminal
        with contextlib.redirect_stderr(stream), progress_or_tqdm(progress) as tell:
            for done in (0, 20, 40):
                time.sleep(pause_s)
                tell(done, 40, "reading tests")
        return stream.getvalue()

    def test_who_is_told(self):
        told = []
        self.assertEqual(self.said(True, lambda *said: told.append(said)), "")
        self.assertEqual(told, [(0, 40, "reading tests"), (20, 40, "reading tests"), (40, 40, "reading tests")])
        self.assertEqual(self.said(False), "")
        with mock.patch.dict(sys.modules, tqdm=None):
            self.assertEqual(self.said(True), "")

    @unittest.skipUnless(importlib.util.find_spec("tqdm"), "tqdm is not installed")
    def test_a_bar(self):
        self.assertRegex(self.said(True, pause_s=0.4), "reading tests: .*20/40")


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
        work = _fleet_rows.error_rows
        reads = []

        def and_then_changes(files, storage, at, most=1):
            rows = work(files, storage, at)
            reads.append(len(files))
            if len(reads) <= most:
                with open(changed, "a", encoding="utf-8") as file:
                    file.write("<!-- written while it was read -->")
            return rows

        with mock.patch.object(_fleet_rows, "error_rows", and_then_changes):
            found = fleet.update(self.plant, self.table)
        self.assertEqual((found.complete, found.read, found.kept, reads), (True, 12, 0, [12, 1]))
        anew = fleet.errors([changed]).compute(scheduler="synchronous")
        self.assertEqual(found.table.set_index("file").loc[changed, "sha256"], anew["sha256"].iloc[0])
        with mock.patch.object(_fleet_rows, "error_rows", lambda files, storage, at: and_then_changes(files, storage, at, 1000)):
            os.utime(changed)
            found = fleet.update(self.plant, self.table)
        self.assertEqual(found.lacking, {changed: "changed again and again while it was read"})
        self.assertEqual(fleet.update(self.plant, self.table).read, 1)

    def test_a_file_that_is_gone_before_it_is_read(self):
        there, gone = f"{self.plant}/m0/000.b5r", f"{self.plant}/m0/gone.b5r"
        shutil.copy(f"{self.plant}/m0/001.b5r", gone)
        read = _fleet_rows._core.tests

        def tests(paths):
            with contextlib.suppress(FileNotFoundError):
                os.remove(gone)
            return read(paths)

        with mock.patch.object(_fleet_rows._core, "tests", tests):
            rows = _fleet_rows.errors_table([there, gone])
        self.assertEqual(rows["file"].tolist(), [there, gone])
        self.assertTrue(pandas.isna(rows["fault"][0]))
        self.assertIn(f"{gone}: ", rows["fault"][1])

    def test_another_folder_is_not_touched(self):
        os.makedirs(self.table)
        with open(f"{self.table}/thesis.txt", "w", encoding="utf-8") as file:
            file.write("years")
        with self.assertRaisesRegex(ballbar.BallbarError, "new or empty"):
            fleet.update(self.plant, self.table)
        self.assertEqual(os.listdir(self.table), ["thesis.txt"])

    def test_the_same_size_and_time(self):
        changed = f"{self.plant}/m1/001.b5r"
        before = fleet.update(self.plant, self.table).table
        stamp = os.stat(changed)
        with open(changed, encoding="utf-8-sig") as file:
            text = file.read()
        digit = text.index("<READINGS>") + len("<READINGS>+0.00")
        with open(changed, "w", encoding="utf-8-sig") as file:
            file.write(text[:digit] + ("1" if text[digit] != "1" else "2") + text[digit + 1 :])
        os.utime(changed, ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
        self.assertEqual((os.stat(changed).st_size, os.stat(changed).st_mtime_ns), (stamp.st_size, stamp.st_mtime_ns))
        self.assertEqual(fleet.update(self.plant, self.table).read, 0)
        told = []
        done = fleet.update(self.plant, self.table, verify=True, progress=lambda *said: told.append(said))
        self.assertEqual((done.read, done.kept), (1, 11))
        self.assertEqual((told[0], told[-1]), ((1, 12, "reading bytes"), (1, 1, "reading tests")))
        self.assertNotEqual(done.table.set_index("file")["sha256"][changed], before.set_index("file")["sha256"][changed])
        pandas.testing.assert_frame_equal(done.table, self.anew())
        os.chmod(changed, 0)
        for path in (self.scratch.name, self.plant, self.table):
            os.chmod(path, 0o777)
        os.chmod(f"{self.table}/.lock", 0o666)
        with without_rights():
            again = fleet.update(self.plant, self.table, verify=True)
        self.assertEqual((again.lacking, again.read), ({changed: "Permission denied"}, 0))
        pandas.testing.assert_frame_equal(again.table, done.table)

    def test_the_same_size_and_time_of_a_second_log(self):
        logs = f"{self.scratch.name}/logs"
        os.makedirs(logs)
        write_log(f"{logs}/1.csv", "CCW", "2026-01-01T10:00:00")
        write_log(f"{logs}/2.csv", "CW", "2026-01-01T10:05:00")
        before = fleet.update(f"{logs}/*", self.table).table
        stamp = os.stat(f"{logs}/2.csv")
        with open(f"{logs}/2.csv", encoding="utf-8") as file:
            text = file.read()
        with open(f"{logs}/2.csv", "w", encoding="utf-8") as file:
            file.write(text.replace("100.00", "100.01"))
        os.utime(f"{logs}/2.csv", ns=(stamp.st_atime_ns, stamp.st_mtime_ns))
        done = fleet.update(f"{logs}/*", self.table, verify=True)
        self.assertEqual((len(before), len(done.table), done.read), (1, 1, 2))
        self.assertNotEqual(before["circularity_um"][0], done.table["circularity_um"][0])

    def anew(self, files=None):
        """The table that the same files give in one update."""
        shutil.rmtree(f"{self.scratch.name}/anew", ignore_errors=True)
        return fleet.update(files or self.plant, f"{self.scratch.name}/anew").table

    def test_updates_at_the_same_time(self):
        fleet.update(self.plant, self.table)
        work = """
import shutil, sys
from ballbar import fleet
plant, table, who = sys.argv[1:]
source = open(plant + "/m0/000.b5r", encoding="utf-8-sig").read()
for k in range(8):
    with open(f"{plant}/m{who}/new{k}.b5r", "w", encoding="utf-8-sig") as file:
        file.write(source.replace("<DATE_STARTED>20", f"<DATE_STARTED>{who}{k}"))
    fleet.update(plant, table)
"""
        both = [subprocess.Popen([sys.executable, "-c", work, self.plant, self.table, who], stderr=subprocess.DEVNULL) for who in "12"]
        reads = 0
        while any(one.poll() is None for one in both):
            self.assertGreaterEqual(len(fleet.read(self.table)), 12)
            reads += 1
        self.assertEqual([one.returncode for one in both], [0, 0])
        self.assertGreater(reads, 3)
        pandas.testing.assert_frame_equal(fleet.read(self.table), self.anew())

    def test_a_file_that_another_update_read_while_this_one_waited(self):
        fleet.update(self.plant, self.table)
        with fleet_table._alone(self.table):
            waiting = threading.Thread(target=fleet.update, args=(self.plant, self.table))
            with self.assertLogs("ballbar", "WARNING"):
                waiting.start()
                while not logging.getLogger("ballbar").handlers[0].watcher.output:
                    time.sleep(0.01)
            self.another("later.b5r")
        waiting.join()
        self.assertIn(f"{self.plant}/m0/later.b5r", set(fleet.read(self.table)["file"]))

    def test_files_of_others(self):
        os.makedirs(self.table)
        for name in ("part-list.txt", "part-000001.csv"):
            with open(f"{self.table}/{name}", "w", encoding="utf-8") as file:
                file.write("theirs")
        with self.assertRaisesRegex(ballbar.BallbarError, "new or empty, found other files"):
            fleet.update(self.plant, self.table)
        self.assertEqual(sorted(os.listdir(self.table)), ["part-000001.csv", "part-list.txt"])
        os.remove(f"{self.table}/part-000001.csv")
        os.rename(f"{self.table}/part-list.txt", f"{self.scratch.name}/part-list.txt")
        fleet.update(self.plant, self.table)
        os.rename(f"{self.scratch.name}/part-list.txt", f"{self.table}/part-list.txt")
        self.another("new.b5r")
        fleet.update(self.plant, self.table)
        self.assertIn("part-list.txt", os.listdir(self.table))

    def test_what_cannot_be_opened(self):
        for path in (self.scratch.name, self.plant):
            os.chmod(path, 0o777)
        kept, file, folder = f"{self.plant}/m2/003.b5r", f"{self.plant}/m0/000.b5r", f"{self.plant}/m1"
        os.chmod(file, 0)
        with without_rights():
            first = fleet.update(self.plant, self.table)
            self.assertEqual((first.lacking, first.faults, len(first.table)), ({file: "Permission denied"}, 0, 11))
        os.chmod(file, 0o644)
        os.chmod(folder, 0)
        os.remove(kept)
        with without_rights():
            second = fleet.update(self.plant, self.table)
            self.assertEqual((second.lacking, second.faults, second.read, second.gone), ({folder: "Permission denied"}, 0, 1, 1))
            self.assertEqual(int(second.table["file"].str.startswith(folder).sum()), 4)
            rows = fleet.errors(self.plant).compute(scheduler="synchronous").set_index("file")
            self.assertEqual(rows.loc[folder, "fault"], f"{folder}: Permission denied.")
        os.chmod(folder, 0o755)
        third = fleet.update(self.plant, self.table)
        self.assertTrue(third.complete)
        pandas.testing.assert_frame_equal(third.table, self.anew())

    def test_what_is_not_there(self):
        missing = ["memory://nowhere/none.b5r", f"{self.plant}/none.b5r"]
        done = fleet.update([self.plant, *missing], self.table)
        self.assertEqual((sorted(done.lacking), done.faults, done.read), (sorted(missing), 0, 12))
        shutil.copy(f"{self.plant}/m0/000.b5r", os.fsencode(self.plant) + b"/m0/latin\xfc.b5r")
        self.assertEqual(list(fleet.update(self.plant, self.table).lacking.values()), ["expected a name in UTF-8"])

    def test_a_copy_that_comes_later(self):
        fleet.update(self.plant, self.table)
        original, copy = f"{self.plant}/m1/002.b5r", f"{self.plant}/m2/copy.b5r"
        shutil.copy(original, copy)
        done = fleet.update(self.plant, self.table)
        self.assertEqual(done.table["fault"].dropna().tolist(), [f"{copy}: expected a different test, found a copy of {original}."])
        pandas.testing.assert_frame_equal(done.table, self.anew())
        os.remove(original)
        done = fleet.update(self.plant, self.table)
        self.assertEqual((done.read, done.faults), (0, 0))
        pandas.testing.assert_frame_equal(done.table, self.anew())

    def test_logs_of_both_directions(self):
        logs = f"{self.scratch.name}/logs"
        pattern = f"{logs}/*.csv"
        os.makedirs(logs)
        write_log(f"{logs}/1-ccw.csv", "CCW", "2026-01-01T10:00:00")
        alone = fleet.update(pattern, self.table).table
        steps = [("1-cw", "CW", "2026-01-01T10:05:00"), ("3-cw", "CW", "2026-03-01T10:05:00"), ("2-ccw", "CCW", "2026-02-01T10:00:00"),
                 ("2-cw", "CW", "2026-02-01T10:05:00"), ("3-ccw", "CCW", "2026-03-01T10:00:00"), ("1-ccw", None, None)]
        for name, direction, started in steps:
            if direction:
                write_log(f"{logs}/{name}.csv", direction, started)
            else:
                os.remove(f"{logs}/{name}.csv")
            done = fleet.update(pattern, self.table)
            pandas.testing.assert_frame_equal(done.table, self.anew(pattern), name)
            self.assertEqual(done.faults, 0)
            self.assertEqual(done.table["file"].tolist(), sorted(said_by_the_program(logs)))
            if name == "1-cw":
                self.assertEqual(len(done.table), 1)
                self.assertNotEqual(done.table["circularity_um_sigma"][0], alone["circularity_um_sigma"][0])
        self.assertEqual((done.read, done.kept), (5, 0))
        write_log(f"{logs}/4-ccw.csv", "CCW", "2026-04-01T10:00:00")
        done = fleet.update(pattern, self.table)
        self.assertEqual((done.read, done.kept), (6, 0))
        for size in (1, 2, 4):
            rows = fleet.errors(pattern, files_of_a_partition=size).compute(scheduler="synchronous")
            pandas.testing.assert_frame_equal(rows.reset_index(drop=True), done.table)

    def test_names_of_any_kind(self):
        for name in ("x\ry", "x\ny", 'x"y', "x,y", "NA", " "):
            os.rename(f"{self.plant}/m0/000.b5r", f"{self.plant}/m0/{name}.b5r")
            done = fleet.update(self.plant, self.table)
            self.assertEqual(done.table["file"].tolist(), fleet.files_of(self.plant))
            self.assertEqual(fleet.update(self.plant, self.table).read, 0)
            os.rename(f"{self.plant}/m0/{name}.b5r", f"{self.plant}/m0/000.b5r")

    def test_an_update_that_is_ended(self):
        before = fleet.update(self.plant, self.table).table
        for k in range(12):
            self.another(f"more{k:02}.b5r", 2030 + k)

        def end(done, of, text):
            raise KeyboardInterrupt

        for seconds, left in ((0.0, 8), (1000.0, 4)):  # it is saved as it goes, and as it ends
            with mock.patch.object(_fleet_rows, "_AT_ONCE", 4), mock.patch.object(fleet_table, "_SECONDS_OF_A_SAVE", seconds), self.assertRaises(KeyboardInterrupt):
                fleet.update(self.plant, self.table, progress=end)
            pandas.testing.assert_frame_equal(fleet.read(self.table), before)
            shutil.copytree(self.table, f"{self.scratch.name}/{left}")
            done = fleet.update(self.plant, f"{self.scratch.name}/{left}")
            self.assertEqual((done.read, len(done.table)), (left, 24))

    def test_damage(self):
        expected = fleet.update(self.plant, self.table).table
        path = f"{self.table}/table.npz"
        with open(path, "rb") as file:
            whole = file.read()
        flipped = bytearray(whole)
        flipped[len(whole) // 2] ^= 1
        for damage in (b"", b"{", b"file,machine\n", b"PK\x03\x04", whole[:-40], whole[:200], bytes(flipped)):
            with open(path, "wb") as file:
                file.write(damage)
            with self.assertRaisesRegex(ballbar.BallbarError, "table.npz: expected a table, found: .* An update reads its files again"):
                fleet.read(self.table)
            with self.assertWarnsRegex(ballbar.BallbarWarning, "table.npz: expected a table, found: .* It is kept as .*/table.npz.damaged") as warned:
                done = fleet.update(self.plant, self.table)
            self.assertEqual(warned.filename, __file__)
            self.assertEqual((done.read, sorted(os.listdir(self.table))), (12, [".lock", "table.npz", "table.npz.damaged"]))
            pandas.testing.assert_frame_equal(done.table, expected)
            with open(f"{path}.damaged", "rb") as file:
                self.assertEqual(file.read(), damage)
        with mock.patch.object(fleet_table._core, "version", "0.0.0"):
            done = fleet.update(self.plant, self.table)
            self.assertEqual((done.read, set(done.table["version"])), (12, {"0.0.0"}))
        with self.assertRaisesRegex(ballbar.BallbarError, "expected a table that an update by this version ended, found none"):
            fleet.read(self.table)
        self.assertEqual(fleet.update(self.plant, self.table).read, 12)

    def test_a_table_that_may_not_be_read(self):
        fleet.update(self.plant, self.table)
        for path in (self.scratch.name, self.plant, self.table):
            os.chmod(path, 0o777)
        os.chmod(f"{self.table}/.lock", 0o666)
        os.chmod(f"{self.table}/table.npz", 0)
        with without_rights(), self.assertRaisesRegex(ballbar.BallbarError, "the table could not be opened: Permission denied"):
            fleet.update(self.plant, self.table)
        os.chmod(f"{self.table}/table.npz", 0o644)
        self.assertEqual(fleet.update(self.plant, self.table).read, 0)

    def test_what_a_killed_update_left(self):
        expected = fleet.update(self.plant, self.table).table
        with open(f"{self.table}/.table.npz.0123", "wb") as file:
            file.write(b"half")
        pandas.testing.assert_frame_equal(fleet.update(self.plant, self.table).table, expected)
        self.assertEqual(sorted(os.listdir(self.table)), [".lock", "table.npz"])


if __name__ == "__main__":
    unittest.main()
