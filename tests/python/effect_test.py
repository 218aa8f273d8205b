"""An effect that is a function of Python is found and fitted as one of the catalogue's, in the call that has it."""
import concurrent.futures
import multiprocessing
import pickle
import unittest

import ballbar as bb
import numpy as np


@bb.effect("cube_of_a_rise", inputs={"temperature": ["degC", "K"]}, gain="gain_um_per_K3", summary="The cube of a rise.", remedy="None.")
def cube(time_s, temperature):
    return (temperature - temperature[0]) ** 3


@bb.effect(
    "swing_after", gain={"sine_um": {"unit": "um"}, "cosine_um": {"unit": "um"}},
    shapes={"period_s": {"start": 5000.0, "lower": 500.0, "upper": 50000.0, "grid": [2000.0, 4000.0, 6000.0, 9000.0], "unit": "s"}},
)
def swing(time_s, period_s):
    phase = 2.0 * np.pi * time_s / period_s
    return np.stack([np.sin(phase), np.cos(phase)])


def room(n=300, seed=1, gain=0.7, noise_um=0.05):
    random = np.random.default_rng(seed)
    time_s = 60.0 * np.arange(n)
    temperature = 20.0 + 2.0 * np.sin(time_s / 4000.0) + 0.8 * np.sin(time_s / 1100.0) + 0.005 * random.standard_normal(n)
    return {"time_s": time_s, "T_room_degC": temperature, "z_um": gain * cube(time_s, temperature) + noise_um * random.standard_normal(n)}


def of(function, data=None, **how):
    """What a model with one effect, made of a function, leaves."""
    how = {"inputs": {"temperature": "degC"}, "gain": "gain_um", **how}
    return bb.Model("z_um", [bb.effect("of_a_test", **how)(function).on("T_room_degC")]).fit(data or room())


def named_of(seed):
    found = bb.Model("z_um").fit(room(seed=seed, gain=0.3, noise_um=0.1)).diagnose(extra=[cube])
    return found.verdict, [one.effect for one in found.named], found.best


