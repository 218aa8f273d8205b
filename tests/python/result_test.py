"""What a fit says of itself, what results lack, what the package shows of itself, and the fleet's machines."""
import importlib.util
import pathlib
import re
import tempfile
import unittest

import ballbar as bb
import numpy as np
import pandas

HISTORY = "sample-runs/machine-history"
B5R = "sample-runs/qc20-style-b5r/00.b5r"


def walk(rows):
    random = np.random.default_rng(0)
    room = 20.0 + np.cumsum(random.normal(0.0, 0.02, rows))
    z = 2.5 * (room - 20.0) + random.normal(0.0, 0.2, rows)
    return room, z, pandas.DataFrame({"T_room_degC": room, "z_um": z}, index=pandas.Index(30.0 * np.arange(rows), name="time_s"))


class Fits(unittest.TestCase):
    def test_least_squares_of_gains_are_exact(self):
        for rows in (200, 2000, 20000):
            room, z, table = walk(rows)
            fit = bb.Model("z_um", ["expansion(T_room_degC)"]).fit(table, white=True)
            columns = np.c_[np.ones(rows), room - room[0]]
            expected = np.linalg.lstsq(columns, z, rcond=None)[0]
            self.assertLess(np.abs((fit.params["value"] - expected) / fit.params["sigma"]).max(), 1e-5)
            residual = z - columns @ expected
            variance = residual @ residual / (rows - 2)
            self.assertAlmostEqual(fit.log_likelihood, -0.5 * (residual @ residual / variance + rows * np.log(2.0 * np.pi * variance)), places=4)
            self.assertAlmostEqual(fit.aic, 2.0 * 3 - 2.0 * fit.log_likelihood, places=9)  # two parameters and the noise
            self.assertAlmostEqual(fit.bic, np.log(rows) * 3 - 2.0 * fit.log_likelihood, places=9)
            self.assertAlmostEqual(fit.r_squared, 1.0 - residual @ residual / ((z - z.mean()) ** 2).sum(), places=9)

    def test_criteria_choose_the_effect_that_is_there(self):
        table = bb.read("sample-runs/hidden-effect/01/data.csv")
        small, large = (bb.Model("y_um", effects).fit(table) for effects in (["lagged_expansion(T_motor_degC)"], ["lagged_expansion(T_motor_degC)", "lagged_expansion(T_room_degC)"]))
        self.assertLess(large.bic, small.bic)
        self.assertGreater(large.r_squared, small.r_squared)

    def test_printed_it_is_the_table_of_its_parameters(self):
        fit = bb.Model("z_um", ["expansion(T_room_degC)"]).fit(walk(400)[2])
        self.assertEqual((repr(fit), str(fit)), (fit.summary(), fit.summary()))
        for part in ("Fit of z_um: 400 rows", "gain_um_per_K", "um/K", "RMSE 0.201 um", "noise 0.2015 um", "R²", "log-likelihood", "AIC", "BIC"):
            self.assertIn(part, fit.summary())
        self.assertIn("gain_um_per_K", fit._repr_html_())


class Results(unittest.TestCase):
    def test_what_there_is_nothing_of_is_none(self):
        found = bb.machine_errors(B5R)
        self.assertEqual((found.feed_forecast, found.groups, found.passes), (None, None, None))
        self.assertNotIn("groups", found)
        with self.assertRaisesRegex(AttributeError, "RankedErrors has no conclusions"):
            found.conclusions
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "alone.b5r")
            path.write_text(re.sub(r"<READINGS>.*?</READINGS>", "", pathlib.Path(B5R).read_text(encoding="utf-8-sig"), flags=re.S), encoding="utf-8")
            stored = bb.machine_errors(path)
            self.assertEqual((stored.conclusion, stored.errors), (None, None))

    def test_what_the_package_shows(self):
        names = dir(bb)
        self.assertLessEqual({"fleet", "plot", "sklearn", "Model", "read", "LaggedExpansion", "__version__"}, set(names))
        self.assertFalse({"importlib", "Any", "annotations"} & set(names))
        self.assertFalse([name for name in names if name.startswith("_") and not name.startswith("__")])
        self.assertIn("continues the run of the fit", " ".join((bb.Expansion.__doc__ or "").split()))


@unittest.skipUnless(importlib.util.find_spec("dask"), "Dask is not installed")
class Machines(unittest.TestCase):
    def test_folders_that_are_dates_are_tests(self):
        from ballbar import fleet

        rows = fleet.errors(f"{HISTORY}/*/*.b5r").compute()
        self.assertEqual(rows["machine"].unique().tolist(), ["machine-history"])
        ranked, history = fleet.rank(rows), bb.history(HISTORY)
        self.assertEqual((ranked.to_dict()["judged"], ranked.to_dict()["found"]), (history.judged, history.found))
        self.assertEqual(ranked.findings["sentence"].tolist(), [history.machines[0].findings[0].sentence])
        dates = sorted(str(path) for path in pathlib.Path(HISTORY).iterdir() if path.is_dir())
        self.assertEqual((bb.history(dates).judged, len(bb.history(dates).machines)), (history.judged, 1))

    def test_says_first_that_nothing_could_be_tested(self):
        from ballbar import fleet

        rows = fleet.errors(f"{HISTORY}/*/*.b5r").compute()
        found = fleet.rank(rows, machine=lambda path: path.parts[-2])
        self.assertTrue(found.text.startswith("Nothing could be tested on any of 5 machines: "), found.text)
        self.assertNotIn("No significant change", found.text)


if __name__ == "__main__":
    unittest.main()
