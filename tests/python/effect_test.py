"""An effect that is a function of Python is found and fitted as one of the catalogue's."""
import unittest

import ballbar
import numpy as np


@ballbar.effect("cube_of_a_rise", inputs={"temperature": ["degC", "K"]}, gain="gain_um_per_K3", summary="The cube of a rise.",
                remedy="None.")
def cube(time_s, temperature):
    return (temperature - temperature[0]) ** 3


@ballbar.effect(
    "swing_after", gain={"sine_um": {"unit": "um"}, "cosine_um": {"unit": "um"}},
    shapes={"period_s": {"start": 5000.0, "lower": 500.0, "upper": 50000.0, "grid": [2000.0, 4000.0, 6000.0, 9000.0], "unit": "s"}},
)
def swing(time_s, period_s):
    phase = 2.0 * np.pi * time_s / period_s
    return np.stack([np.sin(phase), np.cos(phase)])


def room(n=300, seed=1):
    random = np.random.default_rng(seed)
    time_s = 60.0 * np.arange(n)
    temperature = 20.0 + 2.0 * np.sin(time_s / 4000.0) + 0.8 * np.sin(time_s / 1100.0)
    return time_s, temperature + 0.005 * random.standard_normal(n), random


class PythonEffect(unittest.TestCase):
    def test_is_fitted(self):
        time_s, temperature, random = room()
        data = ballbar.Series(time_s, {"T_room_degC": temperature, "z_um": 0.7 * cube(time_s, temperature) + 0.05 * random.standard_normal(300)})
        found = ballbar.check(data, ballbar.Model.of("z_um", cube_of_a_rise={"temperature": "T_room_degC"}))
        gain = next(one for one in found.parameters if one.name == "gain_um_per_K3")
        self.assertAlmostEqual(gain.value, 0.7, delta=5.0 * gain.sigma)
        self.assertLess(gain.sigma, 0.05)

    def test_is_named(self):
        time_s, temperature, random = room()
        data = ballbar.Series(time_s, {"T_room_degC": temperature, "z_um": 0.3 * cube(time_s, temperature) + 0.1 * random.standard_normal(300)})
        found = ballbar.diagnose(data, ballbar.Model.of("z_um"))
        self.assertEqual(found.verdict, "named")
        self.assertEqual([one.effect for one in found.named], ["cube_of_a_rise"])

    def test_shape_is_fitted(self):
        time_s, _, random = room()
        phase = 2.0 * np.pi * time_s / 4321.0
        data = ballbar.Series(time_s, {"z_um": 2.0 * np.sin(phase) - np.cos(phase) + 0.1 * random.standard_normal(300)})
        found = ballbar.check(data, ballbar.Model.of("z_um", "swing_after"))
        value = {one.name: one for one in found.parameters}
        self.assertAlmostEqual(value["period_s"].value, 4321.0, delta=5.0 * value["period_s"].sigma)
        self.assertAlmostEqual(value["sine_um"].value, 2.0, delta=5.0 * value["sine_um"].sigma)

    def test_faults(self):
        @ballbar.effect("breaks", inputs={"temperature": "degC"}, gain="gain_um")
        def breaks(time_s, temperature):
            raise RuntimeError("no such thing")

        @ballbar.effect("short", inputs={"temperature": "degC"}, gain="gain_um")
        def short(time_s, temperature):
            return temperature[1:]

        time_s, temperature, _ = room()
        data = ballbar.Series(time_s, {"T_room_degC": temperature, "z_um": temperature})
        with self.assertRaisesRegex(ballbar.BallbarError, "breaks: RuntimeError: no such thing$") as caught:
            ballbar.check(data, ballbar.Model.of("z_um", breaks={"temperature": "T_room_degC"}))
        self.assertEqual(repr(caught.exception.__cause__), "RuntimeError('no such thing')")
        self.assertEqual(caught.exception.__cause__.__traceback__.tb_frame.f_code.co_name, "breaks")
        with self.assertRaisesRegex(ballbar.BallbarError, r"short: expected an array of shape \(300,\) from its function, found \(299,\)"):
            ballbar.check(data, ballbar.Model.of("z_um", short={"temperature": "T_room_degC"}))
        with self.assertRaisesRegex(ballbar.BallbarError, "expansion: expected a name of its own"):
            ballbar.effect("expansion")(breaks)
        for end in (KeyboardInterrupt, SystemExit):  # no fault of an effect

            @ballbar.effect("breaks", inputs={"temperature": "degC"}, gain="gain_um")
            def ends(time_s, temperature, end=end):
                raise end

            with self.assertRaises(end):
                ballbar.check(data, ballbar.Model.of("z_um", breaks={"temperature": "T_room_degC"}))
        # They would be searched too: quiet ones in their place.
        for name in ("breaks", "short"):
            ballbar.effect(name, inputs={"temperature": "bar"}, gain="gain_um")(lambda time_s, pressure: pressure)

    def test_shape_of_the_answer(self):
        time_s, temperature, random = room()
        rise = temperature - temperature[0]
        data = ballbar.Series(time_s, {"T_room_degC": temperature, "z_um": rise + rise**2 + 0.05 * random.standard_normal(300)})

        def left(answer, **gains):
            ballbar.effect("answers", inputs={"temperature": "degC"}, gain=gains or "gain_um")(lambda time_s, temperature: answer)
            return ballbar.check(data, ballbar.Model.of("z_um", answers={"temperature": "T_room_degC"})).rmse_um

        two = {"a_um": {"unit": "um"}, "b_um": {"unit": "um"}}
        by_gain = np.stack([rise, rise**2])
        self.assertLess(left(by_gain, **two), 0.06)
        self.assertEqual(left(rise), left(rise[None, :]))
        for answer, gains, found in ((by_gain.T, two, "(300, 2)"), (by_gain.ravel(), two, "(600,)"), (rise[:, None], {}, "(300, 1)"), (1.0, {}, "()")):
            with self.assertRaisesRegex(ballbar.BallbarError, "found " + found.replace("(", r"\(").replace(")", r"\)")):
                left(answer, **gains)
        ballbar.effect("answers", inputs={"temperature": "bar"}, gain="gain_um")(lambda time_s, pressure: pressure)

    def test_what_is_stated(self):
        for how, message in (
            ({"shapes": {"tau_s": {"strat": 5.0}}}, "shapes, tau_s: expected one of unit, .* found strat"),
            ({"shapes": {"tau_s": {"start": "a"}}}, "tau_s, start: expected a number, found 'a'"), ({"shapes": {"tau_s": 5.0}}, "shapes, tau_s: expected a dict"),
            ({"inputs": ["temperature"]}, "inputs: expected a dict"), ({"inputs": {"temperature": 3}}, "temperature: expected a unit, or several, found 3"),
            ({"summary": 3}, "summary: expected a text, found 3"), ({"gain": {"a_um": {"units": "um"}}}, "gain, a_um: expected one of"),
        ):
            with self.assertRaisesRegex(ballbar.BallbarError, message):
                ballbar.effect("stated_wrongly", **how)(lambda time_s: time_s)
        with self.assertRaisesRegex(TypeError, "sumary"):
            ballbar.effect("stated_wrongly", sumary="a text")
        with self.assertRaisesRegex(TypeError, "expected a function"):
            ballbar.effect("stated_wrongly")(3)

    def test_calls_ballbar_itself(self):
        time_s, temperature, random = room()
        data = {"time_s": time_s, "T_room_degC": temperature, "z_um": 0.7 * cube(time_s, temperature) + 0.05 * random.standard_normal(300)}

        @ballbar.effect("asks", inputs={"temperature": "degC"}, gain="gain_um_per_K3")
        def asks(time_s, temperature):
            ballbar.check({"time_s": time_s, "z_um": temperature}, ballbar.Model.of("z_um"))
            return cube(time_s, temperature)

        named = (ballbar.Model.of("z_um", **{name: {"temperature": "T_room_degC"}}) for name in ("asks", "cube_of_a_rise"))
        self.assertEqual(*(ballbar.check(data, one).rmse_um for one in named))
        ballbar.effect("asks", inputs={"temperature": "bar"}, gain="gain_um")(lambda time_s, pressure: pressure)


if __name__ == "__main__":
    unittest.main()
