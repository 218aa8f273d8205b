"""What ballbar says when something can be put right."""
from __future__ import annotations

import re

# name:line:column, name:line, or a name alone, as the program's sentences begin.
_PLACE = re.compile(r"^(?P<file>.+?)(?::(?P<line>\d+)(?::(?P<column>\d+))?)?: ")


class BallbarError(ValueError):
    """A file, a column or a value is at fault; the text is a whole sentence.

    Attributes
    ----------
    file : str or None
        What the sentence is about, where it begins with a place.
    line, column : int or None
        From 1.
    """

    def __init__(self, sentence: str) -> None:
        super().__init__(sentence)
        place = _PLACE.match(sentence)
        self.file: str | None = place["file"] if place else None
        self.line: int | None = int(place["line"]) if place and place["line"] else None
        self.column: int | None = int(place["column"]) if place and place["column"] else None


class UsageError(BallbarError):
    """An argument that there is not, or a value of another kind."""
