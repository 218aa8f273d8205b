"""Models, fits and diagnoses are values: computed once, never changed, pickled whole."""
import copy
import os
import pathlib
import pickle
import tempfile
import unittest

import ballbar as bb
import numpy as np
import pandas

HIDDEN = "sample-runs/hidden-effect/01"
HE = "sample-runs/two-arcs-he2015"


def hidden():
    return bb.Model.load(f"{HIDDEN}/model.toml"), bb.read(f"{HIDDEN}/data.csv")


class Models(unittest.TestCase):
    def test_effects_as_text_and_as_classes(self):
        by_text = bb.Model("y_um", ["lagged_expansion(T_motor_degC)"])
        self.assertEqual(by_text, bb.Model("y_um", [bb.LaggedExpansion("T_motor_degC")]))
        self.assertEqual(by_text, bb.Model("y_um", "lagged_expansion(temperature=T_motor_degC)"))
        stated = bb.Model("y_um", [bb.LaggedExpansion("T_motor_degC", gain_um_per_K=2.0, time_constant_s=bb.free(1800.0, upper=7200.0))])
        self.assertIn("gain_um_per_K = 2.0", stated.text)
        self.assertIn("time_constant_s = { start = 1800.0, lower = 10.0, upper = 7200.0 }", stated.text)
        self.assertEqual(stated.effects[0].parameters["time_constant_s"], bb.free(1800.0, lower=10.0, upper=7200.0))
        self.assertNotEqual(stated, by_text)
        two = bb.Model(["x_um", "y_um"], [bb.Expansion("T1_degC"), bb.Expansion("T2_degC"), bb.Step(onset_s=bb.free(60.0))])
        self.assertEqual((two.targets, len(two.effects)), (("x_um", "y_um"), 3))
        formula = bb.Model("z_um", [bb.Expression("k * lag(T_oil_degC - T_air_degC, tau)", k=bb.free(0.0, unit="um/K"), tau=bb.free(600.0, lower=10.0, unit="s"))])
        self.assertIn('unit = "um/K"', formula.text)
        for model in (by_text, stated, two, formula, bb.Model(of_recordings=True, effects=[bb.ScaleMismatch()])):
            self.assertEqual((pickle.loads(pickle.dumps(model)), hash(pickle.loads(pickle.dumps(model)))), (model, hash(model)))
            self.assertEqual(copy.deepcopy(model), model)

    def test_adding_makes_another(self):
        model = bb.Model("y_um")
        more = model + "expansion(T_room_degC)" + bb.Settling()
        self.assertEqual((len(model.effects), [one.name for one in more.effects]), (0, ["expansion", "settling"]))
        self.assertEqual(more - bb.Settling() - "expansion(T_room_degC)", model)
        with self.assertRaisesRegex(bb.BallbarError, "expected an effect of the model, one of none, found settling"):
            model - bb.Settling()
        for change in (lambda: setattr(model, "text", ""), lambda: setattr(more.effects[0], "name", "x")):
            with self.assertRaisesRegex(AttributeError, "cannot be changed"):
                change()

    def test_faults(self):
        for work, message in (
            (lambda: bb.Model("y_um", ["lagged_expansio(T_degC)"]), "the nearest is lagged_expansion"),
            (lambda: bb.Model("y_um", ["lagged_expansion"]), "expected a column for temperature"),
            (lambda: bb.Model("y_um", [bb.LaggedExpansion("T_degC", time_constant_s=bb.free(-5.0))]), "expected a start from 10 to 200000"),
            (lambda: bb.LaggedExpansion("T_degC", time_constant_s="slow"), "expected a number, which is held, or free"),
            (lambda: bb.Model([]), "at least one column for target"),
        ):
            with self.assertRaisesRegex(bb.BallbarError, message):
                work()
        with self.assertRaisesRegex(TypeError, "time_constant"):
            bb.LaggedExpansion("T_degC", time_constant=3.0)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "model.toml")
            path.write_text('format = "ballbar-model 1"\ntarget = "y_um"\n[[effect]]\nname = "no"\n', encoding="utf-8")
            with self.assertRaises(bb.BallbarError) as caught:
                bb.Model.load(path)
            self.assertEqual((caught.exception.file, caught.exception.line), (str(path), 4))

    def test_only_save_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "model.toml")
            model = bb.Model("y_um", ["lagged_expansion(T_motor_degC)"])
            model.save(path)
            before = path.read_bytes()
            loaded = bb.Model.load(path)
            fit = loaded.fit(f"{HIDDEN}/data.csv")
            (loaded + fit.diagnose().best).fit(f"{HIDDEN}/data.csv").compare(fit)
            self.assertEqual((loaded, path.read_bytes(), os.listdir(folder)), (model, before, ["model.toml"]))