class PythonEffect(unittest.TestCase):
    def test_is_fitted(self):
        fit = bb.Model("z_um", [cube.on("T_room_degC")]).fit(room())
        gain = fit.params.set_index("parameter").loc["gain_um_per_K3"]
        self.assertAlmostEqual(gain["value"], 0.7, delta=5.0 * gain["sigma"])
        self.assertLess(gain["sigma"], 0.05)

    def test_is_named_where_it_is_given_and_nowhere_else(self):
        data = room(gain=0.3, noise_um=0.1)
        fit = bb.Model("z_um").fit(data)
        before = fit.diagnose()
        found = fit.diagnose(extra=[cube])
        self.assertEqual((found.verdict, [one.effect for one in found.named]), ("named", ["cube_of_a_rise"]))
        self.assertEqual(found.best, (cube.on("T_room_degC"),))
        better = (fit.model + found.best).fit(data)
        self.assertEqual(better.compare(fit).verdict, "supported")
        self.assertEqual(better.diagnose().verdict, "nothing")
        self.assertEqual(bb.Model("z_um").fit(data).diagnose(), before)  # nothing was registered
        self.assertNotIn("cube_of_a_rise", bb.effects().effects["name"])

    def test_travels_to_threads_and_processes(self):
        expected = [named_of(seed) for seed in (1, 2)]
        self.assertEqual(expected[0][:2], ("named", ["cube_of_a_rise"]))
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            self.assertEqual(list(pool.map(named_of, (1, 2))), expected)
        for start in ("fork", "spawn"):
            with concurrent.futures.ProcessPoolExecutor(2, multiprocessing.get_context(start)) as pool:
                self.assertEqual(list(pool.map(named_of, (1, 2))), expected, start)

    def test_pickled(self):
        fit = bb.Model("z_um", [cube.on("T_room_degC")]).fit(room())
        again = pickle.loads(pickle.dumps(fit))
        self.assertEqual((again, again.model, hash(again.model)), (fit, fit.model, hash(fit.model)))
        self.assertEqual(again.diagnose(), fit.diagnose())
        self.assertEqual(pickle.loads(pickle.dumps(cube)), cube)
        cloud = __import__("cloudpickle") if __import__("importlib.util").util.find_spec("cloudpickle") else pickle
        if cloud is not pickle:
            again = cloud.loads(cloud.dumps(fit.model.effects[0]))
            self.assertEqual((fit.model - again).effects, ())
            self.assertEqual(len(bb.Model("z_um", [again, swing.on()]).fit(room()).diagnose(extra=[cube]).fit.model.functions), 2)
        if cloud is not pickle:  # as Dask sends it: by value where it is of a script, a lambda too
            square = bb.effect("square", inputs={"temperature": "degC"}, gain="gain_um")(lambda time_s, temperature: temperature**2)
            self.assertEqual(cloud.loads(cloud.dumps(square))(0, np.array([3.0])), 9.0)
            self.assertEqual(cloud.loads(cloud.dumps(cube))(0, np.array([1.0, 3.0]))[1], 8.0)
        with self.assertRaisesRegex(bb.BallbarError, "a function of Python; pickle keeps such a model"):
            fit.model.save("never.toml")

    def test_shape_is_fitted(self):
        data = room()
        phase = 2.0 * np.pi * data["time_s"] / 4321.0
        random = np.random.default_rng(2)
        data["z_um"] = 2.0 * np.sin(phase) - np.cos(phase) + 0.1 * random.standard_normal(300)
        value = bb.Model("z_um", [swing.on()]).fit(data).params.set_index("parameter")
        self.assertAlmostEqual(value.loc["period_s", "value"], 4321.0, delta=5.0 * value.loc["period_s", "sigma"])
        self.assertAlmostEqual(value.loc["sine_um", "value"], 2.0, delta=5.0 * value.loc["sine_um", "sigma"])
        held = bb.Model("z_um", [swing.on(period_s=4321.0)]).fit(data).params.set_index("parameter")
        self.assertEqual((held.loc["period_s", "value"], held.loc["period_s", "state"]), (4321.0, "held"))

    def test_faults(self):
        def breaks(time_s, temperature):
            raise RuntimeError("no such thing")

        with self.assertRaisesRegex(bb.BallbarError, "of_a_test: RuntimeError: no such thing$") as caught:
            of(breaks)
        self.assertEqual(repr(caught.exception.__cause__), "RuntimeError('no such thing')")
        self.assertEqual(caught.exception.__cause__.__traceback__.tb_frame.f_code.co_name, "breaks")
        with self.assertRaisesRegex(bb.BallbarError, r"of_a_test: expected an array of shape \(300,\) from its function, found \(299,\)"):
            of(lambda time_s, temperature: temperature[1:])
        with self.assertRaisesRegex(bb.BallbarError, "of_a_test: expected finite values from its function, found others"):
            of(lambda time_s, temperature: temperature * np.nan)
        for end in (KeyboardInterrupt, SystemExit):  # no fault of an effect

            def ends(time_s, temperature, end=end):
                raise end

            with self.assertRaises(end):
                of(ends)
        bad = bb.effect("bad", inputs={"temperature": "degC"}, gain="gain_um")(breaks)
        fit = bb.Model("z_um").fit(room())
        with self.assertRaisesRegex(bb.BallbarError, "bad: RuntimeError"):
            fit.diagnose(extra=[bad])
        fit.diagnose()  # and nothing of it stays
        taken = bb.effect("expansion", inputs={"temperature": "degC"}, gain="gain_um")(lambda time_s, temperature: temperature)
        with self.assertRaisesRegex(bb.BallbarError, "expansion: expected a name of its own"):
            fit.diagnose(extra=[taken])
        other = bb.effect("cube_of_a_rise", inputs={"temperature": "degC"}, gain="gain_um")(lambda time_s, temperature: temperature)
        with self.assertRaisesRegex(bb.BallbarError, "cube_of_a_rise: expected one effect of this name, found two"):
            fit.diagnose(extra=[cube, other])

    def test_shape_of_the_answer(self):
        data = room()
        rise = data["T_room_degC"] - data["T_room_degC"][0]
        data["z_um"] = rise + rise**2 + 0.05 * np.random.default_rng(3).standard_normal(300)
        two = {"a_um": {"unit": "um"}, "b_um": {"unit": "um"}}
        by_gain = np.stack([rise, rise**2])
        self.assertLess(of(lambda time_s, temperature: by_gain, data, gain=two).rmse_um, 0.06)
        self.assertEqual(of(lambda time_s, temperature: rise, data).rmse_um, of(lambda time_s, temperature: rise[None, :], data).rmse_um)
        for answer, gain, found in ((by_gain.T, two, r"\(300, 2\)"), (by_gain.ravel(), two, r"\(600,\)"), (rise[:, None], "gain_um", r"\(300, 1\)"), (1.0, "gain_um", r"\(\)")):
            with self.assertRaisesRegex(bb.BallbarError, "found " + found):
                of(lambda time_s, temperature, answer=answer: answer, data, gain=gain)

    def test_what_is_stated(self):
        for how, message in (
            ({"shapes": {"tau_s": {"strat": 5.0}}}, "shapes, tau_s: expected one of unit, .* found strat"),
            ({"shapes": {"tau_s": {"start": "a"}}}, "tau_s, start: expected a number, found 'a'"), ({"shapes": {"tau_s": 5.0}}, "shapes, tau_s: expected a dict"),
            ({"inputs": ["temperature"]}, "inputs: expected a dict"), ({"inputs": {"temperature": 3}}, "temperature: expected a unit, or several, found 3"),
            ({"summary": 3}, "summary: expected a text, found 3"), ({"gain": {"a_um": {"units": "um"}}}, "gain, a_um: expected one of"),
        ):
            with self.assertRaisesRegex(bb.BallbarError, message):
                bb.effect("stated_wrongly", **how)(lambda time_s: time_s)
        with self.assertRaisesRegex(TypeError, "sumary"):
            bb.effect("stated_wrongly", sumary="a text")
        with self.assertRaisesRegex(TypeError, "expected a function"):
            bb.effect("stated_wrongly")(3)
        for work, message in ((lambda: cube.on(), "a column for each of temperature, found 0"), (lambda: cube.on("T_degC", gain=1.0), "found gain")):
            with self.assertRaisesRegex(bb.UsageError, message):
                work()

    def test_calls_ballbar_itself(self):
        data = room()

        def asks(time_s, temperature):
            bb.Model("z_um").fit({"time_s": time_s, "z_um": temperature})
            return cube(time_s, temperature)

        self.assertEqual(of(asks, data).rmse_um, of(cube.function, data).rmse_um)


if __name__ == "__main__":
    unittest.main()
