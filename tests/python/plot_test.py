"""Pictures by matplotlib show what the results hold."""
import importlib.util
import pickle
import sys
import unittest

if importlib.util.find_spec("matplotlib") is None:
    print("Passed over: matplotlib is not installed.")
    sys.exit(0)

import matplotlib

matplotlib.use("Agg")

import ballbar as bb  # noqa: E402
import numpy as np  # noqa: E402
import pandas  # noqa: E402
from ballbar import plot  # noqa: E402

HE = "sample-runs/two-arcs-he2015"


class Plots(unittest.TestCase):
    def test_circle(self):
        recordings = bb.read_recordings("sample-runs/qc20-style-b5r/00.b5r")
        axes = plot.circle(recordings, bb.fit_circle(recordings), magnified=1000.0)
        self.assertEqual([line.get_label() for line in axes.lines], ["XY CCW", "XY CW"])
        radius_mm = axes.lines[0].get_ydata()
        self.assertAlmostEqual(float(np.mean(radius_mm)), 100.004, places=1)
        self.assertGreater(np.ptp(radius_mm), 4.0)  # 5.6 um a thousand times

    def test_a_circle_has_a_scale_in_um(self):
        recordings = bb.read_recordings("sample-runs/qc20-style-b5r/00.b5r")
        axes = plot.circle(recordings, bb.fit_circle(recordings))
        labels = [label.get_text() for label in axes.get_yticklabels()]
        self.assertEqual(labels, ["-4 µm", "-2 µm", "0", "+2 µm", "+4 µm"])
        radii_mm, ring_mm = axes.lines[0].get_ydata(), axes.get_yticks()
        largest_um = 2.0 * np.abs(radii_mm - ring_mm[2]).max() / (ring_mm[3] - ring_mm[2])
        self.assertAlmostEqual(float(largest_um), 2.9, delta=0.3)  # circularity is 5.6 um
        self.assertIn("a ring 2 µm", axes.get_title())

    def test_nothing_is_cut_off_or_hidden(self):
        """Labels, and legends, are within the figure; a legend is beside the axes."""
        fit = bb.Model.load(f"{HE}/model.toml").fit(HE)
        recordings = bb.read_recordings("sample-runs/qc20-style-b5r/00.b5r")
        errors = bb.machine_errors("sample-runs/qc20-style-b5r/00.b5r")
        for axes in (fit.plot(), fit.diagnose().plot(), errors.plot(), plot.circle(recordings, bb.fit_circle(recordings)), bb.drift(HE).plot()):
            axes.figure.canvas.draw()
            box, whole = axes.get_tightbbox(axes.figure.canvas.get_renderer()), axes.figure.bbox
            self.assertTrue(box.x0 > whole.x0 - 1.0 and box.x1 < whole.x1 + 1.0 and box.y0 > whole.y0 - 1.0 and box.y1 < whole.y1 + 1.0, (box, whole))
            if axes.get_legend() is not None:
                self.assertGreaterEqual(axes.get_legend().get_window_extent().x0, axes.get_window_extent().x1)

    def test_drift_and_comparison(self):
        axes = bb.drift(HE).plot()
        self.assertIn("y", [text.get_text() for text in axes.get_legend().get_texts()])
        self.assertEqual(axes.get_ylabel(), "drift, µm")
        self.assertGreaterEqual(len(plot.comparison(bb.compare(HE), "y").lines), 2)

    def test_fit_and_diagnosis(self):
        fit = bb.Model.load(f"{HE}/model.toml").fit(HE)
        axes = fit.plot()
        measured, model, residual = (line.get_ydata() for line in axes.lines)
        np.testing.assert_array_equal(measured, fit.measured)
        np.testing.assert_allclose(measured - model, residual, atol=1e-12)
        dated = bb.read("sample-runs/hidden-effect/01/data.csv")
        dated.index = pandas.Timestamp("2026-11-22") + pandas.to_timedelta(dated.index, unit="s")
        self.assertEqual(bb.Model("y_um").fit(dated).plot().get_xlabel(), "")
        found = fit.diagnose()
        bars = found.plot().patches
        self.assertAlmostEqual(max(bar.get_width() for bar in bars), max([found.p_nothing, *found.effects["p"]]))

    def test_errors(self):
        found = bb.machine_errors("sample-runs/qc20-style-b5r/00.b5r")
        widths = [bar.get_width() for bar in found.plot().patches]
        self.assertEqual((widths, widths[-1] > 3.0), (sorted(widths), True))

    def test_history_has_a_line_a_plane(self):
        axes = plot.history(bb.errors("sample-runs/machine-history/**/*.b5r").assign(machine="mill"), "backlash_a_pos_um")
        self.assertEqual([len(one.lines[0].get_xdata()) for one in axes.containers], [5, 3, 2])

    def test_svg(self):
        found = bb.drift(HE)
        svg = plot.svg_of(found)
        self.assertTrue(svg.count("<svg") == 1 and "script" not in svg)
        self.assertEqual(plot.svg_of(pickle.loads(pickle.dumps(found))), svg)
        self.assertEqual(plot.svg_of(bb.effects()), "")
        with self.assertRaisesRegex(TypeError, "expected a result with a picture"):
            bb.effects().plot()


if __name__ == "__main__":
    unittest.main()
