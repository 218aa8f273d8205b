"""What ballbar says when something can be put right."""
from __future__ import annotations

import contextlib
import math
import os
import re
import sys
import warnings
from collections.abc import Collection
from numbers import Real
from typing import Any

# name:line:column or name:line, as the program's sentences begin.
_LINE = re.compile(r"^(.+?):(\d+)(?::(\d+))?: ")
_FILE = re.compile(r"^[^<>\s]+\.[A-Za-z]\w*$")  # by its ending, where there is none of that name


# What the program's sentences say of its command line, as Python has it.
_HELP = re.compile(r"; see ballbar \S+ --help$")
_OPTION = re.compile(r"(?<![^\s(])--([a-z][A-Za-z0-9-]*)(?: (\d+(?:ms|s|min|h))\b)?")
_ARGUMENTS = {"max_gap": "max_gap_s", "unit": "units", "role": "roles", "set": "hold", "lag_range": "lag_range_s", "radius": "radius_mm"}


def in_python(sentence: str) -> str:
    """A sentence of the program with arguments in the place of options: ``every="10s"`` for ``--every 10s``."""

    def argument(option: re.Match[str]) -> str:
        name = option[1].replace("-", "_")
        return _ARGUMENTS.get(name, name) + (f'="{option[2]}"' if option[2] else "")

    return _OPTION.sub(argument, _HELP.sub("", sentence))


class BallbarError(ValueError):
    """A file, a column or a value is at fault; the text is a whole sentence.

    Attributes
    ----------
    file : str or None
        The file that the sentence is about, where it begins with one.
    line, column : int or None
        From 1.
    """

    file: str | None = None
    line: int | None = None
    column: int | None = None

    def __init__(self, sentence: str) -> None:
        super().__init__(sentence)
        self.find_place()

    def find_place(self, files: Collection[str] = ()) -> None:
        """Takes file, line and column from the sentence; a name is a file's that is one of these, or that there is."""
        sentence = str(self)
        located = _LINE.match(sentence)
        if located and (": " not in located[1] or os.path.exists(located[1])):
            self.file, self.line = located[1], int(located[2])
            self.column = int(located[3]) if located[3] else None
            return
        names = [sentence[: at.start()] for at in re.finditer(": ", sentence)]
        known = [name for name in names if name[:1] not in "-<" and (name in files or os.path.exists(name))]
        self.file = known[-1] if known else names[0] if names and _FILE.match(names[0]) else None


class UsageError(BallbarError):
    """An argument that does not exist, or a value of another kind."""


def number_of(name: str, value: Any, low: float = -math.inf, high: float = math.inf, *, whole: bool = False) -> float:
    """A number within bounds. Raises UsageError."""
    if isinstance(value, Real) and not isinstance(value, bool) and math.isfinite(value) and low <= float(value) <= high:
        if not whole:
            return float(value)
        if value == int(value):
            return int(value)
    bounds = f" from {low:g} to {high:g}" if high < math.inf else f" from {low:g} on" if low > -math.inf else ""
    raise UsageError(f"{name}: expected a {'whole ' if whole else ''}number{bounds}, found {value!r}.")


class BallbarWarning(UserWarning):
    """Something was left out, or taken for something else; the text says what."""


def warn(text: str) -> None:
    """Warns whoever called the package, from however deep in it."""
    folder, depth, frame = os.path.dirname(__file__), 2, sys._getframe(1)
    while frame.f_back and (os.path.dirname(frame.f_code.co_filename) == folder or frame.f_code.co_filename == contextlib.__file__):
        frame, depth = frame.f_back, depth + 1
    warnings.warn(text, BallbarWarning, stacklevel=depth)
