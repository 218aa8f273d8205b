"""A model, a model fitted to data, and what it lacks."""
from __future__ import annotations

import os
import pathlib
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NoReturn, Union

import numpy as np
import pandas
from numpy.typing import NDArray

from . import _core, _kinds
from ._errors import BallbarError, UsageError, number_of
from ._frame import Data, Held, Path, Progress
from ._kinds import Plan, Preflight, Tried
from ._summary import NORMAL_95, criteria_of, half_interval_of, r_squared_of, summary_of
from ._terms import Effect, PythonEffect, effect_from_table, functions_of, parameter_names, toml_of, toml_table
from ._times import ROWS, Every, zero_of
from ._units import in_unit, named_in

Array = NDArray[np.float64]


class Model:
    """A sum of effects and a constant that explains a column. A value: it cannot be changed, and touches no file.

    Parameters
    ----------
    target : str or list of str
        The column to explain, in um, or several, each by its own fit; recordings: leave it out.
    effects : list of Effect or str
        ``bb.LaggedExpansion("T_motor_degC")`` or ``"lagged_expansion(T_motor_degC)"``, or ``square.on(...)`` of an effect
        made by :func:`effect`.
    constant_um : float
        Holds the constant there; None: the fit finds it.
    of_recordings : bool
        A model of ballbar recordings; their circles are part of it.

    Raises
    ------
    BallbarError
        An effect, an input or a parameter that does not exist, bounds that are crossed, an effect twice.

    Examples
    --------
    >>> import ballbar as bb
    >>> model = bb.Model("y_um", ["expansion(T_housing_degC)"])
    >>> print(model.text)
    format = "ballbar-model 1"
    target = "y_um"
    <BLANKLINE>
    [[effect]]
    name = "expansion"
    temperature = "T_housing_degC"
    <BLANKLINE>
    >>> (model + bb.ThermostatCycle()) - "expansion(T_housing_degC)"
    Model('y_um', [thermostat_cycle])
    """

    __slots__ = ("targets", "effects", "text", "of_recordings", "functions", "_root")
    targets: tuple[str, ...]
    effects: tuple[Effect, ...]
    text: str
    of_recordings: bool
    functions: tuple[PythonEffect, ...]
    _root: dict[str, Any]

    def __init__(
        self,
        target: str | Sequence[str] | None = None,
        effects: Effects = (),
        *,
        constant_um: float | None = None,
        of_recordings: bool = False,
    ) -> None:
        if target is None and not of_recordings:
            raise UsageError("target: expected the column to explain, found none.")
        root: dict[str, Any] = {"level": "recording"} if of_recordings else {}
        if target is not None:
            root["target"] = target if isinstance(target, str) else list(target)
        if constant_um is not None:
            root["constant_um"] = constant_um
        self._make(root, _effects(effects, of_recordings), "model")

    def _make(self, root: dict[str, Any], effects: Sequence[Effect], name: str) -> None:
        functions = functions_of(effects)
        for one in effects:
            if sum(one == other for other in effects) > 1:
                raise BallbarError(f"effects: expected each once, found {one!r} twice.")
        plain = {key: value for key, value in root.items() if key not in ("trained", "effect", "history")}
        text = toml_table({"format": "ballbar-model 1", **plain})
        if root.get("trained"):
            text += "\n[trained]\n" + toml_table(root["trained"])
        text = _core.model_text(text + "".join(map(toml_of, effects)), name, [one.core for one in functions])
        found = tomllib.loads(text)
        target = found.get("target", [])
        made = {
            "targets": (target,) if isinstance(target, str) else tuple(target),
            "effects": _effects_of(found, functions),
            "text": text, "of_recordings": found.get("level") == "recording", "functions": tuple(functions), "_root": found,
        }
        for key, value in made.items():
            object.__setattr__(self, key, value)

    @classmethod
    def load(cls, path: Path) -> Model:
        """The model of a ``model.toml``, without its comments and its history.

        Raises
        ------
        BallbarError
            With file, line and column of what is wrong.
        OSError
            A file that cannot be read.
        """
        name = os.fspath(path)
        return cls._of_text(_core.model_text(pathlib.Path(path).read_bytes(), name, []), name)

    @classmethod
    def _of_text(cls, text: str, name: str = "model", functions: Sequence[PythonEffect] = ()) -> Model:
        root = tomllib.loads(text)
        return cls._of(root, _effects_of(root, functions), name)

    @classmethod
    def _of(cls, root: dict[str, Any], effects: Sequence[Effect], name: str = "model") -> Model:
        model = cls.__new__(cls)
        model._make(root, effects, name)
        return model

    def save(self, path: Path) -> None:
        """Writes a ``model.toml``.

        Raises
        ------
        BallbarError
            A model with an effect that is a function of Python, which no file can hold.
        """
        if self.functions:
            raise BallbarError(f"{os.fspath(path)}: expected effects of the catalogue, found {self.functions[0].name}, a function of Python; pickle keeps such a model.")
        pathlib.Path(path).write_text(self.text, encoding="utf-8")

    def __add__(self, effects: Effects | Model) -> Model:
        if isinstance(effects, Model):
            if (effects.targets, effects.of_recordings) != (self.targets, self.of_recordings):
                raise BallbarError(f"expected a model of {', '.join(self.targets)}, found one of {', '.join(effects.targets)}.")
            effects = effects.effects
        return self._of(self._root, [*self.effects, *_effects(effects, self.of_recordings)])

    def __sub__(self, effects: Effects) -> Model:
        left = list(self.effects)
        for less in _effects(effects, self.of_recordings):
            same = [k for k, mine in enumerate(left) if mine.name == less.name and mine.columns == less.columns]
            exact = [k for k in same if left[k].parameters == less.parameters]
            if not same:
                raise BallbarError(f"expected an effect of the model, one of {', '.join(map(repr, left)) or 'none'}, found {less!r}.")
            del left[(exact or same)[0]]
        return self._of(self._root, left)

    def with_target(self, target: str | Sequence[str]) -> Model:
        """The same effects for another column, or for several."""
        return self._of({**self._root, "target": target if isinstance(target, str) else list(target)}, self.effects)

    def fit(
        self,
        data: Data,
        *,
        target: str | None = None,
        robust: bool = False,
        white: bool = False,
        hold: Mapping[str, float] | None = None,
        also_input: str | Sequence[str] = (),
        max_gap_s: float | None = None,
        units: Mapping[str, str] | None = None,
        roles: Mapping[str, str] | None = None,
        every: Every = None,
        progress: Progress | None = None,
    ) -> Fit:
        """Fits the model to data; all numbers are computed here, once.

        Parameters
        ----------
        data : DataFrame, path, list of paths, dict of arrays, Series, recordings
            A DataFrame has its time in a column ``time_s`` (or ``time_min``, ``time_h``) or as index of dates or durations;
            columns end in their unit. Columns that are no numbers are left out with a :class:`BallbarWarning`; one that
            the model reads is an error. A target in another length (``z_mm``) is read in um, as ``z_um``.
        target : str
            One column instead of the model's own.
        robust : bool
            Discounts outlying values (Tukey's biweight).
        white : bool
            Ordinary least squares: the noise has no memory.
        hold : dict
            Parameters held, in their units: ``{"time_constant_s": 3600.0}``, or of several effects that have it
            ``{"lagged_expansion(T9_degC).time_constant_s": 3600.0}``.
        also_input : str or list of str
            Other targets, which effects may read.
        max_gap_s : float
            Longest gap of a signal to interpolate over, s; default 600.
        units : dict
            Of columns whose names have none: ``{"z": "um"}`` makes ``z_um`` of it; ``{"T": "degF"}`` gives ``T_degC``.
        roles : dict
            Of columns whose role is not the usual one of their unit: ``{"T_room_degC": "ambient"}``.
        every : float, str or timedelta
            Step of the rows, s or such as ``"10s"``, for a table without times.
        progress : callable
            Called with (done, of, text); `of` is 0 if the length of the work is unknown.

        Returns
        -------
        Fit

        Raises
        ------
        BallbarError
            What can be put right in data or model.

        Notes
        -----
        Noise: A. C. Harvey, Forecasting, Structural Time Series Models and the Kalman Filter (1989), chapter 3; D. A.
        Harville, J. Am. Stat. Assoc. 72 (1977). Whiteness: J. Durbin, Biometrika 56 (1969) 1.

        Examples
        --------
        >>> import ballbar as bb
        >>> he = "sample-runs/two-arcs-he2015"
        >>> fit = bb.Model.load(f"{he}/model.toml").fit(he)
        >>> round(fit.rmse_um, 3), fit.residuals.name
        (0.201, 'residual_um')
        """
        for name, flag in (("robust", robust), ("white", white)):
            if not isinstance(flag, (bool, np.bool_)):
                raise UsageError(f"{name}: expected True or False, found {flag!r}.")
        if target is not None and not isinstance(target, str):
            raise UsageError(f"target: expected the name of one column, found {target!r}; fit_all() fits each.")
        how: dict[str, Any] = {
            "target": [] if target is None else [target], "also_input": [also_input] if isinstance(also_input, str) else list(also_input),
            "set": [f"{self._parameter(key)}={number!r}" for key, value in (hold or {}).items() for number in [number_of(key, value)]],
            "max_gap_s": None if max_gap_s is None else number_of("max_gap_s", max_gap_s, 0.0), "robust": bool(robust), "white": bool(white),
        }
        held = Held(units=units, roles=roles, every=every, needed=self._columns(target))
        places = held.places(data)
        return Fit._of(self, places, held.values, held.index, how, progress)

    def _columns(self, target: str | None = None) -> set[str]:
        """That it reads."""
        named = {column for one in self.effects if one.name != "expression" for column in one.columns.values()}
        return named | (set(self.targets) if target is None else {target})

    def _parameter(self, key: str) -> str:
        """The parameter that a key of `hold` names, with its effect."""
        if key == "constant_um":
            return "constant.constant_um"
        having = [one for one in self.effects if key in parameter_names(one)]
        if "." in key or len(having) == 1:
            return key if "." in key else f"{_label(having[0])}.{key}"
        known = [f"{_label(one)}.{name}" for one in self.effects for name in parameter_names(one)]
        found = f'"{key}", of {len(having)} effects' if having else f'"{key}"'
        raise UsageError(f"hold: expected a parameter of the model, one of {', '.join([*known, 'constant_um'])}, found {found}.")

    def predict(
        self, data: Data, *, units: Mapping[str, str] | None = None, roles: Mapping[str, str] | None = None,
        every: Every = None, progress: Progress | None = None,
    ) -> pandas.DataFrame:
        """The series of a model whose parameters are all held; :meth:`Fit.predict` is of one that is fitted.

        Returns
        -------
        DataFrame
            As of :meth:`Fit.predict`, without the interval; the sigma of held parameters is not known: NaN. Its zero is the first row.

        Raises
        ------
        BallbarError
            A parameter that is free, and what can be put right in the data.
        """
        held = Held(units=units, roles=roles, every=every, needed=self._columns() - set(self.targets))
        places = held.places(data)
        how: dict[str, Any] = {"target": [], "also_input": [], "set": [], "max_gap_s": None, "robust": False, "white": False}
        return _predicted(_bench_of(self, places, held.values, how, progress), places, held.values, held.index, progress)

    def fit_all(self, data: Data, **how: Any) -> dict[str, Fit]:
        """A fit of each target, by its name; parameters as of :meth:`fit`."""
        several = list(data) if isinstance(data, Iterator) else data
        return {target: self.fit(several, target=target, **how) for target in self.targets}

    def __setattr__(self, name: str, value: object = None) -> NoReturn:
        raise AttributeError("a model cannot be changed; + and - make another one")

    __delattr__ = __setattr__

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and (self.text, self.functions) == (other.text, other.functions)

    def __hash__(self) -> int:
        return hash(self.text)

    def __reduce__(self) -> Any:
        return Model._of_text, (self.text, "model", self.functions)

    def __repr__(self) -> str:
        target = self.targets[0] if len(self.targets) == 1 else list(self.targets)
        return f"Model({'of_recordings=True' if self.of_recordings else repr(target)}, {list(self.effects)!r})"


