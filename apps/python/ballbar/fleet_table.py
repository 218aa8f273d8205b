"""A table of tests that is kept in a folder: only what is new or changed is read, nothing is ever half-written.

The folder holds parts (`part-000001.parquet`, or `.csv` where no Parquet library is installed) and `table.json`, which
says which rows are of which part, and of each file its size and time. A part is written under another name, then named;
`table.json` is replaced at last: whoever reads sees the table before or the table after.
"""
from __future__ import annotations

import json
import os
import time
import zlib
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Callable

import pandas

from . import _core
from ._errors import BallbarError
from .fleet import _COLUMNS, _error_rows, _typed, files_of

_FORMAT = "ballbar-fleet-table 1"
_FILES_OF_A_TASK = 100
_MOST_PARTS = 40  # then they are made one
_PATIENCE_S = 20  # with a scheduler that is gone
_TRIES = 3  # of a file that changes while it is read, of a scheduler that is gone

Stamp = list[int]  # size, ns since 1970


@dataclass
class Updated:
    """What :func:`update` did."""

    table: pandas.DataFrame
    read: int = 0  # files
    kept: int = 0
    gone: int = 0
    faults: int = 0  # rows with a sentence
    lacking: dict[str, str] = field(default_factory=dict)  # files that were not read, and why; they are read next time

    @property
    def complete(self) -> bool:
        return not self.lacking


def update(
    paths: Any,
    table: str,
    *,
    client: Any = None,
    progress: Callable[[int, int], object] | None = None,
    **storage: Any,
) -> Updated:
    """Reads what is new or changed since the table was written, and writes it anew.

    Parameters
    ----------
    paths : pattern, folder, or list of paths
        As of :func:`ballbar.fleet.files_of`.
    table : folder
        Made where there is none.
    client : dask.distributed.Client
        Whose workers read; without one, threads of this process.
    progress : callable
        Is told how many files are done, and of how many.

    Raises
    ------
    BallbarError
        No file of that name; a folder that holds something else; no room to write. The table is then as it was.
    """
    state = _State.opened(table)
    files = files_of(paths, **storage)
    stamps = {file: _stamp(file, storage) for file in files}
    wanted = [file for file in files if state.stamps.get(file) != stamps[file]]
    result = Updated(pandas.DataFrame(), kept=len(files) - len(wanted), gone=len(set(state.stamps) - set(files)))
    rows: list[dict[str, Any]] = []
    for part, answer in _answers(wanted, storage, client, result.lacking):
        for file, stamp, of_file in _settled(part, answer, stamps, storage, result.lacking):
            stamps[file] = stamp
            rows += of_file
        result.read += len(part)
        if progress:
            progress(result.read, len(wanted))
    state.replace({file: stamp for file, stamp in stamps.items() if file not in result.lacking}, rows, wanted)
    result.table = state.frame()
    result.faults = int(result.table["fault"].notna().sum())
    return result


def read(table: str) -> pandas.DataFrame:
    """The table in that folder, by file."""
    state = _State.opened(table)
    if not state.parts:
        raise BallbarError(f"{table}: expected a table that update() wrote, found none.")
    return state.frame()


def _stamp(file: str, storage: dict[str, Any]) -> Stamp:
    if "://" not in file:
        try:
            found = os.stat(file)
            return [found.st_size, found.st_mtime_ns]
        except OSError:
            return [-1, -1]
    from fsspec.core import get_fs_token_paths

    system, _, (inside,) = get_fs_token_paths(file, storage_options=storage)
    about = system.info(inside)
    changed = about.get("mtime") or about.get("LastModified") or about.get("ETag") or 0
    return [int(about.get("size") or 0), zlib.crc32(str(changed).encode())]


