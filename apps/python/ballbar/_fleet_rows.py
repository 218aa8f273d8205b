"""Rows of a table of many files: the columns, what is read of each file, and which test is a copy of another."""
from __future__ import annotations

import contextlib
import itertools
import math
import os
import queue
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import CancelledError, ThreadPoolExecutor
from typing import Any

import numpy as np
import pandas

from . import _core
from ._errors import BallbarError
from ._fleet_files import Paths, files_of, opened
from ._frame import Progress
from ._progress import progress_or_tqdm

Row = dict[str, Any]

#: Errors of a table, with their units: columns NAME_UNIT and NAME_UNIT_sigma.
ERRORS: tuple[tuple[str, str], ...] = tuple(
    (name, unit)
    for unit, names in (
        (
            "um",
            "global_scale scale_mismatch sin_4_theta backlash_a_pos backlash_a_neg backlash_b_pos backlash_b_neg "
            "lateral_play_a_pos lateral_play_a_neg lateral_play_b_pos lateral_play_b_neg straightness_a straightness_b "
            "cyclic_error_a_fwd cyclic_error_a_rev cyclic_error_b_fwd cyclic_error_b_rev cubic_error_along "
            "cubic_error_across reversal_spike_a_pos reversal_spike_a_neg reversal_spike_b_pos reversal_spike_b_neg "
            "circularity residual_rms radius_change centre_a centre_b offset_a_shift offset_b_shift",
        ),
        ("um_per_m", "squareness scale_x scale_y scale_z"),
        ("ms", "servo_mismatch"),
    )
    for name in names.split()
)

_TEXTS = ("file", "sha256", "version", "machine", "bar", "date", "plane", "fault")
NUMBERS = ("length_mm", "feed_mm_per_min", "start_deg", "arc_deg")
COLUMNS = {
    **{name: "object" for name in _TEXTS},
    **{name: "float64" for name in NUMBERS},
    "stored": "boolean",
    **{f"{name}_{unit}{of}": "float64" for name, unit in ERRORS for of in ("", "_sigma")},
}

_AT_ONCE = 25  # files
_READERS = 2  # threads: one works in Python as the other one fits
_PATIENCE_S = 20.0  # with a cluster that is gone, or has no worker
_TRIES = 3  # of a task whose worker dies


def errors_table(paths: Paths, *, strict: bool = False, progress: Progress | None = None) -> pandas.DataFrame:
    """Returns the errors of each ballbar test, one row a test.

    Parameters
    ----------
    paths : path, pattern, or list of them
        ``"plant/**/*.b5r"``, a file, or a folder, which stands for all `.b5r` below it.
    strict : bool
        A file at fault ends it; otherwise it is a row with its sentence in `fault`.
    progress : callable
        Is told how many files are done, of how many, and what is done; what it raises ends the work.

    Returns
    -------
    pandas.DataFrame
        By file, with the columns of :func:`ballbar.fleet.errors`. The numbers are those of ``ballbar errors --json``.

    Raises
    ------
    BallbarError
        There is no file; with `strict`, the sentence of the first file at fault.

    Notes
    -----
    Both directions of a test in two logs are one row. A copy of a test is at fault.
    """
    files = files_of(paths)
    rows: list[Row] = []
    with progress_or_tqdm(progress) as tell:
        for of_part, lacking in read_rows(files, {}, None, tell):
            rows += tests_and_faults(of_part, lacking)
    table = copies_marked(typed(rows, COLUMNS))
    faults = table["fault"].dropna()
    if strict and len(faults):
        raise BallbarError(str(faults.iloc[0]))
    return table


def typed(rows: list[Row], columns: dict[str, str]) -> pandas.DataFrame:
    """Returns a table of these columns; what a row lacks is NaN."""

    def values(name: str) -> list[Any]:
        return [math.nan if value is None else value for value in (row.get(name) for row in rows)]

    return pandas.DataFrame({name: pandas.Series(values(name), dtype=kind) for name, kind in columns.items()})


def unit_of(file: str) -> str:
    """Returns what is read together with a file: itself, or all logs of its folder, as two of them may be one test."""
    return file if file.lower().endswith(".b5r") else os.path.dirname(file) + "/"


def parts_of(files: Iterable[str], size: int) -> Iterator[list[str]]:
    """Yields parts of `size` files, or more where there are more logs in a folder."""
    part: list[str] = []
    for _, unit in itertools.groupby(sorted(files, key=lambda file: (unit_of(file), file)), unit_of):
        some = list(unit)
        if part and len(part) + len(some) > size:
            yield part
            part = []
        part += some
    if part:
        yield part


def fault(file: str, sha256: str, sentence: str | None) -> Row:
    """Returns the row of a file without a test; no sentence: it is the second log of one."""
    return {"file": file, "sha256": sha256, "version": _core.version, "fault": sentence}


def tests_and_faults(rows: list[Row], lacking: dict[str, str]) -> list[Row]:
    """Returns the rows without second logs of tests, and a fault for each file that could not be opened."""
    faults = [fault(file, "", f"{file}: {why}.") for file, why in lacking.items()]
    return [row for row in rows if row.get("plane") or row.get("fault")] + faults