Effects = Union[Effect, str, PythonEffect, Sequence[Union[Effect, str, PythonEffect]]]


def _effects(said: Effects, of_recordings: bool) -> list[Effect]:
    """One effect, or several, each as a value, a text or a function without inputs."""
    return [_effect(one, of_recordings) for one in ([said] if isinstance(said, (str, Effect, PythonEffect)) else said)]


def _effect(said: Effect | str | PythonEffect, of_recordings: bool) -> Effect:
    if isinstance(said, Effect):
        return said
    if isinstance(said, PythonEffect):
        return said.on()
    if not isinstance(said, str):
        raise TypeError(f"expected an effect, or its name with columns, found {type(said).__name__}")
    return _effects_of(tomllib.loads(_core.model_of_effect(said, of_recordings, [])))[0]


def _effects_of(root: Mapping[str, Any], functions: Sequence[PythonEffect] = ()) -> tuple[Effect, ...]:
    """The effects of a model file."""
    of_recordings = root.get("level") == "recording"
    return tuple(effect_from_table(table, of_recordings, functions) for table in root.get("effect", []))


def _label(effect: Effect) -> str:
    """As the program names it, with its columns."""
    return f"{effect.name}({', '.join(effect.columns.values())})" if effect.columns else effect.name


class Fit(_kinds.Checked):
    """A model fitted to data. Cannot be changed; pickled and copied whole.

    A target that is no length keeps its unit: of one in degC the RMSE is ``rmse_degC``, and `params` and sentences say
    degC. Without a unit it is ``rmse``.

    Attributes
    ----------
    model : Model
        That was fitted.
    params : DataFrame
        A row a parameter: effect, parameter, value, sigma, low, high (95 %), unit, state.
    residuals, fitted, measured : pandas.Series
        um, on the index of the data.
    contributions : DataFrame
        What each effect adds, um, on that index.
    cov : (p, p) array
        Covariance of the parameters, in the order of `params`; 0 where one is held.
    where : DataFrame
        Where the model fails: one row per group of readings.
    log_likelihood, aic, bic : float
        Of the residual with its noise; AIC and BIC count the parameters of the noise.
    r_squared : float
        Share of the variance of the readings that the model explains.
    """

    __slots__ = ("model", "_places", "_held", "_index", "_how", "_arrays", "_labels", "_bench")
    model: Model
    _places: list[str]
    _held: dict[str, Any]
    _index: pandas.Index | None
    _how: dict[str, Any]
    _arrays: dict[str, Any]
    _labels: list[str]
    _bench: Any

    @classmethod
    def _of(cls, model: Model, places: list[str], held: dict[str, Any], index: Any, how: dict[str, Any], progress: Any) -> Fit:
        from ._call import told

        bench = _bench_of(model, places, held, how, progress)
        keys, arrays = told(bench.check, places, progress)
        keys = in_unit(keys, keys["target_unit"])
        of_files = _of_files(bench, places, held)
        kept = None if len(places) > 1 and of_files else bench  # one that knows no file: it is made when it is needed
        return cls._from(keys, model, places, {**held, **of_files}, index, how, arrays, bench.labels, kept)

    @classmethod
    def _from(cls, keys: dict[str, Any], *state: Any) -> Fit:
        fit = cls(keys)
        for name, value in zip(cls.__slots__, (*state, None)):
            object.__setattr__(fit, name, value)
        return fit

    def __reduce__(self) -> Any:
        return Fit._from, (self._json, *(getattr(self, name) for name in self.__slots__[:-1]))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Fit) and self.model == other.model and super().__eq__(other)

    @property
    def params(self) -> pandas.DataFrame:
        """A row a parameter: effect, parameter, value, sigma, low, high (95 %), unit, state."""
        rows = pandas.DataFrame(self._json["parameters"]).rename(columns={"name": "parameter"})
        rows[["value", "sigma"]] = rows[["value", "sigma"]].astype(float)
        half = NORMAL_95 * rows["sigma"]
        rows.insert(4, "low", rows["value"] - half)
        rows.insert(5, "high", rows["value"] + half)
        return rows

    @property
    def index(self) -> pandas.Index:
        """Of the readings that were fitted: the rows of the data's index, else their time in s; of several runs with the run."""
        time_s = self._arrays["time_s"]
        if self._index is not None:
            return self._index[np.searchsorted(self._held[self._places[0]].time_s, time_s)]
        return _index_of(time_s, self.model.of_recordings, getattr(self._held.get(self._places[0]), "has_clock", True))

    def _on_index(self, name: str) -> pandas.Series:
        return pandas.Series(self._arrays[name], index=self.index, name=named_in(name, self._json["target_unit"]), copy=True)

    @property
    def residuals(self) -> pandas.Series:
        """Measured less fitted, um, on the index of the data."""
        return self._on_index("residual_um")

    @property
    def fitted(self) -> pandas.Series:
        """What the model says, um, on the index of the data."""
        return self._on_index("predicted_um")

    @property
    def measured(self) -> pandas.Series:
        """The target, um, on the index of the data."""
        return self._on_index("measured_um")

    @property
    def contributions(self) -> pandas.DataFrame:
        """What each effect adds, um, on the index of the data."""
        return pandas.DataFrame(dict(zip(self._labels, self._arrays["contribution_um"])), index=self.index)

    @property
    def cov(self) -> Array:
        """(p, p) covariance of the parameters, in the order of `params`; 0 where one is held."""
        return np.array(self._arrays["covariance"])

    @property
    def log_likelihood(self) -> float:
        """ln of the likelihood of the residual, with the noise of the fit."""
        return criteria_of(self).log_likelihood

    @property
    def aic(self) -> float:
        """Akaike's criterion, 2 k - 2 ln L; comparable between fits of the same readings."""
        return criteria_of(self).aic

    @property
    def bic(self) -> float:
        """Schwarz's criterion, k ln n - 2 ln L."""
        return criteria_of(self).bic

    @property
    def r_squared(self) -> float:
        """Share of the variance of the readings that the model explains."""
        return r_squared_of(self)

    def summary(self) -> str:
        """A table of the parameters, with RMSE, noise, rows, R², log-likelihood, AIC and BIC.

        Examples
        --------
        >>> import ballbar as bb
        >>> fit = bb.Model("y_um", ["lagged_expansion(T_motor_degC)"]).fit("sample-runs/hidden-effect/01/data.csv")
        >>> print(fit.summary().splitlines()[0])
        Fit of y_um: 1441 rows
        """
        return summary_of(self)

    def __repr__(self) -> str:
        return self.summary()

    @property
    def where(self) -> pandas.DataFrame:  # type: ignore[override]
        """Where the model fails: one row per group of readings."""
        return pandas.DataFrame(self._json["where"])

    def diagnose(
        self,
        *,
        tolerance_um: float = 0.0,
        most_rows: int | None = None,
        extra: Sequence[PythonEffect] = (),
        seed: int | None = None,
        progress: Progress | None = None,
    ) -> Diagnosis:
        """Which physical effect the model lacks: one verdict, the candidates, what the data cannot tell.

        Parameters
        ----------
        tolerance_um : float
            Smaller effects are called minor, um.
        most_rows : int
            Values of the target that are searched; of longer series every k-th.
        extra : list of PythonEffect
            Effects made by :func:`effect`, searched beside the catalogue's in this call alone.
        seed : int
            Changes nothing: a diagnosis draws no random numbers. Programs for earlier versions state it.
        progress : callable
            As of :meth:`Model.fit`.

        Returns
        -------
        Diagnosis

        Notes
        -----
        The sets of effects are weighed by their marginal likelihood (C. E. Rasmussen, C. K. I. Williams, Gaussian
        Processes for Machine Learning (2006), chapter 5).

        Examples
        --------
        >>> import ballbar as bb
        >>> run = "sample-runs/hidden-effect/01"
        >>> found = bb.Model.load(f"{run}/model.toml").fit(f"{run}/data.csv").diagnose()
        >>> found.verdict, found.best
        ('named', (lagged_expansion(T_room_degC),))
        """
        from ._call import told

        tolerance_um = number_of("tolerance_um", tolerance_um, 0.0)
        most_rows = None if most_rows is None else int(number_of("most_rows", most_rows, 30, 5000, whole=True))
        bench = _bench_of(self.model, self._places, self._held, self._how, progress, extra) if extra else self._workbench()
        keys, text = told(lambda tell: bench.diagnose(tolerance_um, most_rows, tell), self._places, progress)
        keys = in_unit(keys, self._json["target_unit"])
        return Diagnosis._from(keys, self, _effects_of(tomllib.loads(text), functions_of(self.model.effects, extra)))

    def test(self, effects: Effects, *, progress: Progress | None = None) -> Tried:
        """What effects would change, and whether the data support them; the model stays as it is.

        Returns
        -------
        Tried
            Before and after, with the evidence, and each earlier effect tested anew.
        """
        more = _effects(effects, self.model.of_recordings)
        if not more:
            raise BallbarError("effects: expected one at least, found none.")
        return self._tested(more, progress)

    def _tested(self, more: Sequence[Effect], progress: Progress | None) -> Tried:
        from ._call import told

        of_them = Model._of({key: value for key, value in self.model._root.items() if key in ("level", "target")}, more)
        functions = [one.core for one in of_them.functions]
        keys, = told(lambda tell: self._workbench().test(of_them.text, functions, tell), self._places, progress)
        return Tried(in_unit(keys, self._json["target_unit"]))

    def compare(self, other: Fit, *, progress: Progress | None = None) -> Tried:
        """This fit beside one of a smaller model of the same data: the fall of the error, and tests.

        Parameters
        ----------
        other : Fit
            Whose model has some of the effects of this one's.

        Returns
        -------
        Tried

        Raises
        ------
        BallbarError
            Where the other model is not part of this one, or the data are others.
        """
        more = list(self.model.effects)
        for one in other.model.effects:
            if one not in more:
                raise BallbarError(f"expected a fit whose model is part of this one's, found {one!r}, which this one lacks or holds otherwise.")
            more.remove(one)
        if not more:
            raise BallbarError("expected a fit of a smaller model, found one with the same effects.")
        if self.target != other.target or (self._places, self._held) != (other._places, other._held):
            raise BallbarError(f"expected a fit of the same data and target, found another one of {other.target}.")
        rest = [{key: value for key, value in one.model._root.items() if key not in ("effect", "target")} for one in (self, other)]
        ways: list[dict[str, Any]] = [{**one._how, "target": []} for one in (self, other)]
        if rest[0] != rest[1] or ways[0] != ways[1] or any(ways[0][key] for key in ("robust", "white", "set")):
            raise BallbarError("expected fits that differ in their effects alone, without robust, white and hold, found others.")
        return other._tested(more, progress)

    def predict(
        self, data: Data = None, *, units: Mapping[str, str] | None = None, roles: Mapping[str, str] | None = None,
        every: Every = None, progress: Progress | None = None,
    ) -> pandas.DataFrame:
        """The model's series for these data or others, with sigma, interval, and what each effect adds.

        Rows of the data that were fitted, and rows that follow them within 8 h on the same clock, continue the run of the
        fit: zero and memory of its effects are those of the fit. Any other data are a run of their own, whose zero is its
        first row, as a remark says. Rows before the first of the fit are NaN.

        Returns
        -------
        DataFrame
            The target, its sigma by what the parameters scatter (``z_um_sigma``), a column an effect, and the interval that
            holds 95 % of readings (``z_um_low``, ``z_um_high``: by sigma and noise).

        Examples
        --------
        >>> import ballbar as bb
        >>> table = bb.read("sample-runs/hidden-effect/01/data.csv")
        >>> fit = bb.Model("y_um", ["lagged_expansion(T_motor_degC)", "lagged_expansion(T_room_degC)"]).fit(table.iloc[:700])
        >>> fit.predict(table.iloc[700:])["y_um"].equals(fit.predict(table)["y_um"].iloc[700:])
        True
        """
        if data is None:
            return self._with_interval(_predicted(self._workbench(), None, self._held, self._index, progress, self._places))
        needed = self.model._columns() - set(self.model.targets)
        held = Held(units=units, roles=roles, every=every, needed=needed, zero=zero_of(self._index))
        places = held.places(data)
        return self._with_interval(_predicted(self._workbench(), places, held.values, held.index, progress, fitted=True))

    def _with_interval(self, found: pandas.DataFrame) -> pandas.DataFrame:
        """With the interval of readings."""
        mean, half = found[self.target], half_interval_of(self, found[f"{self.target}_sigma"])
        return found.assign(**{f"{self.target}_low": mean - half, f"{self.target}_high": mean + half})

    def could(self) -> Preflight:
        """Which effects the data could show, and from which size, before any residual is looked at."""
        from ._functions import could

        return Preflight(in_unit(could(self._sources(), model=self.model, **self._of_call()).to_dict(), self._json["target_unit"]))

    def plan(self, **how: Any) -> Plan:
        """The run of the machine that would decide what is missing; parameters as of :func:`ballbar.plan`."""
        from ._functions import plan

        return Plan(in_unit(plan(self._sources(), model=self.model, **self._of_call(), **how).to_dict(), self._json["target_unit"]))

    def _sources(self) -> Any:
        return [self._held.get(place, place) for place in self._places]

    def _of_call(self) -> dict[str, Any]:
        if self._how["set"]:
            raise BallbarError("expected a fit without hold, found one; a number in the model holds a parameter for every question.")
        return {"target": self.target, "max_gap_s": self._how["max_gap_s"], "also_input": self._how["also_input"] or None}

    def _workbench(self) -> Any:
        if self._bench is None:
            object.__setattr__(self, "_bench", _bench_of(self.model, self._places, self._held, self._how, None))
        return self._bench


