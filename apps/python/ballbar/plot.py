"""Pictures by matplotlib, drawn from what results hold: each draws on the axes given, or on new ones, and returns them.

>>> import ballbar as bb, ballbar.plot
>>> axes = bb.drift("sample-runs/two-arcs-he2015").plot()
>>> axes.get_xlabel()
'time, min'
"""
from __future__ import annotations

import io
from collections.abc import Callable
from typing import Any

import numpy as np
import pandas

from ._core import Recording
from ._kinds import Comparison, Drift, Fitted, RankedErrors
from ._model import Diagnosis, Fit
from ._results import Result
from ._times import ROWS

__all__ = ["circle", "comparison", "diagnosis", "drift", "errors", "fit", "history", "of", "svg_of"]


def of(result: Result, axes: Any = None) -> Any:
    """The picture of a result. Raises TypeError where it has none."""
    for kind, draw in _DRAWN:
        if isinstance(result, kind):
            return draw(result, axes=axes)
    raise TypeError(f"expected a result with a picture, one of {', '.join(kind.__name__ for kind, _ in _DRAWN)}, found {type(result).__name__}")


def svg_of(result: Result) -> str:
    """The same as SVG, byte for byte the same of equal results; empty: no picture, or no matplotlib."""
    try:
        import matplotlib
        from matplotlib.figure import Figure
    except ImportError:
        return ""
    figure = Figure(figsize=(8.0, 4.0), layout="constrained")
    try:
        of(result, figure.subplots())
    except TypeError:
        return ""
    text = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "ballbar"}):
        figure.savefig(text, format="svg", metadata={"Date": None})
    return text.getvalue()


def fit(found: Fit, *, axes: Any = None) -> Any:
    """What was measured, the model and the residual, um."""
    axes = axes or _new()
    dates = found.index if isinstance(found.index, pandas.DatetimeIndex) else None
    is_numbered = found.index.names[-1] == ROWS
    at = dates.to_numpy() if dates is not None else found._arrays["elapsed_s"] / (1.0 if is_numbered else 60.0)
    axes.plot(at, found.measured.to_numpy(), ".", markersize=3, label="measured")
    axes.plot(at, found.fitted.to_numpy(), "-", label="model")
    axes.plot(at, found.residuals.to_numpy(), "-", linewidth=0.8, label="residual")
    return _named(axes, "" if dates is not None else "row" if is_numbered else "time, min", f"{found.target}, {_sign(found.target_unit)}")


def diagnosis(found: Diagnosis, *, axes: Any = None) -> Any:
    """How probable it is that each effect is missing, the most probable first."""
    axes = axes or _new()
    rows = sorted(found._json["effects"], key=lambda row: float(row["p"]))[-12:]
    names = [f"{row['effect']}({', '.join(row['columns'].values())})" for row in rows] + ["nothing"]
    axes.barh(names, [*(row["p"] for row in rows), found.p_nothing])
    axes.set_xlim(0.0, 1.0)
    axes.set_title(f"{found.target}: {found.verdict}")
    return _named(axes, "probability that it is missing", "")


def circle(recordings: Recording | list[Recording], found: Fitted, *, magnified: float | None = None, axes: Any = None) -> Any:
    """The deviation from the fitted circle over the angle, magnified; the rings say it in um.

    Parameters
    ----------
    recordings : Recording or list of Recording
        Circles.
    found : Fitted
        What :func:`ballbar.fit_circle` says of them.
    magnified : float
        How many times; default such that the largest is 0.4 of the radius.
    axes : matplotlib.axes.Axes
        Polar ones.

    Returns
    -------
    matplotlib.axes.Axes
    """
    several = [recordings] if isinstance(recordings, Recording) else list(recordings)
    axes = axes or _new(subplot_kw={"projection": "polar"})
    each = []
    for one, at in zip(several, found.recordings):
        centre_mm = 1e-3 * (at.centre_a_um * np.cos(one.angle_rad) + at.centre_b_um * np.sin(one.angle_rad))
        each.append(1e3 * (one.length_mm - at.radius_mm - centre_mm))
    largest = max(float(np.abs(deviation).max()) for deviation in each) or 1.0
    radius_mm = found.recordings[0].radius_mm
    scale = magnified or 0.4 * 1e3 * radius_mm / largest
    for one, deviation in zip(several, each):
        axes.plot(one.angle_rad, radius_mm + 1e-3 * scale * deviation, label=f"{one.plane} {one.direction}")
    step_um = _step(largest)
    rings_um = step_um * np.arange(-np.ceil(largest / step_um), np.ceil(largest / step_um) + 1.0)
    axes.set_rticks(radius_mm + 1e-3 * scale * rings_um, [f"{ring:+g} µm" if ring else "0" for ring in rings_um])
    farthest_mm = 1e-3 * scale * float(rings_um[-1])
    axes.set_rlim(min(0.0, radius_mm - farthest_mm), radius_mm + farthest_mm)
    axes.set_title(f"deviation from the circle of {radius_mm:.3f} mm, a ring {step_um:g} µm")
    return _beside(axes)


