"""A table of tests that is kept in a folder: only what is new or changed is read, nothing is ever half-written.

The folder's one file, `table.npz`, is replaced as a whole: whoever reads it sees the table before an update or the table
after it. What an update that did not end has read is in the file too, `ahead` of the table.
"""
from __future__ import annotations

import contextlib
import fcntl
import glob
import io
import json
import logging
import os
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas

from . import _core
from ._errors import BallbarError, warn
from ._fleet_files import Paths, Stamp, files_of, opened, reason_of, stamp_of, write_whole
from ._fleet_rows import COLUMNS, Row, copies_marked, read_rows, typed, unit_of
from ._frame import Progress
from ._progress import progress_or_tqdm

__all__ = ["Updated", "read", "update"]

_TRIES = 3  # of a file that changes while it is read
_FORMAT = "ballbar-fleet-table 4"
_SECONDS_OF_A_SAVE = 10.0

_STATES = ("size", "modified", "ahead")
_STORED = {**COLUMNS, **dict.fromkeys(_STATES, "int64")}
_TEXTS = [name for name, kind in COLUMNS.items() if kind == "object"]
_NUMBERS = [name for name, kind in COLUMNS.items() if kind != "object"]


@dataclass(frozen=True, eq=False)
class Updated:
    """What :func:`update` did.

    Attributes
    ----------
    table : pandas.DataFrame
        By file, with the columns of :func:`ballbar.fleet.errors`.
    read, kept, gone : int
        Files that were read, that are as they were, and that are no more.
    faults : int
        Rows with a sentence in `fault`: files that are no test, and copies of others.
    lacking : dict
        Files that were not read, and why. They are read next time.
    complete : bool
        Nothing is lacking.
    """

    table: pandas.DataFrame
    read: int
    kept: int
    gone: int
    faults: int
    lacking: dict[str, str]

    @property
    def complete(self) -> bool:
        return not self.lacking


def update(
    paths: Paths, table: str | os.PathLike[str], *, client: Any = None, verify: bool = False, progress: Progress | None = None, **storage: Any
) -> Updated:
    """Reads what is new or changed since the table was written, and writes it anew.

    Parameters
    ----------
    paths : path, pattern, or list of them
        As of :func:`ballbar.fleet.files_of`.
    table : path
        A folder; made where there is none.
    client : dask.distributed.Client
        Its workers read; without one, threads of this process.
    verify : bool
        A file is read again, too, where its SHA-256 is another and its size and time are the same.
    progress : callable
        Is told how many files are done, of how many, and what is done. None: tqdm, if it is installed, on a terminal.
    **storage
        Options of fsspec's file system.

    Returns
    -------
    Updated
        The same files give the same table, in one update or in many.

    Raises
    ------
    BallbarError
        No file of that name; a folder that holds something else; no room to write. The table is then as it was.

    Warns
    -----
    BallbarWarning
        The table is damaged. It is kept under another name, and all files are read anew.

    Notes
    -----
    A file is read again where its size or its time is another. The rows of a file that can no longer be looked at, and
    of those below a folder that can no longer be listed, stay. Two logs of a folder may be one test: with one of them
    all are read again.
    """
    fresh: list[Row] = []
    read_now: set[str] = set()
    gone: set[str] = set()
    lacking: dict[str, str] = {}
    with _alone(os.fspath(table)) as (path, rows), progress_or_tqdm(progress) as tell:
        saved = time.monotonic()
        try:
            for attempt in range(_TRIES + 1):  # once more: files may change while they are read
                files = files_of(paths, **storage)  # not before: another update may end meanwhile, with files that are newer
                newest = rows.drop_duplicates("file", keep="last")
                known = dict(zip(newest["file"], zip(newest["size"], newest["modified"])))
                stamps, hidden = _stamps(files, storage, lacking)
                there = {file for file in known if file in stamps or file.startswith(hidden)}
                changed = {file for file, stamp in stamps.items() if known.get(file) != stamp}
                if verify and attempt == 0:
                    changed |= _other_bytes(newest[newest["file"].isin(stamps.keys() - changed)], storage, lacking, tell)
                units = set(map(unit_of, (changed - lacking.keys()) | (known.keys() - there - gone)))
                to_read = [file for file in stamps if unit_of(file) in units and file not in lacking]
                gone |= known.keys() - there
                if not to_read:
                    break
                if attempt == _TRIES:
                    lacking.update(dict.fromkeys(to_read, "changed again and again while it was read"))
                    break
                for some, why in read_rows(to_read, storage, client, tell):
                    fresh += [{**row, **dict(zip(_STATES, (*stamps[row["file"]], 1)))} for row in some]
                    read_now.update(row["file"] for row in some)
                    lacking.update(why)
                    if time.monotonic() - saved >= _SECONDS_OF_A_SAVE:
                        rows, fresh, saved = _with(rows, fresh), [], time.monotonic()
                        _write(path, rows)
                rows, fresh = _with(rows, fresh), []
        except BaseException:
            if fresh or read_now:
                with contextlib.suppress(BallbarError):
                    _write(path, _with(rows, fresh))
            raise
        before = set(rows["file"][rows["ahead"] == 0])
        if before - there or rows["ahead"].any():
            rows = newest[newest["file"].isin(there)].assign(ahead=0)
            _write(path, rows)
    shown = _shown(rows)
    return Updated(shown, len(read_now), len(there - read_now), len(before - there), int(shown["fault"].notna().sum()), lacking)


