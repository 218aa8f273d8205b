"""Ballbar logs of machine tools: circles, errors of the axes, thermal drift of the spindle, models of it and what they lack.

Everything that the program ``ballbar`` does, as functions on files and on arrays. Results have the keys of the
program's ``--json`` as attributes, with the same numbers to the last bit. What can be put right comes as
:class:`BallbarError`, with file, line and column. Remarks go to the logger ``ballbar``.

Units stand at the end of every name: ``_um``, ``_mm``, ``_deg``, ``_s``, ``_degC``, ``_rpm``.
"""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Callable, Mapping, Union

from . import _core
from ._catalogue import effect
from ._core import Recording, Series, read_recordings, read_series
from ._errors import BallbarError, UsageError
from ._kinds import (
    Added,
    Checked,
    Comparison,
    Diagnosis,
    Drift,
    Effects,
    Errors,
    Fitted,
    History,
    Imported,
    Injected,
    Plan,
    Predicted,
    Preflight,
    Report,
    Selected,
    Simulated,
    Trained,
    Tried,
)
from ._results import Result, Rows
from ._words import Model, Words

__version__: str = _core.version
__all__ = [
    "Added", "BallbarError", "Checked", "Comparison", "Diagnosis", "Drift", "Effects", "Errors", "Fitted", "History",
    "Imported", "Injected", "Model", "Plan", "Predicted", "Preflight", "Recording", "Report", "Result", "Rows",
    "Selected", "Series", "Simulated", "Trained", "Tried", "UsageError", "add", "check", "compare", "compensate",
    "diagnose", "drift", "effect", "effects", "errors", "fit", "history", "import_log", "inject", "ledger", "merge",
    "plan", "predict", "preflight", "read_recordings", "read_series", "report", "select", "simulate", "train",
    "try_effect", "undo",
]

Path = Union[str, "os.PathLike[str]"]
Progress = Callable[[str], object]


def fit(data: Any, *, polar: bool = False, robust: bool = False, out: Path | None = None) -> Fitted:
    """The circle, or the length, of each recording.

    Parameters
    ----------
    data : path, list of paths, Recording or list of Recording
        Files are `.b5r` or ballbar logs. Two recordings that differ in direction alone are a pair of ISO 230-4.
    polar : bool
        The circle through the polar points, as instrument software has it.
    robust : bool
        Discounts outlying readings (Tukey's biweight).
    out : path
        Written as well, .json.

    Raises
    ------
    BallbarError
        A file that is none of these, or a reading that cannot be.

    Examples
    --------
    >>> import ballbar, numpy as np
    >>> angle_deg = np.arange(0.0, 360.0)
    >>> length_mm = 100.0 + 0.005 * np.cos(np.radians(angle_deg))
    >>> found = ballbar.fit(ballbar.Recording(length_mm, angle_deg))
    >>> round(found.recordings[0].centre_a_um, 3)
    5.0
    """
    recordings = [data] if isinstance(data, Recording) else data
    words = Words("fit", "--json").data(data).options(polar=polar, robust=robust, out=out)
    if out is None and isinstance(recordings, list) and all(type(one) is Recording for one in recordings):
        return Fitted(_core.fit(recordings, polar, robust), words)  # without a command line: it takes longer than a fit
    return Fitted(words.run(), words)


def errors(files: Any, *, strict: bool = False, out: Path | Sequence[Path] | None = None) -> Errors:
    """The errors of each ballbar test, all of a test fitted together: one row a test.

    Parameters
    ----------
    files : path or list of paths
        `.b5r` files, ballbar logs, folders of them.
    strict : bool
        A file that cannot be read ends it; otherwise it stands in ``skipped``.
    out : path
        Written as well: .csv, one row a test, or .json.

    Examples
    --------
    >>> import ballbar
    >>> found = ballbar.errors("sample-runs/qc20-style-b5r/00.b5r")
    >>> [(one.name, round(one.value, 1)) for one in found.tests[0].errors if one.name == "scale_mismatch"]
    [('scale_mismatch', 8.0)]
    """
    return Errors(Words("errors", "--json").data(files).options(strict=strict, out=out).run())


