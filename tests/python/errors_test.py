"""What can be put right comes as an exception with its place."""
import contextlib
import io
import logging
import os
import signal
import tempfile
import threading
import unittest

import ballbar
import numpy as np


class Errors(unittest.TestCase):
    def fault(self, work):
        with self.assertRaises(ballbar.BallbarError) as caught:
            work()
        return caught.exception

    def test_place(self):
        self.assertEqual(self.fault(lambda: ballbar.fit("missing.b5r")).file, "missing.b5r")
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "bad.csv")
            with open(path, "w", encoding="utf-8") as file:
                file.write("time_s,z_um\n0,1\n1,x\n")
            error = self.fault(lambda: ballbar.check(path, target="z_um"))
            self.assertEqual((error.file, error.line), (path, 3))
            self.assertIsNotNone(error.column)
            path = os.path.join(folder, "a: b", "c: d.csv")
            os.mkdir(os.path.dirname(path))
            with open(path, "w", encoding="utf-8") as file:
                file.write("time_s,z_um\n0,1\n1,x\n")
            error = self.fault(lambda: ballbar.check(path, target="z_um"))
            self.assertEqual((error.file, error.line), (path, 3))
            broken = os.path.join(folder, "broken.b5r")
            with open(broken, "w", encoding="utf-8") as file:
                file.write("<x>")
            error = self.fault(lambda: ballbar.errors(broken))
            self.assertEqual((error.file, error.line, str(error).count(broken)), (broken, 1, 1))
        self.assertEqual(self.fault(lambda: ballbar.fit("missing")).file, "missing")
        for work in (
            lambda: ballbar.Recording([100.0, 0.0]), lambda: ballbar.Recording([[100.0]]), lambda: ballbar.check({"time_s": [0.0], "z_um": [1.0]}, target="y_um"),
            lambda: ballbar.history("sample-runs/machine-history", tolerance={"nonsense": 1.0}),
        ):
            self.assertIsNone(self.fault(work).file)

    def test_usage(self):
        with self.assertRaises(ballbar.UsageError):
            ballbar.simulate("x.toml", "out", seed=-1)
        with self.assertRaises(ballbar.UsageError):
            ballbar.import_log("x.csv", nonsense="1")
        self.assertIn("a\\x00b", str(self.fault(lambda: ballbar.fit("a\0b"))))
        circle = ballbar.Recording(np.full(90, 100.0), 4.0 * np.arange(90.0))
        for name, value in (("robust", 1), ("polar", "yes")):
            with self.assertRaisesRegex(ballbar.UsageError, f"{name}: expected True or False"):
                ballbar.fit(circle, **{name: value})
        with self.assertRaisesRegex(ballbar.UsageError, "seed: expected a value"):
            ballbar.diagnose(circle, seed=True)
        self.assertEqual(ballbar.fit(circle, polar=np.True_), ballbar.fit(circle, polar=True))
        he = "sample-runs/two-arcs-he2015"
        for work, sentence in (
            (lambda: ballbar.check([]), "DATA is required"), (lambda: ballbar.drift([he, he]), "expected nothing more"),
            (lambda: ballbar.check(he, max_gap_s=False), "max_gap: expected a value, found False."),
            (lambda: ballbar.check(he, robust=[]), "robust: expected True or False, found none."),
            (lambda: ballbar.select("runs.csv", "x.csv", "y_um", methods="pcr"), "methods: expected an option of train, found none of that name; the nearest is method."),
        ):
            self.assertIn(sentence, str(self.fault(work)))
        for targets in (np.array(["y_um", "z_um"]), {"z_um", "y_um"}, ("y_um", "z_um")):
            self.assertEqual(ballbar.check(he, target=targets).targets["target"], ["y_um", "z_um"])

    def test_nothing_is_printed(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), self.assertLogs("ballbar", logging.WARNING) as logs:
            ballbar.check("sample-runs/two-arcs-he2015", target="y_um")
        self.assertEqual(out.getvalue(), "")
        self.assertTrue(any("constant" in line for line in logs.output))

    def test_progress_and_ctrl_c(self):
        data, model = "sample-runs/hidden-effect/01/data.csv", "sample-runs/hidden-effect/01/model.toml"
        lines = []
        ballbar.diagnose(data, model, progress=lines.append)
        self.assertTrue(any("weighing" in line for line in lines), lines)
        timer = threading.Timer(0.05, lambda: os.kill(os.getpid(), signal.SIGINT))
        with self.assertRaises(KeyboardInterrupt):
            timer.start()
            for _ in range(50):
                ballbar.diagnose(data, model)
        self.assertGreater(ballbar.check(data, model).rmse_um, 0.0)

        def stop(line):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            ballbar.diagnose(data, model, progress=stop)

    def test_many_files_can_be_ended(self):
        for work in (ballbar.errors, ballbar.history):
            lines = []

            def enough(line, lines=lines):
                lines.append(line)
                raise KeyboardInterrupt

            with self.assertRaises(KeyboardInterrupt):
                work("sample-runs/machine-history", progress=enough)
            self.assertRegex(" ".join(lines), r"^reading file \d+ of \d+$")
        timer = threading.Timer(0.0, lambda: os.kill(os.getpid(), signal.SIGINT))
        with self.assertRaises(KeyboardInterrupt):
            timer.start()
            timer.join()
            ballbar.errors("sample-runs/machine-history")

    def test_attributes(self):
        found = ballbar.fit("sample-runs/qc20-style-b5r/00.b5r")
        with self.assertRaisesRegex(AttributeError, "Fitted has no recording; it has recordings, iso230_4"):
            found.recording
        self.assertIn("recordings", dir(found))
        self.assertIn("<svg", found._repr_html_())


if __name__ == "__main__":
    unittest.main()
