"""Ballbar logs of machine tools: circles, errors of the axes, thermal drift of the spindle, models of it and what they lack.

Data are files or tables of pandas. Results cannot be changed; their attributes are the keys of the program's ``--json``,
with the same numbers to the last bit. What can be put right comes as :class:`BallbarError`, with file, line and column.
Remarks go to the logger ``ballbar``.

Units stand at the end of every name: ``_um``, ``_mm``, ``_deg``, ``_s``, ``_degC``, ``_rpm``.
"""
from __future__ import annotations

from typing import Any

from . import _core, _effects
from ._core import Recording, Series, read_recordings
from ._effects import *  # noqa: F403
from ._errors import BallbarError, BallbarWarning, UsageError
from ._fleet_rows import errors_table as errors
from ._functions import (
    circles, compare, compensate, could, drift, effects, history, import_log, machine_errors, plan, predict, report,
    simulate, train,
)
from ._measure import fit_circle, read, write
from ._model import Diagnosis, Fit, Model
from ._results import Result, Rows
from ._terms import Effect, Expression, Free, PythonEffect, effect, free

__version__: str = _core.version
errors.__module__, errors.__name__, errors.__qualname__ = __name__, "errors", "errors"
__all__ = [
    "BallbarError", "BallbarWarning", "Diagnosis", "Effect", "Expression", "Fit", "Free", "Model", "PythonEffect", "Recording",
    "Result", "Rows", "Series", "UsageError", "circles", "compare", "compensate", "could", "drift", "effect", "effects", "errors",
    "fit_circle", "free", "history", "import_log", "machine_errors", "plan", "predict", "read", "read_recordings", "report",
    "simulate", "train", "write", *_effects.__all__,
]


_MODULES = ("fleet", "plot", "sklearn")  # that need more than numpy and pandas: imported when they are first used


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        from importlib import import_module

        return import_module(f"{__name__}.{name}")
    raise AttributeError(f"module {__name__} has no attribute {name}")


def __dir__() -> list[str]:
    return sorted([*__all__, *_MODULES, *(name for name in globals() if name.startswith("__"))])