def drift(
    session: Any,
    *,
    reference_s: float | None = None,
    sequential: bool = False,
    equal_radii: bool = False,
    eq34: bool = False,
    polar: bool = False,
    robust: bool = False,
    five_probe: bool = False,
    from_plane_1_mm: float | None = None,
    from_nose_mm: float | None = None,
    plane_1_mm: float | None = None,
    spacing_mm: float | None = None,
    resolution_um: float | None = None,
    linearity_percent: float | None = None,
    probe: Mapping[str, str] | None = None,
    out: Path | Sequence[Path] | None = None,
) -> Drift:
    """The drift of the spindle over a session, or of five probes: one row a test.

    Parameters
    ----------
    session : path, Series
        A `session.toml`, a folder of it or of `.b5r` files; or the series of five probes.
    reference_s : float
        Drift is taken to the test at this time; default the first.
    from_plane_1_mm, from_nose_mm, plane_1_mm, spacing_mm, resolution_um, linearity_percent, probe
        Of five probes, where the file does not state them.
    out : path
        Written as well: .csv, .json or .mat.
    """
    words = Words("drift", "--json").data(session)
    words.options(
        reference=reference_s, sequential=sequential, equal_radii=equal_radii, eq34=eq34, polar=polar, robust=robust,
        five_probe=five_probe, out=out, **_five_probes(from_plane_1_mm, from_nose_mm, plane_1_mm, spacing_mm,
                                                       resolution_um, linearity_percent, probe),
    )
    return Drift(words.run())


def compare(
    a: Any,
    b: Any = None,
    *,
    reference_s: float | None = None,
    max_gap_s: float | None = None,
    match: Mapping[str, str] | None = None,
    from_plane_1_mm: float | None = None,
    from_nose_mm: float | None = None,
    plane_1_mm: float | None = None,
    spacing_mm: float | None = None,
    resolution_um: float | None = None,
    linearity_percent: float | None = None,
    probe: Mapping[str, str] | None = None,
    out: Path | Sequence[Path] | None = None,
    plot: Path | None = None,
) -> Comparison:
    """How well two drifts agree, and whether within their uncertainty.

    Parameters
    ----------
    a, b : path, Series
        Sessions, drifts or five probes; without `b` the session's own five probes.
    match : dict
        Axis of `a` and the axis of `b` that it stands for, such as ``{"axial": "-z"}``.
    """
    words = Words("compare", "--json").data(a, *([] if b is None else [b]))
    words.options(
        reference=reference_s, max_gap=max_gap_s, match=match, out=out, plot=plot,
        **_five_probes(from_plane_1_mm, from_nose_mm, plane_1_mm, spacing_mm, resolution_um, linearity_percent, probe),
    )
    return Comparison(words.run())


def history(
    folders: Any,
    *,
    tolerance: Mapping[str, float] | None = None,
    strict: bool = False,
    out: Path | Sequence[Path] | None = None,
) -> History:
    """A machine over its tests: what changed, trends, when a tolerance is met; squareness and scales.

    Parameters
    ----------
    folders : path or list of paths
    tolerance : dict
        Limit of a quantity, to both sides of 0: ``{"backlash_a_pos": 5.0}``.
    """
    return History(Words("history", "--json").data(folders).options(tolerance=tolerance, strict=strict, out=out).run())


def import_log(log: Path, *, out: Path | None = None, save: Path | None = None, **how: Any) -> Imported:
    """What a logger's file is taken for, column by column; `read_series` gives the series.

    `how` are the program's options: recipe, sheet, delimiter, decimal, dates, time, time_unit, every, missing, unit,
    role, name, leave_out; those of the form COLUMN=WORD are dicts.
    """
    return Imported(Words("import", "--json").data(log).options(out=out, save=save, **how).run())


