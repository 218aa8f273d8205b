"""Many machines at once: lazy tables over files, on a laptop's threads or on a cluster, by Dask.

>>> from ballbar import fleet
>>> table = fleet.errors("sample-runs/machine-history/*/*.b5r")   # nothing is read yet
>>> rows = table.compute()                                         # here it is
>>> len(rows), rows["fault"].isna().all(), rows["machine"].unique().tolist()
(10, True, ['machine-history'])

:func:`update` keeps such a table in a folder and reads only what is new or changed; :func:`rank` says which machine needs
what.
"""
from __future__ import annotations

import difflib
import html
import math
import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from numbers import Real
from pathlib import PurePath, PurePosixPath
from typing import Any

import pandas

from . import _core
from ._errors import BallbarError, warn
from ._fleet_files import Paths, files_of, opened, write_whole
from ._fleet_rows import COLUMNS, ERRORS, NUMBERS, Row, copies_marked, error_rows, fault, parts_of, tests_and_faults, typed
from .fleet_table import Updated, read, update

__all__ = ["ERRORS", "Ranking", "Updated", "diagnose", "errors", "files_of", "rank", "read", "train", "update"]


def errors(paths: Paths, *, files_of_a_partition: int = 50, **storage: Any) -> Any:
    """Returns a lazy table of the errors of each ballbar test: one row a test.

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
        start_deg, arc_deg, stored, each of :data:`ERRORS` with its sigma, their units in the names, and `fault`, the
        sentence of a file that could not be read: such a row has nothing else. The second log of a test has no row.
        Copies are found in whole tables alone: by :func:`update` and :func:`rank`.

    Raises
    ------
    BallbarError
        There is no file.
    """
    at = os.getcwd()
    return _frame(lambda files: tests_and_faults(*error_rows(files, storage, at)), paths, storage, files_of_a_partition, COLUMNS)


def diagnose(
    paths: Paths, model: Any = None, *, target: str | None = None, extra: Sequence[Any] = (), files_of_a_partition: int = 1,
    **storage: Any,
) -> Any:
    """Returns a lazy table of what a diagnosis says of each file, :func:`ballbar.machine_errors` of a `.b5r`.

    Parameters
    ----------
    paths, files_of_a_partition, **storage
        As of :func:`errors`: series, logs of loggers, `.b5r` files.
    model : Model or path
        What is fitted to each file; None: a model of `target` without effects. A `.b5r` needs none.
    target : str
        One column; None: that of the model.
    extra : list of PythonEffect
        Are searched beside the catalogue's; they go to the workers with the task.

    Returns
    -------
    dask.dataframe.DataFrame
        Columns: file, sha256, version, verdict, sentence, named, fault, rmse_um, floor_um (NaN of a target that is no
        length), p_nothing.

    Raises
    ------
    BallbarError
        There is no file; the model cannot be read; `target` is no name.
    """
    from . import Model, machine_errors

    if target is not None and not isinstance(target, str):
        raise BallbarError(f"target: expected the name of one column, found {target!r}.")
    if isinstance(model, (str, os.PathLike)):
        model = Model.load(model)
    fitted = model if target is None else Model(target) if model is None else model.with_target(target)

    def work(path: str, file: str, sha256: str) -> Row:
        if file.lower().endswith(".b5r"):
            found: Any = machine_errors(path, model=model)
            row = {"sentence": found.conclusion, "rmse_um": found.residual_rms_um}
        elif fitted is None:
            raise BallbarError(f"{path}: expected a model or a target for a series, found neither; pass target=.")
        else:
            fit = fitted.fit(path)
            found = fit.diagnose(extra=extra)
            row = {"sentence": found.sentence, "rmse_um": fit.to_dict().get("rmse_um"), "floor_um": fit.to_dict().get("floor_um"), "p_nothing": found.p_nothing}
        return {**row, "verdict": found.verdict, "named": ", ".join(one.effect for one in found.named)}

    return _frame_of_each(work, paths, storage, files_of_a_partition, "verdict sentence named fault", "rmse_um floor_um p_nothing")


