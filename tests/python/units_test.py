"""Units, times and options as people write them; what is not known is not said."""
import datetime
import importlib.util
import inspect
import pathlib
import tempfile
import unittest
import warnings

import ballbar as bb
import numpy as np
import pandas

DATA = "sample-runs/hidden-effect/01/data.csv"
ROOM = bb.Model("z_um", ["expansion(T_room_degC)"])


def log(rows=400):
    random = np.random.default_rng(0)
    dates = pandas.date_range("2026-01-05", periods=rows, freq="30s")
    room = 20.0 + np.cumsum(random.normal(0.0, 0.02, rows))
    return pandas.DataFrame({"T_room_degC": room, "z_um": 2.0 * (room - 20.0) + random.normal(0.0, 0.1, rows)}, index=dates)


def gain(fit):
    return fit.params["value"].iloc[1]


class Targets(unittest.TestCase):
    def test_a_length_becomes_um(self):
        table, expected = bb.read(DATA), bb.Model("y_um", ["lagged_expansion(T_motor_degC)"]).fit(DATA)
        sentence = expected.diagnose(seed=1).sentence
        self.assertIn("5 um", sentence)
        for name, in_um in (("y_mm", 1e-3), ("y_m", 1e-6), ("y (mm)", 1e-3), ("y_nm", 1e3)):
            with self.assertLogs("ballbar") as logs:
                fit = bb.Model(name, ["lagged_expansion(T_motor_degC)"]).fit(table.drop(columns="y_um").assign(**{name: in_um * table["y_um"]}))
            self.assertIn(f"{name}: read as y_um, in um", logs.output[0])
            self.assertEqual((fit.target, fit.target_unit, fit.params["unit"].tolist()), ("y_um", "um", ["um", "um/K", "s"]))
            np.testing.assert_allclose(fit.params["value"], expected.params["value"], rtol=1e-5)
            self.assertAlmostEqual(fit.rmse_um, expected.rmse_um, places=6)
            self.assertEqual(fit.diagnose().sentence, sentence)

    def test_its_sigma_too(self):
        table = log().assign(z_um_sigma=0.1)
        expected = ROOM.fit(table)
        in_mm = 1e-3 * table[["z_um", "z_um_sigma"]].rename(columns={"z_um": "z_mm", "z_um_sigma": "z_mm_sigma"})
        fit = bb.Model("z_mm", ROOM.effects).fit(in_mm.assign(T_room_degC=table["T_room_degC"]))
        np.testing.assert_allclose(fit.params[["value", "sigma"]], expected.params[["value", "sigma"]], rtol=1e-5)
        with self.assertRaisesRegex(bb.BallbarError, "expected z_mm in one unit, found z_um too"):
            bb.Model("z_mm", ROOM.effects).fit(table.assign(z_mm=1.0 * table["z_um"]))

    def test_another_unit_is_carried(self):
        """Names, units and sentences are of the target; um stands nowhere."""
        table = bb.read(DATA)
        fit = bb.Model("T_motor_degC", ["expansion(T_room_degC)"]).fit(table)
        self.assertEqual(fit.params["unit"].tolist(), ["degC", "degC/K"])
        self.assertEqual((fit.residuals.name, fit.measured.name), ("residual_degC", "measured_degC"))
        self.assertGreater(fit.rmse_degC, fit.noise.white_degC)
        for wrong in (lambda: fit.rmse_um, lambda: fit.noise.white_um):
            with self.assertRaisesRegex(AttributeError, "_degC"):
                wrong()
        found = fit.diagnose()
        for text in (found.sentence, fit.summary(), *fit.sentences):
            self.assertNotRegex(text, r"(?<![\w])um(?!\w)")
        self.assertRegex(found.sentence, r"\d degC")
        self.assertEqual(fit.plot().get_ylabel() if has_matplotlib() else "T_motor_degC, °C", "T_motor_degC, °C")
        bare = bb.Model("power", ["expansion(T_room_degC)"]).fit(table.assign(power=table["y_um"]))
        self.assertEqual((bare.target_unit, bare.params["unit"].tolist()), ("", ["units", "units/K"]))
        self.assertGreater(bare.rmse, 0.0)


def has_matplotlib():
    return importlib.util.find_spec("matplotlib") is not None


class Columns(unittest.TestCase):
    def test_units_as_people_write_them(self):
        table = log()
        expected, bare = gain(ROOM.fit(table)), table.rename(columns={"T_room_degC": "T_room"})
        for unit in ("°C", "C", "degC"):
            self.assertAlmostEqual(gain(ROOM.fit(bare, units={"T_room": unit})), expected, places=9)
        fahrenheit = bare.assign(T_room=32.0 + 1.8 * bare["T_room"])
        for unit in ("degF", "°F", "F"):
            self.assertAlmostEqual(gain(ROOM.fit(fahrenheit, units={"T_room": unit})), expected, places=6)
        for name in ("T_room_degF", "T_room (°F)"):
            fit = bb.Model("z_um", [bb.Expansion(name)]).fit(fahrenheit.rename(columns={"T_room": name}))
            self.assertAlmostEqual(gain(fit), expected, places=6)
        for name in ("T_room_C", "T_room °C"):
            self.assertAlmostEqual(gain(bb.Model("z_um", [bb.Expansion(name)]).fit(bare.rename(columns={"T_room": name}))), expected, places=9)
        self.assertIsNotNone(ROOM.fit(table.assign(phase_C=1.0, op_a=2.0)))  # no temperature, no current
        with self.assertRaisesRegex(bb.UsageError, 'units: expected a unit such as um, .* found "furlong" for T_room'):
            ROOM.fit(bare, units={"T_room": "furlong"})

    def test_a_column_of_texts_that_the_model_reads(self):
        table = log()
        comma = table.assign(T_room_degC=[f"{value:.3f}".replace(".", ",") for value in table["T_room_degC"]])
        with self.assertRaisesRegex(bb.BallbarError, r"T_room_degC, row 0: expected a number, found '20,003'; pandas.to_numeric\(table\['T_room_degC'\].str.replace"):
            ROOM.fit(comma)
        with self.assertRaisesRegex(bb.BallbarError, "z_um, row 0: expected a number, found 'a'"):
            ROOM.fit(table.assign(z_um="a"))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            ROOM.fit(table.assign(note="a"))
        self.assertIn("note", str(caught[0].message))
        with self.assertRaisesRegex(TypeError, "found an array, whose columns have no names"):
            ROOM.fit(table.to_numpy())


