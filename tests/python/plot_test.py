"""Pictures by matplotlib show what the results hold."""
import importlib.util
import sys
import unittest

if importlib.util.find_spec("matplotlib") is None:
    print("Passed over: matplotlib is not installed.")
    sys.exit(0)

import matplotlib

matplotlib.use("Agg")

import ballbar  # noqa: E402
import numpy as np  # noqa: E402
from ballbar import plot  # noqa: E402

HE = "sample-runs/two-arcs-he2015"


class Plots(unittest.TestCase):
    def test_circle(self):
        recordings = ballbar.read_recordings("sample-runs/qc20-style-b5r/00.b5r")
        axes = plot.circle(recordings, magnified=1000.0)
        self.assertEqual([line.get_label() for line in axes.lines], ["XY CCW", "XY CW"])
        radius_mm = axes.lines[0].get_ydata()
        self.assertAlmostEqual(float(np.mean(radius_mm)), 100.004, places=1)
        self.assertGreater(np.ptp(radius_mm), 4.0)  # 5.6 um a thousand times

    def test_drift(self):
        found = ballbar.drift(HE)
        axes = plot.drift(found)
        self.assertIn("y", [text.get_text() for text in axes.get_legend().get_texts()])
        self.assertEqual(axes.get_ylabel(), "drift, µm")

    def test_comparison(self):
        self.assertGreaterEqual(len(plot.comparison(ballbar.compare(HE), "y").lines), 2)

    def test_residual(self):
        axes = plot.residual(ballbar.report(HE, f"{HE}/model.toml"))
        measured, model, left = (line.get_ydata() for line in axes.lines)
        np.testing.assert_allclose(measured - model, left, atol=2e-3)

    def test_history(self):
        axes = plot.history(ballbar.errors("sample-runs/machine-history"), "backlash_a_pos")
        self.assertEqual(len(axes.containers[0].lines[0].get_xdata()), 10)


if __name__ == "__main__":
    unittest.main()
