"""Logs of loggers, one or several, and data that are simulated."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ._kinds import Imported, Simulated
from ._call import Path, Call


def import_log(log: Path, *, out: Path | None = None, save: Path | None = None, **how: Any) -> Imported:
    """What a logger's file is taken for, column by column; :func:`read_series` gives the series.

    Parameters
    ----------
    log : path
        Delimited text, .xlsx, .mat or .json of columns over time.
    out : path
        The series, .csv, with time in s.
    save : path
        How this log was read, for the next of its kind, .toml.
    **how
        The program's options: recipe, sheet, delimiter, decimal, dates, time, time_unit, every, missing, unit, role,
        name, leave_out; those of the form COLUMN=WORD are dicts, those that may be repeated lists.

    Returns
    -------
    Imported
        Columns with units and roles; `rows` and lines from 1.

    Raises
    ------
    BallbarError
        What the file does not tell, with the option that does.
    UsageError
        An option that there is not.

    Examples
    --------
    >>> import ballbar
    >>> ballbar.import_log("sample-runs/foreign-logs/warmup.csv").started
    '2026-11-22T13:05:10'
    """
    return Imported(Call("import").files(log).options(out=out, save=save, **how).run())


def merge(
    logs: Sequence[Path],
    *,
    out: Path | None = None,
    keep_clocks: bool = False,
    lag_range_s: float | None = None,
    max_gap_s: float | None = None,
    **how: Any,
) -> Imported:
    """Several logs, each with its own clock, as one series.

    Parameters
    ----------
    logs : list of paths
        As :func:`import_log` reads them, and series; the clock of the first counts.
    out : path
        The series, .csv.
    keep_clocks : bool
        By their dates alone, without a lag from what both know.
    lag_range_s : float
        How far apart the clocks may be, s; default 1800, without dates half the log.
    max_gap_s : float
        Longest gap of a signal to interpolate over, s; default 600.
    **how
        As of :func:`import_log`.

    Returns
    -------
    Imported
        `parts` with the lag of each clock, s.

    Raises
    ------
    BallbarError
        Logs that cannot be put together.

    Examples
    --------
    >>> import ballbar
    >>> found = ballbar.merge(["sample-runs/foreign-logs/probes.csv", "sample-runs/foreign-logs/control.csv"])
    >>> found.rows, found.columns
    (2378, 8)
    """
    if not isinstance(logs, (list, tuple)) or len(logs) < 2:
        raise TypeError("ballbar.merge: expected a list of two logs or more")
    call = Call("import").files(logs)
    call.options(out=out, keep_clocks=keep_clocks, lag_range=lag_range_s, max_gap=max_gap_s, **how)
    return Imported(call.run())


def simulate(
    machine: Path, out: Path, *, truth: Path | None = None, seed: int | None = None, b5r: bool = False, force: bool = False
) -> Simulated:
    """The recordings, signals and five probes of a virtual machine whose true drift is known.

    Parameters
    ----------
    machine : path
        `machine.toml`, or `fleet.toml` of a plant of them.
    out : path
        The folder for the session's files, new or empty.
    truth : path
        File for the truth; default beside the folder.
    seed : int
        Of the noise, 0 or above; default the machine's own.
    b5r : bool
        Method circles: `.b5r` files alone.
    force : bool
        Replaces files of the same names.

    Returns
    -------
    Simulated
        The files, and where the truth is.

    Raises
    ------
    BallbarError
        A machine that cannot be, or a folder that is not empty.

    Examples
    --------
    >>> import ballbar, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     ballbar.simulate("sample-runs/qc20-style-b5r/machine.toml", folder + "/run", b5r=True).tests
    6
    """
    call = Call("simulate").files(machine).options(out=out, truth=truth, seed=seed, b5r=b5r, force=force)
    return Simulated(call.run())
