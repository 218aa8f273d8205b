"""The estimator of scikit-learn, by scikit-learn's own checks."""
import importlib
import importlib.util
import sys
import unittest
import warnings

if importlib.util.find_spec("sklearn") is None:
    print("Passed over: scikit-learn is not installed.")
    sys.exit(0)

import ballbar as bb
import numpy as np
import pandas
from ballbar.sklearn import EffectRegressor
from sklearn.model_selection import GridSearchCV, TimeSeriesSplit, cross_val_predict, cross_val_score
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import FunctionTransformer
from sklearn.utils.estimator_checks import check_estimator

DATA = "sample-runs/hidden-effect/01/data.csv"
BOTH = ["lagged_expansion(T_motor_degC)", "lagged_expansion(T_room_degC)"]


def data():
    table = bb.read(DATA)
    return table.filter(regex="_degC|_rpm"), table["y_um"]


class Sklearn(unittest.TestCase):
    def test_checks(self):
        """All pass but the two for which rows must not depend on each other; scikit-learn skips them with that reason."""
        skipped = []
        for estimator, check in check_estimator(EffectRegressor(["expansion(T0_degC)"]), generate_only=True):
            try:
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")
                    check(estimator)
            except unittest.SkipTest as why:
                skipped.append(str(why))
        self.assertEqual(len(skipped), 2, skipped)
        self.assertTrue(all("depends on the rows before it" in why for why in skipped))

    def test_is_the_fit(self):
        inputs, target = data()
        regressor = EffectRegressor(BOTH).fit(inputs, target)
        fit = bb.Model("y_um", BOTH).fit(bb.read(DATA))
        np.testing.assert_array_equal(regressor.predict(inputs), fit.fitted)

    def test_splits_by_time(self):
        inputs, target = data()
        split = TimeSeriesSplit(3)
        known, lacking = (cross_val_score(EffectRegressor(effects), inputs, target, cv=split) for effects in (BOTH, BOTH[:1]))
        self.assertGreater(known.mean(), lacking.mean())
        self.assertGreater(cross_val_score(EffectRegressor(few=True), inputs, target, cv=split).mean(), 0.3)
        found = GridSearchCV(EffectRegressor(), {"effects": [BOTH[:1], BOTH]}, cv=split).fit(inputs, target)
        self.assertEqual(found.best_params_["effects"], BOTH)
        piped = make_pipeline(FunctionTransformer(lambda table: table.drop(columns="speed_rpm")), EffectRegressor(BOTH, max_gap_s=1e6))
        self.assertEqual(len(cross_val_predict(piped, inputs, target, cv=4)), len(target))

    def test_a_later_stretch_goes_on(self):
        """From where the training ended, as the whole run predicts it; without times it begins anew."""
        inputs, target = data()
        regressor = EffectRegressor(BOTH).fit(inputs.iloc[:1000], target.iloc[:1000])
        whole, later = regressor.predict(inputs), regressor.predict(inputs.iloc[1000:])
        np.testing.assert_allclose(later, whole[1000:], atol=1e-9)
        anew = EffectRegressor(BOTH).fit(inputs.iloc[:1000].reset_index(drop=True), target.iloc[:1000]).predict(inputs.iloc[1000:].reset_index(drop=True))
        self.assertGreater(np.abs(anew - later).max(), 1.0)

    def test_numbered_rows_go_on(self):
        """Without times the numbers of the rows are the clock: of consecutive rows, as splits by time take them."""
        inputs, target = (one.reset_index(drop=True) for one in data())
        timed = cross_val_score(EffectRegressor(BOTH), *data(), cv=TimeSeriesSplit(3))
        np.testing.assert_allclose(cross_val_score(EffectRegressor(BOTH), inputs, target, cv=TimeSeriesSplit(3)), timed, atol=1e-6)

    def test_folds_of_time_are_parts_of_the_run(self):
        """A fold in the middle of the training lies in its run; of one before it, the zero is its own."""
        inputs, target = data()
        middle = np.r_[0:400, 800 : len(inputs)]
        regressor = EffectRegressor(BOTH, max_gap_s=1e6).fit(inputs.iloc[middle], target.iloc[middle])
        found = regressor.predict(inputs.iloc[400:800])
        self.assertLess(float(np.sqrt(np.mean((found - target.iloc[400:800]) ** 2))), 1.0)
        np.testing.assert_allclose(regressor.predict(inputs.iloc[900:1000]), regressor.fit_.fitted.to_numpy()[500:600], atol=1e-9)
        later = EffectRegressor(BOTH).fit(inputs.iloc[500:], target.iloc[500:])
        with self.assertLogs("ballbar") as logs:
            self.assertTrue(np.isfinite(later.predict(inputs.iloc[:400])).all())
        self.assertIn("another run", logs.output[0])

    def test_with_the_functions_of_later_versions(self):
        """As scikit-learn 1.7: validate_data is public, and the estimator has lost _validate_data and its like."""
        import sklearn.base
        import sklearn.utils.validation as validation
        from unittest import mock

        base, called = sklearn.base.BaseEstimator, []
        kept = {name: getattr(base, name) for name in ("_validate_data", "_check_n_features", "_check_feature_names") if hasattr(base, name)}

        def validate_data(estimator, X, *, reset, skip_check_array=False, **how):
            called.append(skip_check_array)
            estimator.n_features_in_ = X.shape[1]
            return X if skip_check_array else validation.check_array(X, **how)

        module = sys.modules["ballbar.sklearn"]
        inputs, target = data()
        for name in kept:
            delattr(base, name)
        try:
            with mock.patch.object(validation, "validate_data", validate_data, create=True):
                later = importlib.reload(module).EffectRegressor
                found = later(BOTH).fit(inputs, target).predict(inputs)
                self.assertEqual(later(["expansion(T0_degC)"]).fit(inputs.to_numpy(), target).predict(inputs.to_numpy()).shape, target.shape)
        finally:
            for name, value in kept.items():
                setattr(base, name, value)
            importlib.reload(module)
        self.assertEqual(sorted(set(called)), [False, True])
        np.testing.assert_array_equal(found, bb.Model("y_um", BOTH).fit(bb.read(DATA)).fitted)

    def test_dates(self):
        inputs, target = data()
        dated = inputs.set_axis(pandas.Timestamp("2026-11-22") + pandas.to_timedelta(inputs.index, unit="s"))
        a, b = (EffectRegressor(BOTH).fit(one.iloc[:1000], target.iloc[:1000]).predict(one.iloc[1000:]) for one in (dated, inputs))
        np.testing.assert_allclose(a, b, atol=1e-6)


if __name__ == "__main__":
    unittest.main()
