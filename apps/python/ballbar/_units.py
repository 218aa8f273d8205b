"""Units: of columns as people name them, and of results whose target is no length."""
from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any

from . import _core
from ._errors import BallbarError, UsageError

_NAMED = re.compile(r"_um(?=_|$)")
_WORD = re.compile(r"(?<![\w/])um(?!\w)")
_OF_TEMPERATURE = re.compile(r"(?i)^t\d*[_ (\[]|temp")


def named_column(name: str, units: Mapping[str, str]) -> tuple[str, float, float]:
    """The name with the unit of a series at its end, and how the values become of this unit: factor and offset."""
    if name in units:
        unit = units[name]
        if _core.unit_of("x_" + unit) == unit:
            return name if name.endswith("_" + unit) else f"{name}_{unit}", 1.0, 0.0
        known = _core.column_unit(unit)
        if known is None:
            raise UsageError(f'units: expected a unit such as um, mm, degC, degF, rpm, A, W, bar or percent, found "{unit}" for {name}.')
        stem = name.removesuffix("_" + unit)
        return f"{stem}_{known[0]}", known[1], known[2]
    found = _core.in_unit_of_series(name)
    if found is None or found[0].endswith("_um"):  # a length may be an input in its own unit; a target is converted later
        return name, 1.0, 0.0
    of_one_letter = len(name) > 1 and not name[-2].isalnum() and name[-2] != "°"
    if of_one_letter and (name[-1] not in "CF" or not _OF_TEMPERATURE.search(name)):
        return name, 1.0, 0.0  # phase_C is no temperature
    return found


def expect_columns(units: Mapping[str, str], names: Any) -> None:
    for name in units:
        if name not in names:
            raise BallbarError(f'units: expected names of columns, found "{name}".')


def in_unit(value: Any, unit: str) -> Any:
    """Keys and sentences of a result with the unit of its target in the place of um; no unit: "units"."""
    if unit == "um":
        return value
    if isinstance(value, dict):
        return {named_in(key, unit): in_unit(one, unit) for key, one in value.items()}
    if isinstance(value, list):
        return [in_unit(one, unit) for one in value]
    return _WORD.sub(unit or "units", value) if isinstance(value, str) else value


def named_in(key: str, unit: str) -> str:
    """``rmse_degC`` of ``rmse_um``; no unit: ``rmse``."""
    return _NAMED.sub(f"_{unit}" if unit else "", key) if unit != "um" else key