def train(paths: Paths, target: str, out: str | os.PathLike[str], *, few: bool = False, files_of_a_partition: int = 1, **storage: Any) -> Any:
    """Returns a lazy table of models that predict a column, one a file, by :func:`ballbar.train` on the catalogue's effects.

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
        There is no file.
    """
    folder = os.path.abspath(out)

    def work(path: str, file: str, sha256: str) -> Row:
        from . import train as train_one

        os.makedirs(folder, exist_ok=True)
        model = os.path.join(folder, f"{os.path.splitext(os.path.basename(file))[0]}-{sha256[:8]}.json")
        found = train_one(path, target=target, out=model, effects=True, few=few)
        return {"model": model, "held_out_um": found.forecasts.rmse_um if found.forecasts else None}

    return _frame_of_each(work, paths, storage, files_of_a_partition, "model fault", "held_out_um")


@dataclass(frozen=True, eq=False, repr=False)
class Ranking:
    """What was found of many machines. Printed, it is its `text`.

    Attributes
    ----------
    findings : pandas.DataFrame
        One row a finding, those of the neediest machine first: machine, kind, axis, from, to, the quantity that shows it
        the clearest with plane, size, sigma and unit, quantities (how many have part in it), p_value, q_value (corrected
        for all questions), sentence, remedy.
    machines : pandas.DataFrame
        One row a machine, the neediest first: machine, tests, first, last, need, reason, findings (how many).
    text : str
        The ranking for a terminal.
    faults, lacking : int
        Rows that were passed over for a fault, and files that the table lacks.
    """

    findings: pandas.DataFrame
    machines: pandas.DataFrame
    text: str
    faults: int
    lacking: int
    _keys: dict[str, Any] = field(repr=False)

    def to_dict(self) -> dict[str, Any]:
        """Returns the keys of ``ballbar history --json`` of many machines, and `faults` and `lacking`."""
        return {**self._keys, "faults": self.faults, "lacking": self.lacking}

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"


def rank(
    tests: Any,
    *,
    machine: Callable[[PurePath], str | tuple[str, ...]] | None = None,
    tolerance: Mapping[str, float] | None = None,
    false_discovery_rate: float = 0.05,
    page: str | os.PathLike[str] | None = None,
    title: str = "fleet",
    lacking: int = 0,
) -> Ranking:
    """Says which machine needs what: change points, wear, seasons, replaced parts, exchanged instruments, tolerances.

    Parameters
    ----------
    tests : pandas.DataFrame or dask.dataframe.DataFrame
        Of :func:`errors` or :func:`update`; rows with a fault, and copies, are passed over.
    machine : callable
        Takes the path of a test, and returns the name of its machine, or the parts of that name:
        ``lambda path: path.parts[-3:-1]``. None: the name in the file, or else that of its folder; a folder named by a
        date holds a test, and the one above it is the machine's.
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
    Ranking

    Raises
    ------
    BallbarError
        A table without these columns; a tolerance of something else, or not above 0; a page that cannot be written.

    Warns
    -----
    BallbarWarning
        Tests of one machine's name lie below different folders, and `machine` does not say whose they are.
    """
    limits = limits_of(tolerance or {})
    table: pandas.DataFrame = tests.compute() if hasattr(tests, "compute") else tests
    absent = [name for name in COLUMNS if name not in table.columns]
    if absent:
        raise BallbarError(f"{absent[0]}: expected a column of that name, as fleet.errors() has it, found none.")
    table = copies_marked(table)
    rows = table[table["fault"].isna()]
    faults = len(table) - len(rows)
    remarks = [f"This is a part of the whole: {files_text(lacking)} could not be read."] if lacking else []
    remarks += [f"Passed over for a fault: {files_text(faults)}."] if faults else []
    texts: dict[str, list[str]] = {name: rows[name].fillna("").astype(str).tolist() for name in ("file", "machine", "bar", "plane")}
    if machine is None:
        _expect_one_place_each(texts["file"], texts["machine"])
    else:
        named = (machine(_path_of(file)) for file in texts["file"])
        parts = [(one,) if isinstance(one, str) else one for one in named]
        for file, one in zip(texts["file"], parts):
            if not isinstance(one, tuple) or not one or not all(isinstance(part, str) and part for part in one):
                raise BallbarError(f"machine: expected a text or a tuple of texts for {file}, found {one!r}.")
        texts["machine"] = ["/".join(one) for one in parts]
    quantities = [f"{name}_{unit}{of}" for name, unit in ERRORS for of in ("", "_sigma")]
    numbers = {name: rows[name].to_numpy(float) for name in (*NUMBERS, *quantities)}
    numbers["started_s"] = ((pandas.to_datetime(rows["date"]) - pandas.Timestamp(0)) / pandas.Timedelta(seconds=1)).to_numpy(float)
    numbers["stored"] = rows["stored"].fillna(False).to_numpy(float)
    of_page = None if page is None else title
    keys, text, html_page = _core.fleet(texts, numbers, ERRORS, limits, false_discovery_rate, of_page, remarks)
    if page is not None:
        write_whole(page, html_page.encode())
    findings = [
        {"machine": one["machine"], **finding["quantities"][0], **finding, "quantities": len(finding["quantities"])}
        for one in keys["machines"] for finding in one["findings"]
    ]
    machines = [{**one, "findings": len(one["findings"])} for one in keys["machines"]]
    found = pandas.DataFrame(findings, columns=(
        "machine", "kind", "axis", "from", "to", "quantity", "plane", "size", "sigma", "unit", "quantities", "p_value", "q_value",
        "sentence", "remedy",
    )).astype({**dict.fromkeys(("from", "to"), "datetime64[ns]"), **dict.fromkeys(("size", "sigma", "p_value", "q_value"), "float64")})
    needs = pandas.DataFrame(machines, columns=("machine", "tests", "first", "last", "need", "reason", "findings")).astype(
        dict.fromkeys(("first", "last"), "datetime64[ns]")
    )
    return Ranking(found, needs, text, faults, lacking, keys)


