"""Effects tried, added to a model and taken back; effects put into data."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ._kinds import Added, Injected, Tried
from ._results import Result
from ._call import Model, Path, Call


def try_effect(
    effects: str | Sequence[str],
    data: Any,
    model: Model | Path | None = None,
    *,
    target: str | Sequence[str] | None = None,
    max_gap_s: float | None = None,
    also_input: str | Sequence[str] | None = None,
) -> Tried:
    """Before and after an effect is added, and whether the data support it; nothing is saved.

    Parameters
    ----------
    effects : str or list of str
        ``"lagged_expansion(T16_degC)"`` or ``"lagged_expansion:temperature=T16_degC"``, or several.
    data, model, target, max_gap_s, also_input
        As of :func:`check`.

    Returns
    -------
    Tried
        What is left before and after, um, and the verdict.

    Raises
    ------
    BallbarError
        An effect or a column that there is not, and what :func:`check` raises.

    Examples
    --------
    >>> import ballbar
    >>> he = "sample-runs/two-arcs-he2015"
    >>> ballbar.try_effect("expansion(T_room_degC)", he, f"{he}/model.toml").verdict
    'not supported'
    """
    call = Call("add", *_list(effects)).data(data)
    return Tried(call.options(dry_run=True, model=model, target=target, max_gap=max_gap_s, also_input=also_input).run())


def add(
    effects: str | Sequence[str],
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
    replace: str | Sequence[str] | None = None,
) -> Added:
    """A new revision of a model with more effects; earlier effects are tested anew.

    Parameters
    ----------
    effects : str or list of str
        As of :func:`try_effect`; with `auto` none.
    data, model, target, max_gap_s, also_input
        As of :func:`check`; the model's own file is written. A :class:`Model` without a file stays as it is: the new
        one is ``Model(added.text)``.
    out : path
        Written instead of it.
    auto : bool
        Adds what :func:`diagnose` names, then what predicts.
    named_only : bool
        With `auto`: no more than is named.
    prune : bool
        Takes effects out that are no longer needed.
    replace : str or list of str
        Effects of the model that are taken out for those that are added.

    Returns
    -------
    Added
        The rows of the ledger.

    Raises
    ------
    BallbarError
        As :func:`try_effect`, and a file that cannot be written.

    Examples
    --------
    >>> import ballbar, tempfile
    >>> he = "sample-runs/two-arcs-he2015"
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     added = ballbar.add("thermostat_cycle", he, f"{he}/model.toml", out=f"{folder}/model.toml")
    ...     len(ballbar.ledger(f"{folder}/model.toml").rows)
    2
    """
    call = Call("add", *_list(effects)).data(data)
    call.options(
        model=model, target=target, max_gap=max_gap_s, also_input=also_input, out=out, auto=auto, named_only=named_only,
        prune=prune, replace=replace,
    )
    return Added(call.run())


def undo(model: Model | Path) -> Result:
    """The revision of a model before its last one, in its file.

    Parameters
    ----------
    model : Model or path
        With a ledger; its file is changed. Of one without a file, the result's `text` is the model before.

    Returns
    -------
    Result
        The revision that it has now.

    Raises
    ------
    BallbarError
        A model without an earlier revision.

    Examples
    --------
    >>> import ballbar
    >>> ballbar.undo(ballbar.Model.of("z_um"))  # doctest: +IGNORE_EXCEPTION_DETAIL
    Traceback (most recent call last):
    ballbar.BallbarError: ...
    """
    return Result(Call("undo").options(model=model).run())


def ledger(model: Model | Path) -> Result:
    """What a model went through: every revision, its error in um and likelihood ratio.

    Parameters
    ----------
    model : Model or path
        With a ledger, as :func:`add` writes it.

    Returns
    -------
    Result
        `rows`, one a revision.

    Raises
    ------
    BallbarError
        A model without one.

    Examples
    --------
    See :func:`add`.
    """
    found = Call("ledger").options(model=model).run()
    return Result(found if isinstance(found, dict) else {"revisions": found})


def inject(
    effect: str,
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
    """Whether that effect could have been seen in these data, and from which size.

    Parameters
    ----------
    effect : str
        As of :func:`try_effect`.
    data, model, target, max_gap_s, also_input
        As of :func:`check`.
    amplitude_um : float
        Its largest less its smallest value, um.
    set : dict
        Its shapes, in their units: ``{"time_constant_s": 1800.0}``.
    seed : int
        Of the random draws.
    out : path
        The data with the effect added, .csv.

    Returns
    -------
    Injected
        The answer, and the smallest that is seen, um.

    Raises
    ------
    BallbarError
        As :func:`try_effect`.

    Examples
    --------
    >>> import ballbar
    >>> he = "sample-runs/two-arcs-he2015"
    >>> found = ballbar.inject("expansion(T_room_degC)", he, 2.0, model=f"{he}/model.toml")
    >>> round(found.detectable_um, 1)
    1.2
    """
    call = Call("could", effect).data(data)
    call.options(
        amplitude_um=amplitude_um, model=model, target=target, max_gap=max_gap_s, also_input=also_input, set=set,
        seed=seed, out=out,
    )
    return Injected(call.run())


def _list(effects: str | Sequence[str]) -> list[str]:
    return [effects] if isinstance(effects, str) else list(effects)
