"""Models of drift: what data could show, where a model fails, what it lacks, and the run that decides."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ._kinds import Checked, Diagnosis, Effects, Plan, Preflight
from ._call import Model, Path, Progress, Call


def effects(name: str | None = None) -> Effects:
    """The catalogue of physical effects, or the page of one, those of :func:`effect` among them.

    Parameters
    ----------
    name : str
        Of one; without it all.

    Returns
    -------
    Effects
        Cause, formula, remedy and source of one; `effects` of all.

    Raises
    ------
    BallbarError
        A name that there is not.

    Examples
    --------
    >>> import ballbar
    >>> ballbar.effects("backlash_a").summary
    'Play of axis A: a step where A reverses, at 0 and 180 deg.'
    """
    found = Call("effects", *([] if name is None else [name])).run()
    return Effects(found[0] if name is not None and len(found) == 1 else {"effects": found})


def preflight(
    data: Any,
    *,
    model: Model | Path | None = None,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
) -> Preflight:
    """Which effects these data could show, and from which size, before any residual is looked at.

    Parameters
    ----------
    data, model, target, max_gap_s, also_input
        As of :func:`check`.

    Returns
    -------
    Preflight
        A row an effect: from how many um it is seen, and told from others.

    Raises
    ------
    BallbarError
        What can be put right in data or model.

    Examples
    --------
    >>> import ballbar
    >>> ballbar.preflight("sample-runs/two-arcs-he2015", target="y_um").n
    14
    """
    call = Call("could").data(data)
    return Preflight(call.options(model=model, target=target, max_gap=max_gap_s, also_input=also_input).run())


def check(
    data: Any,
    model: Model | Path | None = None,
    *,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
    robust: bool = False,
    white: bool = False,
    set: Mapping[str, float] | None = None,  # noqa: A002
) -> Checked:
    """A model fitted, and where it fails.

    Parameters
    ----------
    data : path, list of paths, Series, DataFrame, dict of arrays, recordings
        A DataFrame or dict has ``time_s`` (or ``time_min``), (n,), and columns, (n,) each, whose names end in their unit.
    model : Model or path
        Without it a constant (of recordings a circle each).
    target : str or list of str
        Column to explain instead of the model's own.
    max_gap_s : float
        Longest gap of a signal to interpolate over, s; default 600.
    also_input : str or list of str
        Another target, which effects may read.
    robust : bool
        Discounts outlying values (Tukey's biweight).
    white : bool
        Ordinary least squares: no memory in the noise.
    set : dict
        Parameters held, in their units: ``{"lagged_expansion(T9_degC).time_constant_s": 3600.0}``.

    Returns
    -------
    Checked
        What is left in um, the floor, where it fails, the parameters with sigmas.

    Raises
    ------
    BallbarError
        What can be put right in data or model, with file, line and column.
    TypeError
        Data of another kind.

    Notes
    -----
    Noise: A. C. Harvey, Forecasting, Structural Time Series Models and the Kalman Filter (1989), chapter 3; D. A.
    Harville, J. Am. Stat. Assoc. 72 (1977). Whiteness: J. Durbin, Biometrika 56 (1969) 1.

    Examples
    --------
    >>> import ballbar
    >>> found = ballbar.check("sample-runs/two-arcs-he2015", "sample-runs/two-arcs-he2015/model.toml")
    >>> round(found.rmse_um, 3)
    0.201
    """
    call = Call("check").data(data)
    call.options(
        model=model, target=target, max_gap=max_gap_s, also_input=also_input, robust=robust, white=white, set=set
    )
    return Checked(call.run(), call)


def diagnose(
    data: Any,
    model: Model | Path | None = None,
    *,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
    tolerance_um: float | None = None,
    seed: int | None = None,
    most_rows: int | None = None,
    progress: Progress | None = None,
) -> Diagnosis:
    """Which physical effect a model lacks: one verdict, the candidates, what could not be told.

    Of circles that two linear axes drive :func:`errors` ranks the errors.

    Parameters
    ----------
    data, model, target, max_gap_s, also_input
        As of :func:`check`.
    tolerance_um : float
        Smaller effects are called minor, um.
    seed : int
        Of the random draws; the same seed gives the same result.
    most_rows : int
        Values of the target that are searched; of longer series every k-th.
    progress : callable
        Is told how far it is, a line of text; what it raises ends the work.

    Returns
    -------
    Diagnosis
        The verdict and the sentence that says it; sizes in um.

    Raises
    ------
    BallbarError
        What can be put right in data or model, with file, line and column.

    Examples
    --------
    >>> import ballbar
    >>> run = "sample-runs/hidden-effect/01"
    >>> found = ballbar.diagnose(f"{run}/data.csv", f"{run}/model.toml")
    >>> found.verdict, found.named["effect"]
    ('named', ['lagged_expansion'])
    """
    call = Call("diagnose").data(data)
    call.options(
        model=model, target=target, max_gap=max_gap_s, also_input=also_input, tolerance=tolerance_um, seed=seed,
        most_rows=most_rows,
    )
    return Diagnosis(call.run(progress), call)


def plan(
    data: Any,
    model: Model | Path | None = None,
    *,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
    hours: float | None = None,
    max_rpm: float | None = None,
    can: str | Sequence[str] | None = None,
    out: Path | None = None,
    ballbar_mm: float | None = None,
    every_min: float | None = None,
    seed: int | None = None,
    progress: Progress | None = None,
) -> Plan:
    """The run of the machine that would decide what is left open, and how surely.

    Parameters
    ----------
    data, model, target, max_gap_s, also_input
        As of :func:`check`.
    hours : float
        The longest run that can be made, h; default 12.
    max_rpm : float
        Highest speed, rpm; default that of the data.
    can : str or list of str
        What can be moved beside the speed: load, room, coolant.
    out : path
        A new folder: schedule, programs of the machine, check list, picture.
    ballbar_mm : float
        Drives a ballbar test between the speeds, with a bar of this length, mm.
    every_min : float
        Between the ballbar tests, min; default 60.
    seed, progress
        As of :func:`diagnose`.

    Returns
    -------
    Plan
        The schedule, and what it would decide.

    Raises
    ------
    BallbarError
        What can be put right in data or model.

    Examples
    --------
    >>> import ballbar
    >>> run = "sample-runs/hidden-effect/01"
    >>> ballbar.plan(f"{run}/data.csv", f"{run}/model.toml", hours=8).sentence
    'The data at hand decide: no further test is needed.'
    """
    call = Call("plan").data(data)
    call.options(
        model=model, target=target, max_gap=max_gap_s, also_input=also_input, hours=hours, max_rpm=max_rpm, can=can,
        out=out, ballbar=ballbar_mm, every=every_min, seed=seed,
    )
    return Plan(call.run(progress))
