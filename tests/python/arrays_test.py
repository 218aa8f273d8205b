"""Arrays of numpy in the place of files."""
import concurrent.futures
import copy
import importlib.util
import pathlib
import pickle
import tempfile
import unittest

import ballbar
import numpy as np

HE = "sample-runs/two-arcs-he2015"
DATA = "sample-runs/hidden-effect/01/data.csv"
MODEL = "sample-runs/hidden-effect/01/model.toml"
BATCHES = "sample-runs/batches-tan2024"


def without_names(result):
    return {key: value for key, value in result.to_dict().items() if key not in ("file", "files", "command", "next_test", "title")}


class OfTwo(ballbar.Result):
    __slots__ = ("text",)

    def __init__(self, keys, text=""):
        super().__init__(keys)
        self.text = text


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
        errors = {one.name: one.value for one in ballbar.errors(recordings, ranked=True).errors}
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
            "plane: expected one of XY, YZ, ZX, YX, ZY, XZ, found \"XX\"": lambda: ballbar.Recording(np.ones(9), np.arange(9.0), plane="XX"),
            "length above 0": lambda: ballbar.Recording(np.zeros(9), np.arange(9.0)),
            "angle_deg: expected 9 values": lambda: ballbar.Recording(np.ones(9), np.arange(8.0)),
        }.items():
            with self.assertRaisesRegex(ballbar.BallbarError, message.replace("(", r"\(")):
                work()
        with self.assertRaises(KeyError):
            ballbar.Series(time_s, {})["x_um"]
        with self.assertRaises(TypeError):
            ballbar.check(3)

    def test_numbers_by_their_kind(self):
        gap = np.nan
        for values, expected in (
            (np.ma.array([1.0, 1e6, 3.0], mask=[False, True, False]), [1.0, gap, 3.0]),
            (np.ma.array([1, 10**6, 3], mask=[False, True, False]), [1.0, gap, 3.0]),
            (np.ma.array([1, None, 3], mask=[True, False, False], dtype=object), [gap, gap, 3.0]),
            ([1, None, 3], [1.0, gap, 3.0]),
            (np.array([1, 2, 3], np.float16), [1.0, 2.0, 3.0]),
            (np.arange(6, dtype=np.uint8)[::2], [0.0, 2.0, 4.0]),
        ):
            np.testing.assert_array_equal(ballbar.Series(np.arange(3.0), {"z_um": values})["z_um"], expected)
        for values, found in (
            (np.arange(3).astype("datetime64[ns]"), "datetime64"), (np.ones(3) + 1j, "complex128"), (["1.5", "2", "3"], "<U3"),
            (np.ones(3, bool), "bool"), (np.array([1, "a", 3], object), 'row 1: expected a number, found "a"'),
            (np.array([1, True, 3], object), "row 1"), ([[1], [1, 2]], "none of equal rows"),
        ):
            with self.assertRaisesRegex(ballbar.BallbarError, f"^z_um.*{found}"):
                ballbar.Series(np.arange(3.0), {"z_um": values})
            with self.assertRaises(ballbar.BallbarError):
                ballbar.Recording(100.0 + np.arange(3.0), values)
        with self.assertRaisesRegex(ballbar.BallbarError, "reading 1: .* found nan mm"):
            ballbar.Recording(np.ma.array([100.0, 1e6, 100.0], mask=[False, True, False]))

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "pandas is not installed")
    def test_tables_of_pandas(self):
        import pandas

        series = ballbar.read_series(DATA)
        table = pandas.DataFrame({"time_s": series.time_s, **{name: series[name] for name in series}})
        expected = ballbar.check(table, MODEL).rmse_um
        self.assertEqual(ballbar.check(table.convert_dtypes(), MODEL).rmse_um, expected)
        minutes = {**table.drop(columns="time_s"), "time_min": [one / 60.0 for one in series.time_s]}
        self.assertAlmostEqual(ballbar.check(minutes, MODEL).rmse_um, expected, places=9)
        with self.assertRaisesRegex(ballbar.BallbarError, '^note_um, row 0: expected a number, found "cold"'):
            ballbar.check(table.assign(note_um=["cold"] * len(table)), MODEL)

    def test_data_in_the_place_of_other_files(self):
        series = ballbar.read_series(DATA)
        data = {"time_s": series.time_s, **{name: series[name] for name in series}}
        self.assertEqual(ballbar.predict(DATA, MODEL, on=data), ballbar.predict(DATA, MODEL, on=DATA))
        self.assertEqual(ballbar.compensate(MODEL, data, fit=data).rows, ballbar.compensate(MODEL, DATA, fit=DATA).rows)
        with open(MODEL, encoding="utf-8") as file:
            model = ballbar.Model(file.read())
        for of_text in (model, [model]):
            self.assertEqual(ballbar.compensate(of_text, DATA, fit=DATA).rows, ballbar.compensate(MODEL, DATA, fit=DATA).rows)
        job = f"{BATCHES}/test1.csv"
        by_array, by_file = (ballbar.select(f"{BATCHES}/runs.csv", one, "y_um") for one in (ballbar.read_series(job), job))
        self.assertEqual(by_array.ranked, by_file.ranked)
        probes = f"{HE}/five-probe.csv"
        self.assertEqual(ballbar.report(HE, compare=ballbar.read_series(probes)).compare.axes, ballbar.report(HE, compare=probes).compare.axes)
        with tempfile.TemporaryDirectory() as folder:
            trained = [pathlib.Path(folder, name) for name in ("a.json", "b.json")]
            for one, path in zip((series, DATA), trained):
                ballbar.train(one, "z_um", path, effects=True, few=True)
            self.assertEqual(*(path.read_bytes() for path in trained))

    def test_kinds_of_data_that_are_not_taken(self):
        series, recordings = ballbar.read_series(DATA), ballbar.read_recordings("sample-runs/qc20-style-b5r/00.b5r")
        for function in (ballbar.errors, ballbar.history, ballbar.merge):
            with self.assertRaisesRegex(TypeError, "expected a path or a list of paths, found Recording"):
                function(recordings)
        for work in (lambda: ballbar.drift(recordings), lambda: ballbar.train(recordings, "z_um", "no.json", effects=True)):
            with self.assertRaisesRegex(TypeError, "expected a path or a series, found recordings"):
                work()
        with self.assertRaisesRegex(TypeError, "expected the path of a runs.csv, or effects=True"):
            ballbar.train(series, "z_um", "no.json")

    def test_series_is_a_container_that_its_file_can_hold(self):
        time_s = np.arange(3.0)
        series = ballbar.Series(time_s, {"z_um": [1.0, None, 3.0], "T_room_degC": time_s}, started="2026-11-22T13:05:10")
        self.assertEqual(list(series), ["z_um", "T_room_degC"])
        self.assertIn("z_um", series)
        self.assertNotIn("y_um", series)
        with tempfile.TemporaryDirectory() as folder:
            series.write(f"{folder}/series.csv")
            again = ballbar.read_series(f"{folder}/series.csv")
        np.testing.assert_array_equal(again["z_um"], series["z_um"])
        self.assertEqual((again.started, list(again)), (series.started, list(series)))
        for columns, how, message in (
            ({"z_um": [1.0, np.inf, 3.0]}, {}, "z_um, row 1: expected a finite value"), ({"time_s": time_s}, {}, "no second time"),
            ({"a,b_um": time_s}, {}, "without comma"), ({"a\n_um": time_s}, {}, "line break"), ({"": time_s}, {}, "expected a name"),
            ({"z_um": time_s}, {"started": "yesterday"}, "started: expected a date"), ({3: time_s, "3": time_s}, {}, "each name once"),
            ({"z_um": time_s}, {"roles": {"y_um": "load"}}, 'roles: expected names of columns, found "y_um"'),
        ):
            with self.assertRaisesRegex(ballbar.BallbarError, message):
                ballbar.Series(time_s, columns, **how)
        length_mm = np.full(3, 100.0)
        for how in ({"time_s": [0.0, np.nan, 2.0]}, {"time_s": [0.0, 2.0, 1.0]}, {"nominal_length_mm": np.nan}, {"nominal_length_mm": -1.0},
                    {"feed_mm_per_min": 0.0}, {"height_offset_mm": np.inf}):
            with self.assertRaisesRegex(ballbar.BallbarError, next(iter(how))):
                ballbar.Recording(length_mm, **how)

    def test_pickled(self):
        series = ballbar.read_series(f"{HE}/five-probe.csv")
        again = pickle.loads(pickle.dumps(series))
        self.assertEqual(ballbar.drift(again), ballbar.drift(series))
        self.assertEqual((list(again), again.roles), (list(series), series.roles))
        recordings = ballbar.read_recordings("sample-runs/qc20-style-b5r/00.b5r")
        self.assertEqual(without_names(ballbar.errors(copy.deepcopy(recordings), ranked=True)), without_names(ballbar.errors(recordings, ranked=True)))
        model = ballbar.Model.of("z_um", "thermostat_cycle")
        text, copied = model.text, copy.copy(model)
        del model  # and its file
        self.assertEqual(copied.text, text)
        self.assertEqual(pickle.loads(pickle.dumps(ballbar.Model(MODEL))).path, pathlib.Path(MODEL))
        result = ballbar.check(DATA, MODEL)
        self.assertEqual(copy.deepcopy(result), result)
        self.assertEqual(pickle.loads(pickle.dumps(OfTwo({"a": 1}, "text"))).text, "text")

    def test_calls_within_calls(self):
        series = ballbar.read_series(DATA)
        inner = []
        found = ballbar.diagnose(series, MODEL, progress=lambda line: inner or inner.append(ballbar.check({"time_s": [0.0, 1.0, 2.0, 3.0], "z_um": [1.0, 2.0, 1.0, 2.0]}).n))
        self.assertEqual(inner, [4])
        self.assertEqual(found, ballbar.diagnose(series, MODEL))

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
