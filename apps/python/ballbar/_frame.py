"""Tables of pandas and their like as the data of a fit, and back."""
from __future__ import annotations

import math
import os
from collections.abc import Callable, Iterable, Mapping
from typing import Any, Union

import numpy as np
import pandas

from . import _core
from ._core import Recording, Series
from ._errors import BallbarError, warn

Path = Union[str, os.PathLike[str]]
Progress = Callable[[int, int, str], object]
"""Called with (done, of, text); `of` is 0 if the length of the work is unknown."""
Data = Any
"""A path or a list of paths, a DataFrame (pandas, or what has ``__dataframe__`` or ``to_dataframe``), a dict of arrays,
a :class:`Series`, a :class:`Recording` or a list of them."""

TIMES = {"time_s": 1.0, "time_min": 60.0, "time_h": 3600.0}


class Held:
    """Data and models that a call holds, by the names that stand for them."""

    def __init__(self, **how: Any) -> None:
        self.values: dict[str, Any] = {}
        self._indexes: list[pandas.Index] = []
        self._places = 0
        self._how = how

    @property
    def index(self) -> pandas.Index | None:
        """Of the table, where there is one; of several their rows are known by time alone."""
        return self._indexes[0] if len(self._indexes) == 1 and self._places == 1 else None

    def places(self, data: Data) -> list[str]:
        """The words that stand for data: paths, and names of what is held."""
        if isinstance(data, (str, os.PathLike)):
            path = os.fspath(data)
            self._places += 1
            return ["./-" if path == "-" else path]  # not the standard input
        if isinstance(data, Series):
            return [self.hold(data)]
        if isinstance(data, Recording):
            return [self.hold([data])]
        frame = frame_of(data)
        if frame is not None:
            series, index = series_of(frame, **self._how)
            self._indexes.append(index)
            return [self.hold(series)]
        if isinstance(data, Iterable) and not hasattr(data, "read"):
            several = list(data)
            if several and all(isinstance(one, Recording) for one in several):
                return [self.hold(several)]
            return [place for one in several for place in self.places(one)]
        raise TypeError(f"expected a path, a DataFrame, a Series or recordings, found {type(data).__name__}")

    def hold(self, value: Any, kind: str = "data") -> str:
        number = 1 + sum(name.startswith(f"<{kind}") for name in self.values)
        self._places += kind == "data"
        name = f"<{kind}>" if number == 1 else f"<{kind} {number}>"
        self.values[name] = value
        return name


def frame_of(data: Any) -> pandas.DataFrame | None:
    """A table as one of pandas; None: it is no table."""
    if isinstance(data, pandas.DataFrame):
        return data
    if isinstance(data, pandas.Series):
        return data.to_frame()
    if hasattr(data, "compute") and hasattr(data, "columns"):  # Dask
        return frame_of(data.compute())
    if isinstance(data, Mapping):
        arrays = {str(name): _column(values, str(name)) for name, values in data.items()}
        lengths = {name: len(values) for name, values in arrays.items()}
        if len(set(lengths.values())) > 1:
            raise BallbarError("expected columns of one length, found " + ", ".join(f"{key}: {n}" for key, n in lengths.items()) + ".")
        return pandas.DataFrame(arrays)
    if hasattr(data, "to_dataframe"):  # xarray
        return frame_of(data.to_dataframe())
    if hasattr(data, "__dataframe__"):  # polars, pyarrow ...
        return pandas.api.interchange.from_dataframe(data)
    return None


def _column(values: Any, name: str) -> Any:
    """A masked array has gaps where its mask is; what else it is, pandas knows."""
    if isinstance(values, np.ma.MaskedArray):
        return _core.numbers(values, name)
    return values if hasattr(values, "dtype") else list(values)


def series_of(
    frame: pandas.DataFrame,
    *,
    units: Mapping[str, str] | None = None,
    roles: Mapping[str, str] | None = None,
    every: float | str | None = None,
) -> tuple[Series, pandas.Index]:
    """The columns that are numbers, over time, and the index of the rows.

    Time is a column ``time_s``, ``time_min`` or ``time_h``, else the index: dates, durations, numbers under one of these
    names, or with `every` any; else the one column of dates.
    """
    named = {str(name): frame[name] for name in frame.columns}
    if len(named) < len(frame.columns):
        raise BallbarError("expected columns of different names, found " + ", ".join(map(str, frame.columns)) + ".")
    time_s, started, used = _time_of(named, frame.index, every)
    columns: dict[str, Any] = {}
    names: dict[str, str] = {}  # of the columns that are kept, as files have them
    for name in units or ():
        if name not in named:
            raise BallbarError(f'units: expected names of columns, found "{name}".')
    left_out = []
    for name, values in named.items():
        if name == used:
            continue
        if not _is_numbers(values):
            left_out.append(name)
            continue
        is_bare = units and name in units and not name.endswith("_" + units[name])
        names[name] = f"{name}_{units[name]}" if units and is_bare else file_name(name)
        if names[name] in columns:
            raise BallbarError(f'{name}: expected a name of its own with its unit, found two columns "{names[name]}".')
        columns[names[name]] = values.to_numpy()
    if left_out:
        warn(f"left out, as these columns are no numbers: {', '.join(left_out)}")
    stated = {**frame.attrs.get("roles", {}), **(roles or {})}
    known = {names.get(name, name): role for name, role in stated.items() if name in names or roles and name in roles}
    of_file = {key: frame.attrs.get(key) for key in ("started", "five_probe") if key != "started" or every is None}
    return Series(time_s, columns, roles=known, **{**of_file, **({"started": started} if started else {})}), frame.index


