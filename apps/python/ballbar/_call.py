"""A command of the program, called with values of Python."""
from __future__ import annotations

import logging
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from datetime import timedelta
from typing import Any, Union

import numpy as np

from . import _core
from ._errors import BallbarError, UsageError, in_python
from ._frame import Data, Held, Path, Progress
from ._model import Model
from ._progress import progress_or_tqdm
from ._terms import Effect
from ._times import Every, seconds

__all__ = ["Data", "DataOf", "Every", "ModelLike", "Path", "Progress", "TextOf", "run"]

_log = logging.getLogger("ballbar")


class DataOf:
    """Data of an option."""

    def __init__(self, data: Data) -> None:
        self.data = data


class TextOf:
    """What a file of an option would hold."""

    def __init__(self, text: str) -> None:
        self.text = text


ModelLike = Union[Model, Path, TextOf]


def run(command: str, places: Sequence[Any], options: Mapping[str, Any], progress: Progress | None = None, answers: bool = True) -> Any:
    """The JSON of a command. None is left out; a list gives an option more than once; a dict is NAME=VALUE."""
    held = Held()
    effects: list[Any] = []
    words = [word for place in places if place is not None for word in _places(place, held)]
    stated: list[tuple[str, bool | list[str]]] = [("json", True)] if answers else []
    for name, value in options.items():
        if isinstance(value, DataOf):
            if value.data is not None:
                stated.append((name, held.places(value.data)))
        elif isinstance(value, (bool, np.bool_)):
            stated.append((name, bool(value)))
        elif isinstance(value, Mapping):
            stated.append((name, [f"{key}={_text(one)}" for key, one in value.items()]))
        elif value is not None:
            several = list(value) if isinstance(value, (list, tuple, set, frozenset, np.ndarray, Iterator)) else [value]
            stated.append((name, [_word(one, held, effects) for one in several]))
    texts = [*words, *(word for _, value in stated if isinstance(value, list) for word in value)]
    found, wrote = told(lambda tell: _core.call(command, words, stated, held.values, effects, tell), texts, progress)
    for file in wrote:
        _log.info("wrote %s", file)
    if isinstance(found, list):  # pages of the catalogue
        return found[0] if len(found) == 1 else {command: found}
    return found or {}


def _places(data: Any, held: Held) -> list[str]:
    """An effect is one by its name and its columns."""
    if isinstance(data, Effect) and (data.parameters or data.function):
        raise UsageError(f"effect: expected one of the catalogue as it is, found {data!r}; set= states its shapes.")
    return [f"{data.name}({', '.join(data.columns.values())})"] if isinstance(data, Effect) else held.places(data)


def told(work: Callable[[Callable[[str], object]], Any], words: Iterable[str], progress: Progress | None) -> tuple[Any, ...]:
    """What `work` returns but for its remarks, the last of it, which go to the logger."""
    for word in words:
        if "\0" in word:
            raise UsageError(f"{word!r}: expected a text without a null character.")
    try:
        with progress_or_tqdm(progress) as tell:
            *result, remarks = work(lambda line: tell(0, 0, line))
    except BallbarError as error:
        error.find_place(list(words))
        raise
    for remark in remarks:
        _log.warning(in_python(remark))
    return tuple(result)


def _word(value: Any, held: Held, effects: list[Any]) -> str:
    if isinstance(value, TextOf):
        return held.hold(value.text, "model")
    if not isinstance(value, Model):
        return _text(value)
    effects += [one.core for one in value.functions]
    return held.hold(value.text, "model")


def _text(value: Any) -> str:
    if isinstance(value, (os.PathLike, str)):
        return os.fspath(value)
    if isinstance(value, (timedelta, np.timedelta64)):
        value = seconds(value)
    return repr(float(value)) if isinstance(value, float) else str(value)
