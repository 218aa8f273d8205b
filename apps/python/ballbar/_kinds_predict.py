"""The results of what predicts, and of a page, with their keys. A key that does not apply is not there."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._results import Result, Rows

Array = NDArray[np.float64]


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
