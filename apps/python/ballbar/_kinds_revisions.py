"""The results on effects that are tried, added or put into data, with their keys. A key that does not apply is not there."""
from __future__ import annotations

from ._results import Result, Rows


class Tried(Result):
    """Before and after an effect, :func:`ballbar.try_effect`.

    Attributes
    ----------
    target : str
    data : list[str]
    before : Result
        Parameters, rmse_um, times_floor, held_out_um.
    after : Result
    likelihood_ratio : float
    threshold : float
    best_surrogate_fall : float
    verdict : str
    effects : Rows
    earlier : Rows
    sentence : str
    """

    target: str
    data: list[str]
    before: Result
    after: Result
    likelihood_ratio: float
    threshold: float
    best_surrogate_fall: float
    verdict: str
    effects: Rows
    earlier: Rows
    sentence: str


class Added(Result):
    """A new revision, :func:`ballbar.add`.

    Attributes
    ----------
    rows : Rows
        Of the ledger.
    revisions : Rows
    written : str
        File.
    """

    rows: Rows
    revisions: Rows
    written: str


class Injected(Result):
    """An effect put into data, :func:`ballbar.inject`.

    Attributes
    ----------
    target : str
    effect : str
    columns : Result
    shapes : Result
    amplitude_um : float
    d : float
    detectable_um : float
    identifiable_um : float
    without : Result
    with : Result
    answer : str
    smallest : Result
    """

    target: str
    effect: str
    columns: Result
    shapes: Result
    amplitude_um: float
    d: float
    detectable_um: float
    identifiable_um: float
    without: Result
    answer: str
    smallest: Result
