"""Files read as tables, and circles fitted."""
from __future__ import annotations

import os
import tempfile
from typing import Any, cast

import pandas
from numpy.typing import ArrayLike

from . import _core
from ._core import Recording, Series
from ._frame import Path, frame_from, frame_of, series_of
from ._functions import import_log
from ._kinds import Fitted


def read(data: Any, **how: Any) -> pandas.DataFrame:
    """A series, a logger's log or several as a DataFrame over ``time_s``.

    Parameters
    ----------
    data : path or list of paths
        Delimited text, .xlsx, .mat, .json or a ballbar series; several logs are joined on the clock of the first.
    **how
        As of :func:`import_log`: recipe, sheet, delimiter, decimal, dates, time, time_unit, every, missing, units, roles,
        name, leave_out, keep_clocks, lag_range_s, max_gap_s ...

    Returns
    -------
    DataFrame
        Index ``time_s``, or ``row`` where no file tells the time and `every` is not given: a fit then knows no time, and
        refuses effects with a time constant. ``attrs`` has ``units`` and ``roles`` by column, and ``started`` where the file tells it.

    Raises
    ------
    BallbarError
        What the file does not tell, with the option that does.

    Examples
    --------
    >>> import ballbar as bb
    >>> table = bb.read("sample-runs/hidden-effect/01/data.csv")
    >>> table.index.name, table.attrs["units"]["z_um"]
    ('time_s', 'um')
    """
    if isinstance(data, (str, os.PathLike)) and not how:
        return frame_from(_core.read_series(data))
    with tempfile.TemporaryDirectory(prefix="ballbar-") as folder:
        path = os.path.join(folder, "series.csv")
        import_log(data, out=path, **how)
        return frame_from(_core.read_series(path))


def write(frame: Any, path: Path, **how: Any) -> None:
    """Writes a table as a series .csv, which reads back to the same numbers; a gap is an empty cell.

    Parameters
    ----------
    frame : DataFrame, dict of arrays, Series
        As of :meth:`Model.fit`.
    path : path
        Of the .csv.
    **how
        units, roles, every, as of :meth:`Model.fit`.
    """
    table = None if isinstance(frame, Series) else frame_of(frame)
    if table is None and not isinstance(frame, Series):
        raise TypeError(f"expected a table or a Series, found {type(frame).__name__}")
    (frame if table is None else series_of(table, **how)[0]).write(path)


def fit_circle(
    length_mm: ArrayLike | Recording | list[Recording],
    *,
    angle_deg: ArrayLike | None = None,
    polar: bool = False,
    robust: bool = False,
    **recording: Any,
) -> Fitted:
    """The circle, or without angles the length, of readings of a ballbar.

    Parameters
    ----------
    length_mm : (n,) array, Recording or list of Recording
        Lengths of the bar, mm.
    angle_deg : (n,) array
        From +A towards +B of the plane, deg; None: no circle, lengths along a line.
    polar : bool
        The circle through the polar points, as instrument software has it.
    robust : bool
        Discounts outlying readings (Tukey's biweight).
    **recording
        As of :class:`Recording`: time_s, plane, direction, nominal_length_mm ...

    Returns
    -------
    Fitted
        `recordings` has centre in um and radius in mm, with sigmas; `pairs` the numbers of ISO 230-4.

    Raises
    ------
    BallbarError
        A reading that cannot be.

    Notes
    -----
    The length equation is solved in all readings at once.

    Examples
    --------
    >>> import ballbar as bb, numpy as np
    >>> angle_deg = np.arange(0.0, 360.0)
    >>> circle = bb.fit_circle(100.0 + 0.005 * np.cos(np.radians(angle_deg)), angle_deg=angle_deg)
    >>> round(circle.recordings[0].centre_a_um, 3)
    5.0
    """
    if isinstance(length_mm, Recording):
        length_mm = [length_mm]
    if not (isinstance(length_mm, list) and length_mm and isinstance(length_mm[0], Recording)):
        length_mm = [Recording(cast(ArrayLike, length_mm), angle_deg, **recording)]
    return Fitted(_core.fit(cast(list[Recording], length_mm), bool(polar), bool(robust)))
