"""Ballbar logs of machine tools: circles, errors of the axes, thermal drift of the spindle, models of it and what they lack.

Everything that the program ``ballbar`` does, as functions on files and on arrays. Results have the keys of the
program's ``--json`` as attributes, with the same numbers to the last bit. What can be put right comes as
:class:`BallbarError`, with file, line and column. Remarks go to the logger ``ballbar``.

Units stand at the end of every name: ``_um``, ``_mm``, ``_deg``, ``_s``, ``_degC``, ``_rpm``.
"""
from __future__ import annotations

from . import _core
from ._call import Model
from ._catalogue import effect
from ._core import Recording, Series, read_recordings, read_series
from ._errors import BallbarError, UsageError
from ._kinds import (
    Added, Checked, Comparison, Diagnosis, Drift, Effects, Errors, Fitted, History, Imported, Injected, Plan,
    Predicted, Preflight, RankedErrors, Report, Selected, Simulated, Trained, Tried,
)
from ._logs import import_log, merge, simulate
from ._measure import compare, drift, errors, fit, history
from ._models import check, diagnose, effects, plan, preflight
from ._predict import compensate, predict, report, select, train
from ._results import Result, Rows
from ._revisions import add, inject, ledger, try_effect, undo

__version__: str = _core.version
__all__ = [
    "Added", "BallbarError", "Checked", "Comparison", "Diagnosis", "Drift", "Effects", "Errors", "Fitted", "History",
    "Imported", "Injected", "Model", "Plan", "Predicted", "Preflight", "RankedErrors", "Recording", "Report", "Result", "Rows",
    "Selected", "Series", "Simulated", "Trained", "Tried", "UsageError", "add", "check", "compare", "compensate",
    "diagnose", "drift", "effect", "effects", "errors", "fit", "history", "import_log", "inject", "ledger", "merge",
    "plan", "predict", "preflight", "read_recordings", "read_series", "report", "select", "simulate", "train",
    "try_effect", "undo",
]
