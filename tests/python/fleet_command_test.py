"""`ballbar history` with Dask as a command: what it writes, its sentences and its status."""
import contextlib
import io
import json
import os
import resource
import signal
import subprocess
import sys
import tempfile
import unittest
import warnings
from unittest import mock

import ballbar
from ballbar import fleet
from ballbar.__main__ import history as command
from fleet_test import plant


def ran(*words):
    """Status, stdout, stderr."""
    out, remarks = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(remarks), warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of other packages, which unittest would show
        warnings.simplefilter("default", ballbar.BallbarWarning)
        try:
            status = command([str(word) for word in words])
        except SystemExit as end:
            status = end.code
    return status, out.getvalue(), remarks.getvalue()


def started(*words, stdout=subprocess.PIPE, **environment):
    run = "import sys; from ballbar.__main__ import history; sys.exit(history(sys.argv[1:]))"  # as the program does
    return subprocess.Popen([sys.executable, "-c", run, *words], stdout=stdout, stderr=subprocess.PIPE,
                            env=dict(os.environ, **environment), start_new_session=True)


class Command(unittest.TestCase):
    def setUp(self):
        self.scratch = tempfile.TemporaryDirectory()
        self.plant, self.table = f"{self.scratch.name}/plant", f"{self.scratch.name}/table"
        os.makedirs(self.plant)
        plant(self.plant, 2, 3)

    def tearDown(self):
        self.scratch.cleanup()

    def test_what_it_writes(self):
        outs = [f"{self.scratch.name}/{name}" for name in ("a.csv", "a.json", "a.html", "b.html")]
        status, out, remarks = ran(self.plant, *(word for path in outs for word in ("--out", path)))
        self.assertEqual((status, remarks), (0, "6 files read\n" + "".join(f"wrote {path}\n" for path in outs)))
        self.assertIn("of 2 machines", out)
        with open(outs[1], encoding="utf-8") as file:
            keys = json.load(file)
        self.assertEqual((keys["faults"], keys["lacking"]), (0, 0))
        with open(outs[2], encoding="utf-8") as one, open(outs[3], encoding="utf-8") as other:
            self.assertEqual(one.read(), other.read())

    def test_what_is_lacking(self):
        with open(f"{self.plant}/m0/broken.b5r", "w", encoding="utf-8") as file:
            file.write("<?xml version='1.0'?><nothing/>")
        page, missing = f"{self.scratch.name}/a.html", f"{self.scratch.name}/none.b5r"
        status, out, remarks = ran(self.plant, missing, "--out", page)
        self.assertEqual(status, 1)
        self.assertIn(f"{missing}: not read: No such file or directory.\n7 files read\n", remarks)
        sentences = ["This is a part of the whole: 1 file could not be read.", "Passed over for a fault: 1 file."]
        with open(page, encoding="utf-8") as file:
            text = file.read()
        for sentence in sentences:
            self.assertIn(sentence, out)
            self.assertIn(sentence, text)
        keys = json.loads(ran(self.plant, missing, "--json")[1])
        self.assertEqual((keys["faults"], keys["lacking"]), (1, 1))

    def test_two_plants(self):
        os.rename(self.plant, f"{self.scratch.name}/A")
        os.makedirs(f"{self.scratch.name}/B")
        os.rename(f"{self.scratch.name}/A/m1", f"{self.scratch.name}/B/m0")
        status, out, remarks = ran(f"{self.scratch.name}/A", f"{self.scratch.name}/B")
        self.assertEqual(status, 0)
        self.assertRegex(remarks, "ballbar: m0: expected tests of one machine, found tests below .*/A/m0 and below .*/B/m0, ")

    def test_what_may_be_written_over(self):
        source = f"{self.plant}/m0/log.csv"
        os.rename(f"{self.plant}/m0/000.b5r", source)
        with open(source, encoding="utf-8-sig") as file:
            before = file.read()
        for words, sentence in (
            ([f"{self.plant}/*/*", "--out", source], "expected another file than those that are read"),
            ([self.plant, "--table", self.table, "--out", f"{self.table}/table.json"], "expected another folder than that of the table"),
            ([self.plant, "--out", f"{self.scratch.name}/none/a.html"], "expected a folder to write to, found none of that name."),
        ):
            os.makedirs(self.table, exist_ok=True)
            with mock.patch.object(fleet, "update") as update:
                status, out, remarks = ran(*words)
            self.assertEqual((status, out), (1, ""))
            self.assertRegex(remarks, f"^ballbar: --out [^ ]*: {sentence}.*\n$")
            update.assert_not_called()
        with open(source, encoding="utf-8-sig") as file:
            self.assertEqual(file.read(), before)

    def test_a_full_disk(self):
        outs = [f"{self.scratch.name}/{name}" for name in ("a.csv", "a.json", "a.html")]
        for path in outs:
            ran(self.plant, "--table", self.table, "--out", path)
            with open(path, "w", encoding="utf-8") as file:
                file.write("the former one")
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        limits = resource.getrlimit(resource.RLIMIT_FSIZE)
        for path in outs:
            resource.setrlimit(resource.RLIMIT_FSIZE, (100, limits[1]))
            try:
                status, _, remarks = ran(self.plant, "--table", self.table, "--out", path)
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, limits)
            self.assertEqual((status, remarks), (1, f"ballbar: --out {path}: could not be written: File too large; it is as it was.\n"))
            with open(path, encoding="utf-8") as file:
                self.assertEqual(file.read(), "the former one")
        self.assertEqual([name for name in os.listdir(self.scratch.name) if name.startswith(".")], [])

    def test_misuse(self):
        for words, sentence in (
            (["--workers", "-3"], '--workers: expected a number from 1 to 1024, found "-3"'),
            (["--workers", "two"], '--workers: expected a number from 1 to 1024, found "two"'),
            (["--false-discovery-rate", "2"], '--false-discovery-rate: expected a number from 0 to 1, found "2"'),
            (["--tolerance", "x=y"], '--tolerance: expected NAME=VALUE with a number above 0, found "x=y"'),
            (["--tolerance", "circularity=-3"], '--tolerance: expected NAME=VALUE with a number above 0, found "circularity=-3"'),
            (["--out", "x.txt"], '--out: expected a name that ends in .csv, .json or .html, found "x.txt"'),
            (["--table", ""], '--table: expected a value, found ""'),
            (["--tab", "x"], "unrecognized arguments: --tab x"),
        ):
            self.assertEqual(ran(self.plant, *words), (2, "", f"ballbar: {sentence}; see ballbar history --help\n"))

    def test_one_sentence(self):
        for words, sentence in (
            ([self.plant, "--tolerance", "circularty=3"], 'tolerance: expected a quantity of tests, found "circularty"; the nearest is circularity.'),
            ([f"{self.plant}/none"], f"{self.plant}/none: expected a folder, files or a pattern, found none of that name."),
            (["foo://x/*"], "foo://x/*: expected files, found: Protocol not known: foo."),
            ([self.plant, "--scheduler", "nonsense"], "--scheduler nonsense: expected the address of a Dask scheduler that runs, "
             "such as tcp://host:8786, found: missing port number in address 'nonsense'."),
        ):
            self.assertEqual(ran(*words), (1, "", f"ballbar: {sentence}\n"))
        for error, status in ((KeyboardInterrupt(), 130), (ImportError("No module named 'pandas'"), 1), (OSError(5, "Input/output error", "x"), 1)):
            with mock.patch.object(fleet, "update", side_effect=error):
                self.assertEqual(ran(self.plant)[0], status)
        for tolerance in ({"nonsense": 3}, {"circularity": -3}, {"circularity": "wide"}):
            with self.assertRaisesRegex(ballbar.BallbarError, "tolerance: expected"):
                fleet.rank(fleet.errors(self.plant), tolerance=tolerance)

    def test_where_it_prints(self):
        with open("/dev/full", "wb") as full:
            done = started(self.plant, stdout=full)
            self.assertEqual((done.communicate()[1], done.returncode), (b"ballbar: output: No space left on device.\n", 1))
        done = started(self.plant, "--tolerance", "circularity=0.1", PYTHONIOENCODING="ascii")
        out, remarks = done.communicate()
        self.assertEqual((done.returncode, remarks), (0, b"6 files read\n"))
        self.assertIn(b" ? ", out)

    def test_an_end_from_outside(self):
        plant(f"{self.plant}/more", 4, 150)
        done = started(self.plant, "--table", self.table)
        while not os.path.exists(f"{self.table}/.lock"):
            pass
        os.killpg(done.pid, signal.SIGINT)
        self.assertEqual((*done.communicate(), done.returncode), (b"", b"", 130))


if __name__ == "__main__":
    unittest.main()
