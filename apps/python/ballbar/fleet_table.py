"""A table of tests that is kept in a folder: only what is new or changed is read, nothing is ever half-written.

The folder holds parts (`part-000001.parquet`, or `.csv` where no Parquet library is installed) and `table.json`, which
says which rows are of which part, and of each file its size and time. Updates of one table wait for each other; whoever
reads sees the table before or the table after. What an update that did not end has read is not read again.
"""
from __future__ import annotations

import bisect
import contextlib
import os
import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import pandas

from ._errors import BallbarError
from ._fleet_files import Stamp, files_of, reason_of, stamp_of
from ._fleet_rows import Row, error_rows as _error_rows, is_log, parts_of
from ._fleet_store import Entry, to_update, whole_table

_FILES_OF_A_TASK = 100
_FILES_OF_A_SAVE = 2000
_PATIENCE_S = 20  # with a scheduler that is gone, or has no worker
_TRIES = 3  # of a file that changes while it is read, of a scheduler that is gone

Answer = tuple[list[Row], dict[str, str]]  # rows, and files that could not be opened


@dataclass
class Updated:
    """What :func:`update` did.

    Attributes
    ----------
    table : DataFrame
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
    read: int = 0
    kept: int = 0
    gone: int = 0
    faults: int = 0
    lacking: dict[str, str] = field(default_factory=dict)

    @property
    def complete(self) -> bool:
        return not self.lacking


def update(
    paths: Any,
    table: str | os.PathLike[str],
    *,
    client: Any = None,
    progress: Callable[[int, int], object] | None = None,
    **storage: Any,
) -> Updated:
    """Reads what is new or changed since the table was written, and writes it anew.

    Parameters
    ----------
    paths : path, pattern, or list of them
        As of :func:`ballbar.fleet.files_of`.
    table : path
        A folder; made where there is none.
    client : dask.distributed.Client
        Whose workers read; without one, threads of this process.
    progress : callable
        Called with how many files are done, and of how many.
    **storage
        Options of fsspec's file system.

    Returns
    -------
    Updated
        The table, and what was done. The same files give the same table, in one update or in many.

    Raises
    ------
    BallbarError
        No file of that name; a folder that holds something else; no room to write. The table is then as it was.

    Notes
    -----
    A file is read again where its size or its time is another. The rows of a file that can no longer be looked at, and
    of those below a folder that can no longer be listed, stay. Two logs after each other may be one test: with a log
    those after it in its folder are read again, and the one before it.
    """
    with to_update(os.fspath(table)) as store:
        files = files_of(paths, **storage)  # not before: another update may end meanwhile, with files that are newer
        known = store.entries()
        stamps, out_of_reach = _stamps(files, storage)
        stay = _below_or_among(known, stamps, out_of_reach)
        gone = set(known) - set(stamps) - stay
        changed = {file for file, stamp in stamps.items() if known.get(file, ())[:2] != stamp}
        to_read = sorted(changed | _logs_after(changed | gone, stamps, known))
        result = Updated(pandas.DataFrame(), kept=len(stamps) - len(to_read) + len(stay), gone=len(gone & set(store.shown)))
        result.lacking = out_of_reach
        done = 0
        try:
            for part, answer in _answers(list(parts_of(to_read, _FILES_OF_A_TASK)), storage, client, result.lacking):
                rows, lacking = _settled(part, answer, stamps, storage)
                result.lacking.update(lacking)
                if store.add({file: stamps[file] for file in part if file not in lacking}, rows) >= _FILES_OF_A_SAVE:
                    store.save()
                result.read += len(part) - len(lacking)
                done += len(part)
                if progress:
                    progress(done, len(to_read))
        except BaseException:
            with contextlib.suppress(BallbarError):
                store.save()
            raise
        result.table = store.commit([file for file in [*stamps, *stay] if file not in result.lacking or file in stay])
    result.faults = int(result.table["fault"].notna().sum())
    return result


def read(table: str | os.PathLike[str]) -> pandas.DataFrame:
    """The table in that folder, by file; others may update it meanwhile.

    Parameters
    ----------
    table : path
        The folder.

    Returns
    -------
    DataFrame
        With the columns of :func:`ballbar.fleet.errors`.

    Raises
    ------
    BallbarError
        No table there; one of another version; a part that is damaged.
    """
    return whole_table(os.fspath(table))


def _stamps(files: Sequence[str], storage: dict[str, Any]) -> tuple[dict[str, Stamp], dict[str, str]]:
    stamps: dict[str, Stamp] = {}
    out_of_reach: dict[str, str] = {}
    for file in files:
        try:
            stamps[file] = stamp_of(file, storage)
        except Exception as error:  # noqa: BLE001  each file system has its own
            out_of_reach[file] = reason_of(error)
    return stamps, out_of_reach


def _below_or_among(known: Iterable[str], stamps: Mapping[str, Stamp], out_of_reach: Mapping[str, str]) -> set[str]:
    """Files of the table that cannot be looked at: whether they are the same is not known."""
    hidden = [os.path.join(name, "") for name in out_of_reach if os.path.isdir(name)]
    return {
        file for file in known
        if file not in stamps and (any(file.startswith(folder) for folder in hidden) or (file in out_of_reach and _may_be_there(file)))
    }


def _may_be_there(file: str) -> bool:
    if "://" in file:
        return True
    try:
        os.lstat(file)
    except FileNotFoundError:
        return False
    except OSError:
        pass
    return True


def _logs_after(changed: Iterable[str], stamps: Mapping[str, Stamp], known: Mapping[str, Entry]) -> set[str]:
    """The logs whose test may be another one, as there are others before them."""
    first: dict[str, str] = {}
    for file in filter(is_log, changed):
        folder = os.path.dirname(file)
        first[folder] = min(first.get(folder, file), file)
    logs: dict[str, list[str]] = {folder: [] for folder in first}
    for file in sorted(filter(is_log, stamps)) if first else ():
        logs.get(os.path.dirname(file), []).append(file)
    to_read: set[str] = set()
    for folder, of_folder in logs.items():
        place = bisect.bisect_left(of_folder, first[folder])
        if place > 0 and known[of_folder[place - 1]][2] is not None:  # it is not the second of a test
            place -= 1
        to_read.update(of_folder[place:])
    return to_read


def _settled(part: Sequence[str], answer: Answer, stamps: dict[str, Stamp], storage: dict[str, Any]) -> Answer:
    """The rows; of what changed while it was read, with the logs of its folder, those after it is read again."""
    rows, lacking = answer
    for attempt in range(_TRIES + 1):
        now, out_of_reach = _stamps([file for file in part if file not in lacking], storage)
        changed = {file for file, stamp in now.items() if stamp != stamps[file]}
        folders = {os.path.dirname(file) for file in [*changed, *out_of_reach] if is_log(file)}
        again = {file for file in now if file in changed or (is_log(file) and os.path.dirname(file) in folders)}
        rows = [row for row in rows if row["file"] not in again and row["file"] not in out_of_reach]
        lacking = {**lacking, **out_of_reach}
        if attempt == _TRIES:
            return rows, {**lacking, **dict.fromkeys(again, "changed again and again while it was read")}
        if not again:
            break
        stamps.update(now)
        more, why = _error_rows(sorted(again), storage)
        rows, lacking = rows + more, {**lacking, **why}
    return rows, lacking


def _answers(
    parts: Sequence[list[str]], storage: dict[str, Any], client: Any, lacking: dict[str, str]
) -> Iterator[tuple[list[str], Answer]]:
    if client is None:
        for part in parts:  # the program reads on all cores
            yield part, _error_rows(part, storage)
        return
    left = dict(enumerate(parts))
    for attempt in range(_TRIES):
        reasons: dict[int, str] = {}
        if client is None or client.status != "running":
            reasons = dict.fromkeys(left, "the cluster is gone")
        else:  # names as of here: workers may be in another folder
            futures = {client.submit(_error_rows, part, storage, os.getcwd(), pure=False): place for place, part in left.items()}
            for future in _finished(list(futures), client):
                place = futures[future]
                try:
                    answer = future.result(timeout=60)
                except Exception as error:  # noqa: BLE001  whatever befell a worker: noted, and tried again
                    reasons[place] = f"{type(error).__name__}: {error}"
                    continue
                yield left.pop(place), answer
        if not left:
            return
        has_no_worker = client is not None and client.status == "running" and not left.keys() <= reasons.keys()
        if attempt + 1 == _TRIES or has_no_worker:
            otherwise = "the cluster has no worker" if has_no_worker else "the cluster is gone"
            for place, part in left.items():
                lacking.update(dict.fromkeys(part, reasons.get(place, otherwise)))
            return
        client = _again(client)


def _finished(futures: list[Any], client: Any) -> Iterator[Any]:
    """Each as it ends, in whatever way; until the client is gone, or there has been no worker for long."""
    alive = looked = time.monotonic()
    while futures:
        ended: list[Any] = []
        pending: list[Any] = []
        for future in futures:
            (pending if future.status == "pending" else ended).append(future)
        yield from ended
        futures = pending
        now = time.monotonic()
        if ended:
            alive = now
        elif client.status == "running" and now - looked > _PATIENCE_S / 4:
            looked = now
            alive = now if _has_workers(client) else alive
        if client.status == "closed" or now - alive > _PATIENCE_S:
            with contextlib.suppress(Exception):
                client.cancel(futures)
            return
        if not ended:
            time.sleep(0.02)


def _has_workers(client: Any) -> bool:
    try:
        return bool(client.scheduler_info()["workers"])
    except Exception:  # noqa: BLE001  no scheduler there
        return False


def _again(client: Any) -> Any:
    """A client of the same scheduler, which may have been restarted; None: it is not there."""
    if client is None or client.status == "running":
        return client
    from dask.distributed import Client

    try:
        address = client.scheduler.address if client.scheduler else client._start_arg
        return Client(address, timeout=_PATIENCE_S, set_as_default=False)
    except Exception:  # noqa: BLE001  no scheduler there
        return None