def merge(
    logs: Sequence[Any],
    *,
    out: Path | None = None,
    keep_clocks: bool = False,
    lag_range_s: float | None = None,
    max_gap_s: float | None = None,
    **how: Any,
) -> Imported:
    """Several logs, each with its own clock, as one series; `how` as of `import_log`."""
    words = Words("merge", "--json").data(*logs)
    words.options(out=out, keep_clocks=keep_clocks, lag_range=lag_range_s, max_gap=max_gap_s, **how)
    return Imported(words.run())


def effects(name: str | None = None) -> Effects:
    """The catalogue of physical effects, or the page of one, those of :func:`effect` among them."""
    found = Words("effects", *([] if name is None else [name]), "--json").run()
    return Effects(found[0] if name is not None and len(found) == 1 else {"effects": found})


def preflight(
    data: Any,
    *,
    model: Model | Path | None = None,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
) -> Preflight:
    """Which effects these data could show, and from which size, before any residual is looked at."""
    words = Words("preflight", "--json").data(data)
    return Preflight(words.options(model=model, target=target, max_gap=max_gap_s, also_input=also_input).run())


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
        A DataFrame or dict has ``time_s`` (or ``time_min``) and columns whose names end in their unit.
    model : Model or path
        Without it a constant (of recordings a circle each).
    target : str or list of str
        Column to explain instead of the model's own.
    white : bool
        Ordinary least squares: no memory in the noise.
    set : dict
        Parameters held: ``{"lagged_expansion(T9_degC).time_constant_s": 3600.0}``.

    Examples
    --------
    >>> import ballbar
    >>> found = ballbar.check("sample-runs/two-arcs-he2015", "sample-runs/two-arcs-he2015/model.toml")
    >>> round(found.rmse_um, 3)
    0.201
    """
    words = Words("check", "--json").data(data)
    words.options(
        model=model, target=target, max_gap=max_gap_s, also_input=also_input, robust=robust, white=white, set=set
    )
    return Checked(words.run(), words)


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
    prior: str | None = None,
    strict: bool = False,
    progress: Progress | None = None,
) -> Diagnosis:
    """Which physical effect a model lacks: one verdict, the candidates, what could not be told.

    Of recordings of two linear axes: all errors of the machine together, ranked.

    Parameters
    ----------
    data, model, target, max_gap_s, also_input
        As of :func:`check`.
    tolerance_um : float
        Smaller effects are called minor; of circles the largest circularity that passes.
    progress : callable
        Is told how far it is, a line of text.
    """
    words = Words("diagnose", "--json").data(data)
    words.options(
        model=model, target=target, max_gap=max_gap_s, also_input=also_input, tolerance=tolerance_um, seed=seed,
        most_rows=most_rows, prior=prior, strict=strict,
    )
    return Diagnosis(words.run(progress), words)


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
    """The run of the machine that would decide what is left open, and how surely."""
    words = Words("plan", "--json").data(data)
    words.options(
        model=model, target=target, max_gap=max_gap_s, also_input=also_input, hours=hours, max_rpm=max_rpm, can=can,
        out=out, ballbar=ballbar_mm, every=every_min, seed=seed,
    )
    return Plan(words.run(progress))


def try_effect(
    effects: str | Sequence[str],  # noqa: A002
    data: Any,
    model: Model | Path | None = None,
    *,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
) -> Tried:
    """Before and after an effect is added, and whether the data support it; nothing is saved.

    `effects`: ``"lagged_expansion(T16_degC)"`` or ``"lagged_expansion:temperature=T16_degC"``, or several.
    """
    words = Words("try", *_list(effects), "--json").data(data)
    return Tried(words.options(model=model, target=target, max_gap=max_gap_s, also_input=also_input).run())


def add(
    effects: str | Sequence[str],  # noqa: A002
    data: Any,
    model: Model | Path,
    *,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
    out: Path | None = None,
    auto: bool = False,
    named_only: bool = False,
    prune: bool = False,
) -> Added:
    """A new revision of a model with more effects, in the model's own file or in `out`; earlier effects tested anew.

    `auto` adds what :func:`diagnose` names, then what predicts; `effects` is then empty.
    """
    words = Words("add", *_list(effects), "--json").data(data)
    words.options(
        model=model, target=target, max_gap=max_gap_s, also_input=also_input, out=out, auto=auto, named_only=named_only,
        prune=prune,
    )
    return Added(words.run())


def undo(model: Model | Path) -> Result:
    """The revision of a model before its last one, in its file."""
    return Result(Words("undo", "--json").options(model=model).run())


def ledger(model: Model | Path) -> Result:
    """What a model went through: every revision, its error and likelihood ratio."""
    found = Words("ledger", "--json").options(model=model).run()
    return Result(found if isinstance(found, dict) else {"revisions": found})


def inject(
    effect: str,  # noqa: A002
    data: Any,
    amplitude_um: float,
    *,
    model: Model | Path | None = None,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
    set: Mapping[str, float] | None = None,  # noqa: A002
    seed: int | None = None,
    out: Path | None = None,
) -> Injected:
    """Whether that effect could have been seen in these data, and from which size."""
    words = Words("inject", effect, "--json").data(data)
    words.options(
        amplitude_um=amplitude_um, model=model, target=target, max_gap=max_gap_s, also_input=also_input, set=set,
        seed=seed, out=out,
    )
    return Injected(words.run())


def train(data: Any, target: str, out: Path, *, effects: bool = False, few: bool = False, **how: Any) -> Trained:
    """A model that predicts without naming causes, written to `out`: on the catalogue's effects, or on temperatures.

    `data`: `runs.csv`, or with `effects` one series or session too. `how` are the program's options: room, inputs,
    without, without_sensor, keep_broken, method, components, share, penalty, model, max_gap.
    """
    words = Words("train", "--json").data(data).options(target=target, out=out, effects=effects, few=few, **how)
    return Trained(words.run())


def select(runs: Path, on: Any, target: str, **how: Any) -> Selected:
    """Which of the recorded tests to train on for the job at hand; `how`: the program's options."""
    return Selected(Words("select", "--json").data(runs).options(on=on, target=target, **how).run())


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
    """The model's series, with what each effect adds; with `on` of other data, by the parameters fitted to `data`."""
    words = Words("predict", "--json").data(data)
    words.options(
        model=model, on=on, target=target, max_gap=max_gap_s, robust=robust, white=white, set=set, out=out,
        state=state, anyway=anyway,
    )
    return Predicted(words.run())


