"""The terms of a model: effects of the catalogue on columns, formulas, and functions of Python."""
from __future__ import annotations

import inspect
import json
import math
import pickle
import re
import sys
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from numbers import Real
from types import MappingProxyType
from typing import Any, NoReturn, Union

from . import _core
from ._errors import BallbarError, UsageError

_OF_A_PARAMETER = ("unit", "meaning", "lower", "upper", "start", "grid")
_EXPLAINED = ("summary", "cause", "formula", "signature", "on_parts", "separated_by", "remedy", "validity",
              "source")


@dataclass(frozen=True)
class Free:
    """A parameter that a fit finds; made by :func:`free`.

    Attributes
    ----------
    start, lower, upper : float or None
        Where the fit starts, and the bounds, in the unit of the parameter; None: as the catalogue has it.
    unit : str or None
        Of a parameter of an :class:`Expression`.
    held : bool
        Of such a parameter: it stays at its start.
    """

    start: float | None = None
    lower: float | None = None
    upper: float | None = None
    unit: str | None = None
    held: bool = False

    def __post_init__(self) -> None:
        for name in ("start", "lower", "upper"):
            value = getattr(self, name)
            if value is not None and (isinstance(value, bool) or not isinstance(value, Real)):
                raise UsageError(f"{name}: expected a number, found {value!r}.")


def free(start: float | None = None, *, lower: float | None = None, upper: float | None = None, unit: str | None = None, held: bool = False) -> Free:
    """A parameter that a fit finds, with its start and bounds; a plain number holds a parameter.

    Examples
    --------
    >>> import ballbar as bb
    >>> bb.LaggedExpansion("T_motor_degC", time_constant_s=bb.free(1800.0, upper=7200.0))
    lagged_expansion(T_motor_degC, time_constant_s=free(1800.0, upper=7200.0))
    """
    return Free(start, lower, upper, unit, held)


Value = Union[float, Free]


class Effect:
    """An effect on columns of the data, with what is stated of its parameters. A value: it cannot be changed.

    Attributes
    ----------
    name : str
        As ``ballbar effects`` lists it.
    columns : dict of str
        The column of each input.
    parameters : dict
        A number holds a parameter, :class:`Free` has the fit find it; what is not here is as in the catalogue.
    function : PythonEffect or None
        The function of Python that it is.
    """

    __slots__ = ("name", "columns", "parameters", "function")
    of_recordings = False
    effect_name = ""
    name: str
    columns: Mapping[str, str]
    parameters: Mapping[str, Value]
    function: PythonEffect | None

    def __init__(
        self, name: str, columns: Mapping[str, str], parameters: Mapping[str, Value | None], function: PythonEffect | None = None
    ) -> None:
        stated = {key: _value(f"{name}, {key}", value) for key, value in parameters.items() if value is not None}
        made = (("name", name), ("columns", MappingProxyType(dict(columns))), ("parameters", MappingProxyType(stated)), ("function", function))
        for key, value in made:
            object.__setattr__(self, key, value)

    def __init_subclass__(cls) -> None:
        if "effect_name" in cls.__dict__:
            _classes.setdefault((cls.effect_name, cls.of_recordings), cls)

    def __setattr__(self, name: str, value: object = None) -> NoReturn:
        raise AttributeError("an effect cannot be changed; make another one")

    __delattr__ = __setattr__

    def _key(self) -> tuple[Any, ...]:
        return self.name, dict(self.columns), dict(self.parameters), self.function

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Effect) and self._key() == other._key()

    def __hash__(self) -> int:
        return hash((self.name, *self.columns.values()))

    def __reduce__(self) -> Any:
        return _remade, (self.of_recordings, *self._key())

    def __repr__(self) -> str:
        stated = [f"{key}={_shown(value)}" for key, value in self.parameters.items()]
        inner = ", ".join([*self.columns.values(), *stated])
        return f"{self.name}({inner})" if inner else self.name


_classes: dict[tuple[str, bool], type[Effect]] = {}  # of effects of the catalogue


def _remade(
    of_recordings: bool, name: str, columns: Mapping[str, str], parameters: Mapping[str, Value], function: PythonEffect | None = None
) -> Effect:
    kind: Any = Effect if function else _classes.get((name, of_recordings), Effect)
    effect: Effect = object.__new__(kind)
    Effect.__init__(effect, name, columns, parameters, function)
    return effect


class Expression(Effect):
    """A formula of columns and parameters, in um: what a user writes where the catalogue lacks an effect.

    Parameters
    ----------
    formula : str
        ``"k * lag(T_oil_degC - T_air_degC, tau)"``; ``ballbar.effects("expression")`` says what may stand in it.
    **parameters : Free or float
        Each name of the formula that is no column: ``k=bb.free(0.0, unit="um/K")``; a number is held.
    """

    effect_name = "expression"

    def __init__(self, formula: str, **parameters: Value) -> None:
        super().__init__("expression", {"formula": formula}, parameters)


