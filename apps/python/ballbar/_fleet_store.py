"""The folder of a table: parts of rows, and `table.json`, which says which rows are of which part.

A part is never changed, and its number is given once. `table.json` is replaced at last: whoever reads sees the table
before an update or the table after it. What an update has read before it ended (`ahead`) is no part of the table yet, but
is not read again. One update at a time has the folder: `.lock`.
"""
from __future__ import annotations

import contextlib
import csv
import fcntl
import io
import json
import logging
import os
import re
import zlib
from collections.abc import Iterable, Iterator
from typing import Optional

import pandas

from . import _core
from ._errors import BallbarError
from ._fleet_files import Stamp, reason_of, written_whole
from ._fleet_rows import COLUMNS, Row, copies_marked, typed

_FORMAT = "ballbar-fleet-table 2"
_MOST_PARTS = 40  # then they are made one
_PART = re.compile(r"part-(\d{6})\.(csv|parquet)")
_TEMPORARY = re.compile(r"\.(part-\d{6}\.(csv|parquet)|table\.json)\.[0-9a-f]{32}")

Entry = tuple[int, int, Optional[str]]  # the stamp, and the part that has the rows; None: it has none, as a second log


class Damaged(BallbarError):
    """A part that is not as it was written."""


class Store:
    """The table of a folder as `table.json` has it."""

    def __init__(self, folder: str, index: str) -> None:
        self.folder = folder
        self.parts: dict[str, int] = {}  # CRC-32 of each
        self.shown: dict[str, Entry] = {}
        self.ahead: dict[str, Entry] = {}
        self._is_other = False  # than what is written
        self._frames: dict[str, pandas.DataFrame] = {}
        self._rows: list[Row] = []
        self._stamps: dict[str, Stamp] = {}
        try:
            stored = json.loads(index)
            if not re.fullmatch(r"ballbar-fleet-table \d+", stored["format"]):
                raise ValueError("format")
            if (stored["format"], stored["version"]) != (_FORMAT, _core.version):
                self._is_other = True  # of another version: all is read anew
                return
            self.parts = {str(name): int(crc) for name, crc in stored["parts"]}
            if not all(_PART.fullmatch(name) for name in self.parts):
                raise ValueError("parts")
            names = [*self.parts, None]
            for entries, of in ((self.shown, stored["files"]), (self.ahead, stored["ahead"])):
                entries.update({str(file): (size, time, names[place]) for file, (size, time, place) in of.items()})
        except (ValueError, KeyError, TypeError, IndexError, AttributeError):
            where = os.path.join(folder, "table.json")
            raise BallbarError(f"{where}: expected format {_FORMAT}, found something else.") from None

    def entries(self) -> dict[str, Entry]:
        """Of all files that need not be read again."""
        return {**self.shown, **self.ahead}

    def forget_what_is_damaged(self) -> None:
        """Its files are read again."""
        for part in list(self.parts):
            try:
                self._frame(part)
            except Damaged:
                self._is_other = True
                del self.parts[part]
                for entries in (self.shown, self.ahead):
                    for file in [file for file, entry in entries.items() if entry[2] == part]:
                        del entries[file]

    def table(self) -> pandas.DataFrame:
        """By file. Raises Damaged."""
        frames = self._shown_frames()
        return copies_marked(pandas.concat(frames) if frames else typed([], COLUMNS))

    def add(self, stamps: dict[str, Stamp], rows: Iterable[Row]) -> int:
        """What was read; kept in memory until it is saved. How many files that are."""
        self._stamps.update(stamps)
        self._rows += rows
        return len(self._stamps)

    def save(self) -> None:
        """Writes what was added, ahead of the table. Raises BallbarError."""
        if not self._stamps:
            return
        with self._writing():
            self._take_in()
            self._write_index()

    def commit(self, keep: Iterable[str]) -> pandas.DataFrame:
        """The table is that of these files, with all that was added. Raises BallbarError; it is then as it was."""
        before, is_other = self.shown, bool(self._is_other or self._stamps or self.ahead)
        with self._writing():
            self._take_in()
            known = self.entries()
            self.shown, self.ahead = {file: known[file] for file in keep}, {}
            if not is_other and self.shown == before:
                return self.table()
            if len(self._shown_parts()) > _MOST_PARTS:
                self._make_one()
            used = self._shown_parts()
            self.parts = {name: crc for name, crc in self.parts.items() if name in used}
            self._write_index()
        for name in os.listdir(self.folder):
            if (_PART.fullmatch(name) and name not in self.parts) or _TEMPORARY.fullmatch(name):
                with contextlib.suppress(OSError):
                    os.remove(os.path.join(self.folder, name))
        return self.table()

    @contextlib.contextmanager
    def _writing(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise BallbarError(f"{self.folder}: the table could not be written: {reason_of(error)}; it is as it was.") from None

    def _take_in(self) -> None:
        part = self._write_part(typed(self._rows, COLUMNS)) if self._rows else None
        with_rows = {row["file"] for row in self._rows}
        for file, stamp in self._stamps.items():
            self.ahead[file] = (*stamp, part if file in with_rows else None)
        self._rows, self._stamps = [], {}

    def _shown_parts(self) -> dict[str, None]:
        return dict.fromkeys(part for _, _, part in self.shown.values() if part)

    def _shown_frames(self) -> list[pandas.DataFrame]:
        """Of each part the rows that are of the table."""
        frames = []
        for part in self._shown_parts():
            found = self._frame(part)
            frames.append(found[[self.shown.get(file, (0, 0, None))[2] == part for file in found["file"]]])
        return frames

    def _make_one(self) -> None:
        name = self._write_part(pandas.concat(self._shown_frames()).sort_values("file", kind="stable"))
        self.shown = {file: (size, time, part and name) for file, (size, time, part) in self.shown.items()}

    def _frame(self, part: str) -> pandas.DataFrame:
        if part not in self._frames:
            try:
                with open(os.path.join(self.folder, part), "rb") as file:
                    data = file.read()
                if zlib.crc32(data) != self.parts[part]:
                    raise ValueError("not as it was written")
                if part.endswith(".parquet"):
                    self._frames[part] = pandas.read_parquet(io.BytesIO(data))
                else:
                    self._frames[part] = pandas.read_csv(
                        io.BytesIO(data), dtype=COLUMNS, float_precision="round_trip", keep_default_na=False, na_values=[""]
                    )
            except (OSError, ValueError, ImportError) as error:
                raise Damaged(f"{os.path.join(self.folder, part)}: expected a part of the table, found: {reason_of(error)}.") from None
        return self._frames[part]

    def _write_part(self, frame: pandas.DataFrame) -> str:
        numbers = [int(found[1]) for found in map(_PART.fullmatch, [*os.listdir(self.folder), *self.parts]) if found]
        name = f"part-{max(numbers, default=0) + 1:06}.{'parquet' if _parquet() else 'csv'}"
        with written_whole(os.path.join(self.folder, name)) as temporary:
            if name.endswith(".parquet"):
                frame.to_parquet(temporary, index=False)
            else:
                frame.to_csv(temporary, index=False, quoting=csv.QUOTE_NONNUMERIC)
            with open(temporary, "rb") as file:
                self.parts[name] = zlib.crc32(file.read())
        return name

    def _write_index(self) -> None:
        places = {part: place for place, part in enumerate(self.parts)}

        def placed(entries: dict[str, Entry]) -> dict[str, list[int]]:
            return {file: [size, time, places[part] if part else -1] for file, (size, time, part) in entries.items()}

        index = {
            "format": _FORMAT, "version": _core.version, "parts": list(self.parts.items()),
            "files": placed(self.shown), "ahead": placed(self.ahead),
        }
        with written_whole(os.path.join(self.folder, "table.json")) as temporary, open(temporary, "w", encoding="utf-8") as file:
            json.dump(index, file)


@contextlib.contextmanager
def to_update(folder: str) -> Iterator[Store]:
    """The table of a folder, which nobody else updates as long as this lasts. Raises BallbarError."""
    with contextlib.ExitStack() as stack:
        try:
            index = os.path.join(folder, "table.json")
            os.makedirs(folder, exist_ok=True)
            others = [name for name in os.listdir(folder) if not name.startswith(".")]
            if others and not os.path.exists(index):
                raise BallbarError(f"{folder}: expected a table, or a folder that is new or empty, found other files.")
            lock = stack.enter_context(open(os.path.join(folder, ".lock"), "a", encoding="utf-8"))
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                logging.getLogger("ballbar").warning("%s: waiting for another update of this table", folder)
                fcntl.flock(lock, fcntl.LOCK_EX)
            text = _index_of(folder)
            store = Store(folder, text if text is not None else json.dumps({"format": _FORMAT, "version": ""}))
            if text is None:
                store._write_index()  # before any part, which without it would be a file of somebody else
        except OSError as error:
            raise BallbarError(f"{folder}: the table could not be opened: {reason_of(error)}.") from None
        store.forget_what_is_damaged()
        yield store


def whole_table(folder: str) -> pandas.DataFrame:
    """The table of a folder that others may update meanwhile. Raises BallbarError."""
    before: str | None = None
    while True:
        try:
            index = _index_of(folder)
        except OSError as error:
            raise BallbarError(f"{folder}: the table could not be opened: {reason_of(error)}.") from None
        if index is None:
            raise BallbarError(f"{folder}: expected a table that update() wrote, found none.")
        store = Store(folder, index)
        if not store.shown:
            raise BallbarError(f"{folder}: expected a table that an update by this version ended, found none.")
        try:
            return store.table()
        except Damaged as damaged:
            if index == before:
                raise BallbarError(f"{damaged} An update reads its files again.") from None
        before = index  # a part is gone as the table was replaced


def _index_of(folder: str) -> str | None:
    try:
        with open(os.path.join(folder, "table.json"), encoding="utf-8", errors="replace") as file:
            return file.read()
    except FileNotFoundError:
        return None


def _parquet() -> bool:
    for name in ("pyarrow", "fastparquet"):
        try:
            __import__(name)
            return True
        except ImportError:
            pass
    return False
