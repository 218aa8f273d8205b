"""What ballbar says when something can be put right."""
from __future__ import annotations

import os
import re
from collections.abc import Collection

# name:line:column or name:line, as the program's sentences begin.
_LINE = re.compile(r"^(.+?):(\d+)(?::(\d+))?: ")
_FILE = re.compile(r"^[^<>\s]+\.[A-Za-z]\w*$")  # by its ending, where there is none of that name


# What the program's sentences say of its command line, as Python has it.
_HELP = re.compile(r"; see ballbar \S+ --help$")
_OPTION = re.compile(r"(?<![^\s(])--([a-z][A-Za-z0-9-]*)")


def in_python(sentence: str) -> str:
    """A sentence of the program with arguments in the place of options."""
    return _OPTION.sub(lambda option: _ARGUMENTS.get(option[1], option[1].replace("-", "_")), _HELP.sub("", sentence))


_ARGUMENTS = {"set": "hold"}


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


class BallbarWarning(UserWarning):
    """Something was left out, or taken for something else; the text says what."""
