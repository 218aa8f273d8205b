"""Many machines at once: lazy tables over files, on a laptop's threads or on a cluster, by Dask.

>>> from ballbar import fleet
>>> table = fleet.errors("sample-runs/machine-history/*/*.b5r")   # nothing is read yet
>>> rows = table.compute()                                         # here it is
>>> len(rows), rows["fault"].isna().all()
(10, True)

:func:`update` keeps such a table in a folder and reads only what is new or changed.
"""
from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Union

import numpy as np
import pandas
from fsspec.core import get_fs_token_paths

from . import _core, diagnose as _diagnose, errors as _errors, train as _train
from ._errors import BallbarError
from ._results import Result

__all__ = ["ERRORS", "diagnose", "errors", "files_of", "ranked", "read", "train", "update"]

Paths = Union[str, "os.PathLike[str]", Iterable[Union[str, "os.PathLike[str]"]]]

FILES_OF_A_PARTITION = 200

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
_NUMBERS = ("length_mm", "feed_mm_per_min", "start_deg", "arc_deg")
_COLUMNS = {
    **{name: "object" for name in _TEXTS},
    **{name: "float64" for name in _NUMBERS},
    "stored": "boolean",
    **{f"{name}{of}_{unit}": "float64" for name, unit in ERRORS for of in ("", "_sigma")},
}


def files_of(paths: Paths, **storage: Any) -> list[str]:
    """The files of a pattern (``plant/**/*.b5r``), of a folder (all `.b5r` below) or of a list; fsspec's paths.

    Raises
    ------
    BallbarError
        Where there is none.
    """
    several = [paths] if isinstance(paths, (str, os.PathLike)) else list(paths)
    found: list[str] = []
    for one in several:
        text = os.fspath(one)
        if "://" not in text and os.path.isdir(text):
            found += _below(text)
        elif "://" not in text and not any(sign in text for sign in "*?["):
            if not os.path.exists(text) and one is paths:
                raise BallbarError(f"{text}: expected a folder, files or a pattern, found nothing of that name.")
            found.append(text)
        else:
            system, _, matches = get_fs_token_paths(text, storage_options=storage)
            protocol = text.partition("://")[0] + "://" if "://" in text else ""
            found += [protocol + str(path) for path in matches] if protocol else [_as_typed(text, path) for path in matches]
    files = sorted(set(found))
    if not files:
        raise BallbarError(f"{several[0] if several else ''}: expected files, found none of that name.")
    return files


def errors(paths: Paths, *, files_of_a_partition: int = FILES_OF_A_PARTITION, **storage: Any) -> Any:
    """A lazy table (``dask.dataframe``) of the errors of each ballbar test: one row a test.

    Columns: file, sha256 and version (whence the row is), machine, bar, date, plane, length_mm, feed_mm_per_min,
    start_deg, arc_deg, stored, each of :data:`ERRORS` with its sigma, and `fault`, the sentence of a file that could not
    be read: such a row has nothing else. `storage` are fsspec's options.
    """
    return _frame(_error_rows, files_of(paths, **storage), files_of_a_partition, _COLUMNS, storage)


def diagnose(paths: Paths, model: Any = None, *, target: str | None = None, files_of_a_partition: int = 1, **storage: Any) -> Any:
    """A lazy table of what :func:`ballbar.diagnose` says of each file: verdict, sentence, named, rmse_um, floor_um.

    `paths`: series, logs of loggers, `.b5r` files; `model` and `target` as there.
    """
    texts = ("file", "sha256", "version", "verdict", "sentence", "named", "fault")
    columns = {**{name: "object" for name in texts}, "rmse_um": "float64", "floor_um": "float64", "p_nothing": "float64"}
    model_text = model.text if hasattr(model, "text") else model
    return _frame(_diagnosed_rows, files_of(paths, **storage), files_of_a_partition, columns, storage, model_text, target)


def train(paths: Paths, target: str, out: str, *, few: bool = False, files_of_a_partition: int = 1, **storage: Any) -> Any:
    """A lazy table of models that predict `target`, one a file, written to the folder `out`: file, model, held_out_um."""
    columns = {**{name: "object" for name in ("file", "sha256", "version", "model", "fault")}, "held_out_um": "float64"}
    return _frame(_trained_rows, files_of(paths, **storage), files_of_a_partition, columns, storage, target, out, few)