def _time_of(named: dict[str, Any], index: pandas.Index, every: float | str | None) -> tuple[Any, str | None, str | None]:
    """Seconds, the wall clock at their start, and the column that they are from."""
    if every is not None:
        timed = [name for name in TIMES if name in named or index.name == name]
        if timed or isinstance(index, (pandas.DatetimeIndex, pandas.TimedeltaIndex)):
            raise BallbarError(f"every: expected a table without times, found {timed[0] if timed else 'an index of them'}; leave it out.")
        try:
            step_s = pandas.Timedelta(every).total_seconds() if isinstance(every, str) else float(every)
        except (TypeError, ValueError):
            step_s = math.nan
        if not 0.0 < step_s < math.inf:
            raise BallbarError(f'every: expected the step of the rows, in s or such as "10s", found {every!r}.')
        return step_s * np.arange(len(index)), None, None
    for name, seconds in TIMES.items():
        if name in named:
            return seconds * _core.numbers(named[name].to_numpy(), name), None, name
    if isinstance(index, (pandas.DatetimeIndex, pandas.TimedeltaIndex)):
        return *_seconds_of(index), None
    if index.name in TIMES:
        return TIMES[str(index.name)] * _core.numbers(index.to_numpy(), str(index.name)), None, None
    dates = [name for name, values in named.items() if pandas.api.types.is_datetime64_any_dtype(values)]
    if len(dates) == 1:
        return *_seconds_of(pandas.DatetimeIndex(named[dates[0]])), dates[0]
    raise BallbarError(
        "time_s: expected a column of that name (or time_min, time_h), an index of dates or durations, or every=, the "
        f"step of the rows, such as every=\"10s\", found {', '.join(named) or 'none'}."
    )


def _seconds_of(index: Any) -> tuple[Any, str | None]:
    if isinstance(index, pandas.TimedeltaIndex):
        return index.total_seconds().to_numpy(), None
    if index.hasnans:
        raise BallbarError(f"time, row {int(np.argmax(index.isna()))}: expected a date, found none.")
    if not len(index):
        return np.empty(0), None
    started = index[0].strftime("%Y-%m-%dT%H:%M:%S")  # of the wall clock; what passes since is of no zone
    passed = index if index.tz is None else index.tz_convert("UTC").tz_localize(None)
    return (passed - passed[0].floor("s")).total_seconds().to_numpy(), started


def _is_numbers(values: Any) -> bool:
    kinds = pandas.api.types
    if values.dtype == object:  # of numbers and gaps; one that is neither is told by its row
        known = values.dropna()
        return known.empty or any(isinstance(one, (int, float, np.number)) and not isinstance(one, bool) for one in known)
    return kinds.is_numeric_dtype(values) and not kinds.is_bool_dtype(values) and not kinds.is_complex_dtype(values)


def file_name(name: str) -> str:
    """x_sigma_um of x_um_sigma: tables have the sigma of a column at the end of its name, files before the unit."""
    stem = name.removesuffix("_sigma")
    unit = _core.unit_of(stem) if stem != name else ""
    return f"{stem.removesuffix(unit)}sigma_{unit}" if unit else name


def table_name(name: str) -> str:
    """x_um_sigma of x_sigma_um."""
    unit = _core.unit_of(name)
    stem = name.removesuffix(f"_sigma_{unit}") if unit else name
    return f"{stem}_{unit}_sigma" if stem != name else name


def frame_from(series: Series) -> pandas.DataFrame:
    """A series as a DataFrame over ``time_s``, with units, roles and what else the file states in ``attrs``."""
    frame = pandas.DataFrame({table_name(name): series[name] for name in series}, index=pandas.Index(series.time_s, name="time_s"))
    frame.attrs["units"] = {table_name(name): unit for name, unit in series.units.items()}
    frame.attrs["roles"] = {table_name(name): role for name, role in series.roles.items()}
    frame.attrs |= {key: value for key in ("started", "five_probe") if (value := getattr(series, key)) is not None}
    return frame