def _answers(
    files: Sequence[str], storage: dict[str, Any], client: Any, lacking: dict[str, str]
) -> Iterator[tuple[Sequence[str], list[dict[str, Any]]]]:
    parts = [files[at : at + _FILES_OF_A_TASK] for at in range(0, len(files), _FILES_OF_A_TASK)]
    if client is None:
        for part in parts:  # the program reads on all cores
            yield part, _error_rows(part, storage)
        return
    left = {tuple(part) for part in parts}
    for attempt in range(_TRIES):
        reasons: dict[tuple[str, ...], str] = {}
        if client is None or client.status != "running":
            reasons = dict.fromkeys(left, "the cluster is gone")
        else:
            futures = {client.submit(_error_rows, list(part), storage, pure=False): part for part in sorted(left)}
            for future in _finished(list(futures), client):
                part = futures[future]
                try:
                    answer = future.result(timeout=60)
                except Exception as error:  # noqa: BLE001  whatever befell a worker: told, and tried again
                    reasons[part] = f"{type(error).__name__}: {error}"
                    continue
                left.discard(part)
                yield part, answer
        if not left:
            return
        if attempt + 1 == _TRIES:
            for part in left:
                lacking.update(dict.fromkeys(part, reasons.get(part, "the cluster gave no answer")))
        else:
            client = _again(client)


def _finished(futures: list[Any], client: Any) -> Iterator[Any]:
    """Each as it ends, in whatever way; until the client is gone."""
    gone_since: float | None = None
    while futures:
        ended = [future for future in futures if future.status != "pending"]
        yield from ended
        futures = [future for future in futures if future not in ended]
        if client.status == "running":
            gone_since = None
        else:
            gone_since = gone_since or time.monotonic()
            if client.status == "closed" or time.monotonic() - gone_since > _PATIENCE_S:
                return
        if not ended:
            time.sleep(0.02)


def _again(client: Any) -> Any:
    """A client of the same scheduler, which may have been restarted; None: it is not there."""
    if client is None or client.status == "running":
        return client
    from dask.distributed import Client

    try:
        return Client(client.scheduler.address if client.scheduler else client._start_arg, timeout=_PATIENCE_S)
    except Exception:  # noqa: BLE001  no scheduler there
        return None


def _settled(
    part: Sequence[str], rows: list[dict[str, Any]], stamps: dict[str, Stamp], storage: dict[str, Any], lacking: dict[str, str]
) -> Iterator[tuple[str, Stamp, list[dict[str, Any]]]]:
    """Rows of each file; one that changed while it was read is read again."""
    of_file: dict[str, list[dict[str, Any]]] = {file: [] for file in part}
    for row in rows:
        of_file[row["file"]].append(row)
    for file in part:
        stamp, found = stamps[file], of_file[file]
        for attempt in range(_TRIES):
            now = _stamp(file, storage)
            if now == stamp:
                break
            stamp, found = now, _error_rows([file], storage)
        else:
            lacking[file] = "changed again and again while it was read"
            continue
        yield file, stamp, found