def _value(what: str, value: Any) -> Value:
    if isinstance(value, Free):
        return value
    try:
        if not isinstance(value, bool):
            return float(value)
    except (TypeError, ValueError):
        pass
    raise UsageError(f"{what}: expected a number, which is held, or free(...), found {value!r}.")


def _shown(value: Value) -> str:
    if not isinstance(value, Free):
        return repr(value)
    parts = [] if value.start is None else [repr(value.start)]
    parts += [f"{key}={getattr(value, key)!r}" for key in ("lower", "upper", "unit", "held") if getattr(value, key)]
    return f"free({', '.join(parts)})"


def toml_value(value: Any) -> str:
    """A text, a number, a list or a :class:`Free` as TOML has it."""
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(toml_value, value)) + "]"
    if isinstance(value, Free):
        stated = [f"{key} = {toml_value(getattr(value, key))}" for key in ("start", "lower", "upper", "unit") if getattr(value, key) is not None]
        return "{ " + ", ".join([*stated, *(["held = true"] if value.held else [])]) + " }"
    number = float(value)
    return repr(number) if math.isfinite(number) else str(number)


def toml_table(keys: Mapping[str, Any]) -> str:
    """Lines of ``key = value``."""
    return "".join(
        f"{key if re.fullmatch(r'[A-Za-z0-9_-]+', key) else toml_value(key)} = {toml_value(value)}\n" for key, value in keys.items()
    )


def toml_of(effect: Effect) -> str:
    return f"\n[[effect]]\nname = {toml_value(effect.name)}\n" + toml_table({**effect.columns, **effect.parameters})


def effect_from_table(table: Mapping[str, Any], of_recordings: bool, functions: Sequence[PythonEffect] = ()) -> Effect:
    """Of a model file's ``[[effect]]``."""
    name = table["name"]
    columns = {key: value for key, value in table.items() if isinstance(value, str) and key != "name"}
    values = {key: value for key, value in table.items() if not isinstance(value, str)}
    for key, value in values.items():
        if not isinstance(value, Mapping):
            continue
        values[key] = Free(**{one: value[one] for one in ("start", "lower", "upper", "unit", "held") if one in value})
    return _remade(of_recordings, name, columns, values, next((one for one in functions if one.name == name), None))


class PythonEffect:
    """A function of Python as an effect; made by :func:`effect`. It can still be called as the function.

    Attributes
    ----------
    name : str
        Of its own.
    function : callable
        What it evaluates.
    """

    def __init__(self, function: Callable[..., Any], name: str, stated: Mapping[str, Any]) -> None:
        if not callable(function):
            raise TypeError(f"{name}: expected a function, found {type(function).__name__}")
        self.name, self.function, self._stated = name, function, dict(stated)
        self.core = _core.effect(name, function, **self._stated)

    def __call__(self, *arguments: Any, **named: Any) -> Any:
        return self.function(*arguments, **named)

    def on(self, *columns: str, **parameters: Value) -> Effect:
        """This effect on columns, in the order of its inputs.

        Raises
        ------
        UsageError
            Another number of columns, or a parameter that it does not have.
        """
        inputs = list(self._stated["inputs"])
        if len(columns) != len(inputs):
            raise UsageError(f"{self.name}: expected a column for each of {', '.join(inputs) or 'no input'}, found {len(columns)}.")
        for key in parameters:
            if key not in self._stated["gains"] and key not in self._stated["shapes"]:
                raise UsageError(f"{self.name}: expected one of {', '.join([*self._stated['gains'], *self._stated['shapes']])}, found {key}.")
        return Effect(self.name, dict(zip(inputs, columns)), parameters, self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PythonEffect) or (self.name, self._stated) != (other.name, other._stated):
            return False
        return bool(self.function == other.function) or (_code_of(self.function) == _code_of(other.function) is not None)

    def __hash__(self) -> int:
        return hash(self.name)

    def __reduce__(self) -> Any:
        # A decorated function is found by its module as NAME.function, so that pickle takes it by name.
        name = getattr(self.function, "__qualname__", "")
        if name and getattr(sys.modules.get(self.function.__module__), name, None) is self:
            self.function.__qualname__ += ".function"
        return PythonEffect, (self.function, self.name, self._stated)

    def __repr__(self) -> str:
        return f"<ballbar effect {self.name}>"


