"""Tables as users have them."""
import pathlib
import pickle
import tempfile
import unittest
import warnings

import ballbar as bb
import numpy as np
import pandas

DATA = "sample-runs/hidden-effect/01/data.csv"
MODEL = bb.Model.load("sample-runs/hidden-effect/01/model.toml")


class Interchange:
    """What polars offers: __dataframe__, and nothing of pandas."""

    def __init__(self, table):
        self._table = table

    def __dataframe__(self, **how):
        return self._table.__dataframe__(**how)


class Xarray:
    def __init__(self, table):
        self._table = table

    def to_dataframe(self):
        return self._table


class Tables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.table = bb.read(DATA)
        cls.expected = MODEL.fit(DATA).rmse_um

    def test_any_index(self):
        table, time_s = self.table, self.table.index.to_numpy()
        dates = pandas.Timestamp("2026-11-22T13:05:10") + pandas.to_timedelta(time_s, unit="s")
        for index in (dates, dates.tz_localize("Europe/Berlin"), pandas.to_timedelta(time_s, unit="s"), pandas.Index(time_s / 60.0, name="time_min")):
            one = table.set_axis(index)
            fit = MODEL.fit(one)
            self.assertAlmostEqual(fit.rmse_um, self.expected, places=9)
            self.assertTrue(fit.residuals.index.equals(one.index))
            self.assertTrue(fit.predict().index.equals(one.index))
            self.assertTrue(fit.predict(one.iloc[:40]).index.equals(one.index[:40]))
        plain = table.reset_index(drop=True)
        self.assertAlmostEqual(MODEL.fit(plain, every="60s").rmse_um, self.expected, places=9)
        self.assertAlmostEqual(MODEL.fit(plain, every=60).rmse_um, self.expected, places=9)
        self.assertEqual(MODEL.fit(table.reset_index()).rmse_um, self.expected)  # time_s as a column
        self.assertAlmostEqual(MODEL.fit(plain.assign(when=dates)).rmse_um, self.expected, places=9)
        with self.assertRaisesRegex(bb.BallbarError, "^time_s: expected a column of that name .* every="):
            MODEL.fit(plain)

    def test_columns_that_are_no_numbers_are_left_out_by_name(self):
        beside = self.table.assign(note="cold", good=True, when=pandas.Timestamp("2026-01-01"), kind=pandas.Categorical(["a"] * len(self.table)))
        with self.assertWarnsRegex(bb.BallbarWarning, "note, good, when, kind"):
            self.assertEqual(MODEL.fit(beside).rmse_um, self.expected)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            MODEL.fit(self.table)
        mixed = self.table.astype({"T_motor_degC": object})
        mixed.iloc[3, list(mixed).index("T_motor_degC")] = "cold"
        with self.assertRaisesRegex(bb.BallbarError, '^T_motor_degC, row 3: expected a number, found "cold"'):
            MODEL.fit(mixed)

    def test_kinds_of_tables(self):
        table = self.table.reset_index()
        for one in (table.convert_dtypes(), Interchange(table), Xarray(table), {name: table[name].to_numpy() for name in table},
                    {name: list(table[name]) for name in table}, table.astype(np.float32).astype(float).assign(**table)):
            self.assertEqual(MODEL.fit(one).rmse_um, self.expected)
        masked = {**table, "y_um": np.ma.array(table["y_um"], mask=np.arange(len(table)) % 7 == 0)}
        self.assertEqual(len(MODEL.fit(masked).residuals), len(table) - len(range(0, len(table), 7)))
        with self.assertRaisesRegex(bb.BallbarError, "expected columns of one length"):
            MODEL.fit({"time_s": [0.0, 1.0], "y_um": [1.0]})
        with self.assertRaisesRegex(TypeError, "expected a path, a DataFrame"):
            MODEL.fit(3)

    def test_units_and_roles(self):
        bare = self.table.rename(columns={"y_um": "y", "T_motor_degC": "motor"})
        model = bb.Model("y_um", ["lagged_expansion(motor_degC)"])
        self.assertEqual(model.fit(bare, units={"y": "um", "motor": "degC"}).rmse_um, self.expected)
        with self.assertRaisesRegex(bb.BallbarError, 'units: expected names of columns, found "z"'):
            model.fit(bare, units={"z": "um"})
        self.assertEqual(self.table.attrs["roles"]["T_room_degC"], "ambient")
        self.assertEqual(self.table.attrs["units"]["speed_rpm"], "rpm")
        with self.assertRaisesRegex(bb.BallbarError, "expected a role"):
            MODEL.fit(self.table, roles={"T_room_degC": "weather"})
        with self.assertRaisesRegex(bb.BallbarError, 'roles: expected names of columns, found "no_degC"'):
            MODEL.fit(self.table, roles={"no_degC": "ambient"})

    def test_what_would_be_taken_for_something_else(self):
        for work, message in (
            (lambda: MODEL.fit(self.table.assign(y=1.0), units={"y": "um"}), 'found two columns "y_um"'),
            (lambda: MODEL.fit(self.table, every="60s"), "every: expected a table without times, found time_s"),
            (lambda: MODEL.fit(self.table.set_axis(pandas.date_range("2026", periods=len(self.table), freq="60s")), every=60), "an index of them"),
        ):
            with self.assertRaisesRegex(bb.BallbarError, message):
                work()
        with self.assertRaisesRegex(TypeError, "found TextIOWrapper"), open(DATA, encoding="utf-8") as file:
            MODEL.fit(file)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            MODEL.fit(self.table.assign(note="cold"))
        self.assertEqual(pathlib.Path(caught[0].filename).name, "frame_test.py")

    def test_sigma_of_a_column(self):
        """Stands at the end of the name in Python, before the unit in files."""
        table = self.table.assign(y_um_sigma=0.3)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "series.csv")
            bb.write(table, path)
            self.assertIn("y_sigma_um", path.read_text(encoding="utf-8"))
            again = bb.read(path)
            self.assertEqual(MODEL.fit(path).rmse_um, MODEL.fit(table).rmse_um)
        self.assertIn("y_um_sigma", again)
        pandas.testing.assert_frame_equal(again[list(table)], table, check_exact=True)
        self.assertEqual(again.attrs["roles"]["T_room_degC"], "ambient")

    def test_logs(self):
        log = bb.read("sample-runs/foreign-logs/warmup.csv")
        self.assertEqual(log.attrs["started"], "2026-11-22T13:05:10")
        joined = bb.read(["sample-runs/foreign-logs/probes.csv", "sample-runs/foreign-logs/control.csv"])
        self.assertEqual(joined.shape, (2378, 8))
        with self.assertRaisesRegex(TypeError, "nonsense"):
            bb.read("sample-runs/foreign-logs/warmup.csv", nonsense=1)
        with self.assertRaises(bb.BallbarError) as caught:
            bb.read("nowhere.csv")
        self.assertEqual(caught.exception.file, "nowhere.csv")

    def test_nothing_of_the_callers_is_changed(self):
        before = pickle.dumps(self.table)
        fit = MODEL.fit(self.table)
        fit.residuals.iloc[0] = 99.0  # of a copy
        self.assertLess(abs(fit.residuals.iloc[0]), 9.0)
        fit.diagnose()
        fit.predict(self.table)
        self.assertEqual(pickle.dumps(self.table), before)


if __name__ == "__main__":
    unittest.main()
