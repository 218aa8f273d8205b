"""Results: the keys of the program's JSON as attributes that cannot be changed."""
from __future__ import annotations

import copy
import html
import re
from collections.abc import Iterator
from typing import Any, NoReturn, TypeVar, overload

import numpy as np
import pandas

_classes: dict[str, type[Result]] = {}  # by name, for the parts of results


def is_numbers(values: Any) -> bool:
    return isinstance(values, np.ndarray) or bool(values) and all(value is None or type(value) in (int, float) for value in values)


class Result:
    """One result: ``result.rmse_um`` is the key ``rmse_um`` of the program's JSON, to the last bit.

    Lists of numbers are arrays (a number that is not known is NaN), lists of objects are :class:`Rows`, objects are
    results. An attribute of the class that has no key here, as there is nothing of it, is None. A key that is a word of Python is read as ``result["from"]``.
    """

    __slots__ = ("_json", "_made")
    _json: dict[str, Any]
    _made: dict[str, Any]
    _is_open = False  # a class of results whose keys are known once they are made

    def __init__(self, keys: dict[str, Any]) -> None:
        object.__setattr__(self, "_json", keys)
        object.__setattr__(self, "_made", {})

    def __init_subclass__(cls) -> None:
        _classes.setdefault(cls.__name__, cls)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            if _annotation(type(self), name) and not self._has_other_unit(name):  # a key of other cases: there is nothing
                return None
            raise AttributeError(f"{type(self).__name__} has no {name}; it has {', '.join(self._json)}") from None

    def _has_other_unit(self, name: str) -> bool:
        """Whether the key in um is there in another unit, that of a target which is no length."""
        stem, um, _ = name.partition("_um")
        return bool(um) and not any("_um" in key for key in self._json) and any(f"{key}_".startswith(f"{stem}_") for key in self._json)

    def __getitem__(self, name: str) -> Any:
        if name not in self._made:
            self._made[name] = _wrapped(self._json[name], type(self), name)
        made = self._made[name]
        return list(made) if type(made) is list else made

    def __setattr__(self, name: str, value: object = None) -> NoReturn:
        raise AttributeError(f"{type(self).__name__} is a result and cannot be changed; to_dict() gives a dict of it")

    __delattr__ = __setattr__

    def __contains__(self, name: object) -> bool:
        return name in self._json

    def __iter__(self) -> Iterator[str]:
        return iter(self._json)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._json]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Result) and _equal(self._json, other._json)

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        return type(self), (self._json,)

    def to_dict(self) -> dict[str, Any]:
        """A dict with the keys and values of the program's JSON; the columns of a prediction are arrays."""
        return copy.deepcopy(self._json)

    def to_pandas(self) -> Any:
        """A DataFrame of the longest list of rows, else of the numbers of equal length, else of the single values.

        The sigma of a column stands behind its name: ``x_um_sigma``.
        """
        lists = {key: value for key, value in self._json.items() if type(value) in (list, np.ndarray) and len(value)}
        columns = {key: self[key] for key, value in lists.items() if is_numbers(value)}
        rows = [value for value in lists.values() if type(value[0]) is dict]
        if rows and not any(type(value) is np.ndarray for value in lists.values()):
            return pandas.DataFrame(max(rows, key=len)).rename(columns=python_name)
        if columns:
            longest = max(len(values) for values in columns.values())
            return pandas.DataFrame({python_name(key): values for key, values in columns.items() if len(values) == longest})
        return pandas.DataFrame([{python_name(key): value for key, value in self._json.items() if type(value) not in (dict, list)}])

    def plot(self, axes: Any = None) -> Any:
        """Draws this result with matplotlib on these axes, or on new ones, and returns them.

        Raises
        ------
        TypeError
            Of a kind of result that has no picture.
        """
        from . import plot

        return plot.of(self, axes)

    def __repr__(self) -> str:
        short = []
        for key, value in self._json.items():
            if type(value) is np.ndarray:
                short.append(f"{key}: {len(value)} numbers")
            elif type(value) is list and not is_numbers(value[:1] if len(value) < 9 else []):
                short.append(f"{key}: {len(value)} of them" if value else f"{key}: none")
            elif type(value) is dict:
                short.append(f"{key}: {', '.join(value)}" if value else f"{key}: empty")
            else:
                short.append(f"{key}: {value}")
        return f"<{type(self).__name__}\n  " + "\n  ".join(line if len(line) < 116 else line[:113] + "..." for line in short) + ">"

    def _repr_html_(self) -> str:
        from . import plot

        return plot.svg_of(self) + f"<pre>{html.escape(repr(self))}</pre>"


Row = TypeVar("Row", bound=Result)


class Rows(tuple[Row, ...]):
    """Rows of a result; ``rows["value"]`` is a column, as an array where it holds numbers."""

    __slots__ = ()

    @overload  # type: ignore[override]
    def __getitem__(self, place: str) -> Any: ...
    @overload
    def __getitem__(self, place: int) -> Row: ...
    @overload
    def __getitem__(self, place: slice) -> tuple[Row, ...]: ...
    def __getitem__(self, place: Any) -> Any:
        if not isinstance(place, str):
            return super().__getitem__(place)
        known = dict.fromkeys(key for row in self for key in row)
        if self and place not in known:
            raise KeyError(f"{place}: the rows have {', '.join(known)}")
        values = [row._json.get(place) for row in self]
        return _wrapped(values, type(self[0]), place) if values else np.empty(0)

    def to_dict(self) -> list[dict[str, Any]]:
        """The rows of the program's JSON."""
        return copy.deepcopy([row._json for row in self])

    def to_pandas(self) -> Any:
        """A DataFrame with a line a row; the sigma of a column stands behind its name, ``x_um_sigma``."""
        return pandas.DataFrame([row._json for row in self]).rename(columns=python_name)


def python_name(name: str) -> str:
    """x_um_sigma of the keys x_sigma_um and sigma_x_um."""
    if name.startswith("sigma_") and name.count("_") > 1:
        return name.removeprefix("sigma_") + "_sigma"
    stem, middle, unit = name.rpartition("_sigma_")
    return f"{stem}_{unit}_sigma" if middle else name


def _equal(a: Any, b: Any) -> bool:
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(_equal(value, b[key]) for key, value in a.items())
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(a, b, equal_nan=True)
    return bool(a == b)


def _annotation(kind: type, name: str) -> str:
    return next((one.__dict__["__annotations__"][name] for one in kind.__mro__ if name in one.__dict__.get("__annotations__", ())), "")


def _class_for(keys: dict[str, Any], annotation: str) -> type[Result]:
    """Of the classes that an annotation names the first that has all of these keys."""
    named = [_classes[word] for word in re.findall(r"\w+", annotation) if word in _classes]
    for one in named:
        if one._is_open or all(_annotation(one, key) for key in keys):
            return one
    return named[0] if named else Result


def _wrapped(value: Any, of: type, name: str) -> Any:
    annotation = _annotation(of, name)
    if type(value) is dict:
        return _class_for(value, annotation)(value)
    if type(value) is list:
        if not value:
            return np.empty(0) if annotation == "Array" else [] if annotation.startswith("list") else Rows()
        if all(type(one) is dict for one in value):
            return Rows(_class_for(one, annotation)(one) for one in value)
        if is_numbers(value) or annotation == "Array":
            whole = all(type(one) is int for one in value)
            value = np.array(value, dtype=np.int64 if whole else np.float64)
    if isinstance(value, np.ndarray):
        value.setflags(write=False)
    return value
