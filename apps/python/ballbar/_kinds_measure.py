"""The results of what measures, imports and simulates, with their keys. A key that does not apply is not there."""
from __future__ import annotations

from ._results import Result, Rows


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
