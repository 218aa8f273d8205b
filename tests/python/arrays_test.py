"""Arrays of numpy in the place of files."""
import concurrent.futures
import unittest

import ballbar
import numpy as np

HE = "sample-runs/two-arcs-he2015"
DATA = "sample-runs/hidden-effect/01/data.csv"


def without_names(result):
    return {key: value for key, value in result.to_dict().items() if key not in ("file", "files", "command", "next_test", "title")}


class Arrays(unittest.TestCase):
    def test_recordings_are_fitted_as_their_file(self):
        file = "sample-runs/qc20-style-b5r/00.b5r"
        recordings = ballbar.read_recordings(file)
        self.assertEqual([one.direction for one in recordings], ["CCW", "CW"])
        by_file, by_array = ballbar.fit(file), ballbar.fit(recordings)
        for a, b in zip(by_file.recordings, by_array.recordings):
            self.assertEqual(a.centre_a_um, b.centre_a_um)
            self.assertEqual(a.sigma_radius_um, b.sigma_radius_um)
        # From arrays alone: the angle goes to radians and back.
        first = recordings[0]
        again = ballbar.Recording(first.length_mm, np.degrees(first.angle_rad), nominal_length_mm=first.nominal_length_mm)
        self.assertAlmostEqual(ballbar.fit(again).recordings[0].centre_a_um, by_file.recordings[0].centre_a_um, places=9)
        errors = {one.name: one.value for one in ballbar.diagnose(recordings).errors}
        self.assertAlmostEqual(errors["scale_mismatch"], 8.0, places=1)

    def test_series_is_diagnosed_as_its_file(self):
        model = "sample-runs/hidden-effect/01/model.toml"
        series = ballbar.read_series(DATA)
        self.assertEqual(without_names(ballbar.diagnose(series, model)), without_names(ballbar.diagnose(DATA, model)))
        columns = {name: series[name] for name in series.names}
        again = ballbar.Series(series.time_s, columns, roles=series.roles)
        self.assertEqual(without_names(ballbar.check(again, model)), without_names(ballbar.check(DATA, model)))
        self.assertEqual(
            without_names(ballbar.check({"time_s": series.time_s, **columns}, model)), without_names(ballbar.check(DATA, model))
        )

    def test_columns_are_seen_without_a_copy(self):
        series = ballbar.read_series(DATA)
        name = series.names[0]
        self.assertEqual(series[name].__array_interface__["data"], series[name].__array_interface__["data"])
        self.assertFalse(series[name].flags.writeable)
        values = series[name]
        del series  # the array keeps what it shows
        self.assertTrue(np.isfinite(values).any())

    def test_faults(self):
        time_s = np.arange(5.0)
        for message, work in {
            "T_degC: expected as many values as time_s has, 5, found 4.": lambda: ballbar.Series(time_s, {"T_degC": np.ones(4)}),
            "later than the row before": lambda: ballbar.Series(time_s[::-1], {}),
            "one dimension": lambda: ballbar.Series(np.ones((2, 2)), {}),
            "expected a role": lambda: ballbar.Series(time_s, {"T_degC": time_s}, roles={"T_degC": "weather"}),
            "plane: expected one of XY, YZ, ZX, found \"XX\"": lambda: ballbar.Recording(np.ones(9), np.arange(9.0), plane="XX"),
            "length above 0": lambda: ballbar.Recording(np.zeros(9), np.arange(9.0)),
            "angle_deg: expected 9 values": lambda: ballbar.Recording(np.ones(9), np.arange(8.0)),
        }.items():
            with self.assertRaisesRegex(ballbar.BallbarError, message.replace("(", r"\(")):
                work()
        with self.assertRaises(KeyError):
            ballbar.Series(time_s, {})["x_um"]
        with self.assertRaises(TypeError):
            ballbar.check(3)

    def test_threads(self):
        files = [f"sample-runs/qc20-style-b5r/0{k}.b5r" for k in range(6)] * 4
        one_by_one = [ballbar.fit(file).to_dict() for file in files]
        with concurrent.futures.ThreadPoolExecutor(6) as pool:
            self.assertEqual(list(pool.map(lambda file: ballbar.fit(file).to_dict(), files)), one_by_one)
        data = [ballbar.read_series(DATA)] * 4
        with concurrent.futures.ThreadPoolExecutor(4) as pool:
            found = list(pool.map(lambda one: ballbar.check(one, target=None, model="sample-runs/hidden-effect/01/model.toml").rmse_um, data))
        self.assertEqual(len(set(found)), 1)


if __name__ == "__main__":
    unittest.main()
