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
        with self.assertRaisesRegex(ballbar.BallbarError, "breaks: RuntimeError: no such thing"):
            ballbar.check(data, ballbar.Model.of("z_um", breaks={"temperature": "T_room_degC"}))
        with self.assertRaisesRegex(ballbar.BallbarError, "short: expected 300 values from its function, one a row, found 299"):
            ballbar.check(data, ballbar.Model.of("z_um", short={"temperature": "T_room_degC"}))
        with self.assertRaisesRegex(ballbar.BallbarError, "expansion: expected a name of its own"):
            ballbar.effect("expansion")(breaks)
        # They would be searched too: quiet ones in their place.
        for name in ("breaks", "short"):
            ballbar.effect(name, inputs={"temperature": "bar"}, gain="gain_um")(lambda time_s, pressure: pressure)


if __name__ == "__main__":
    unittest.main()
