"""Effects that are functions of Python."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Callable, TypeVar

from . import _core
from ._errors import UsageError

_OF_A_PARAMETER = ("unit", "meaning", "lower", "upper", "start", "grid")

Function = TypeVar("Function", bound=Callable[..., Any])


def effect(
    name: str,
    *,
    inputs: Mapping[str, str | Sequence[str]] | None = None,
    gain: str | Mapping[str, Mapping[str, Any]] = "gain_um",
    shapes: Mapping[str, Mapping[str, Any]] | None = None,
    summary: str | None = None,
    cause: str | None = None,
    formula: str | None = None,
    signature: str | None = None,
    separated_by: str | None = None,
    remedy: str | None = None,
    validity: str | None = None,
    source: str | None = None,
) -> Callable[[Function], Function]:
    """Adds a function to the catalogue: it is found by name, searched and fitted as the others, in this process.

    The function is called with ``time_s``, (n,) s, an (n,) array for each input in the unit of its column, and the value
    of each shape; it returns what a gain of 1 adds, um: (n,), or (gains, n) of several gains.

    Parameters
    ----------
    name : str
        Of its own; one that was given before is replaced.
    inputs : dict
        Role in a model file, and the units of columns that may stand for it: ``{"temperature": ["degC", "K"]}``.
    gain : str or dict
        Name of the gain, which ends in its unit (``"gain_um_per_K"``); or several, each with ``unit``, ``lower``,
        ``upper``.
    shapes : dict
        Parameters that do not enter linearly: ``{"time_constant_s": {"start": 600.0, "lower": 30.0, "upper": 7200.0,
        "grid": [60.0, 600.0, 3600.0], "unit": "s"}}``. The grid are the starts of a search, rising.
    summary, cause, formula, signature, separated_by, remedy, validity, source : str
        For ``ballbar effects``.

    Returns
    -------
    callable
        Takes the function, and gives it back.

    Raises
    ------
    BallbarError
        A name that the catalogue has, a gain or shape that cannot be; of a fit: what the function raises
        (``__cause__``), and an array of another shape.

    Examples
    --------
    >>> import ballbar, numpy as np
    >>> @ballbar.effect("swing_of_the_room", inputs={"temperature": "degC"}, gain="gain_um_per_K2",
    ...                 summary="Grows with the square of a rise.")
    ... def swing(time_s, temperature):
    ...     return (temperature - temperature[0]) ** 2
    >>> ballbar.effects("swing_of_the_room").summary
    'Grows with the square of a rise.'
    """
    explained = {
        "summary": summary, "cause": cause, "formula": formula, "signature": signature, "separated_by": separated_by,
        "remedy": remedy, "validity": validity, "source": source,
    }
    gains = {gain: {"unit": _unit_of(gain)}} if isinstance(gain, str) else _stated("gain", gain)

    def add(function: Function) -> Function:
        if not callable(function):
            raise TypeError(f"{name}: expected a function, found {type(function).__name__}")
        _core.add_effect(
            str(name),
            function,
            inputs=dict(_mapping("inputs", inputs or {})),
            gains=gains,
            shapes=_stated("shapes", shapes or {}),
            explanation={key: text for key, text in explained.items() if text is not None},
        )
        return function

    return add


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


def _unit_of(parameter: str) -> str:
    """um/K of gain_um_per_K."""
    unit = parameter.partition("_")[2]
    return unit.replace("_per_", "/") or "1"
