"""Rows of a table of many files: the columns, what is read of each file, and which test is a copy of another."""
from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Sequence
from typing import Any

import numpy as np
import pandas

from . import _core
from ._errors import BallbarError
from ._fleet_files import Local, opened

Row = dict[str, Any]

#: Errors of a table, with their units: columns NAME_UNIT and NAME_sigma_UNIT.
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
    **{f"{name}{of}_{unit}": "float64" for name, unit in ERRORS for of in ("", "_sigma")},
}

_AT_ONCE = 100  # files
_GONE = "expected a file, found nothing of that name."
_NEITHER = "expected a .b5r file or a ballbar log of a circle, found neither."
_COPY = "expected a test of its own, found a copy of "


def typed(rows: list[Row], columns: dict[str, str]) -> pandas.DataFrame:
    frame = pandas.DataFrame({name: [row.get(name) for row in rows] for name in columns})
    return frame.astype(columns).where(frame.notna(), np.nan).astype(columns)


def is_log(file: str) -> bool:
    """Of which two may be one test, both directions."""
    return not file.lower().endswith(".b5r")


def parts_of(files: Sequence[str], size: int) -> Iterator[list[str]]:
    """In parts of `size` or fewer; but logs of one folder are never parted, as two of them may be one test."""
    together: dict[str, list[str]] = {}
    for file in files:
        together.setdefault(os.path.dirname(file) + "/" if is_log(file) else file, []).append(file)
    part: list[str] = []
    for some in together.values():
        if part and len(part) + len(some) > size:
            yield part
            part = []
        part += some
    if part:
        yield part


def fault(file: str, sha256: str, sentence: str) -> Row:
    return {"file": file, "sha256": sha256, "version": _core.version, "fault": sentence}


def error_rows(files: Sequence[str], storage: dict[str, Any], at: str = "") -> tuple[list[Row], dict[str, str]]:
    """A row a test and a row a file that is at fault, and why files could not be opened.

    The second log of a test has no row. Copies are rows like any other: :func:`copies_marked` finds them.
    """
    rows: list[Row] = []
    lacking: dict[str, str] = {}
    start = 0
    while start < len(files):
        some = files[start : start + _AT_ONCE]
        start += len(some)
        found, why = _rows_at_once(some, storage, at)
        if start < len(files) and len(some) > 1 and some[-1] in found and is_log(some[-1]):
            del found[some[-1]]  # it is read once more, with the log after it
            start -= 1
        rows += found.values()
        lacking.update(why)
    return sorted(rows, key=lambda row: str(row["file"])), lacking


def _rows_at_once(files: Sequence[str], storage: dict[str, Any], at: str) -> tuple[dict[str, Row], dict[str, str]]:
    with opened(files, storage, at) as (locals_of, lacking):
        of_path = {local.path: local for local in locals_of}
        paths = list(of_path)
        tests, skipped = _read(paths)
        rows = {path: _row(of_path[path], test, at) for path, test in tests.items()}
        copies = [path for path, one in skipped.items() if one["copy_of"]]
        for path in copies:  # they are held against the whole table, not against these files
            place = paths.index(path)
            second = [one for one in paths[place + 1 : place + 2] if one not in tests and one not in skipped]
            rows[path] = _row(of_path[path], _read([path, *second])[0][path], at)
        for path, local in of_path.items():
            if path not in rows and (path in skipped or not _can_be_read(path)):
                sentence = skipped[path]["sentence"] if path in skipped else f"{path}: {_NEITHER}"
                rows[path] = fault(local.file, local.sha256, sentence.replace(path, local.file))
    return {str(row["file"]): row for row in rows.values()}, lacking


def _read(paths: list[str]) -> tuple[dict[str, Row], dict[str, Row]]:
    """Tests, and what was skipped, by path."""
    try:
        found = _core.tests(paths)
    except BallbarError:
        gone = [path for path in paths if not os.path.exists(path)]  # since it was opened
        if not gone:
            raise
        tests, skipped = _read([path for path in paths if path not in gone])
        return tests, skipped | {path: {"sentence": f"{path}: {_GONE}", "copy_of": None} for path in gone}
    return {test["file"]: test for test in found["tests"]}, {one["file"]: one for one in found["skipped"]}


def _can_be_read(path: str) -> bool:
    try:
        return bool(_core.read_recordings(path))
    except BallbarError:
        return False


def _row(local: Local, test: Row, at: str) -> Row:
    row = {"file": local.file, "sha256": local.sha256, "version": _core.version, "fault": None}
    row.update({name: test[name] for name in ("machine", "bar", "date", "plane", "stored", "feed_mm_per_min", "start_deg", "arc_deg")})
    row["length_mm"] = test["nominal_length_mm"]
    row["bar"] = row["bar"] or None
    row["machine"] = row["machine"] or os.path.basename(os.path.dirname(os.path.join(at, local.file))) or None
    for one in test["errors"]:
        unit = one["unit"].replace("/", "_per_")
        row[f"{one['name']}_{unit}"] = one["value"]
        row[f"{one['name']}_sigma_{unit}"] = one["sigma"]
    return row


def copies_marked(table: pandas.DataFrame) -> pandas.DataFrame:
    """The same table, in which a test with the numbers and the moment of one before it is a fault: it would count twice."""
    table = table.sort_values("file", kind="stable").reset_index(drop=True)
    numbers = ["date", "plane", *(f"{name}_{unit}" for name, unit in ERRORS)]
    tests = table[table["fault"].isna()]
    twice = tests[tests.duplicated(numbers, keep=False)]
    if twice.empty:
        return table
    first = twice.groupby(pandas.util.hash_pandas_object(twice[numbers], index=False))["file"].transform("first")
    copies = twice.index[twice["file"] != first]
    table.loc[copies, [name for name in table.columns if name not in ("file", "sha256", "version", "fault")]] = np.nan
    table.loc[copies, "fault"] = [f"{file}: {_COPY}{of}." for file, of in zip(twice["file"][copies], first[copies])]
    return table


def rows_of_each(
    files: Sequence[str], storage: dict[str, Any], at: str, work: Callable[[str, str, str], Row]
) -> list[Row]:
    """A row a file: what `work` makes of its path, its name and its SHA-256, or its fault."""
    rows: list[Row] = []
    for one in files:
        with opened([one], storage, at) as (locals_of, lacking):
            rows += [fault(file, "", f"{file}: {why}.") for file, why in lacking.items()]
            for local in locals_of:
                try:
                    row = work(local.path, local.file, local.sha256)
                    rows.append({"file": local.file, "sha256": local.sha256, "version": _core.version, **row})
                except BallbarError as error:
                    rows.append(fault(local.file, local.sha256, str(error).replace(local.path, local.file)))
    return rows