def _of_files(bench: Any, places: list[str], held: dict[str, Any]) -> dict[str, Any]:
    """What was read, under the names of its files, so that what they become changes no result."""
    files = [place for place in places if place not in held]
    if len(places) == 1 and files and bench.series is not None:
        return {files[0]: bench.series}
    return {file: _core.read_series(file) if bench.series is not None else _core.read_recordings(file) for file in files}


def _index_of(time_s: Array, of_recordings: bool, has_clock: bool = True) -> pandas.Index:
    """Times, of several runs with the number of the run; without a clock the numbers of the rows."""
    times = pandas.Index(time_s, name="time_s") if has_clock else pandas.Index(time_s.astype(np.int64), name=ROWS)
    runs = np.cumsum(np.diff(time_s, prepend=-np.inf) <= 0.0)
    return times if of_recordings or not runs.any() else pandas.MultiIndex.from_arrays([runs, times], names=["run", times.name])


def _predicted(
    bench: Any, places: list[str] | None, held: dict[str, Any], index: pandas.Index | None, progress: Progress | None,
    of_fit: Sequence[str] = (), fitted: bool = False,
) -> pandas.DataFrame:
    """Of these places, or, None, of the data of the fit, which stand `of_fit`."""
    from ._call import told

    known = list(of_fit if places is None else places)
    time_s, mean, sigma, parts = told(lambda tell: bench.predict(places, held, fitted, tell), known, progress)
    if index is not None and len(index) != len(mean):  # the first or the last rows lack an input
        index = index[np.searchsorted(held[known[0]].time_s, time_s)]
    columns = {bench.target: mean, f"{bench.target}_sigma": sigma, **dict(zip(bench.labels, parts))}
    return pandas.DataFrame(columns, index=_index_of(time_s, bench.series is None, getattr(bench.series, "has_clock", True)) if index is None else index, copy=False)