def ranked(
    table: pandas.DataFrame,
    *,
    tolerance: Mapping[str, float] | None = None,
    false_discovery_rate: float = 0.05,
    page: str | os.PathLike[str] | None = None,
    title: str = "fleet",
) -> Ranked:
    """Which machine needs what: change points, wear, seasons, replaced parts, exchanged instruments, tolerances.

    Parameters
    ----------
    table : DataFrame
        As :func:`errors` computes it, or :func:`update` keeps it; rows with a fault are passed over.
    tolerance : dict
        Limit of a quantity, to both sides of 0: ``{"backlash_a_pos": 5.0}``.
    false_discovery_rate : float
        The share of what is called that may be by chance, over all machines and quantities.
    page : path
        Written as well: a page of HTML with the ranking and a picture of what was found.
    """
    rows = table[table["fault"].isna()]
    texts = {name: rows[name].fillna("").astype(str).tolist() for name in ("file", "machine", "bar", "plane")}
    dates = pandas.to_datetime(rows["date"])
    numbers = {name: rows[name].to_numpy(float) for name in _NUMBERS}
    numbers["started_s"] = ((dates - pandas.Timestamp(0)) / pandas.Timedelta(seconds=1)).to_numpy(float)
    numbers["stored"] = rows["stored"].fillna(False).to_numpy(float)
    for name, unit in ERRORS:
        for column in (f"{name}_{unit}", f"{name}_sigma_{unit}"):
            numbers[column] = rows[column].to_numpy(float)
    found, text, html = _core.fleet(
        texts, numbers, ERRORS, dict(tolerance or {}), false_discovery_rate, title if page is not None else None
    )
    if page is not None:
        with open(page, "w", encoding="utf-8") as file:
            file.write(html)
    return Ranked(found, text)


class Ranked(Result):
    """What was found of many machines; the keys are those of ``ballbar fleet --json``. ``text`` is its table."""

    __slots__ = ("text",)

    def __init__(self, keys: dict[str, Any], text: str = "") -> None:
        super().__init__(keys)
        self.text = text

    def __repr__(self) -> str:
        return self.text


def update(paths: Paths, table: str, **how: Any) -> Any:
    """Brings the table in the folder `table` up to date with the files, and returns it; see :mod:`ballbar.fleet_table`."""
    from .fleet_table import update as work

    return work(paths, table, **how)


def read(table: str) -> pandas.DataFrame:
    """The table in that folder, whole."""
    from .fleet_table import read as work

    return work(table)


def _below(folder: str) -> list[str]:
    files: list[str] = []
    for at, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        files += [os.path.join(at, name) for name in names if name.lower().endswith(".b5r") and not name.startswith(".")]
    return files


def _as_typed(pattern: str, path: str) -> str:
    return path if os.path.isabs(pattern) else os.path.relpath(path)


def _frame(work: Any, files: Sequence[str], size: int, columns: dict[str, str], *how: Any) -> Any:
    import dask.dataframe as frames

    meta = pandas.DataFrame({name: pandas.Series(dtype=kind) for name, kind in columns.items()})
    parts = [files[at : at + size] for at in range(0, len(files), size)]
    return frames.from_map(lambda part: _typed(work(part, *how), columns), parts, meta=meta)


def _typed(rows: list[dict[str, Any]], columns: dict[str, str]) -> pandas.DataFrame:
    frame = pandas.DataFrame({name: [row.get(name) for row in rows] for name in columns})
    return frame.astype(columns).where(frame.notna(), np.nan).astype(columns)


class _Local:
    """A file that the program can open, whatever file system it is on, with what it was when it was opened."""

    def __init__(self, path: str, storage: dict[str, Any]) -> None:
        self.folder: tempfile.TemporaryDirectory[str] | None = None
        self.path = path
        if "://" in path:
            system, _, (inside,) = get_fs_token_paths(path, storage_options=storage)
            self.folder = tempfile.TemporaryDirectory(prefix="ballbar-")
            self.path = os.path.join(self.folder.name, os.path.basename(inside) or "file")
            system.get(inside, self.path)
        with open(self.path, "rb") as file:
            self.sha256 = hashlib.sha256(file.read()).hexdigest()

    def close(self) -> None:
        if self.folder:
            self.folder.cleanup()


