"""Arrays of numpy in the place of files: Series and Recording."""
import concurrent.futures
import copy
import pathlib
import pickle
import tempfile
import unittest

import ballbar as bb
import numpy as np
from ballbar._core import read_series

HE = "sample-runs/two-arcs-he2015"
DATA = "sample-runs/hidden-effect/01/data.csv"
MODEL = bb.Model.load("sample-runs/hidden-effect/01/model.toml")
B5R = "sample-runs/qc20-style-b5r/00.b5r"


class Arrays(unittest.TestCase):
    def test_recordings_are_fitted_as_their_file(self):
        recordings = bb.read_recordings(B5R)
        self.assertEqual([one.direction for one in recordings], ["CCW", "CW"])
        by_file, by_array = bb.circles(B5R), bb.fit_circle(recordings)
        for a, b in zip(by_file.recordings, by_array.recordings):
            self.assertEqual((a.centre_a_um, a.sigma_radius_um), (b.centre_a_um, b.sigma_radius_um))
        # From arrays alone: the angle goes to radians and back.
        first = recordings[0]
        again = bb.fit_circle(first.length_mm, angle_deg=np.degrees(first.angle_rad), nominal_length_mm=first.nominal_length_mm)
        self.assertAlmostEqual(again.recordings[0].centre_a_um, by_file.recordings[0].centre_a_um, places=9)
        errors = {one.name: one.value for one in bb.machine_errors(recordings).errors}
        self.assertAlmostEqual(errors["scale_mismatch"], 8.0, places=1)

    def test_columns_are_seen_without_a_copy(self):
        series = read_series(DATA)
        name = series.names[0]
        self.assertEqual(series[name].__array_interface__["data"], series[name].__array_interface__["data"])
        self.assertFalse(series[name].flags.writeable)
        values = series[name]
        del series  # the array keeps what it shows
        self.assertTrue(np.isfinite(values).any())

    def test_faults(self):
        time_s = np.arange(5.0)
        for message, work in {
            "T_degC: expected as many values as time_s has, 5, found 4.": lambda: bb.Series(time_s, {"T_degC": np.ones(4)}),
            "later than the row before": lambda: bb.Series(time_s[::-1], {}),
            "one dimension": lambda: bb.Series(np.ones((2, 2)), {}),
            "expected a role": lambda: bb.Series(time_s, {"T_degC": time_s}, roles={"T_degC": "weather"}),
            "plane: expected one of XY, YZ, ZX, YX, ZY, XZ, found \"XX\"": lambda: bb.Recording(np.ones(9), np.arange(9.0), plane="XX"),
            "length above 0": lambda: bb.Recording(np.zeros(9), np.arange(9.0)),
            "angle_deg: expected 9 values": lambda: bb.Recording(np.ones(9), np.arange(8.0)),
        }.items():
            with self.assertRaisesRegex(bb.BallbarError, message.replace("(", r"\(")):
                work()
        with self.assertRaises(KeyError):
            bb.Series(time_s, {})["x_um"]

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
            np.testing.assert_array_equal(bb.Series(np.arange(3.0), {"z_um": values})["z_um"], expected)
        for values, found in (
            (np.arange(3).astype("datetime64[ns]"), "datetime64"), (np.ones(3) + 1j, "complex128"), (["1.5", "2", "3"], "<U3"),
            (np.ones(3, bool), "bool"), (np.array([1, "a", 3], object), 'row 1: expected a number, found "a"'),
            (np.array([1, True, 3], object), "row 1"), ([[1], [1, 2]], "none of equal rows"),
        ):
            with self.assertRaisesRegex(bb.BallbarError, f"^z_um.*{found}"):
                bb.Series(np.arange(3.0), {"z_um": values})
            with self.assertRaises(bb.BallbarError):
                bb.Recording(100.0 + np.arange(3.0), values)
        with self.assertRaisesRegex(bb.BallbarError, "reading 1: .* found nan mm"):
            bb.Recording(np.ma.array([100.0, 1e6, 100.0], mask=[False, True, False]))

    def test_series_is_a_container_that_its_file_can_hold(self):
        time_s = np.arange(3.0)
        series = bb.Series(time_s, {"z_um": [1.0, None, 3.0], "T_room_degC": time_s}, started="2026-11-22T13:05:10")
        self.assertEqual(list(series), ["z_um", "T_room_degC"])
        self.assertIn("z_um", series)
        self.assertNotIn("y_um", series)
        with tempfile.TemporaryDirectory() as folder:
            series.write(f"{folder}/series.csv")
            again = read_series(f"{folder}/series.csv")
        np.testing.assert_array_equal(again["z_um"], series["z_um"])
        self.assertEqual((again.started, list(again)), (series.started, list(series)))
        for columns, how, message in (
            ({"z_um": [1.0, np.inf, 3.0]}, {}, "z_um, row 1: expected a finite value"), ({"time_s": time_s}, {}, "no second time"),
            ({"a,b_um": time_s}, {}, "without comma"), ({"a\n_um": time_s}, {}, "line break"), ({"": time_s}, {}, "expected a name"),
            ({"z_um": time_s}, {"started": "yesterday"}, "started: expected a date"), ({3: time_s, "3": time_s}, {}, "each name once"),
            ({"z_um": time_s}, {"roles": {"y_um": "load"}}, 'roles: expected names of columns, found "y_um"'),
        ):
            with self.assertRaisesRegex(bb.BallbarError, message):
                bb.Series(time_s, columns, **how)
        length_mm = np.full(3, 100.0)
        for how in ({"time_s": [0.0, np.nan, 2.0]}, {"time_s": [0.0, 2.0, 1.0]}, {"nominal_length_mm": np.nan}, {"nominal_length_mm": -1.0},
                    {"feed_mm_per_min": 0.0}, {"height_offset_mm": np.inf}):
            with self.assertRaisesRegex(bb.BallbarError, next(iter(how))):
                bb.Recording(length_mm, **how)

    def test_data_in_the_place_of_other_files(self):
        series = read_series(DATA)
        data = {"time_s": series.time_s, **{name: series[name] for name in series}}
        self.assertEqual(MODEL.fit(DATA).predict(data).to_numpy().tolist(), MODEL.fit(DATA).predict(DATA).to_numpy().tolist())
        self.assertEqual(bb.predict(DATA, model=MODEL, on=data), bb.predict(DATA, model=MODEL, on=DATA))
        by_data, by_file = (bb.compensate(model=MODEL, on=one, fit=one).rows for one in (data, DATA))
        self.assertEqual(by_data, by_file)
        probes = f"{HE}/five-probe.csv"
        self.assertEqual(bb.report(HE, compare=bb.read(probes)).compare.axes, bb.report(HE, compare=probes).compare.axes)
        with tempfile.TemporaryDirectory() as folder:
            trained = [f"{folder}/{name}.json" for name in "ab"]
            for one, path in zip((series, DATA), trained):
                bb.train(one, target="z_um", out=path, effects=True, few=True)
            with open(trained[0], "rb") as a, open(trained[1], "rb") as b:
                self.assertEqual(a.read(), b.read())
            forecast = bb.predict(DATA, model=trained[0])
            self.assertEqual((type(forecast["z_model_um"]), forecast["z_model_um"].dtype), (np.ndarray, np.float64))

    def test_files_that_are_written(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, picture in (("page.html", None), ("picture.svg", "measured")):
                bb.report(DATA, model=MODEL, out=f"{folder}/{name}", no_diagnosis=True, picture=picture)
                with open(f"{folder}/{name}", encoding="utf-8") as file:
                    self.assertIn("<svg" if name.endswith("svg") else "<html", file.read())
            bb.compensate(model=MODEL, fit=DATA, out=f"{folder}/model.toml")
            held = bb.Model.load(f"{folder}/model.toml")
            self.assertEqual(held.predict(bb.read(DATA))["y_um"].shape, (1441,))

    def test_recordings_that_hardly_are(self):
        def of(n, plane):
            return bb.Recording(100.0 + np.zeros(n), 360.0 / n * np.arange(n), plane=plane)

        with self.assertRaisesRegex(bb.BallbarError, "length_mm: expected readings, found none"):
            bb.Recording([], [])
        found = bb.machine_errors([of(200, "XY"), of(3, "YZ")])
        self.assertEqual(len(found.skipped), 1)

    def test_equal(self):
        series = read_series(DATA)
        self.assertEqual(series, read_series(DATA))
        self.assertNotEqual(series, read_series(f"{HE}/five-probe.csv"))
        self.assertEqual(bb.read_recordings(B5R), bb.read_recordings(B5R))
        self.assertIn("1441 rows of speed_rpm", repr(series))

    def test_pickled(self):
        series = read_series(f"{HE}/five-probe.csv")
        again = pickle.loads(pickle.dumps(series))
        self.assertEqual(bb.drift(again), bb.drift(series))
        self.assertEqual((list(again), again.roles), (list(series), series.roles))
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "numbered.csv"
            path.write_text("dz,T1\n" + "".join(f"{k},{20 + 0.1 * k}\n" for k in range(9)))
            self.assertEqual([one.has_clock for one in (series, pickle.loads(pickle.dumps(read_series(path))))], [True, False])
        recordings = bb.read_recordings(B5R)
        self.assertEqual(bb.fit_circle(copy.deepcopy(recordings)), bb.fit_circle(recordings))
        result = bb.drift(series)
        self.assertEqual((copy.deepcopy(result), pickle.loads(pickle.dumps(result))), (result, result))

    def test_calls_within_calls(self):
        inner = []
        fit = MODEL.fit(DATA)

        def ask(done, of, text):
            if not inner:
                inner.append(bb.Model("z_um").fit({"time_s": [0.0, 1.0, 2.0, 3.0], "z_um": [1.0, 2.0, 1.0, 2.0]}).n)

        self.assertEqual((fit.diagnose(progress=ask), inner), (fit.diagnose(), [4]))

    def test_threads(self):
        files = [f"sample-runs/qc20-style-b5r/0{k}.b5r" for k in range(6)] * 4
        one_by_one = [bb.circles(file).to_dict() for file in files]
        with concurrent.futures.ThreadPoolExecutor(6) as pool:
            self.assertEqual(list(pool.map(lambda file: bb.circles(file).to_dict(), files)), one_by_one)
        fit = MODEL.fit(DATA)
        with concurrent.futures.ThreadPoolExecutor(4) as pool:  # one workbench, asked by several
            found = list(pool.map(lambda one: one.diagnose(), [fit] * 4))
            tested = list(pool.map(lambda one: one.test("expansion(T_room_degC)"), [fit] * 4))
        self.assertEqual((found, tested), ([found[0]] * 4, [tested[0]] * 4))


if __name__ == "__main__":
    unittest.main()
