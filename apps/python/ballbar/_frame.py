"""Tables of pandas and their like as the data of a fit, and back."""
from __future__ import annotations

import os
import re
from collections.abc import Callable, Collection, Iterable, Mapping
from typing import Any, NoReturn, Union

import numpy as np
import pandas

from . import _core
from ._core import Recording, Series
from ._errors import BallbarError, warn
from ._times import ROWS, Every, times_of
from ._units import expect_columns, named_column

Path = Union[str, os.PathLike[str]]
Progress = Callable[[int, int, str], object]
"""Called with (done, of, text); `of` is 0 if the length of the work is unknown."""
Data = Any
"""A path or a list of paths, a DataFrame (pandas, or what has ``__dataframe__`` or ``to_dataframe``), a dict of arrays,
a :class:`Series`, a :class:`Recording` or a list of them."""

_EXPECTED = "expected a path, a DataFrame, a Series or recordings"


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
        if isinstance(data, Iterable) and not hasattr(data, "read") and not isinstance(data, np.ndarray):
            several = list(data)
            if several and all(isinstance(one, Recording) for one in several):
                return [self.hold(several)]
            return [place for one in several for place in self.places(one)]
        if isinstance(data, (np.ndarray, np.generic)):
            raise TypeError(f"{_EXPECTED}, found an array, whose columns have no names; pandas.DataFrame(data, columns=[...]) gives them")
        raise TypeError(f"{_EXPECTED}, found {type(data).__name__}")

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
    every: Every = None,
    zero: pandas.Timestamp | None = None,
    needed: Collection[str] = (),
) -> tuple[Series, pandas.Index]:
    """The columns that are numbers, over time, and the index of the rows.

    Time is a column ``time_s``, ``time_min`` or ``time_h``, else the index: dates, durations, periods, numbers under one
    of these names, or with `every` any; else the one column of dates. Rows of :func:`read` that a file without times
    numbers stay numbered. `zero`: time 0 of dates. `needed`: columns that a model reads, which must be numbers.
    """
    named = {str(name): frame[name] for name in frame.columns}
    if len(named) < len(frame.columns):
        raise BallbarError("expected columns of different names, found " + ", ".join(map(str, frame.columns)) + ".")
    times = times_of(named, frame.index, every, zero)
    columns: dict[str, Any] = {}
    names: dict[str, str] = {}  # of the columns that are kept, as files have them
    expect_columns(units or {}, named)
    left_out = []
    for name, values in named.items():
        if name == times.column:
            continue
        if not _is_numbers(values):
            if name in needed:
                _expect_numbers(name, values)
            left_out.append(name)
            continue
        stated, factor, offset = named_column(name, units or {})
        names[name] = stated if units and name in units else file_name(stated)
        if names[name] in columns:
            raise BallbarError(f'{name}: expected a name of its own with its unit, found two columns "{names[name]}".')
        numbers = values.to_numpy()
        columns[names[name]] = numbers if (factor, offset) == (1.0, 0.0) else factor * _core.numbers(numbers, name) + offset
    if left_out:
        warn(f"left out, as these columns are no numbers: {', '.join(left_out)}")
    stated_roles = {**frame.attrs.get("roles", {}), **(roles or {})}
    known = {names.get(name, name): role for name, role in stated_roles.items() if name in names or roles and name in roles}
    of_file = {key: frame.attrs.get(key) for key in ("started", "five_probe") if key != "started" or every is None}
    started = {"started": times.started} if times.started else {}
    headers = {file: name for name, file in names.items() if file != name and file_name(name) != file}
    return Series(times.time_s, columns, roles=known, headers=headers, has_clock=times.has_clock, **{**of_file, **started}), frame.index


def _expect_numbers(name: str, values: Any) -> NoReturn:
    """Says what a column of texts holds, and how it becomes numbers."""
    row, found = next(((row, one) for row, one in enumerate(values) if not isinstance(one, (int, float, np.number))), (0, values.iloc[0]))
    how = ""
    if isinstance(found, str):
        comma = re.fullmatch(r"\s*[-+]?\d+,\d+\s*", found) is not None
        texts = 'table[name].str.replace(",", ".")' if comma else "table[name]"
        how = f"; pandas.to_numeric({texts.replace('name', repr(name))}) makes numbers of texts" if comma or re.fullmatch(r"\s*[-+.\deE]+\s*", found) else ""
    raise BallbarError(f"{name}, row {row}: expected a number, found {found!r}{how}.")


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
    """A series as a DataFrame over ``time_s``, or over ``row`` where no file tells the time; its units and roles, and what
    else the file states, are in ``attrs``."""
    index = pandas.Index(series.time_s, name="time_s") if series.has_clock else pandas.RangeIndex(len(series), name=ROWS)
    frame = pandas.DataFrame({table_name(name): series[name] for name in series}, index=index)
    frame.attrs["units"] = {table_name(name): unit for name, unit in series.units.items()}
    frame.attrs["roles"] = {table_name(name): role for name, role in series.roles.items()}
    frame.attrs |= {key: value for key in ("started", "five_probe") if (value := getattr(series, key)) is not None}
    return frame
