"""Many machines at once: lazy tables over files, on a laptop's threads or on a cluster, by Dask.

>>> from ballbar import fleet
>>> table = fleet.errors("sample-runs/machine-history/*/*.b5r")   # nothing is read yet
>>> rows = table.compute()                                         # here it is
>>> len(rows), rows["fault"].isna().all()
(10, True)

:func:`update` keeps such a table in a folder and reads only what is new or changed.
"""
from __future__ import annotations

import difflib
import math
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import pandas

from . import _core, diagnose as _diagnose, errors as _errors, train as _train
from ._call import Model
from ._errors import BallbarError
from ._fleet_files import Paths, files_of, written_whole
from ._fleet_rows import COLUMNS, ERRORS, NUMBERS, Row, copies_marked, error_rows, fault, parts_of, rows_of_each, typed
from ._results import Result
from .fleet_table import Updated, read, update

__all__ = ["ERRORS", "Ranked", "Updated", "diagnose", "errors", "files_of", "ranked", "read", "train", "update"]


def errors(paths: Paths, *, files_of_a_partition: int = 200, **storage: Any) -> Any:
    """A lazy table of the errors of each ballbar test: one row a test.

    Parameters
    ----------
    paths : path, pattern, or list of them
        As of :func:`files_of`.
    files_of_a_partition : int
        Files that are read at once; logs of one folder stay together, as two of them may be one test.
    **storage
        Options of fsspec's file system.

    Returns
    -------
    dask.dataframe.DataFrame
        Columns: file, sha256 and version (whence the row is), machine, bar, date, plane, length_mm, feed_mm_per_min,
        start_deg, arc_deg, stored, each of :data:`ERRORS` with its sigma, and `fault`, the sentence of a file that could
        not be read: such a row has nothing else. The second log of a test has no row. Copies are found in whole tables
        alone: by :func:`update` and :func:`ranked`.

    Raises
    ------
    BallbarError
        Where there is no file.

    Notes
    -----
    Units are in the names: um, um_per_m (ppm), ms for times, deg for angles; each sigma has that of its error.
    """
    at = os.getcwd()

    def rows(files: Sequence[str]) -> list[Row]:
        found, lacking = error_rows(files, storage, at)
        return found + [fault(file, "", f"{file}: {why}.") for file, why in lacking.items()]

    return _frame(rows, files_of(paths, **storage), files_of_a_partition, COLUMNS)


def diagnose(paths: Paths, model: Any = None, *, target: str | None = None, files_of_a_partition: int = 1, **storage: Any) -> Any:
    """A lazy table of what :func:`ballbar.diagnose` says of each file, :func:`ballbar.errors` of a `.b5r`.

    Parameters
    ----------
    paths, files_of_a_partition, **storage
        As of :func:`errors`: series, logs of loggers, `.b5r` files.
    model : Model or path
        As there; None: what the file is diagnosed with alone.
    target : str
        One column; None: that of the model.

    Returns
    -------
    dask.dataframe.DataFrame
        Columns: file, sha256, version, verdict, sentence, named, fault, rmse_um, floor_um, p_nothing.

    Raises
    ------
    BallbarError
        Where there is no file; more than one target.
    """
    if target is not None and not isinstance(target, str):
        raise BallbarError(f"target: expected the name of one column, found {target!r}.")
    texts = ("file", "sha256", "version", "verdict", "sentence", "named", "fault")
    columns = {**dict.fromkeys(texts, "object"), "rmse_um": "float64", "floor_um": "float64", "p_nothing": "float64"}
    text = None if model is None else (model if isinstance(model, Model) else Model(model)).text

    def work(path: str, file: str, sha256: str) -> Row:
        asked = Model(text) if text else None
        if file.lower().endswith(".b5r"):
            found = _errors(path, ranked=True, model=asked).to_dict()
        else:
            found = _diagnose(path, asked, target=target).to_dict()
        return {
            "verdict": found.get("verdict"),
            "sentence": found.get("sentence") or found.get("conclusion"),
            "named": ", ".join(one["effect"] for one in found.get("named", [])),
            "rmse_um": found.get("rmse_um", found.get("residual_rms_um")),
            "floor_um": found.get("floor_um"),
            "p_nothing": found.get("p_nothing"),
        }

    return _frame_of_each(work, paths, storage, files_of_a_partition, columns)


def train(paths: Paths, target: str, out: str | os.PathLike[str], *, few: bool = False, files_of_a_partition: int = 1, **storage: Any) -> Any:
    """A lazy table of models that predict a column, one a file, by :func:`ballbar.train` on the catalogue's effects.

    Parameters
    ----------
    paths, files_of_a_partition, **storage
        As of :func:`errors`: series or sessions.
    target : str
        The column, um.
    out : path
        The folder for the models; made where there is none.
    few : bool
        Few effects.

    Returns
    -------
    dask.dataframe.DataFrame
        Columns: file, sha256, version, model (its path), fault, held_out_um: RMSE of forecasts on rows that the training
        did not have, um; NaN where the file is too short for them.

    Raises
    ------
    BallbarError
        Where there is no file.
    """
    columns = {**dict.fromkeys(("file", "sha256", "version", "model", "fault"), "object"), "held_out_um": "float64"}
    folder = os.path.abspath(out)

    def work(path: str, file: str, sha256: str) -> Row:
        os.makedirs(folder, exist_ok=True)
        model = os.path.join(folder, f"{os.path.splitext(os.path.basename(file))[0]}-{sha256[:8]}.json")
        found = _train(path, target, model, effects=True, few=few).to_dict()
        return {"model": model, "held_out_um": (found.get("forecasts") or {}).get("rmse_um")}

    return _frame_of_each(work, paths, storage, files_of_a_partition, columns)