class Fits(unittest.TestCase):
    def test_arrays_belong_to_the_rows(self):
        model, table = hidden()
        table.loc[table.index[10:20], "y_um"] = np.nan
        fit = model.fit(table)
        self.assertEqual(len(fit.residuals), len(table) - 10)
        self.assertTrue(fit.residuals.index.equals(table.index[table["y_um"].notna()]))
        np.testing.assert_allclose(fit.measured - fit.fitted, fit.residuals, atol=1e-12)
        np.testing.assert_array_equal(fit.measured, table["y_um"].dropna())
        self.assertAlmostEqual(float(np.sqrt((fit.residuals**2).mean())), fit.rmse_um, places=12)
        constant = fit.params.set_index("parameter").loc["constant_um", "value"]
        np.testing.assert_allclose(fit.contributions.sum(axis=1) + constant, fit.fitted, atol=1e-9)
        np.testing.assert_allclose(np.sqrt(np.diag(fit.cov)), fit.params["sigma"])
        self.assertEqual(list(fit.params), ["effect", "parameter", "value", "sigma", "low", "high", "unit", "state"])
        self.assertLess(fit.params["low"].iloc[1], fit.params["value"].iloc[1])
        self.assertEqual(set(fit.where["what"]) & {"regime", "time"}, {"regime", "time"})
        with self.assertRaisesRegex(AttributeError, "Fit has no rms_um; it has target, target_unit, rmse_um"):
            fit.rms_um
        with self.assertRaisesRegex(AttributeError, "cannot be changed"):
            fit.rmse_um = 0.0

    def test_the_sigma_of_a_prediction_is_that_of_repetition(self):
        """Predicted sigma against the scatter of predictions over new noise."""
        time_s = 60.0 * np.arange(200)
        room = 20.0 + np.sin(time_s / 2000.0)
        model, random = bb.Model("z_um", ["expansion(T_room_degC)"]), np.random.default_rng(5)
        runs = []
        for _ in range(200):
            table = {"time_s": time_s, "T_room_degC": room, "z_um": 3.0 * (room - 20.0) + 0.2 * random.standard_normal(200)}
            runs.append(model.fit(table, white=True).predict())
        scatter = np.std([run["z_um"] for run in runs], axis=0)
        stated = np.mean([run["z_um_sigma"] for run in runs], axis=0)
        self.assertLess(np.abs(np.log(scatter / stated)).max(), 0.25)  # 200 runs tell it to 5 %

    def test_pickled_and_copied_whole(self):
        model, table = hidden()
        fit = model.fit(table, robust=True)
        found = fit.diagnose()
        for again in (pickle.loads(pickle.dumps(found)), copy.deepcopy(found)):
            self.assertEqual((again, again.best, again.fit), (found, found.best, fit))
            pandas.testing.assert_series_equal(again.fit.residuals, fit.residuals)
            self.assertEqual(again._repr_html_(), found._repr_html_())
            self.assertEqual(again.fit._repr_html_(), fit._repr_html_())
            self.assertEqual(again.fit.diagnose(), found)
        self.assertEqual(found._repr_html_().count("<svg"), 1)

    def test_pictures_are_of_the_result_not_of_the_file(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "data.csv")
            path.write_bytes(pathlib.Path(f"{HIDDEN}/data.csv").read_bytes())
            fit = bb.Model.load(f"{HIDDEN}/model.toml").fit(path)
            before = fit._repr_html_()
            path.write_text("time_s,y_um\n0,1\n", encoding="utf-8")
            self.assertEqual(fit._repr_html_(), before)

    def test_whole_of_files(self):
        """A fit of a file knows no other file of that name: nor does its copy."""
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "data.csv")
            path.write_bytes(pathlib.Path(f"{HIDDEN}/data.csv").read_bytes())
            fit = hidden()[0].fit(path)
            dumped, found, tested = pickle.dumps(fit), fit.diagnose(), fit.test("expansion(T_room_degC)")
            path.unlink()
            for one in (fit, pickle.loads(dumped)):
                self.assertEqual((one.diagnose(), one.test("expansion(T_room_degC)")), (found, tested))
                self.assertEqual(one.could().n, fit.n)
        recordings = [f"sample-runs/qc20-style-b5r/0{k}.b5r" for k in (0, 3)]
        model = bb.Model(of_recordings=True, effects=["scale_mismatch"])
        self.assertEqual(pickle.loads(pickle.dumps(model.fit(recordings))).could(), bb.could(recordings, model=model))
        self.assertEqual(model.fit(bb.read_recordings(recordings[0])).could().n, 4000)

    def test_nothing_inside_can_be_changed(self):
        model, table = hidden()
        fit = model.fit(table)
        before = pickle.dumps(fit)
        fit.to_dict()["sentences"].append("")
        fit.sentences.append("")
        for array in (fit.correlation, fit.whiteness.autocorrelation):
            with self.assertRaises(ValueError):
                array[0] = 9.0
        with self.assertRaises(TypeError):
            model.effects[0].columns["temperature"] = "x"
        for name in ("text", "model"):
            with self.assertRaises(AttributeError):
                delattr(fit if name == "model" else model, name)
        self.assertEqual(pickle.dumps(fit), before)
        self.assertIsInstance(pickle.loads(pickle.dumps(model)).effects[0], bb.LaggedExpansion)

    def test_several_runs(self):
        model, table = hidden()
        fit = model.fit([table.iloc[:500], table.iloc[600:900]])
        self.assertEqual((list(fit.index.names), fit.index[500]), (["run", "time_s"], (1, 0.0)))
        self.assertEqual(fit.measured.to_numpy()[500], table["y_um"].iloc[600])
        self.assertEqual(len(fit.plot().lines), 3)

    def test_rows_without_an_input(self):
        model, table = hidden()
        table.iloc[:20, list(table).index("T_motor_degC")] = np.nan
        fit = model.fit(table)
        self.assertEqual(fit.predict().index[0], table.index[20])
        np.testing.assert_array_equal(fit.measured, table["y_um"].loc[fit.index])

    def test_arguments(self):
        model, table = hidden()
        fit = model.fit(table)
        for work, message in (
            (lambda: model.fit([]), "data: expected a table, a path or recordings, found none"), (lambda: fit.predict([]), "data: expected"),
            (lambda: model.fit(table, robust="no"), "robust: expected True or False"), (lambda: model.fit(table, target=["y_um"]), "one column"),
            (lambda: model.fit(table, max_gap_s="10min"), "max_gap_s: expected a number"), (lambda: model.fit(table, max_gap_s=np.nan), "max_gap_s"),
            (lambda: fit.diagnose(most_rows=0), "most_rows: expected a whole number from 30 to 5000"),
            (lambda: fit.diagnose(tolerance_um=-1), "tolerance_um"), (lambda: fit.test([]), "effects: expected one"),
            (lambda: model.predict(table), "expected all parameters to be held"), (lambda: model.fit(table, hold={"gain": "x"}), "gain: expected a number"),
        ):
            with self.assertRaisesRegex(bb.BallbarError, message):
                work()
        self.assertEqual(model.fit(table, hold={"constant_um": 1.0}).params["value"][0], 1.0)
        gap = table.drop(table.index[100:130])
        self.assertEqual(model.fit(gap, max_gap_s=5000.0).could().n, len(gap))

    def test_compare(self):
        model, table = hidden()
        fit = model.fit(table)
        better = (model + "lagged_expansion(T_room_degC)").fit(table)
        found = better.compare(fit)
        self.assertEqual((found.verdict, found.before.rmse_um), ("supported", fit.rmse_um))
        self.assertAlmostEqual(found.after.rmse_um, better.rmse_um, places=9)
        for work, message in (
            (lambda: fit.compare(better), "whose model is part of this one's"), (lambda: fit.compare(fit), "expected a fit of a smaller model"),
            (lambda: better.compare(model.fit(table, robust=True)), "without robust, white and hold"),
            (lambda: better.compare(bb.Model("y_um", [bb.LaggedExpansion("T_motor_degC", time_constant_s=5000.0)]).fit(table)), "or holds otherwise"),
            (lambda: better.compare(model.fit(table.assign(T_room_degC=20.0))), "expected a fit of the same data and target"),
            (lambda: better.compare(model.fit(table.iloc[:500])), "expected a fit of the same data and target"),
        ):
            with self.assertRaisesRegex(bb.BallbarError, message):
                work()

    def test_several_targets(self):
        model, table = hidden()
        both = model.with_target(["x_um", "y_um"])
        with self.assertRaisesRegex(bb.BallbarError, r"expected one, found x_um, y_um; fit\(..., target=...\) chooses one"):
            both.fit(table)
        self.assertEqual(both.fit(table, target="y_um").to_dict(), both.fit_all(table)["y_um"].to_dict())

    def test_recordings(self):
        recordings = bb.read_recordings("sample-runs/qc20-style-b5r/00.b5r")
        fit = bb.Model(of_recordings=True, effects=["scale_mismatch"]).fit(recordings)
        value = fit.params.set_index("parameter").loc["mismatch_um"]
        self.assertAlmostEqual(value["value"], 8.0, delta=0.2)
        self.assertEqual(pickle.loads(pickle.dumps(fit)), fit)

    def test_a_plan_and_what_could_be_seen(self):
        model, table = hidden()
        fit = model.fit(table)
        self.assertIn("lagged_expansion", fit.could().effects["effect"])
        square = bb.effect("square_of_a_rise", inputs={"temperature": "degC"}, gain="gain_um_per_K2")(lambda time_s, temperature: (temperature - temperature[0]) ** 2)
        own = (model + square.on("T_room_degC")).fit(table)
        self.assertIn("square_of_a_rise", own.could().effects["effect"])
        told = []
        self.assertIn(fit.plan(hours=4, progress=lambda *step: told.append(step)).verdict, ("named", "probable"))
        self.assertTrue(told and all(len(step) == 3 for step in told))


if __name__ == "__main__":
    unittest.main()