def read(table: str | os.PathLike[str]) -> pandas.DataFrame:
    """Returns the table in a folder; others may update it meanwhile.

    Parameters
    ----------
    table : path
        The folder.

    Returns
    -------
    pandas.DataFrame
        By file, with the columns of :func:`ballbar.fleet.errors`.

    Raises
    ------
    BallbarError
        There is no table that an update by this version ended; the table is damaged.
    """
    path = os.path.join(table, "table.npz")
    try:
        rows = _loaded(path)
    except OSError as error:
        raise BallbarError(f"{path}: expected a table that update() wrote, found: {reason_of(error)}.") from None
    except BallbarError as error:
        raise BallbarError(f"{error} An update reads its files again.") from None
    rows = rows[rows["ahead"] == 0]
    if rows.empty:
        raise BallbarError(f"{path}: expected a table that an update by this version ended, found none; another update reads its files.")
    return _shown(rows)


def _stamps(files: Sequence[str], storage: dict[str, Any], lacking: dict[str, str]) -> tuple[dict[str, Stamp], tuple[str, ...]]:
    """Returns the stamps of files, and how names begin of which nobody knows whether they are there; fills `lacking`."""
    stamps: dict[str, Stamp] = {}
    hidden: list[str] = []
    for file in files:
        try:
            stamps[file] = stamp_of(file, storage)
        except Exception as error:  # noqa: BLE001  each file system has its own
            lacking[file] = reason_of(error)
            if "://" in file or not isinstance(error, FileNotFoundError):
                hidden.append(os.path.join(file, "") if os.path.isdir(file) else file)
    return stamps, tuple(hidden)


def _other_bytes(rows: pandas.DataFrame, storage: dict[str, Any], lacking: dict[str, str], tell: Progress) -> set[str]:
    """Returns the files whose SHA-256 is not that of their row; fills `lacking`."""
    others: set[str] = set()
    for done, (file, sha256) in enumerate(zip(rows["file"], rows["sha256"]), 1):
        with opened([file], storage, os.getcwd()) as (found, why):
            others.update(name for name, now in found.values() if now != sha256)
            lacking.update(why)
        tell(done, len(rows), "reading bytes")
    return others


@contextlib.contextmanager
def _alone(folder: str) -> Iterator[tuple[str, pandas.DataFrame]]:
    """Yields the path and the rows of the table of a folder, which nobody else updates as long as this lasts."""
    path = os.path.join(folder, "table.npz")
    with contextlib.ExitStack() as stack:
        try:
            os.makedirs(folder, exist_ok=True)
            if not os.path.exists(path) and any(not name.startswith((".", "table.npz.")) for name in os.listdir(folder)):
                raise BallbarError(f"{folder}: expected a table, or a folder that is new or empty, found other files.")
            lock = stack.enter_context(open(os.path.join(folder, ".lock"), "a", encoding="utf-8"))
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                logging.getLogger("ballbar").warning("%s: waiting for another update of this table", folder)
                fcntl.flock(lock, fcntl.LOCK_EX)
            for left in glob.glob(os.path.join(glob.escape(folder), ".table.npz.*")):
                os.remove(left)  # of an update that was killed as it wrote
            try:
                rows = _loaded(path) if os.path.exists(path) else typed([], _STORED)
            except BallbarError as error:
                rows = typed([], _STORED)
                os.replace(path, f"{path}.damaged")
                warn(f"{error} It is kept as {path}.damaged, and all files are read anew.")
        except OSError as error:
            raise BallbarError(f"{folder}: the table could not be opened: {reason_of(error)}.") from None
        yield path, rows


def _loaded(path: str) -> pandas.DataFrame:
    """Returns what was written there, or no rows of another version. Raises OSError; BallbarError where it is damaged."""
    with open(path, "rb") as file:
        data = file.read()
    try:
        with np.load(io.BytesIO(data), allow_pickle=False) as stored:  # a zip archive, with checksums
            about, numbers, states = json.loads(stored["about"].tobytes()), stored["numbers"], stored["states"]
            if (about["format"], about["version"]) != (_FORMAT, _core.version):
                return typed([], _STORED)
            columns = {**about["texts"], **dict(zip(_NUMBERS, numbers.T)), **dict(zip(_STATES, states.T))}
            return pandas.DataFrame({name: columns[name] for name in _STORED}).fillna(np.nan).astype(_STORED)
    except Exception as error:  # noqa: BLE001  whatever the damage does
        raise BallbarError(f"{path}: expected a table, found: {reason_of(error)}.") from None


def _write(path: str, rows: pandas.DataFrame) -> None:
    texts = {name: [text if isinstance(text, str) else None for text in rows[name]] for name in _TEXTS}
    about = json.dumps({"format": _FORMAT, "version": _core.version, "texts": texts})
    numbers = rows[_NUMBERS].to_numpy(np.float64, na_value=np.nan)
    data = io.BytesIO()
    np.savez(data, about=np.frombuffer(about.encode(), np.uint8), numbers=numbers, states=rows[[*_STATES]].to_numpy(np.int64))
    write_whole(path, data.getvalue())


def _with(rows: pandas.DataFrame, fresh: list[Row]) -> pandas.DataFrame:
    """Returns these rows and the fresh ones, which take the place of those that were read ahead before."""
    return pandas.concat([rows, typed(fresh, _STORED)]).drop_duplicates(["file", "ahead"], keep="last")


def _shown(rows: pandas.DataFrame) -> pandas.DataFrame:
    """Returns the rows of the table, which has none of the second log of a test."""
    return copies_marked(rows.loc[rows["plane"].notna() | rows["fault"].notna(), list(COLUMNS)])
