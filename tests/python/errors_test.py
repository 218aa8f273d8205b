"""What can be put right comes as an exception with its place; long work can be ended."""
import contextlib
import io
import logging
import os
import signal
import tempfile
import threading
import unittest

import ballbar as bb
import numpy as np
import pandas

HE = "sample-runs/two-arcs-he2015"
HIDDEN = "sample-runs/hidden-effect/01"


def constant(data, **how):
    return bb.Model(how.pop("target", "z_um")).fit(data, **how)


class Errors(unittest.TestCase):
    def fault(self, work):
        with self.assertRaises(bb.BallbarError) as caught:
            work()
        return caught.exception

    def test_place(self):
        self.assertEqual(self.fault(lambda: bb.circles("missing.b5r")).file, "missing.b5r")
        with tempfile.TemporaryDirectory() as folder:
            for path in (os.path.join(folder, "bad.csv"), os.path.join(folder, "a: b", "c: d.csv")):
                os.makedirs(os.path.dirname(path), exist_ok=True)
                with open(path, "w", encoding="utf-8") as file:
                    file.write("time_s,z_um\n0,1\n1,x\n")
                error = self.fault(lambda: constant(path))  # noqa: B023
                self.assertEqual((error.file, error.line), (path, 3))
                self.assertIsNotNone(error.column)
            broken = os.path.join(folder, "broken.b5r")
            with open(broken, "w", encoding="utf-8") as file:
                file.write("<x>")
            error = self.fault(lambda: bb.circles(broken))
            self.assertEqual((error.file, error.line, str(error).count(broken)), (broken, 1, 1))
        for work in (
            lambda: bb.Recording([100.0, 0.0]), lambda: bb.Recording([[100.0]]), lambda: constant({"time_s": [0.0], "z_um": [1.0]}, target="y_um"),
            lambda: bb.history("sample-runs/machine-history", tolerance={"nonsense": 1.0}),
        ):
            self.assertIsNone(self.fault(work).file)

    def test_usage(self):
        with self.assertRaises(bb.UsageError):
            bb.simulate("x.toml", out="out", seed=-1)
        self.assertIn("a\\x00b", str(self.fault(lambda: bb.circles("a\0b"))))
        circle = bb.Recording(np.full(90, 100.0), 4.0 * np.arange(90.0))
        self.assertEqual(bb.fit_circle(circle, polar=np.True_), bb.fit_circle(circle, polar=True))
        for work, sentence in (
            (lambda: bb.circles([]), "FILE is required"), (lambda: bb.drift([HE, HE]), "expected nothing more"),
            (lambda: bb.circles("sample-runs/qc20-style-b5r/00.b5r", robust="yes"), "robust: expected True or False, found yes."),
            (lambda: bb.compare(HE, max_gap_s=True), "max_gap: expected a value, found True."),
            (lambda: constant(HE, target="y_um", hold={"constant.constant": 1}), "constant_um"),
            (lambda: constant(HE, target="yy_um"), "the nearest is y_um"),
        ):
            self.assertIn(sentence, str(self.fault(work)))

    def test_nothing_is_printed(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out), self.assertLogs("ballbar", logging.WARNING) as logs:
            bb.report(HE, diagnose=True, target="y_um")
        self.assertEqual(out.getvalue(), "")
        self.assertTrue(any("constant" in line for line in logs.output))

    def test_progress(self):
        fit = bb.Model.load(f"{HIDDEN}/model.toml").fit(f"{HIDDEN}/data.csv")
        steps = []
        fit.diagnose(progress=lambda done, of, text: steps.append((done, of, text)))
        self.assertTrue(any("weighing" in text for _, _, text in steps), steps)

        def stop(done, of, text):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            fit.diagnose(progress=stop)
        with self.assertRaisesRegex(RuntimeError, "enough"):
            bb.history("sample-runs/machine-history", progress=stop)

    def test_ctrl_c(self):
        """Ends long work where it stands: a fit, and a diagnosis that would take seconds more."""
        time_s = np.arange(300_000.0)
        random = np.random.default_rng(1)
        room = 20.0 + 2.0 * np.sin(time_s / 40000.0) + 0.3 * np.sin(time_s / 7000.0)
        table = pandas.DataFrame({"time_s": time_s, "T_room_degC": room, "z_um": 3.0 * room + random.normal(0.0, 0.3, len(time_s))})
        fit = bb.Model("z_um").fit(table)

        def endless():
            while True:
                fit.diagnose()

        for delay_s in (0.05, 0.4, 1.1):
            with self.assertRaises(KeyboardInterrupt):
                threading.Timer(delay_s, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
                endless()
        self.assertEqual(fit.diagnose(), fit.diagnose())

    def test_attributes(self):
        found = bb.circles("sample-runs/qc20-style-b5r/00.b5r")
        with self.assertRaisesRegex(AttributeError, "Fitted has no recording; it has recordings, iso230_4"):
            found.recording
        self.assertIn("recordings", dir(found))
        with self.assertRaisesRegex(KeyError, "typo: the rows have file"):
            found.recordings["typo"]
        with self.assertRaisesRegex(AttributeError, "cannot be changed"):
            found.recordings = []
        with self.assertRaises(TypeError):
            found.recordings[0] = 1
        self.assertEqual(type(found.recordings[0]).__name__, "FittedRecording")


if __name__ == "__main__":
    unittest.main()
