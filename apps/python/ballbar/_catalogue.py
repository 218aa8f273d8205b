"""Effects that are functions of Python."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Callable, TypeVar

from . import _core

Function = TypeVar("Function", bound=Callable[..., Any])


def effect(
    name: str,
    *,
    inputs: Mapping[str, str | Sequence[str]] | None = None,
    gain: str | Mapping[str, Mapping[str, Any]] = "gain_um",
    shapes: Mapping[str, Mapping[str, Any]] | None = None,
    **explanation: str,
) -> Callable[[Function], Function]:
    """Adds a function to the catalogue: it is found by name, searched and fitted as the others, in this process.

    The function is called with ``time_s``, an array for each input, and the value of each shape; it returns what a
    gain of 1 adds, um: an array as long as ``time_s``, or a row of it for each of several gains.

    Parameters
    ----------
    name : str
        Of its own; one that was given before is replaced.
    inputs : dict
        Role in a model file, and the units of the columns that may stand for it: ``{"temperature": ["degC", "K"]}``.
    gain : str or dict
        Name of the gain, which ends in its unit (``"gain_um_per_K"``); or several, each with ``unit``, ``lower``,
        ``upper``.
    shapes : dict
        Parameters that do not enter linearly: ``{"time_constant_s": {"start": 600.0, "lower": 30.0, "upper": 7200.0,
        "grid": [60.0, 600.0, 3600.0], "unit": "s"}}``. The grid are the starts of a search, rising.
    explanation : str
        summary, cause, formula, signature, separated_by, remedy, validity, source: for ``ballbar effects``.

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
    gains = {gain: {"unit": _unit_of(gain)}} if isinstance(gain, str) else {key: dict(value) for key, value in gain.items()}

    def add(function: Function) -> Function:
        _core.add_effect(
            name,
            function,
            inputs=dict(inputs or {}),
            gains=gains,
            shapes={key: dict(value) for key, value in (shapes or {}).items()},
            explanation=explanation,
        )
        return function

    return add


def _unit_of(parameter: str) -> str:
    """um/K of gain_um_per_K."""
    unit = parameter.partition("_")[2]
    return unit.replace("_per_", "/") or "1"