def _step(largest: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that is not larger."""
    power = 10.0 ** np.floor(np.log10(largest))
    return float(max(power * factor for factor in (1.0, 2.0, 5.0) if power * factor <= largest))


def errors(found: RankedErrors, *, axes: Any = None) -> Any:
    """What mending each error would gain of the circularity, um, the largest first."""
    axes = axes or _new()
    rows = [row for row in found._json.get("errors", []) if row.get("circularity_gain_um")]
    rows = sorted(rows, key=lambda row: float(row["circularity_gain_um"]))[-12:]
    axes.barh([row["name"] for row in rows], [row["circularity_gain_um"] for row in rows])
    return _named(axes, "circularity that mending it gains, µm", "")


def drift(found: Drift, *, axes: Any = None) -> Any:
    """Each direction over time with one sigma, um."""
    axes = axes or _new()
    rows = found.points
    minutes = rows["time_s"] / 60.0
    for name in (key for key in rows[0] if key.endswith("_um") and not key.endswith("_sigma_um")):
        of_sigma = name.replace("_um", "_sigma_um")
        sigma = np.nan_to_num(rows[of_sigma]) if of_sigma in rows[0] else None
        axes.errorbar(minutes, rows[name], sigma, marker=".", label=name.removesuffix("_um"))
    return _named(axes, "time, min", "drift, µm")


def comparison(found: Comparison, axis: str | None = None, *, axes: Any = None) -> Any:
    """Both drifts along one axis, um; without a name along the first."""
    axes = axes or _new()
    axis = axis or next(iter(found.axes))
    rows = found.axes[axis].points
    for name in (key for key in rows[0] if key.endswith("_um") and "sigma" not in key):
        axes.plot(rows["time_s"] / 60.0, rows[name], marker=".", label=name.removesuffix("_um"))
    return _named(axes, "time, min", f"{axis}, µm")


def history(tests: pandas.DataFrame, error: str, *, axes: Any = None) -> Any:
    """One error over the tests, with one sigma, a line for each machine and plane.

    Parameters
    ----------
    tests : DataFrame
        Of :func:`ballbar.errors`.
    error : str
        A column such as ``backlash_a_pos_um``.
    axes : matplotlib.axes.Axes

    Returns
    -------
    matplotlib.axes.Axes
    """
    axes = axes or _new()
    rows = tests[tests["date"].notna() & tests[error].notna()].sort_values("date")
    for (machine, plane), each in rows.groupby([rows["machine"].fillna(""), "plane"]):
        dates = pandas.to_datetime(each["date"]).to_numpy()
        axes.errorbar(dates, each[error].to_numpy(), each[f"{error}_sigma"].to_numpy(), marker=".", label=f"{machine} {plane}".strip())
    return _named(axes, "date", error)


def _new(**how: Any) -> Any:
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("expected matplotlib to draw with, found none; on Debian it is in the package python3-matplotlib") from None
    return pyplot.subplots(layout="constrained", **how)[1]


def _named(axes: Any, x: str, y: str) -> Any:
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    return _beside(axes)


def _beside(axes: Any) -> Any:
    """With the legend beside what is drawn, which it hides nothing of."""
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper left", bbox_to_anchor=(1.08 if axes.name == "polar" else 1.01, 1.0), borderaxespad=0.0)
    return axes


def _sign(unit: str) -> str:
    return {"um": "µm", "degC": "°C", "": "units"}.get(unit, unit)


_DRAWN: list[tuple[type, Callable[..., Any]]] = [
    (Diagnosis, diagnosis), (Fit, fit), (Drift, drift), (Comparison, comparison), (RankedErrors, errors),
]
