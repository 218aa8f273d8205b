"""The times of a table's rows: a column, an index, or the step that a user states."""
from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import timedelta
from typing import Any, Union

import numpy as np
import pandas

from . import _core
from ._errors import BallbarError

TIMES = {"time_s": 1.0, "time_min": 60.0, "time_h": 3600.0}
ROWS = "row"  #: name of the index of rows that are numbered, for no file tells their times
Every = Union[float, str, timedelta, np.timedelta64, None]
_ISO = re.compile(r"\d{4}-\d{2}-\d{2}([ T]\d{2}:\d{2}(:\d{2}([.,]\d+)?)?(Z|[+-]\d{2}:?\d{2})?)?")
_EXPECTED = 'a column of that name (or time_min, time_h), an index of dates or durations, or every=, the step of the rows, such as every="10s"'


@dataclass(frozen=True, eq=False)
class Times:
    """Seconds of each row.

    Attributes
    ----------
    time_s : (n,) array
    started : str or None
        Wall clock at time 0.
    column : str or None
        The column that they are from.
    has_clock : bool
        False: the rows are numbered.
    """

    time_s: Any
    started: str | None = None
    column: str | None = None
    has_clock: bool = True


def times_of(columns: Mapping[str, Any], index: pandas.Index, every: Every, zero: pandas.Timestamp | None = None) -> Times:
    """The times of a table.

    Parameters
    ----------
    columns : dict of Series
    index : Index
        Of the rows.
    every : float, str or timedelta
        Step of the rows.
    zero : Timestamp
        Time 0 of dates; None: the first of them.
    """
    if every is not None:
        timed = [name for name in TIMES if name in columns or index.name == name]
        if timed or isinstance(index, (pandas.DatetimeIndex, pandas.TimedeltaIndex, pandas.PeriodIndex)):
            raise BallbarError(f"every: expected a table without times, found {timed[0] if timed else 'an index of them'}; leave it out.")
        first = int(index[0]) if _counts(index) else 0  # rows cut out of a table keep their numbers
        return Times(seconds(every) * np.arange(first, first + len(index)))
    for name, of_one in TIMES.items():
        if name in columns:
            return Times(of_one * _core.numbers(columns[name].to_numpy(), name), column=name)
    if isinstance(index, pandas.PeriodIndex):
        index = index.to_timestamp()
    if isinstance(index, pandas.TimedeltaIndex):
        return Times(index.total_seconds().to_numpy())
    if isinstance(index, pandas.DatetimeIndex):
        return _of_dates(index, zero)
    if index.name in TIMES:
        return Times(TIMES[str(index.name)] * _core.numbers(index.to_numpy(), str(index.name)))
    if index.name == ROWS and pandas.api.types.is_integer_dtype(index.dtype):
        return Times(index.to_numpy(float), has_clock=False)
    if _are_iso(index):
        return _of_dates(pandas.DatetimeIndex(pandas.to_datetime(index)), zero)
    dates = [name for name, values in columns.items() if pandas.api.types.is_datetime64_any_dtype(values) or _are_iso(values)]
    if len(dates) == 1:
        return _of_dates(pandas.DatetimeIndex(pandas.to_datetime(columns[dates[0]])), zero, dates[0])
    if len(dates) > 1:
        raise BallbarError(f"time_s: expected one column of dates, found {', '.join(dates)}; set_index() chooses one.")
    raise BallbarError(f"time_s: expected {_EXPECTED}, found {', '.join(columns) or 'none'}.")


def _counts(index: pandas.Index) -> bool:
    """Whole numbers, each by 1 more than the one before it."""
    return bool(len(index)) and pandas.api.types.is_integer_dtype(index.dtype) and bool((np.diff(index.to_numpy()) == 1).all())


def seconds(every: Any) -> float:
    """The step that a user states, s."""
    try:
        step_s: float = pandas.Timedelta(every).total_seconds() if isinstance(every, (str, timedelta, np.timedelta64)) else float(every)
    except (TypeError, ValueError):
        step_s = math.nan
    if not 0.0 < step_s < math.inf:
        raise BallbarError(f'every: expected the step of the rows, in s or such as "10s", found {every!r}.')
    return step_s


def zero_of(index: pandas.Index | None) -> pandas.Timestamp | None:
    """Time 0 of dates; None: they are none."""
    if isinstance(index, pandas.PeriodIndex):
        index = index.to_timestamp()
    return index[0].floor("s") if isinstance(index, pandas.DatetimeIndex) and len(index) and not index.hasnans else None


def _are_iso(values: Any) -> bool:
    """Texts of dates whose order of day and month is known."""
    if values.dtype != object and not pandas.api.types.is_string_dtype(values.dtype):
        return False
    found = False
    for one in values:
        if isinstance(one, str) and _ISO.fullmatch(one):
            found = True
        elif isinstance(one, str) or not pandas.isna(one):
            return False
    return found


def _of_dates(index: pandas.DatetimeIndex, zero: pandas.Timestamp | None, column: str | None = None) -> Times:
    if index.hasnans:
        raise BallbarError(f"time, row {int(np.argmax(index.isna()))}: expected a date, found none.")
    if not len(index):
        return Times(np.empty(0), column=column)
    first = zero if zero is not None and (zero.tz is None) == (index.tz is None) else index[0].floor("s")
    started = first.strftime("%Y-%m-%dT%H:%M:%S")  # of the wall clock; what passes since is of no zone
    passed, since = (index, first) if index.tz is None else (index.tz_convert("UTC").tz_localize(None), first.tz_convert("UTC").tz_localize(None))
    return Times((passed - since).total_seconds().to_numpy(), started, column)