class Times(unittest.TestCase):
    def test_times_as_people_have_them(self):
        table = log()
        expected = gain(ROOM.fit(table))
        rows = table.reset_index(drop=True)
        for every in (pandas.Timedelta("30s"), datetime.timedelta(seconds=30), np.timedelta64(30, "s"), "30s", 30):
            self.assertAlmostEqual(gain(ROOM.fit(rows, every=every)), expected, places=9)
        texts = table.rename_axis("when").reset_index().astype({"when": str})
        for one in (table.to_period("S"), texts, texts.set_index("when")):
            self.assertAlmostEqual(gain(ROOM.fit(one)), expected, places=9)
        with self.assertRaisesRegex(bb.BallbarError, "time_s: expected a column of that name"):
            ROOM.fit(texts.assign(when=table.index.strftime("%d/%m/%Y %H:%M:%S")))  # nobody knows which is the month

    def test_a_file_without_times(self):
        """Its rows are numbered: an effect with a time constant is refused, and no second is said."""
        lagged = bb.Model("z_um", ["lagged_expansion(T_room_degC)"])
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "log.csv")
            log().to_csv(path, index=False)
            table = bb.read(path)
            self.assertEqual((table.index.name, table.index[1]), ("row", 1))
            for data in (table, path):
                with self.assertRaisesRegex(bb.BallbarError, 'numbered rows; every="10s" states how far apart they are'):
                    lagged.fit(data)
                self.assertEqual(ROOM.fit(data).n, 400)
            fit = ROOM.fit(table)
            np.testing.assert_allclose(fit.predict(table.iloc[50:])["z_um"], fit.fitted.iloc[50:], atol=1e-9)
            timed = bb.read(path, every="30s")
            self.assertEqual((timed.index.name, timed.index[1]), ("time_s", 30.0))
            for every in (30, datetime.timedelta(seconds=30)):
                pandas.testing.assert_frame_equal(bb.read(path, every=every), timed)
            self.assertEqual(lagged.fit(table, every="30s").params["value"].tolist(), lagged.fit(timed).params["value"].tolist())

    def test_gaps(self):
        """A row in a gap is left out, and the remark names the argument; a longer gap may be allowed."""
        table = log()
        table.iloc[100:160, 0] = np.nan
        with self.assertLogs("ballbar") as logs:
            self.assertEqual(ROOM.fit(table).n, 340)
        self.assertIn("60 rows left out, because T_room_degC has no value there within 10 min. State a longer max_gap_s", logs.output[0])
        self.assertEqual(ROOM.fit(table.dropna()).n, 340)
        self.assertEqual(ROOM.fit(table, max_gap_s=3600.0).n, 400)
        table.iloc[50:350, 0] = np.nan
        with self.assertRaisesRegex(bb.BallbarError, "max_gap_s"):
            ROOM.fit(table)


class Options(unittest.TestCase):
    def test_hold(self):
        table = log()
        for key in ("gain_um_per_K", "expansion(T_room_degC).gain_um_per_K"):
            self.assertEqual(ROOM.fit(table, hold={key: 2.0}).params.loc[1, ["value", "state"]].tolist(), [2.0, "held"])
        with self.assertRaisesRegex(bb.UsageError, r'hold: expected a parameter of the model, one of expansion\(T_room_degC\).gain_um_per_K, constant_um, found "gain"\.'):
            ROOM.fit(table, hold={"gain": 2.0})
        two = bb.Model("z_um", ["expansion(T_room_degC)", "day_cycle", "lagged_expansion(T_room_degC)"])
        with self.assertRaisesRegex(bb.UsageError, 'found "gain_um_per_K", of 2 effects'):
            two.fit(table, hold={"gain_um_per_K": 2.0})

    def test_models(self):
        self.assertEqual(ROOM + bb.Model("z_um", ["day_cycle"]), ROOM + "day_cycle")
        with self.assertRaisesRegex(bb.BallbarError, "expected a model of z_um, found one of x_um"):
            ROOM + bb.Model("x_um", ["day_cycle"])
        for twice in (lambda: bb.Model("z_um", ["expansion(T_room_degC)"] * 2), lambda: ROOM + "expansion(T_room_degC)"):
            with self.assertRaisesRegex(bb.BallbarError, r"expected each once, found expansion\(T_room_degC\) twice"):
                twice()

    def test_one_spelling(self):
        """Of what a fit and the functions of the program's commands both take."""
        if importlib.util.find_spec("sklearn"):
            self.assertIn("every", inspect.signature(bb.sklearn.EffectRegressor).parameters)
        for function in (bb.import_log, bb.drift, bb.circles, bb.compare, bb.Model.fit):
            names = set(inspect.signature(function).parameters)
            self.assertLessEqual({"units", "roles", "every"}, names, function.__name__)
            self.assertFalse({"unit", "role", "every_s"} & names, function.__name__)


if __name__ == "__main__":
    unittest.main()