class _State:
    def __init__(self, folder: str) -> None:
        self.folder = folder
        self.parts: list[str] = []
        self.stamps: dict[str, Stamp] = {}
        self.part_of: dict[str, str] = {}
        self.rows: pandas.DataFrame | None = None

    @classmethod
    def opened(cls, folder: str) -> _State:
        state = cls(folder)
        index = os.path.join(folder, "table.json")
        if not os.path.exists(index):
            if os.path.isdir(folder) and any(not name.startswith((".", "part-")) for name in os.listdir(folder)):
                raise BallbarError(f"{folder}: expected a table, or a folder that is new or empty, found other files.")
            return state
        try:
            with open(index, encoding="utf-8") as file:
                stored = json.load(file)
            if stored["format"] != _FORMAT:
                raise KeyError("format")
            if stored["version"] == _core.version:  # another version reads all anew
                state.parts = stored["parts"]
                state.stamps = {name: entry[:2] for name, entry in stored["files"].items()}
                state.part_of = {name: state.parts[entry[2]] for name, entry in stored["files"].items()}
        except (ValueError, KeyError, TypeError, IndexError):
            raise BallbarError(f"{index}: expected format {_FORMAT}, found something else.") from None
        return state

    def frame(self) -> pandas.DataFrame:
        if self.rows is None:
            frames = []
            for part in self.parts:
                found = _read_part(os.path.join(self.folder, part))
                frames.append(found[found["file"].map(self.part_of.get) == part])
            self.rows = pandas.concat(frames) if frames else _typed([], _COLUMNS)
            self.rows = self.rows.sort_values("file", kind="stable").reset_index(drop=True)
        return self.rows

    def replace(self, stamps: dict[str, Stamp], rows: list[dict[str, Any]], renewed: Iterable[str]) -> None:
        """The table of these files: what is renewed has these rows, the rest those it had."""
        keeps = set(stamps) - set(renewed)
        if not rows and keeps == set(self.part_of) and len(stamps) == len(keeps) and self.parts:
            return
        try:
            os.makedirs(self.folder, exist_ok=True)
            self.part_of = {file: self.part_of[file] for file in keeps if file in self.part_of}
            used = [part for part in self.parts if part in set(self.part_of.values())]
            frame = _typed(rows, _COLUMNS)
            if len(used) >= _MOST_PARTS:
                self.parts, self.rows = used, None
                frame, used, self.part_of = pandas.concat([self.frame(), frame]), [], {}
            written = []
            if len(frame) or not used:
                name = _write_part(frame, self.folder, self._next())
                written = [name]
                self.part_of.update({file: name for file in frame["file"]})
            self.parts, self.stamps, self.rows = [*used, *written], stamps, None
            places = {part: place for place, part in enumerate(self.parts)}
            self.part_of = {file: self.part_of.get(file, self.parts[-1]) for file in stamps}
            index = {
                "format": _FORMAT,
                "version": _core.version,
                "parts": self.parts,
                "files": {file: [*stamp, places[self.part_of[file]]] for file, stamp in stamps.items()},
            }
            _write_whole(os.path.join(self.folder, "table.json"), json.dumps(index).encode())
        except OSError as error:
            raise BallbarError(
                f"{self.folder}: the table could not be written: {error.strerror or error}; it is as it was."
            ) from None
        for name in os.listdir(self.folder):
            if name.startswith("part-") and name not in self.parts:
                os.remove(os.path.join(self.folder, name))

    def _next(self) -> int:
        names = [name for name in os.listdir(self.folder) if name.startswith("part-")]
        return max((int(name[5:11]) for name in names if name[5:11].isdigit()), default=0) + 1


def _parquet() -> bool:
    for name in ("pyarrow", "fastparquet"):
        try:
            __import__(name)
            return True
        except ImportError:
            pass
    return False


def _read_part(path: str) -> pandas.DataFrame:
    if path.endswith(".parquet"):
        return pandas.read_parquet(path)
    return pandas.read_csv(path, dtype=_COLUMNS, float_precision="round_trip", keep_default_na=False, na_values=[""])


def _write_part(frame: pandas.DataFrame, folder: str, number: int) -> str:
    name = f"part-{number:06}.{'parquet' if _parquet() else 'csv'}"
    temporary = os.path.join(folder, f".{name}.{os.getpid()}")
    try:
        if name.endswith(".parquet"):
            frame.to_parquet(temporary, index=False)
        else:
            frame.to_csv(temporary, index=False)
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())
        os.replace(temporary, os.path.join(folder, name))
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)
    return name


def _write_whole(path: str, data: bytes) -> None:
    temporary = os.path.join(os.path.dirname(path), f".{os.path.basename(path)}.{os.getpid()}")
    try:
        with open(temporary, "wb") as file:
            file.write(data)
            file.flush()
            os.fsync(file.fileno())
        os.replace(temporary, path)
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)