def read_rows(
    files: Sequence[str], storage: dict[str, Any], client: Any, tell: Progress
) -> Iterator[tuple[list[Row], dict[str, str]]]:
    """Yields what :func:`error_rows` says of some files after others, as threads, or a client's workers, read them."""
    executor: Any = client.get_executor(pure=False, retries=_TRIES) if client else ThreadPoolExecutor(_READERS)
    ended: queue.SimpleQueue[Any] = queue.SimpleQueue()
    left: dict[Any, list[str]] = {}
    done = 0
    try:
        for part in parts_of(files, _AT_ONCE):  # names are as of this folder: workers may be in another one
            future = executor.submit(error_rows, part, storage, os.getcwd())
            left[future] = part
            future.add_done_callback(ended.put)
        while left:
            try:
                future = ended.get(timeout=_PATIENCE_S if client else None)
            except queue.Empty:
                if not _has_workers(client):
                    why = "the cluster has no worker" if client.status == "running" else "the cluster is gone"
                    yield [], {file: why for part in left.values() for file in part}
                    return
                continue
            part = left.pop(future)
            try:
                yield future.result()
            except (CancelledError, Exception) as error:  # noqa: BLE001  whatever befell a worker
                if client is None:
                    raise
                yield [], dict.fromkeys(part, f"{type(error).__name__}: {error}")
            done += len(part)
            tell(done, len(files), "reading tests")
    finally:
        with contextlib.suppress(OSError):  # of a cluster that is gone
            executor.shutdown(wait=False) if client else executor.shutdown(wait=False, cancel_futures=True)


def _has_workers(client: Any) -> bool:
    try:
        return client.status == "running" and bool(client.scheduler_info()["workers"])
    except Exception:  # noqa: BLE001  no scheduler there
        return False


def error_rows(files: Sequence[str], storage: dict[str, Any], at: str) -> tuple[list[Row], dict[str, str]]:
    """Returns a row a file, and why files could not be opened; `at` is the folder that names are relative to.

    The row of the second log of a test has neither a test nor a fault. Copies are rows like any other:
    :func:`copies_marked` finds them.
    """
    rows: list[Row] = []
    with opened(files, storage, at) as (found, lacking):
        paths = list(found)
        tests, skipped = _read(paths)
        for path, after in zip(paths, [*paths[1:], ""]):
            file, sha256 = found[path]
            if path in skipped and skipped[path]["copy_of"]:  # it is held against the whole table, not against these files
                second = [after] if after and after not in tests and after not in skipped else []
                tests.update(_read([path, *second])[0])
            if path in tests:
                rows.append(_row(file, sha256, tests[path], at))
            else:
                why = skipped[path]["sentence"] if path in skipped else _why_no_recording(path)
                rows.append(fault(file, sha256, why and why.replace(path, file)))
    return rows, lacking


def _read(paths: list[str]) -> tuple[dict[str, Row], dict[str, Row]]:
    """Returns tests, and what was skipped, by path; files that are gone since they were opened are in neither."""
    try:
        found = _core.tests(paths)
    except BallbarError:
        there = [path for path in paths if os.path.exists(path)]
        if len(there) == len(paths):
            raise
        return _read(there)
    return {test["file"]: test for test in found["tests"]}, {one["file"]: one for one in found["skipped"]}


def _why_no_recording(path: str) -> str | None:
    """Says what is at fault with a file that is neither a test nor skipped; None: it is the second log of a test."""
    try:
        _core.read_recordings(path)
    except BallbarError as error:
        return str(error)
    return None


def _row(file: str, sha256: str, test: Row, at: str) -> Row:
    row: Row = {"file": file, "sha256": sha256, "version": _core.version}
    row.update({name: test[name] for name in ("date", "plane", "stored", "feed_mm_per_min", "start_deg", "arc_deg")})
    row["length_mm"] = test["nominal_length_mm"]
    row["bar"] = test["bar"] or None
    row["machine"] = test["machine"] or _core.machine_of_folder(os.path.dirname(os.path.join(at, file))) or None
    for one in test["errors"]:
        unit = one["unit"].replace("/", "_per_")
        row[f"{one['name']}_{unit}"] = one["value"]
        row[f"{one['name']}_{unit}_sigma"] = one["sigma"]
    return row


def copies_marked(table: pandas.DataFrame) -> pandas.DataFrame:
    """Returns the table by file, in which a test with the numbers and the moment of one before it is a fault: a copy."""
    table = table.sort_values("file", kind="stable").reset_index(drop=True)
    numbers = ["date", "plane", *(f"{name}_{unit}" for name, unit in ERRORS)]
    tests = table[table["fault"].isna()]
    twice = tests[tests.duplicated(numbers, keep=False)]
    if twice.empty:
        return table
    first = twice.groupby(pandas.util.hash_pandas_object(twice[numbers], index=False))["file"].transform("first")
    copies = twice.index[twice["file"] != first]
    table.loc[copies, [name for name in table.columns if name not in ("file", "sha256", "version", "fault")]] = np.nan
    table.loc[copies, "fault"] = [
        f"{file}: expected a different test, found a copy of {of}." for file, of in zip(twice["file"][copies], first[copies])
    ]
    return table