def compensate(model: Any, on: Any, *, to: str | Sequence[str] | None = None, fit: Any = None, out: Any = None, **limits: Any) -> Result:
    """What the error of a recorded run would have been with the model's offsets; `limits`: the program's options."""
    words = Words("compensate", "--json").options(model=model, to=to, fit=fit, on=on, out=out, **limits)
    return Result(words.run())


def simulate(machine: Path, out: Path, *, truth: Path | None = None, seed: int | None = None, b5r: bool = False, force: bool = False) -> Simulated:
    """The recordings, signals and five probes of a virtual machine whose true drift is known, in the folder `out`."""
    words = Words("simulate", "--json").data(machine).options(out=out, truth=truth, seed=seed, b5r=b5r, force=force)
    return Simulated(words.run())


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
    """Everything to look at: with `out` a page (.html) or a picture (.svg), without it the data of the page."""
    words = Words("report").data(data)
    words.options(
        model=model, target=target, compare=compare, picture=picture, diagnose=diagnose is True,
        no_diagnosis=diagnose is False, **how,
    )
    if out is None:
        words.words.append("--json")
    else:
        words.options(out=out, format="svg" if os.fspath(out).endswith(".svg") else None)
    found = words.run()
    return None if out is not None else Report(found)


def _list(words: str | Sequence[str]) -> list[str]:
    return [words] if isinstance(words, str) else list(words)


def _five_probes(
    from_plane_1: float | None,
    from_nose: float | None,
    plane_1: float | None,
    spacing: float | None,
    resolution: float | None,
    linearity: float | None,
    probe: Mapping[str, str] | None,
) -> dict[str, Any]:
    return {
        "from_plane_1": from_plane_1,
        "from_nose": from_nose,
        "plane_1": plane_1,
        "spacing": spacing,
        "resolution": resolution,
        "linearity": linearity,
        "probe": probe,
    }
