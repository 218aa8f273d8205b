"""Results: what a command says for a program, with its keys as attributes."""
from __future__ import annotations

import html
import json
from typing import Any, Callable, Iterator

import numpy as np

from . import _core


# By the class of a result: the part of a page that it is drawn as, or the picture of the page of the same data.
_PARTS = {"Comparison": "compare", "Drift": "drift"}
_PICTURES: dict[str, Callable[[Any], str]] = {
    "Fitted": lambda _: "recording-circle",
    "Checked": lambda found: f"model-{found.target}-fit" if "target" in found else "",
    "Diagnosis": lambda found: "with-without" if "target" in found else "",
    "RankedErrors": lambda found: "machine-errors" if "errors" in found else "",
}


def _is_numbers(values: list[Any]) -> bool:
    return bool(values) and all(value is None or type(value) in (int, float) for value in values)


def _wrapped(value: Any) -> Any:
    if type(value) is dict:
        return Result(value)
    if type(value) is list:
        if value and all(type(one) is dict for one in value):
            return Rows(value)
        if _is_numbers(value):
            whole = all(type(one) is int for one in value)
            return np.array(value, dtype=np.int64 if whole else np.float64)
    return value


def _empty(kind: type, name: str) -> Any:
    """An empty list as what the class says it is a list of."""
    kind_text = next((one.__annotations__[name] for one in kind.__mro__ if name in one.__dict__.get("__annotations__", ())), "Rows")
    return np.empty(0) if kind_text == "Array" else [] if kind_text.startswith("list") else Rows([])


class Result:
    """One result: ``result.rmse_um`` is the key ``rmse_um`` of the program's JSON, to the last bit.

    Lists of numbers are arrays (a number that is not known is NaN), lists of objects are :class:`Rows`, objects are
    results again. A key that is a word of Python is had as ``result["from"]``.
    """

    __slots__ = ("_json", "_made", "_call")

    def __init__(self, keys: dict[str, Any], call: Any = None) -> None:
        self._json = keys
        self._made: dict[str, Any] = {}
        self._call = call  # that it came of

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except KeyError:
            known = ", ".join(self._json)
            raise AttributeError(f"{type(self).__name__} has no {name}; it has {known}") from None

    def __getitem__(self, name: str) -> Any:
        if name not in self._made:
            value = self._json[name]
            self._made[name] = _empty(type(self), name) if value == [] else _wrapped(value)
        return self._made[name]

    def __contains__(self, name: object) -> bool:
        return name in self._json

    def __iter__(self) -> Iterator[str]:
        return iter(self._json)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._json]

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Result) and self._json == other._json

    __hash__ = None  # type: ignore[assignment]

    def __reduce__(self) -> Any:
        slots = {name: getattr(self, name) for name in type(self).__dict__.get("__slots__", ()) if name[0] != "_"}
        return type(self), (self._json,), (None, slots) if slots else None

    def to_dict(self) -> dict[str, Any]:
        """The keys and values of the program's JSON: dict, list, str, float, int, bool, None."""
        return self._json

    def to_pandas(self) -> Any:
        """A table of pandas: of the longest list of rows, else of the numbers of equal length.

        Raises
        ------
        ImportError
            Where pandas is not installed.
        """
        import pandas

        rows = [value for value in self._json.values() if type(value) is list and value and type(value[0]) is dict]
        if rows:
            return pandas.DataFrame(max(rows, key=len))
        columns = {key: self[key] for key, value in self._json.items() if type(value) is list and _is_numbers(value)}
        if columns:
            longest = max(len(values) for values in columns.values())
            return pandas.DataFrame({key: values for key, values in columns.items() if len(values) == longest})
        return pandas.DataFrame([{key: value for key, value in self._json.items() if type(value) not in (dict, list)}])

    def conclusion_text(self) -> str:
        """The sentence that says it, where the result has one."""
        for key in ("conclusion", "sentence", "verdict"):
            if isinstance(self._json.get(key), str):
                return str(self._json[key])
        return ""

    def __repr__(self) -> str:
        short = []
        for key, value in self._json.items():
            if type(value) is list:
                short.append(f"{key}: {len(value)} of them" if value else f"{key}: none")
            elif type(value) is dict:
                short.append(f"{key}: {', '.join(value)}" if value else f"{key}: empty")
            else:
                short.append(f"{key}: {value}")
        return f"<{type(self).__name__}\n  " + "\n  ".join(line if len(line) < 116 else line[:113] + "..." for line in short) + ">"

    def picture(self) -> str:
        """What the page draws of this result, as SVG; by node. Empty: nothing.

        Raises
        ------
        BallbarError
            No node, or a ballbar that was built without its page.
        """
        kind = type(self).__name__
        if kind in _PARTS:
            return str(_core.picture(json.dumps({_PARTS[kind]: self._json}), self.conclusion_text()))
        name = _PICTURES[kind](self) if kind in _PICTURES else ""
        return str(self._call.picture(name)) if name and self._call else ""

    def _repr_html_(self) -> str:
        try:
            drawn = self.picture()
        except ValueError:  # without node, or without the page
            drawn = ""
        return drawn + f"<pre>{html.escape(repr(self))}</pre>"


class Rows(list):  # type: ignore[type-arg]
    """Rows of a result, each a :class:`Result`; ``rows["value"]`` is a column."""

    def __init__(self, rows: list[dict[str, Any]]) -> None:
        super().__init__(Result(row) for row in rows)

    def __getitem__(self, place: Any) -> Any:
        if isinstance(place, str):
            return _wrapped([row.to_dict().get(place) for row in self]) if self else np.empty(0)
        return super().__getitem__(place)

    def to_dict(self) -> list[dict[str, Any]]:
        """The rows of the program's JSON."""
        return [row.to_dict() for row in self]

    def to_pandas(self) -> Any:
        """A table of pandas, a row each."""
        import pandas

        return pandas.DataFrame(self.to_dict())
