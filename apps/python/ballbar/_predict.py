"""Models that predict and compensate, and the page of everything."""
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from ._kinds import Predicted, Report, Selected, Trained
from ._results import Result
from ._call import Model, Path, Progress, Call


def train(
    data: Any, target: str, out: Path, *, effects: bool = False, few: bool = False, progress: Progress | None = None, **how: Any
) -> Trained:
    """A model that predicts without naming causes: on the catalogue's effects, or on temperatures.

    Parameters
    ----------
    data : path, Series, DataFrame, dict of arrays
        `runs.csv`; with `effects` a session or one series too, as of :func:`check`.
    target : str
        A column in um.
    out : path
        The model, .json.
    effects : bool
        On the catalogue's effects, live; else on temperatures in degC.
    few : bool
        With `effects`: some ten of them.
    progress : callable
        As of :func:`diagnose`.
    **how
        The program's options: room, inputs, without, without_sensor, keep_broken, method, components, share, penalty,
        model, max_gap.

    Returns
    -------
    Trained
        What it leaves on tests left out, um.

    Raises
    ------
    BallbarError
        What can be put right in the data.
    TypeError
        A series without `effects`.

    Notes
    -----
    With `effects`: Rasmussen, Williams 2006, chapters 2 and 5. Batches are merged exactly: Chan, Golub, LeVeque 1983.

    Examples
    --------
    >>> import ballbar, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = ballbar.train("sample-runs/batches-tan2024/runs.csv", "y_um", folder + "/model.json")
    >>> round(found.held_out_um, 1)
    3.1
    """
    call = Call("train").series(data).options(target=target, out=out, effects=effects, few=few, **how)
    if call.held and not effects:
        raise TypeError("ballbar.train: expected the path of a runs.csv, or effects=True, found a series")
    return Trained(call.run(progress))


def select(runs: Path, on: Any, target: str, **how: Any) -> Selected:
    """Which of the recorded tests to train on for the job at hand.

    Parameters
    ----------
    runs : path
        `runs.csv`.
    on : path, Series, DataFrame, dict of arrays
        The job: its temperatures, (n,) degC each, over ``time_s``; with the target it is checked.
    target : str
        A column in um.
    **how
        The program's options: room, inputs, without, without_sensor, keep_broken, method, share, fall, random, seed,
        take, out, every.

    Returns
    -------
    Selected
        The tests in order of likeness, and the choices among them, um.

    Raises
    ------
    BallbarError
        What can be put right in the data.

    Examples
    --------
    >>> import ballbar
    >>> tests = "sample-runs/batches-tan2024"
    >>> len(ballbar.select(f"{tests}/runs.csv", f"{tests}/test1.csv", "y_um").ranked)
    24
    """
    return Selected(Call("train").files(runs).options(target=target, **how).other_data("for", on).run())


def predict(
    data: Any,
    model: Model | Path,
    *,
    on: Any = None,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    robust: bool = False,
    white: bool = False,
    set: Mapping[str, float] | None = None,  # noqa: A002
    out: Path | Sequence[Path] | None = None,
    state: Path | None = None,
    anyway: bool = False,
) -> Predicted:
    """The model's series, with what each effect adds.

    Parameters
    ----------
    data, model, target, max_gap_s, robust, white, set
        As of :func:`check`; or a model of :func:`train`.
    on : as data
        Other data to predict, by the parameters fitted to `data`.
    out : path or list of paths
        The series, .csv.
    state : path
        Of a model of :func:`train` with `effects`: goes on from this file, and keeps in it where the last row stood.
    anyway : bool
        Predicts though a sensor looks broken.

    Returns
    -------
    Predicted
        ``time_s`` and columns in um, (n,) each.

    Raises
    ------
    BallbarError
        What can be put right in data or model.

    Examples
    --------
    >>> import ballbar
    >>> he = "sample-runs/two-arcs-he2015"
    >>> found = ballbar.predict(he, f"{he}/model.toml")
    >>> found.y_model_um.shape == found.time_s.shape
    True
    """
    call = Call("predict").data(data)
    call.options(
        model=model, target=target, max_gap=max_gap_s, robust=robust, white=white, set=set, out=out, state=state,
        anyway=anyway,
    )
    return Predicted(call.other_data("on", on).run())


def compensate(model: Any, on: Any, *, to: str | Sequence[str] | None = None, fit: Any = None, out: Any = None, **limits: Any) -> Result:
    """What the error of a recorded run would have been with the model's offsets.

    Parameters
    ----------
    model : Model, path or list of them
        Of one axis or more.
    on : as data of :func:`check`
        The recorded run.
    to : str or list of str
        The axis of each target, in order; default the target's own name.
    fit : as data of :func:`check`
        What is free is fitted to it.
    out : path or list of paths
        .csv: before, after and offset in um; .toml, with `fit`: the fitted model.
    **limits
        The program's options: resolution_um, hysteresis, rate_um_per_s, step_um, largest_um, range_margin, spike_K,
        heating_K_per_s, stuck_s, gap_s, state.

    Returns
    -------
    Result
        `axes`: for each the error before and after, um.

    Raises
    ------
    BallbarError
        What can be put right in data or model.

    Examples
    --------
    >>> import ballbar
    >>> run = "sample-runs/spindle-rotation-huang2022"
    >>> list(ballbar.compensate(f"{run}/mean-point.toml", run, to="z").axes)
    ['z']
    """
    call = Call("compensate").options(model=model, to=to, out=out, **limits)
    return Result(call.other_data("fit", fit).other_data("on", on).run())


def report(
    data: Any,
    model: Model | Path | None = None,
    *,
    out: Path | None = None,
    target: str | Sequence[str] | None = None,
    compare: Any = None,
    diagnose: bool | None = None,
    picture: str | Sequence[str] | None = None,
    **how: Any,
) -> Report | None:
    """Everything to look at: with `out` a page or a picture, without it the data of the page.

    Parameters
    ----------
    data, model, target
        As of :func:`check`.
    out : path
        A page, .html, or a picture, .svg; the result is then None.
    compare : path, Series
        Another drift, or five probes, to compare with: as `b` of :func:`compare`.
    diagnose : bool
        Which effect is missing, without a model as well; False: not.
    picture : str or list of str
        Names of pictures, for .svg.
    **how
        The program's options: those of :func:`check` and of five probes, anyway, choose, width, without_files.

    Returns
    -------
    Report or None
        Its parts have the numbers of :func:`fit`, :func:`check` and :func:`diagnose`.

    Raises
    ------
    BallbarError
        What can be put right in data or model; no node to draw with.

    Examples
    --------
    >>> import ballbar
    >>> ballbar.report("sample-runs/qc20-style-b5r/00.b5r").format
    'ballbar-report 1'
    """
    call = Call("report", json=out is None).data(data)
    call.options(
        model=model, target=target, picture=picture, diagnose=diagnose is True, no_diagnosis=diagnose is False, **how
    ).other_data("compare", compare)
    if out is not None:
        call.options(out=out, format="svg" if os.fspath(out).endswith(".svg") else None)
    found = call.run()
    return Report(found) if out is None else None
