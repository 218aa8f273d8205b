"""The results of each command, with their keys. A key that does not apply is not there."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._results import Result, Rows

Array = NDArray[np.float64]


class Fitted(Result):
    """What :func:`ballbar.fit` found.

    Attributes
    ----------
    recordings : Rows
        A row a recording: file, kind, plane, direction, centre_a_um, centre_b_um, radius_mm, their sigmas,
        circularity_um, rms_um.
    iso230_4 : Result
        Of the only CCW/CW pair: the numbers of ISO 230-4.
    iso230_4_pairs : Rows
        Of several pairs, each with its file.
    results_alone : Rows
        Files that store results without readings.
    """

    def _picture(self) -> str:
        return "recording-circle"

    recordings: Rows
    iso230_4: Result
    iso230_4_pairs: Rows
    results_alone: Rows


class Errors(Result):
    """The errors of many ballbar tests, :func:`ballbar.errors`.

    Attributes
    ----------
    tests : Rows
        A row a test: file, machine, bar, date, plane, nominal_length_mm, feed_mm_per_min, start_deg, arc_deg, stored,
        errors (name, value, sigma, unit, significant, of_set_up).
    skipped : Rows
        Files that could not be read: file, sentence.
    remarks : list[str]
        Of the readers.
    """

    tests: Rows
    skipped: Rows
    remarks: list[str]


class Drift(Result):
    """The drift of the spindle, :func:`ballbar.drift`.

    Attributes
    ----------
    method : str
        Spindle_rotation, two_arcs, circles or five_probe.
    reference_s : float
        Time of the test that drift is taken to.
    points : Rows
        A row a test: time_s, then um or urad with sigma: x_um, x_sigma_um, ....
    positions : Rows
        The same before the reference is taken off.
    not_cancelled : str
        What of the set-up remains.
    ranges : Result
        Of five probes: the largest less the smallest of each.
    steps : Rows
        Of five probes: changes of the speed.
    remarks : list[str]
    """

    _part = "drift"
    method: str
    reference_s: float
    points: Rows
    positions: Rows
    not_cancelled: str
    ranges: Result
    steps: Rows
    remarks: list[str]


class Comparison(Result):
    """How two drifts agree, :func:`ballbar.compare`.

    Attributes
    ----------
    conclusion : str
        A sentence.
    a : str
        Name of the first.
    b : str
        Name of the second.
    reference_s : float
    samples : int
        Common times.
    left_out : int
        Times of one alone.
    axes : Result
        For each axis: rms, bias, correlation, chi^2 and the series of the difference.
    remarks : list[str]
    """

    _part = "compare"
    conclusion: str
    a: str
    b: str
    reference_s: float
    samples: int
    left_out: int
    axes: Result
    remarks: list[str]


class History(Result):
    """A machine over its tests, :func:`ballbar.history`.

    Attributes
    ----------
    machines : Rows
        Machine, groups of tests with their quantities, geometry.
    without_date : list[str]
        Files.
    remarks : list[str]
    skipped : Rows
        File, sentence.
    """

    machines: Rows
    without_date: list[str]
    remarks: list[str]
    skipped: Rows


class Imported(Result):
    """What logs were taken for, :func:`ballbar.import_log` and :func:`ballbar.merge`.

    Attributes
    ----------
    file : str
    shape : str
        How the values stand.
    time : str
        Where the time is.
    started : str
        Wall clock of time 0.
    rows : int
    first_row_line : int
    columns : Rows
        Source, found_unit, name, unit, role, why, gaps; of a merge their number.
    parts : Rows
        Of a merge: file, moved_s.
    remarks : list[str]
    faults : Rows
        Column, what.
    """

    file: str
    shape: str
    time: str
    started: str
    rows: int
    first_row_line: int
    columns: Rows
    parts: Rows
    remarks: list[str]
    faults: Rows


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
    smallest_um : float
    untestable : Rows
        Effect, why.
    not_searched : list[Any]
    reasons : list[str]
    gains_by_run : list[Any]
    next_test : Result
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
        Name, value, sigma, unit, significant, individual_circularity_um, share_percent, rank, remedy, ....
    one_by_one : Rows
        Effect, rms_um.
    circle_rms_um : float
    circularity_um : float
    residual_rms_um : float
    repeatability_um : float
    left : Result
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
    smallest_um: float
    untestable: Rows
    not_searched: list[Any]
    reasons: list[str]
    gains_by_run: list[Any]
    next_test: Result
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
    residual_rms_um: float
    repeatability_um: float
    left: Result
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
    schedule : Result
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
    schedule: Result
    inseparable: list[Any]
    sensors: Rows
    curves: Rows


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


class Trained(Result):
    """A model that predicts, :func:`ballbar.train`.

    Attributes
    ----------
    target : str
    batches : int
    held_out_um : float
        RMSE on what was left out.
    half_width_um : float
        Of 95 %.
    methods : Rows
    remarks : list[str]
    rows, runs : int
        Of a regression on effects, as all below.
    dictionary : list[str]
        Kinds of effects.
    terms : int
    prior_variance, length_s, sigma_um, interval_scale : float
        Of the Gaussian process.
    rmse_um : float
        On the rows that it was trained on.
    forecasts : Result
        count, error_um, rmse_um, held_um, within_share, predicted.
    drivers : Rows
        Columns, and the um that each moves.
    range_um : float
        Of what is predicted.
    not_needed : list[str]
        Columns.
    interchangeable : list[Any]
        Sets of columns.
    cancelling : Rows
        Pairs of columns.
    sentence : str
    """

    target: str
    batches: int
    held_out_um: float
    half_width_um: float
    methods: Rows
    remarks: list[str]
    rows: int
    runs: int
    dictionary: list[str]
    terms: int
    prior_variance: float
    length_s: float
    sigma_um: float
    interval_scale: float
    rmse_um: float
    forecasts: Result
    drivers: Rows
    range_um: float
    not_needed: list[str]
    interchangeable: list[Any]
    cancelling: Rows
    sentence: str


class Selected(Result):
    """Tests to train on, :func:`ballbar.select`.

    Attributes
    ----------
    target : str
    room_degC : float
    taken : str
    ranked : Rows
    choices : Rows
    held_out : Rows
    random : Result
    remarks : list[str]
    """

    target: str
    room_degC: float
    taken: str
    ranked: Rows
    choices: Rows
    held_out: Rows
    random: Result
    remarks: list[str]


class Predicted(Result):
    """A model's series, :func:`ballbar.predict`: time_s, TARGET_model_um, TARGET_residual_um and what each effect
    adds.

    Attributes
    ----------
    time_s : Array
        N.
    """

    time_s: Array


class Simulated(Result):
    """What was simulated, :func:`ballbar.simulate`.

    Attributes
    ----------
    method : str
    tests : int
    seed : int
    folder : str
    files : list[str]
    truth : str
    """

    method: str
    tests: int
    seed: int
    folder: str
    files: list[str]
    truth: str


class Report(Result):
    """The data of a page, :func:`ballbar.report`.

    Attributes
    ----------
    format : str
    title : str
    made_by : str
    made_on : str
    files : list[str]
    summary : list[str]
        Sentences.
    signals : Rows
    fit, check, diagnose, drift, five_probe, compare, ledger, batch : Result
    machine_errors : Rows
    """

    format: str
    title: str
    made_by: str
    made_on: str
    files: list[str]
    summary: list[str]
    signals: Rows
    fit: Result
    check: Result
    diagnose: Result
    drift: Result
    compare: Result
    five_probe: Result
    ledger: Result
    batch: Result
    machine_errors: Rows