def _each(files: Sequence[str], storage: dict[str, Any]) -> tuple[list[tuple[str, _Local]], list[dict[str, Any]]]:
    """The files that can be opened, and rows of those that cannot."""
    opened: list[tuple[str, _Local]] = []
    faults: list[dict[str, Any]] = []
    for file in files:
        try:
            opened.append((file, _Local(file, storage)))
        except (OSError, ValueError) as error:
            faults.append(_fault(file, "", f"{file}: {getattr(error, 'strerror', None) or error}."))
    return opened, faults


def _fault(file: str, sha256: str, sentence: str) -> dict[str, Any]:
    return {"file": file, "sha256": sha256, "version": _core.version, "fault": sentence}


def _error_rows(files: Sequence[str], storage: dict[str, Any]) -> list[dict[str, Any]]:
    opened, rows = _each(files, storage)
    name_of = {local.path: (file, local) for file, local in opened}
    try:
        found = _errors([local.path for _, local in opened]).to_dict() if opened else {"tests": [], "skipped": []}
    except BallbarError:  # none of them can be read
        found = {"tests": [], "skipped": [_skipped_alone(local.path) for _, local in opened]}
    for test in found["tests"]:
        file, local = name_of[test["file"]]
        row = {"file": file, "sha256": local.sha256, "version": _core.version, "fault": None}
        row.update({name: test[name] for name in ("machine", "bar", "date", "plane", "stored", "feed_mm_per_min", "start_deg", "arc_deg")})
        row["length_mm"] = test["nominal_length_mm"]
        row["machine"] = row["machine"] or os.path.basename(os.path.dirname(file))
        for one in test["errors"]:
            unit = one["unit"].replace("/", "_per_")
            row[f"{one['name']}_{unit}"] = one["value"]
            row[f"{one['name']}_sigma_{unit}"] = one["sigma"]
        rows.append(row)
    for skipped in found["skipped"]:
        file, local = name_of[skipped["file"]]
        rows.append(_fault(file, local.sha256, skipped["sentence"].replace(local.path, file)))
    for file, local in opened:
        if not any(row["sha256"] == local.sha256 for row in rows if row["file"] == file):
            rows.append(_fault(file, local.sha256, f"{file}: the second recording of a test, or none."))
        local.close()
    return sorted(rows, key=lambda row: str(row["file"]))


def _skipped_alone(path: str) -> dict[str, str]:
    try:
        _errors([path])
    except BallbarError as error:
        return {"file": path, "sentence": str(error)}
    return {"file": path, "sentence": f"{path}: could not be read."}


def _diagnosed_rows(files: Sequence[str], storage: dict[str, Any], model: Any, target: str | None) -> list[dict[str, Any]]:
    from ._words import Model

    opened, rows = _each(files, storage)
    for file, local in opened:
        row: dict[str, Any] = {"file": file, "sha256": local.sha256, "version": _core.version}
        try:
            found = _diagnose(local.path, Model(model) if model else None, target=target).to_dict()
            named = ", ".join(one["effect"] for one in found.get("named", []))
            sentence = found.get("sentence") or found.get("conclusion")
            rmse = found.get("rmse_um", found.get("residual_rms_um"))
            row.update(verdict=found.get("verdict"), sentence=sentence, named=named, rmse_um=rmse)
            row.update(floor_um=found.get("floor_um"), p_nothing=found.get("p_nothing"))
        except BallbarError as error:
            row["fault"] = str(error).replace(local.path, file)
        rows.append(row)
        local.close()
    return rows


def _trained_rows(files: Sequence[str], storage: dict[str, Any], target: str, out: str, few: bool) -> list[dict[str, Any]]:
    opened, rows = _each(files, storage)
    os.makedirs(out, exist_ok=True)
    for file, local in opened:
        name = os.path.splitext(os.path.basename(file))[0]
        path = os.path.join(out, f"{name}-{local.sha256[:8]}.json")
        row: dict[str, Any] = {"file": file, "sha256": local.sha256, "version": _core.version}
        try:
            found = _train(local.path, target, path, effects=True, few=few).to_dict()
            row.update(model=path if os.path.exists(path) else None, held_out_um=found.get("held_out_um"))
        except BallbarError as error:
            row["fault"] = str(error).replace(local.path, file)
        rows.append(row)
        local.close()
    return rows