def ranked(
    table: pandas.DataFrame,
    *,
    tolerance: Mapping[str, float] | None = None,
    false_discovery_rate: float = 0.05,
    page: str | os.PathLike[str] | None = None,
    title: str = "fleet",
    lacking: int = 0,
) -> Ranked:
    """Which machine needs what: change points, wear, seasons, replaced parts, exchanged instruments, tolerances.

    Parameters
    ----------
    table : DataFrame
        Of :func:`errors`, computed or lazy, or of :func:`update`; rows with a fault, and copies, are passed over.
    tolerance : dict
        Limit of a quantity, to both sides of 0, in the unit of its column: ``{"backlash_a_pos": 5.0}``.
    false_discovery_rate : float
        The share of what is called that may be by chance, over all machines and quantities.
    page : path
        Written as well: a page of HTML with the ranking and a picture of what was found.
    title : str
        Of that page.
    lacking : int
        Files that the table lacks (``len(updated.lacking)``); the text, the page and the keys say so.

    Returns
    -------
    Ranked
        Also with the keys `faults` and `lacking`: how many rows were passed over, and how many files are not there.

    Raises
    ------
    BallbarError
        A table without these columns; a tolerance of something else, or not above 0; a page that cannot be written.
    """
    limits = limits_of(tolerance or {})
    if hasattr(table, "compute"):
        table = table.compute()
    absent = [name for name in COLUMNS if name not in table.columns]
    if absent:
        raise BallbarError(f"{absent[0]}: expected a column of that name, as fleet.errors() has it, found none.")
    found, html = _ranked(table, limits, false_discovery_rate, title if page is not None else None, lacking)
    if page is not None:
        try:
            with written_whole(page) as temporary, open(temporary, "w", encoding="utf-8") as file:
                file.write(html)
        except OSError as error:
            raise BallbarError(f"{os.fspath(page)}: the page could not be written: {error.strerror or error}.") from None
    return found


class Ranked(Result):
    """What was found of many machines; the keys are those of :class:`ballbar.History` that rank. ``text`` is its table."""

    __slots__ = ("text",)

    def __init__(self, keys: dict[str, Any], text: str = "") -> None:
        super().__init__(keys)
        self.text = text

    def __reduce__(self) -> Any:
        return type(self), (self.to_dict(), self.text)

    def __repr__(self) -> str:
        return self.text


def limits_of(tolerance: Mapping[str, Any]) -> dict[str, float]:
    """Limits of quantities that there are. Raises BallbarError."""
    known = [name for name, _ in ERRORS if not name.startswith("centre_")]
    limits: dict[str, float] = {}
    for name, limit in tolerance.items():
        if name not in known:
            near = difflib.get_close_matches(str(name), known, 1, 0.0)[0]
            raise BallbarError(f'tolerance: expected a quantity of tests, found "{name}"; the nearest is {near}.')
        try:
            limits[name] = float(limit)
        except (TypeError, ValueError):
            limits[name] = math.nan
        if not 0.0 < limits[name] < math.inf:
            raise BallbarError(f"tolerance: expected a number above 0 for {name}, found {limit!r}.")
    return limits


def _ranked(
    table: pandas.DataFrame, limits: dict[str, float], false_discovery_rate: float, title: str | None, lacking: int
) -> tuple[Ranked, str]:
    """With the page, HTML, where it has a title."""
    table = copies_marked(table)
    rows = table[table["fault"].isna()]
    faults = len(table) - len(rows)
    remarks = [f"This is a part of the whole: {files_text(lacking)} could not be read."] if lacking else []
    remarks += [f"Passed over for a fault: {files_text(faults)}."] if faults else []
    texts = {name: rows[name].fillna("").astype(str).tolist() for name in ("file", "machine", "bar", "plane")}
    dates = pandas.to_datetime(rows["date"])
    numbers = {name: rows[name].to_numpy(float) for name in NUMBERS}
    numbers["started_s"] = ((dates - pandas.Timestamp(0)) / pandas.Timedelta(seconds=1)).to_numpy(float)
    numbers["stored"] = rows["stored"].fillna(False).to_numpy(float)
    for name, unit in ERRORS:
        for column in (f"{name}_{unit}", f"{name}_sigma_{unit}"):
            numbers[column] = rows[column].to_numpy(float)
    found, text, html = _core.fleet(texts, numbers, ERRORS, limits, false_discovery_rate, title, remarks)
    return Ranked({**found, "faults": faults, "lacking": lacking}, text), html


def files_text(files: int) -> str:
    """1 file, 2 files."""
    return f"{files} file" + ("" if files == 1 else "s")


def _frame_of_each(
    work: Callable[[str, str, str], Row], paths: Paths, storage: dict[str, Any], size: int, columns: dict[str, str]
) -> Any:
    at = os.getcwd()
    return _frame(lambda files: rows_of_each(files, storage, at, work), files_of(paths, **storage), size, columns)


def _frame(work: Callable[[Sequence[str]], list[Row]], files: Sequence[str], size: int, columns: dict[str, str]) -> Any:
    import dask.dataframe as frames

    if size < 1:
        raise BallbarError(f"files_of_a_partition: expected a number from 1 on, found {size}.")
    return frames.from_map(lambda part: typed(work(part), columns), list(parts_of(files, size)), meta=typed([], columns))
