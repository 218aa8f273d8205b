"""A command of the program, called with values of Python."""
from __future__ import annotations

import logging
import os
import pathlib
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Callable, Union

import numpy as np

from . import _core
from ._core import Recording, Series
from ._errors import BallbarError, UsageError

_log = logging.getLogger("ballbar")

Path = Union[str, "os.PathLike[str]"]
Progress = Callable[[str], object]


class Model:
    """A model: a sum of effects and a constant, as a ``model.toml`` has it.

    Parameters
    ----------
    source : path or str
        A file, or the text of one (with a line break).

    Attributes
    ----------
    path : pathlib.Path or None
        None of a text.

    Examples
    --------
    >>> import ballbar
    >>> model = ballbar.Model.of("y_um", expansion={"temperature": "T_housing_degC"})
    >>> print(model.text)
    format = "ballbar-model 1"
    target = "y_um"
    <BLANKLINE>
    [[effect]]
    name = "expansion"
    temperature = "T_housing_degC"
    <BLANKLINE>
    """

    def __init__(self, source: Path) -> None:
        text = os.fspath(source)
        self.path: pathlib.Path | None = None if "\n" in text else pathlib.Path(text)
        self._text = text

    @classmethod
    def of(cls, target: str | list[str], *effects: str, **columns: Mapping[str, Any]) -> Model:
        """A model of these effects.

        Parameters
        ----------
        target : str or list of str
            Columns in um.
        *effects : str
            Names of effects that need no more.
        **columns : dict
            Of others their columns and parameters: ``name={"input": "column", "parameter": value}``.

        Returns
        -------
        Model
        """
        names = ", ".join(f'"{one}"' for one in target) if isinstance(target, list) else f'"{target}"'
        lines = ['format = "ballbar-model 1"', f"target = [{names}]" if isinstance(target, list) else f"target = {names}"]
        each: list[tuple[str, Mapping[str, Any]]] = [(effect, {}) for effect in effects]
        each += columns.items()
        for name, stated in each:
            lines += ["", "[[effect]]", f'name = "{name}"']
            for key, value in stated.items():
                lines.append(f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value}")
        return cls("\n".join([*lines, ""]))

    @property
    def text(self) -> str:
        """What stands in its file, or would."""
        return self._text if self.path is None else self.path.read_text(encoding="utf-8")

    def save(self, path: Path) -> None:
        """Writes it to a file of another name."""
        pathlib.Path(path).write_text(self.text, encoding="utf-8")

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and (self.path, self._text) == (other.path, other._text)

    def __hash__(self) -> int:
        return hash(self._text)

    def __reduce__(self) -> Any:
        return Model, (self._text,)

    def __repr__(self) -> str:
        return f"<ballbar.Model {self.path or self._text!r}>"


def _series_of(data: Any) -> Series | None:
    """Of a dict of arrays with time_s or time_min, or a DataFrame."""
    if isinstance(data, Series):
        return data
    if hasattr(data, "columns") and hasattr(data, "to_dict"):
        data = {str(name): data[name].to_numpy() for name in data.columns}
    if not isinstance(data, Mapping):
        return None
    columns = dict(data)
    if "time_s" in columns:
        time_s = columns.pop("time_s")
    elif "time_min" in columns:
        time_s = 60.0 * _core.numbers(columns.pop("time_min"), "time_min")
    else:
        raise BallbarError("time_s: expected a column of that name, or time_min, found " + (", ".join(columns) or "none") + ".")
    return Series(time_s, columns)