def limits_of(tolerance: Mapping[str, Any]) -> Mapping[str, float]:
    """Returns limits of quantities that there are. Raises BallbarError."""
    known = [name for name, _ in ERRORS if not name.startswith("centre_")]
    for name, limit in tolerance.items():
        if name not in known:
            near = difflib.get_close_matches(str(name), known, 1, 0.0)[0]
            raise BallbarError(f'tolerance: expected a quantity of tests, found "{name}"; the nearest is {near}.')
        if not isinstance(limit, Real) or not 0.0 < float(limit) < math.inf:
            raise BallbarError(f"tolerance: expected a number above 0 for {name}, found {limit!r}.")
    return tolerance


def _path_of(file: str) -> PurePath:
    return PurePosixPath(file.partition("://")[2]) if "://" in file else PurePath(file)


def _expect_one_place_each(files: Sequence[str], machines: Sequence[str]) -> None:
    """Warns where two plants may each have a machine of that name."""
    places: dict[str, dict[PurePath, str]] = {}  # of each machine the folders that have its own, and its own
    for file, machine in zip(files, machines):
        folders = _path_of(file).parents
        own = next((folder for folder in folders if folder.name == machine), folders[0])
        places.setdefault(machine, {}).setdefault(own.parent, str(own))
    several = {machine: list(owns.values()) for machine, owns in places.items() if len(owns) > 1}
    for machine, (first, second, *_) in list(several.items())[:1]:
        warn(
            f"{machine}: expected tests of one machine, found tests below {first} and below {second}, and took them for one's"
            + (f"; so it is with {len(several) - 1} names more. " if len(several) > 1 else ". ")
            + "Pass machine=lambda path: path.parts[-3:-1] if they are of several, machine=lambda path: path.parts[-2] if of one."
        )


def files_text(files: int) -> str:
    """Says 1 file, 2 files."""
    return f"{files} file" + ("" if files == 1 else "s")


def _frame_of_each(
    work: Callable[[str, str, str], Row], paths: Paths, storage: dict[str, Any], size: int, texts: str, numbers: str
) -> Any:
    """Returns a lazy table of what `work` makes of the path, the name and the SHA-256 of each file, or its fault."""
    at = os.getcwd()

    def rows(files: Sequence[str]) -> list[Row]:
        with opened(files, storage, at) as (found, lacking):
            made = tests_and_faults([], lacking)
            for path, (file, sha256) in found.items():
                try:
                    made.append({**fault(file, sha256, None), **work(path, file, sha256)})
                except BallbarError as error:
                    made.append(fault(file, sha256, str(error).replace(path, file)))
        return made

    columns = {**dict.fromkeys(["file", "sha256", "version", *texts.split()], "object"), **dict.fromkeys(numbers.split(), "float64")}
    return _frame(rows, paths, storage, size, columns)


def _frame(work: Callable[[Sequence[str]], list[Row]], paths: Paths, storage: dict[str, Any], size: int, columns: dict[str, str]) -> Any:
    import dask.dataframe as frames

    if size < 1:
        raise BallbarError(f"files_of_a_partition: expected a number from 1 on, found {size}.")
    parts = list(parts_of(files_of(paths, **storage), size))
    made = frames.from_map  # type: ignore[attr-defined]
    return made(lambda part: typed(work(part), columns), parts, meta=typed([], columns))
