"""The results on models and effects, with their keys. A key that does not apply is not there."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._results import Result, Rows

Array = NDArray[np.float64]


class Effects(Result):
    """The catalogue, :func:`ballbar.effects`.

    Attributes
    ----------
    effects : Rows
        Of the whole catalogue.
    name : str
    level : str
        Series or recording.
    summary : str
    cause : str
    formula : str
    signature : str
    confused_with : list[str]
    becomes : str
    separated_by : str
    remedy : str
    validity : str
    source : str
    time_only : bool
    inputs : Rows
    parameters : Rows
    """

    effects: Rows
    name: str
    level: str
    summary: str
    cause: str
    formula: str
    signature: str
    confused_with: list[str]
    becomes: str
    separated_by: str
    remedy: str
    validity: str
    source: str
    time_only: bool
    inputs: Rows
    parameters: Rows


class Preflight(Result):
    """What data could show, :func:`ballbar.preflight`.

    Attributes
    ----------
    target : str
    n : int
        Rows.
    noise_source : str
    effects : Rows
        Effect, testability, columns, bindings, surviving_share, detectable_um, identifiable_um, inseparable_from.
    targets : Rows
        Of several targets, each as this.
    """

    target: str
    n: int
    noise_source: str
    effects: Rows
    targets: Rows


class Checked(Result):
    """A model fitted, :func:`ballbar.check`.

    Attributes
    ----------
    target : str
    rmse_um : float
        That the model leaves.
    floor_um : float
        That no model could explain.
    floor_source : str
    n : int
        Values.
    n_effective : float
        Independent ones that they are worth.
    adequate : bool
        Whether the model leaves noise alone.
    where : Rows
        Where it fails: what, from, to, n, bias_um, bias_sigma_um, rmse_um, share.
    parameters : Rows
        Effect, name, value, sigma, unit, state.
    correlation : Array
        Of the parameters.
    noise : Result
        White_um, correlated_um, correlation_time_s.
    whiteness : Result
    sentences : list[str]
    converged : bool
    remarks : list[str]
    targets : Rows
        Of several targets, each as this.
    """

    target: str
    rmse_um: float
    floor_um: float
    floor_source: str
    n: int
    n_effective: float
    adequate: bool
    where: Rows
    parameters: Rows
    correlation: Array
    noise: Result
    whiteness: Result
    sentences: list[str]
    converged: bool
    remarks: list[str]
    targets: Rows

    def _picture(self) -> str:
        return f"model-{self.target}-fit" if "target" in self else ""


class Diagnosis(Checked):
    """Which effect a model lacks, :func:`ballbar.diagnose`. Of recordings of two linear axes: the errors of the
    machine.

    Attributes
    ----------
    verdict : str
        Named, equivalent, driver, unexplained, nothing.
    sentence : str
    command : str
        To type next.
    named : Rows
        Effect, columns.
    probable : Rows
    equivalent : list[Any]
        Sets of effects that the data do not tell apart.
    drivers : Rows
        Columns that drive what is missing.
    own : Rows
        Values that the model holds.
    effects : Rows
        Effect, columns, p.
    p_nothing : float
    p_discrepancy : float
    discrepancy_um : float
    candidates : Rows
    stand_ins : Rows
        Effect, by, command.
    hidden_um : float
    untestable : Rows
        Effect, why.
    not_searched : list[Any]
    reasons : list[str]
    gains_by_run : list[Any]
    next_test : Result or None
        Text, command.
    files : list[str]
        Of recordings, as all below.
    plane : str
    nominal_length_mm : float
    recordings : Rows
    file : Result
        What the `.b5r` states.
    conclusion : str
        A sentence.
    errors : Rows
        Name, value, sigma, unit, as_instrument, significant, circularity_gain_um, circularity_gain_sigma_um, rank,
        individual_circularity_um, share_percent, remedy, ....
    one_by_one : Rows
        Effect, rms_um.
    circle_rms_um : float
    circularity_um : float
    circularity_without_all_um : float
        That remains once all significant errors are mended.
    differences : list[str]
        Where ours and the instrument's values differ, and why.
    residual_rms_um : float
    repeatability_um : float
    left : Result or None
        A wave that no error explains.
    left_text : str
    undetermined : list[str]
    prior : Rows
    tolerances : list[str]
    skipped : Rows
    groups : Rows
        Of several planes or bars, each as this.
    results_alone : Rows
    """

    verdict: str
    sentence: str
    command: str
    named: Rows
    probable: Rows
    equivalent: list[Any]
    drivers: Rows
    own: Rows
    effects: Rows
    p_nothing: float
    p_discrepancy: float
    discrepancy_um: float
    candidates: Rows
    stand_ins: Rows
    hidden_um: float
    untestable: Rows
    not_searched: list[Any]
    reasons: list[str]
    gains_by_run: list[Any]
    next_test: Result | None
    files: list[str]
    plane: str
    nominal_length_mm: float
    recordings: Rows
    file: Result
    conclusion: str
    errors: Rows
    one_by_one: Rows
    circle_rms_um: float
    circularity_um: float
    circularity_without_all_um: float
    differences: list[str]
    residual_rms_um: float
    repeatability_um: float
    left: Result | None
    left_text: str
    undetermined: list[str]
    prior: Rows
    tolerances: list[str]
    skipped: Rows
    groups: Rows
    results_alone: Rows

    def _picture(self) -> str:
        return "with-without" if "target" in self else "machine-errors" if "errors" in self else ""


class Plan(Result):
    """The run that would decide, :func:`ballbar.plan`.

    Attributes
    ----------
    target : str
    sentence : str
    verdict : str
    decided : bool
        Whether the data at hand decide.
    tests : Rows
        The runs that were weighed.
    schedule : Result or None
        Of the best one; None where it is decided.
    inseparable : list[Any]
        Sets of effects that no run tells apart.
    sensors : Rows
        That are lacking.
    curves : Rows
    """

    target: str
    sentence: str
    verdict: str
    decided: bool
    tests: Rows
    schedule: Result | None
    inseparable: list[Any]
    sensors: Rows
    curves: Rows