class Call:
    """What a command is called with, as it is collected."""

    def __init__(self, command: str, *places: str, json: bool = True) -> None:
        self.command = command
        self.places: list[str] = [*places]
        self.set: dict[str, Any] = {"json": True} if json else {}
        self.held: dict[str, Any] = {}  # by the names that stand for them

    def data(self, *sources: Any) -> Call:
        """Paths, a Series, a DataFrame, a dict of arrays, recordings, or a list of any of these but dicts."""
        self.places += self._names_of(sources)
        return self

    def series(self, *sources: Any) -> Call:
        """The same without recordings."""
        self.data(*sources)
        if not any(isinstance(one, list) for one in self.held.values()):
            return self
        raise TypeError(f"ballbar.{self.command}: expected a path or a series, found recordings; ballbar.errors takes them, ranked=True")

    def files(self, *paths: Any) -> Call:
        """Paths alone, or lists of them: of commands that look for files themselves."""
        for one in paths:
            if not isinstance(one, (str, os.PathLike)) and not _is_list(one):
                raise TypeError(f"ballbar.{self.command}: expected a path or a list of paths, found {type(one).__name__}")
            self.data(one) if isinstance(one, (str, os.PathLike)) else self.files(*one)
        return self

    def other_data(self, name: str, *sources: Any) -> Call:
        """Data of an option."""
        names = self._names_of([one for one in sources if one is not None])
        return self.options(**{name: names}) if names else self

    def options(self, **options: Any) -> Call:
        """None is left out; a list gives an option more than once; a dict is NAME=VALUE."""
        for name, value in options.items():
            name = name.rstrip("_")
            if isinstance(value, (bool, np.bool_)):
                self.set[name] = bool(value)
            elif isinstance(value, Mapping):
                self.set[name] = [f"{key}={_text(one)}" for key, one in value.items()]
            elif _is_list(value):
                each = sorted(value) if isinstance(value, (set, frozenset)) else value
                self.set[name] = [self._word_of(one) for one in each]
            elif value is not None:
                self.set[name] = [self._word_of(value)]
        return self

    def run(self, progress: Progress | None = None) -> Any:
        words = [*self.places, *(word for value in self.set.values() if isinstance(value, list) for word in value)]
        for word in words:
            if "\0" in word:
                raise UsageError(f"{word!r}: expected a text without a null character.")
        try:
            result, remarks, wrote = self._made(progress)
        except BallbarError as error:
            error.find_place(words)
            raise
        for remark in remarks:
            _log.warning(remark)
        for file in wrote:
            _log.info("wrote %s", file)
        return result

    def picture(self, name: str) -> str:
        """The picture of that name that the page of these data would have, as SVG."""
        report = Call("report", *self.places, json=False)
        report.held = self.held
        report.set |= {key: self.set[key] for key in _OF_A_FIT if key in self.set}
        report.options(format="svg", picture=name)
        if "model" in self.set or name == "with-without":
            report.options(**{"diagnose" if self.command == "diagnose" else "no_diagnosis": True})
        with tempfile.TemporaryDirectory(prefix="ballbar-") as folder:
            path = pathlib.Path(folder) / "picture.svg"
            report.options(out=path)._made()  # what is to be said of the data was said
            return path.read_text(encoding="utf-8")

    def _made(self, progress: Progress | None = None) -> tuple[Any, list[str], list[str]]:
        return _core.call(self.command, self.places, list(self.set.items()), self.held, progress)

    def _names_of(self, sources: Iterable[Any]) -> list[str]:
        names: list[str] = []
        for source in sources:
            series = _series_of(source)
            if series is not None:
                names.append(self._hold(series))
            elif isinstance(source, Recording):
                names.append(self._hold([source]))
            elif isinstance(source, (str, os.PathLike)):
                path = os.fspath(source)
                names.append("./-" if path == "-" else path)  # not the standard input
            elif isinstance(source, Iterable):
                several = list(source)
                recordings = several and all(isinstance(one, Recording) for one in several)
                names += [self._hold(several)] if recordings else self._names_of(several)
            else:
                raise TypeError(f"expected a path, a Series, a DataFrame or recordings, found {type(source).__name__}")
        return names

    def _hold(self, data: Any, kind: str = "data") -> str:
        number = 1 + sum(name.startswith(f"<{kind}") for name in self.held)
        name = f"<{kind}>" if number == 1 else f"<{kind} {number}>"
        self.held[name] = data
        return name

    def _word_of(self, value: Any) -> str:
        is_text = isinstance(value, Model) and value.path is None
        return self._hold(value.text, "model") if is_text else _text(value)


_OF_A_FIT = ("model", "target", "max_gap", "also_input", "set", "robust", "white")


def _is_list(value: Any) -> bool:
    return isinstance(value, (list, tuple, set, frozenset, np.ndarray)) or isinstance(value, Iterator)


def _text(value: Any) -> str:
    if isinstance(value, Model):
        return str(value.path)
    if isinstance(value, (os.PathLike, str)):
        return os.fspath(value)
    return repr(float(value)) if isinstance(value, float) else str(value)
