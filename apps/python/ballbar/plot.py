"""Pictures by matplotlib, where it is installed: each draws on the axes given, or on new ones, and returns them.

>>> import ballbar.plot
>>> axes = ballbar.plot.residual(ballbar.report("sample-runs/two-arcs-he2015", "sample-runs/two-arcs-he2015/model.toml"))
>>> axes.get_xlabel()
'time, min'
"""
from __future__ import annotations

from typing import Any

import numpy as np

from ._core import Recording
from ._kinds import Comparison, Drift, Errors, Fitted, Report

__all__ = ["circle", "comparison", "drift", "history", "residual"]


def circle(recordings: Recording | list[Recording], found: Fitted | None = None, *, magnified: float | None = None, axes: Any = None) -> Any:
    """The deviation from the fitted circle over the angle, magnified.

    Parameters
    ----------
    recordings : Recording or list of Recording
        Circles.
    found : Fitted
        What :func:`ballbar.fit` said of them; without it they are fitted.
    magnified : float
        How many times; default such that the largest is a fifth of the radius.
    axes : matplotlib.axes.Axes
        Polar ones.

    Returns
    -------
    matplotlib.axes.Axes
    """
    from . import fit

    several = [recordings] if isinstance(recordings, Recording) else list(recordings)
    circles = (found or fit(several)).recordings
    axes = axes or _new(subplot_kw={"projection": "polar"})
    each = []
    for one, at in zip(several, circles):
        centre_mm = 1e-3 * (at.centre_a_um * np.cos(one.angle_rad) + at.centre_b_um * np.sin(one.angle_rad))
        each.append(1e3 * (one.length_mm - at.radius_mm - centre_mm))
    largest = max(float(np.abs(deviation).max()) for deviation in each) or 1.0
    scale = magnified or 0.2 * 1e3 * circles[0].radius_mm / largest
    for one, deviation in zip(several, each):
        axes.plot(one.angle_rad, circles[0].radius_mm + 1e-3 * scale * deviation, label=f"{one.plane} {one.direction}")
    axes.set_title(f"deviation, {scale:.0f} times")
    axes.legend(loc="lower left")
    return axes


def drift(found: Drift, *, axes: Any = None) -> Any:
    """Each direction over time with one sigma, um.

    Parameters
    ----------
    found : Drift
        Of :func:`ballbar.drift`.
    axes : matplotlib.axes.Axes

    Returns
    -------
    matplotlib.axes.Axes
    """
    axes = axes or _new()
    rows = found.points
    minutes = rows["time_s"] / 60.0
    for name in (key for key in rows[0] if key.endswith("_um") and not key.endswith("_sigma_um")):
        sigma = rows[name.replace("_um", "_sigma_um")] if name.replace("_um", "_sigma_um") in rows[0] else None
        axes.errorbar(minutes, rows[name], None if sigma is None else np.nan_to_num(sigma), marker=".", label=name.removesuffix("_um"))
    return _named(axes, "time, min", "drift, µm")


def comparison(found: Comparison, axis: str, *, axes: Any = None) -> Any:
    """Both drifts along one axis, um.

    Parameters
    ----------
    found : Comparison
        Of :func:`ballbar.compare`.
    axis : str
        One of ``found.axes``.
    axes : matplotlib.axes.Axes

    Returns
    -------
    matplotlib.axes.Axes
    """
    axes = axes or _new()
    at = found.axes[axis]
    rows = at.points
    for name in (key for key in rows[0] if key.endswith("_um") and "sigma" not in key):
        axes.plot(rows["time_s"] / 60.0, rows[name], marker=".", label=name.removesuffix("_um"))
    return _named(axes, "time, min", f"{axis}, µm")


def residual(found: Report, *, target: int = 0, axes: Any = None) -> Any:
    """What was measured, the model and what it leaves, um.

    Parameters
    ----------
    found : Report
        Of :func:`ballbar.report` with a model.
    target : int
        Which of several targets, from 0.
    axes : matplotlib.axes.Axes

    Returns
    -------
    matplotlib.axes.Axes
    """
    axes = axes or _new()
    series = found.check.targets[target].series
    minutes = series["time_s"] / 60.0
    axes.plot(minutes, series["measured_um"], ".", label="measured")
    axes.plot(minutes, series["predicted_um"], "-", label="model")
    axes.plot(minutes, series["residual_um"], "-", linewidth=0.8, label="left")
    return _named(axes, "time, min", "µm")


def history(found: Errors, error: str, *, axes: Any = None) -> Any:
    """One error over the tests, with one sigma, machine by machine, in the error's unit.

    Parameters
    ----------
    found : Errors
        Of :func:`ballbar.errors`.
    error : str
        Its name.
    axes : matplotlib.axes.Axes

    Returns
    -------
    matplotlib.axes.Axes
    """
    axes = axes or _new()
    machines: dict[str, list[tuple[Any, float, float]]] = {}
    for test in found.tests:
        for one in test.errors:
            if one.name == error and test.date:
                machines.setdefault(test.machine or "", []).append((np.datetime64(test.date), one.value, one.sigma or 0.0))
    for machine, rows in sorted(machines.items()):
        dates, values, sigmas = zip(*sorted(rows))
        axes.errorbar(np.array(dates), np.array(values), np.array(sigmas), marker=".", label=machine or None)
    return _named(axes, "date", error)


def _new(**how: Any) -> Any:
    try:
        from matplotlib import pyplot
    except ImportError:
        raise ImportError("expected matplotlib to draw with, found none; on Debian it is in the package python3-matplotlib") from None
    return pyplot.subplots(**how)[1]


def _named(axes: Any, x: str, y: str) -> Any:
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    if axes.get_legend_handles_labels()[0]:
        axes.legend()
    return axes