def _bench_of(
    model: Model, places: list[str], held: dict[str, Any], how: dict[str, Any], progress: Any, extra: Sequence[PythonEffect] = ()
) -> Any:
    from ._call import told

    functions = [one.core for one in functions_of(model.effects, extra)]
    try:
        return told(lambda tell: _core.bench(places, held, model.text, functions, **how, progress=tell), places, progress)[0]
    except BallbarError as error:
        if not str(error).startswith("set: "):
            raise
        raise type(error)("hold" + str(error).removeprefix("set")) from None


class Diagnosis(_kinds.Diagnosis):
    """Which effect a model lacks; ``model + found.best`` has it.

    Attributes
    ----------
    fit : Fit
        Of the model that was asked.
    best : tuple of Effect
        The effects that the verdict names, or calls probable; empty where it does neither.
    """

    __slots__ = ("fit", "best")
    fit: Fit
    best: tuple[Effect, ...]

    @classmethod
    def _from(cls, keys: dict[str, Any], fit: Fit, best: tuple[Effect, ...]) -> Diagnosis:
        found = cls(keys)
        object.__setattr__(found, "fit", fit)
        object.__setattr__(found, "best", best)
        return found

    def __reduce__(self) -> Any:
        return Diagnosis._from, (self._json, self.fit, self.best)