def _code_of(function: Any) -> Any:
    """What a function does, where it came from a pickle as another object; None: not known."""
    code = getattr(function, "__code__", None)
    if code is None or hasattr(function, "__self__"):
        return None
    try:
        state = pickle.dumps((function.__defaults__, function.__kwdefaults__, [one.cell_contents for one in function.__closure__ or ()]))
    except Exception:  # noqa: BLE001  what cannot be pickled is known by itself alone
        return None
    return code.co_code, code.co_consts, code.co_names, state


def effect(
    name: str,
    *,
    inputs: Mapping[str, str | Sequence[str]] | None = None,
    gain: str | Mapping[str, Mapping[str, Any]] = "gain_um",
    shapes: Mapping[str, Mapping[str, Any]] | None = None,
    **explanation: str,
) -> Callable[[Callable[..., Any]], PythonEffect]:
    """Makes an effect of a function. It is a value: models hold it, ``diagnose(extra=[...])`` searches it.

    The function is called with ``time_s``, (n,) s, an (n,) array for each input in the unit of its column, and the value
    of each shape. It returns what a gain of 1 adds, um: (n,), or (gains, n) of several gains.

    Parameters
    ----------
    name : str
        Of its own.
    inputs : dict
        Each input, and the units of columns that may stand for it: ``{"temperature": ["degC", "K"]}``.
    gain : str or dict
        Name of the gain, which ends in its unit (``"gain_um_per_K"``); or several, each with ``unit``, ``lower``,
        ``upper``.
    shapes : dict
        Parameters that do not enter linearly: ``{"time_constant_s": {"start": 600.0, "lower": 30.0, "upper": 7200.0,
        "grid": [60.0, 600.0, 3600.0], "unit": "s"}}``. The grid holds the starts of a search, rising.
    **explanation : str
        ``summary``, ``cause``, ``formula``, ``signature``, ``on_parts``, ``separated_by``, ``remedy``, ``validity``,
        ``source``.

    Returns
    -------
    callable
        Takes the function, and returns a :class:`PythonEffect`.

    Raises
    ------
    BallbarError
        A gain or a shape that cannot be; of a fit: what the function raises (``__cause__``), an array of another shape,
        or the name of an effect of the catalogue.

    Examples
    --------
    >>> import ballbar as bb
    >>> @bb.effect("square_of_a_rise", inputs={"temperature": "degC"}, gain="gain_um_per_K2")
    ... def square(time_s, temperature):
    ...     return (temperature - temperature[0]) ** 2
    >>> square.on("T_room_degC")
    square_of_a_rise(T_room_degC)
    """
    for key in explanation:
        if key not in _EXPLAINED:
            raise TypeError(f"{name}: expected one of {', '.join(_EXPLAINED)}, found {key}")
    unit = gain.partition("_")[2].replace("_per_", "/") or "1" if isinstance(gain, str) else ""
    stated = {
        "inputs": dict(_mapping("inputs", inputs or {})),
        "gains": {gain: {"unit": unit}} if isinstance(gain, str) else _stated("gain", gain),
        "shapes": _stated("shapes", shapes or {}),
        "explanation": explanation,
    }
    return lambda function: PythonEffect(function, str(name), stated)


def parameter_names(effect: Effect) -> list[str]:
    """The parameters of an effect, of a formula those that are stated."""
    if effect.function:
        return [*effect.function._stated["gains"], *effect.function._stated["shapes"]]
    if isinstance(effect, Expression):
        return list(effect.parameters)
    stated = inspect.signature(type(effect).__init__).parameters.values()
    return [one.name for one in stated if one.kind is inspect.Parameter.KEYWORD_ONLY]


def _mapping(name: str, value: Any) -> Mapping[str, Any]:
    if isinstance(value, Mapping):
        return value
    raise UsageError(f"{name}: expected a dict, found {value!r}.")


def _stated(name: str, parameters: Any) -> dict[str, dict[str, Any]]:
    for parameter, stated in _mapping(name, parameters).items():
        for key in _mapping(f"{name}, {parameter}", stated):
            if key not in _OF_A_PARAMETER:
                raise UsageError(f"{name}, {parameter}: expected one of {', '.join(_OF_A_PARAMETER)}, found {key}.")
    return {key: dict(stated) for key, stated in parameters.items()}


def functions_of(effects: Sequence[Effect], extra: Sequence[PythonEffect] = ()) -> list[PythonEffect]:
    """The functions of Python among them, each once; two of one name are refused."""
    found: dict[str, PythonEffect] = {}
    for one in [*(effect.function for effect in effects if effect.function), *extra]:
        if not isinstance(one, PythonEffect):
            raise TypeError(f"extra: expected effects made by ballbar.effect, found {type(one).__name__}")
        if found.setdefault(one.name, one) != one:
            raise BallbarError(f"{one.name}: expected one effect of this name, found two.")
    return list(found.values())
