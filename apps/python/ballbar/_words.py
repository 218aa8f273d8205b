"""From arguments of Python to the words of a command, and data that are no files."""
from __future__ import annotations

import logging
import os
import pathlib
import shutil
import tempfile
import weakref
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, Callable, Union

import numpy as np

from . import _core
from ._core import Recording, Series
from ._errors import BallbarError, UsageError

_log = logging.getLogger("ballbar")

Path = Union[str, "os.PathLike[str]"]
Progress = Callable[[str], object]

#: The options that are words alone.
FLAGS = frozenset(
    "polar robust strict sequential equal_radii eq34 five_probe keep_clocks white auto named_only prune keep_broken effects few "
    "anyway b5r force diagnose no_diagnosis without_files".split()
)


class Model:
    """A model: a sum of effects and a constant, as a ``model.toml`` has it.

    Parameters
    ----------
    source : path or str
        A file, or the text of one (with a line break). A text is kept in a file of its own as long as the model lives:
        `path`.

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
        self._own = "\n" in text
        if self._own:
            folder = tempfile.mkdtemp(prefix="ballbar-")
            weakref.finalize(self, shutil.rmtree, folder, True)
            self.path = pathlib.Path(folder) / "model.toml"
            self.path.write_text(text, encoding="utf-8")
        else:
            self.path = pathlib.Path(text)

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
        """What stands in its file."""
        return self.path.read_text(encoding="utf-8")

    def save(self, path: Path) -> None:
        """Writes it to a file of another name."""
        pathlib.Path(path).write_text(self.text, encoding="utf-8")

    def __reduce__(self) -> Any:
        return Model, (self.text if self._own else str(self.path),)

    def __repr__(self) -> str:
        return f"<ballbar.Model {self.path}>"


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


class Words:
    """The words of a command as they are collected."""

    def __init__(self, *words: str) -> None:
        self.words: list[str] = [*words]
        self.given: dict[str, Any] = {}
        self.sources: list[str] = []  # the words for DATA

    def data(self, *sources: Any) -> Words:
        """Paths, a Series, a DataFrame, a dict of arrays, recordings, or a list of any of these but dicts."""
        words = self._words_of(sources)
        self.sources += words
        self.words += words
        return self

    def series(self, *sources: Any) -> Words:
        """The same without recordings."""
        self.data(*sources)
        if all(isinstance(one, Series) for one in self.given.values()):
            return self
        raise TypeError(f"ballbar.{self.words[0]}: expected a path or a series, found recordings; ballbar.diagnose takes them")

    def other_data(self, name: str, *sources: Any) -> Words:
        """The same for an option."""
        for word in self._words_of([one for one in sources if one is not None]):
            self.words += [f"--{name}", word]
        return self

    def files(self, *paths: Any) -> Words:
        """Paths alone, or lists of them: of commands that look for files themselves."""
        for one in paths:
            if not isinstance(one, (str, os.PathLike)) and not _is_list(one):
                raise TypeError(f"ballbar.{self.words[0]}: expected a path or a list of paths, found {type(one).__name__}")
            self.data(one) if isinstance(one, (str, os.PathLike)) else self.files(*one)
        return self

    def options(self, **options: Any) -> Words:
        """None and False are left out, True is a flag, a list is repeated, a dict is NAME=VALUE."""
        for name, value in options.items():
            word = "--" + name.rstrip("_").replace("_", "-")
            is_flag = name in FLAGS or (name, self.words[0]) == ("every", "select")
            if is_flag != isinstance(value, (bool, np.bool_)) and value is not None:
                raise UsageError(f"{name}: expected {'True or False' if is_flag else 'a value'}, found {value!r}.")
            if is_flag:
                self.words += [word] if value else []
            elif isinstance(value, Mapping):
                for key, one in value.items():
                    self.words += [word, f"{key}={_text(one)}"]
            elif _is_list(value):
                for one in sorted(value) if isinstance(value, (set, frozenset)) else value:
                    self.words += [word, _text(one)]
            elif value is not None:
                self.words += [word, _text(value)]
        return self

    def run(self, progress: Progress | None = None) -> Any:
        for word in self.words:
            if "\0" in word:
                raise UsageError(f"{word!r}: expected a text without a null character.")
        try:
            result, remarks = _core.run(self.words, self.given, progress)
        except BallbarError as error:
            error.find_place(self.words)
            raise
        for remark in remarks:
            _log.log(logging.INFO if remark.startswith("wrote ") else logging.WARNING, remark)
        return result

    def picture(self, name: str) -> str:
        """The picture of that name that the page of these data would have, as SVG."""
        words = ["report", *self.sources, "--format", "svg", "--picture", name]
        for place, word in enumerate(self.words):
            if word in ("--model", "--target", "--max-gap", "--also-input", "--set"):
                words += self.words[place : place + 2]
            elif word in ("--robust", "--white"):
                words.append(word)
        if "--model" in self.words:
            words.append("--diagnose" if self.words[0] == "diagnose" else "--no-diagnosis")
        elif self.words[0] == "diagnose" and name == "with-without":
            words.append("--diagnose")
        with tempfile.TemporaryDirectory(prefix="ballbar-") as folder:
            path = pathlib.Path(folder) / "picture.svg"
            _core.run([*words, "--out", str(path)], self.given)
            return path.read_text(encoding="utf-8")

    def _words_of(self, sources: Iterable[Any]) -> list[str]:
        words: list[str] = []
        for source in sources:
            series = _series_of(source)
            if series is not None:
                words.append(self._given(series))
            elif isinstance(source, Recording):
                words.append(self._given([source]))
            elif isinstance(source, (str, os.PathLike)):
                words.append(_path(source))
            elif isinstance(source, Iterable):
                several = list(source)
                recordings = several and all(isinstance(one, Recording) for one in several)
                words += [self._given(several)] if recordings else self._words_of(several)
            else:
                raise TypeError(f"expected a path, a Series, a DataFrame or recordings, found {type(source).__name__}")
        return words

    def _given(self, data: Any) -> str:
        name = "<data>" if not self.given else f"<data {len(self.given) + 1}>"
        self.given[name] = data
        return name


def _is_list(value: Any) -> bool:
    return isinstance(value, (list, tuple, set, frozenset, np.ndarray)) or isinstance(value, Iterator)


def _path(path: Path) -> str:
    text = os.fspath(path)
    return "./" + text if text.startswith("-") else text


def _text(value: Any) -> str:
    if isinstance(value, Model):
        return str(value.path)
    if isinstance(value, (os.PathLike, str)):
        return os.fspath(value)
    return repr(float(value)) if isinstance(value, float) else str(value)
