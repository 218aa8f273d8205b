"""Models as estimators of scikit-learn, for its pipelines, searches and cross-validation."""
from __future__ import annotations

import pathlib
import tempfile
from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas
from sklearn.base import BaseEstimator, RegressorMixin
from sklearn.utils.validation import check_array, check_is_fitted, column_or_1d

from ._call import TextOf
from ._frame import series_of
from ._functions import predict, train
from ._model import Model
from ._terms import Effect
from ._times import TIMES, Every, seconds, zero_of

try:
    from sklearn.utils.validation import validate_data  # from 1.6 on
except ImportError:

    def validate_data(estimator: Any, X: Any, *, reset: bool, skip_check_array: bool = False, **how: Any) -> Any:
        """The same by what scikit-learn had until 1.5."""
        if not skip_check_array:
            return estimator._validate_data(X, reset=reset, **how)
        estimator._check_feature_names(X, reset=reset)
        estimator._check_n_features(X, reset=reset)
        return X


class EffectRegressor(RegressorMixin, BaseEstimator):  # type: ignore[misc]
    """Effects of the catalogue as a regression, um.

    Rows are readings in the order of time. Rows of the training, and a DataFrame whose times, or numbers of its rows, go on
    after them, continue the run of the training, as :meth:`Fit.predict` has it; any other X is a run of its own, in which
    effects start at its first row. Split by stretches of time (``TimeSeriesSplit``) or by runs, not by shuffled rows.

    Parameters
    ----------
    effects : list of Effect or str
        Fitted by :meth:`Model.fit`; None: every effect on every column, by :func:`ballbar.train`.
    columns : list of str
        Names for an X without column names, ending in their unit; None: ``T0_degC``, ``T1_degC`` ...
    every : float, str or timedelta
        Step of the rows, s or such as ``"10s"``, where X has no times.
    max_gap_s : float
        Longest gap of a signal to interpolate over, s; default 600. A fold taken out of the middle leaves a longer one.
    few : bool
        Of ``effects=None``: some ten effects.

    Attributes
    ----------
    fit_ : Fit
        Of a model with `effects`.
    model_ : str
        Of ``effects=None``: the model that :func:`ballbar.train` writes; empty: no effect is likelier than none.
    n_features_in_ : int
        Columns of X.

    Notes
    -----
    With `effects` the checks of ``check_estimator`` pass but for those that shuffle rows or take subsets of them: with a
    memory the prediction of a row depends on the rows before it. Without `effects` it needs 40 rows.

    Examples
    --------
    >>> import ballbar as bb
    >>> from ballbar.sklearn import EffectRegressor
    >>> table = bb.read("sample-runs/hidden-effect/01/data.csv")
    >>> inputs, target = table.filter(regex="_degC|_rpm"), table["y_um"]
    >>> model = EffectRegressor(["lagged_expansion(T_motor_degC)", "lagged_expansion(T_room_degC)"])
    >>> round(model.fit(inputs, target).score(inputs, target), 3)
    0.981
    """

    def __init__(
        self, effects: Sequence[Effect | str] | None = None, *, columns: Sequence[str] | None = None, every: Every = 60.0,
        max_gap_s: float | None = None, few: bool = False,
    ) -> None:
        self.effects = effects
        self.columns = columns
        self.every = every
        self.max_gap_s = max_gap_s
        self.few = few

    def fit(self, X: Any, y: Any) -> EffectRegressor:
        """Fits to a run; X: (n, p) or a DataFrame, y: (n,) um."""
        if y is None:
            raise ValueError("This EffectRegressor estimator requires y to be passed, but the target y is None.")
        self._zero = zero_of(X.index) if isinstance(X, pandas.DataFrame) else None
        table = self._table(X, reset=True)
        values = column_or_1d(y, warn=True)
        target = check_array(values, ensure_2d=False, dtype=np.float64, input_name="y")
        if len(target) != len(table):
            raise ValueError(f"expected as many values of y as rows of X, {len(table)}, found {len(target)}")
        data = table.assign(target_um=target)
        self._last = X.copy() if _has_times(X) and self.effects is None else None
        if self.effects is not None:
            self.fit_ = Model("target_um", self.effects).fit(data, max_gap_s=self.max_gap_s)
            return self
        with tempfile.TemporaryDirectory(prefix="ballbar-") as folder:
            path = pathlib.Path(folder, "model.json")
            train(data, target="target_um", out=path, effects=True, few=self.few, max_gap_s=self.max_gap_s)
            self.model_ = path.read_text(encoding="utf-8") if path.exists() else ""
            self.mean_um_ = float(target.mean())
        return self

    def predict(self, X: Any) -> Any:
        """(n,) um; NaN where an input is not known at the first or the last rows, and before the first row of the run."""
        check_is_fitted(self)
        table = self._table(X, reset=False)
        if self.effects is not None:
            found = self.fit_.predict(table)[self.fit_.target].reindex(table.index).to_numpy()
        elif self.model_:
            goes_on = _has_times(X) and self._last is not None and len(X) and X.index[0] > self._last.index[-1]
            whole = self._table(pandas.concat([self._last, X]), reset=False) if goes_on else table
            of_model = predict(whole, model=TextOf(self.model_))
            found = pandas.Series(of_model["target_model_um"], index=of_model["time_s"]).reindex(whole["time_s"]).to_numpy()
        else:
            found = np.full(len(table), self.mean_um_)
        return found[len(found) - len(table) :]

    def _table(self, X: Any, *, reset: bool) -> pandas.DataFrame:
        """X as a table with its times."""
        if isinstance(X, pandas.DataFrame) and all(isinstance(name, str) for name in X.columns):
            validate_data(self, X, reset=reset, skip_check_array=True)
            timed = _has_times(X) or any(name in X for name in TIMES)
            series, _ = series_of(X, every=None if timed else self.every, zero=self._zero)
            return pandas.DataFrame({"time_s": series.time_s, **{name: series[name] for name in series}})
        rows = validate_data(self, X, reset=reset, dtype=np.float64, ensure_min_samples=3 if reset else 1)
        names = self.columns or [f"T{k}_degC" for k in range(rows.shape[1])]
        return pandas.DataFrame({"time_s": seconds(self.every) * np.arange(len(rows)), **dict(zip(names, rows.T))})

    def __sklearn_tags__(self) -> Any:  # from 1.6 on
        tags = super().__sklearn_tags__()
        tags.regressor_tags.poor_score = True
        return tags

    def _more_tags(self) -> dict[str, Any]:
        memory = "the prediction of a row depends on the rows before it"
        names = ("check_methods_subset_invariance", "check_methods_sample_order_invariance")
        return {"poor_score": True, "_xfail_checks": dict.fromkeys(names, memory)}


def _has_times(X: Any) -> bool:
    if not isinstance(X, pandas.DataFrame):
        return False
    return isinstance(X.index, (pandas.DatetimeIndex, pandas.TimedeltaIndex)) or X.index.name in TIMES
