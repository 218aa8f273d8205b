"""The results, with their keys. Written by tests/apps/result_keys from their lists of fields.

A key that does not apply is not there. A number that is not known is None, in an array NaN.
"""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._results import Result, Rows

Array = NDArray[np.float64]


class Fitted(Result):
    """The circles of recordings, :func:`ballbar.fit`.

    Attributes
    ----------
    recordings : Rows
        A row a recording: file, index, kind, readings, nominal_length_mm, length_mm, sigma_length_um, plane,
        direction, arc_deg, model, centre_a_um, centre_b_um, radius_mm, circularity_um, feed_mm_per_min, rms_um,
        sigma_centre_a_um, sigma_centre_b_um, sigma_radius_um, sigma_circularity_um, correlation_a_b,
        correlation_a_radius, correlation_b_radius, sigma_reading_um, autocorrelation, effective_readings,
        max_circular_um, max_at_deg, min_circular_um, min_at_deg, converged, discounted, stored.
    results_alone : Rows
        Files that store results without readings: file, stored.
    iso230_4 : Result
        Of the only pair of CCW and CW: the numbers of ISO 230-4: RESULT, stored, remarks.
    iso230_4_pairs : Rows
        Of several pairs, each with its file: file, RESULT, stored, remarks.
    """

    recordings: Rows
    results_alone: Rows
    iso230_4: Result
    iso230_4_pairs: Rows


class Errors(Result):
    """The errors of many ballbar tests, :func:`ballbar.errors`.

    Attributes
    ----------
    tests : Rows
        A row a test: file, machine, bar, date, plane, nominal_length_mm, feed_mm_per_min, start_deg, arc_deg, stored,
        errors.
    remarks : list[str]
        Of the readers.
    skipped : Rows
        Files that could not be read: file, sentence, copy_of.
    """

    tests: Rows
    remarks: list[str]
    skipped: Rows


class RankedErrors(Result):
    """The errors of a machine, :func:`ballbar.errors`.

    Attributes
    ----------
    files : list[str]
        Of recordings.
    plane : str
        XY, YZ, ZX.
    nominal_length_mm : float
    recordings : Rows
        Direction, arc_deg, feed_mm_per_min, readings.
    file : Result
        What the only file states: test, machine, operator, comment, ballbar, serial_number, last_calibrated,
        calibrator_serial_number, software, software_version, started_s, programmed_feed_mm_per_min.
    conclusion : str
        What it says in plain words.
    verdict : str
        Named, unexplained, nothing.
    named : Rows
        Errors that the test shows: effect, columns.
    errors : Rows
        By what mending them gains, then those of the circle: name, value, sigma, unit, as_instrument, significant,
        predicts_other_run, individual_circularity_um, share_percent, rank, stored, stored_is_same, stored_rank,
        circularity_without_um, circularity_gain_um, circularity_gain_sigma_um, effect,
        stored_individual_circularity_um, p_value, shape, remedy, in_the_model.
    one_by_one : Rows
        The significant ones, each time that which leaves least: effect, rms_um.
    circle_rms_um : float
        That the circles alone leave.
    circularity_um : float
        Largest less smallest reading about the fitted centre.
    circularity_without_all_um : float
        That remains once all significant errors are mended.
    differences : list[str]
        Where ours and the instrument's values differ, and why.
    residual_rms_um : float
        That all errors leave.
    repeatability_um : float
        What of it is not the same in both directions; null: one direction.
    noise : Result
        Of the readings: white_um, correlated_um, correlation_time_s.
    left : Result | None
        A wave that no error explains; null: none: harmonic, recording, peak_to_peak_um, p_value, in_both_directions.
    left_text : str
        What the errors do not explain.
    undetermined : list[str]
        What the readings do not tell apart.
    prior : Rows
        Name, value, sigma, unit, readings_alone, readings_alone_sigma.
    tolerances : list[str]
        Pass or fail, a line each.
    skipped : Rows
        Files that could not be read: file, why.
    remarks : list[str]
        Of the readers.
    groups : Rows
        Of several planes or bars, each as the errors of one: files, plane, nominal_length_mm, recordings, file,
        conclusion, verdict, named, errors, one_by_one, circle_rms_um, circularity_um, circularity_without_all_um,
        differences, residual_rms_um, repeatability_um, noise, left, left_text, undetermined, prior, tolerances.
    results_alone : Rows
        Files that store results without readings: file, stored.
    """

    files: list[str]
    plane: str
    nominal_length_mm: float
    recordings: Rows
    file: Result
    conclusion: str
    verdict: str
    named: Rows
    errors: Rows
    one_by_one: Rows
    circle_rms_um: float
    circularity_um: float
    circularity_without_all_um: float
    differences: list[str]
    residual_rms_um: float
    repeatability_um: float
    noise: Result
    left: Result | None
    left_text: str
    undetermined: list[str]
    prior: Rows
    tolerances: list[str]
    skipped: Rows
    remarks: list[str]
    groups: Rows
    results_alone: Rows


class Drift(Result):
    """The drift of the spindle, :func:`ballbar.drift`.

    Attributes
    ----------
    method : str
        Spindle_rotation, two_arcs, circles; of five probes five_probe.
    reference_s : float
        Time of the test that drift is taken to.
    points : Rows
        A row a test: time_s, x_um, y_um, z_um, radial_um, axial_um, shift_a_um, shift_b_um, radius_change_um,
        radius_change_a_um, x_sigma_um, y_sigma_um, z_sigma_um, radial_sigma_um, axial_sigma_um, shift_a_sigma_um,
        shift_b_sigma_um, radius_change_sigma_um, radius_change_a_sigma_um, elongation_correction_um, correlation_y_z.
    positions : Rows
        The same before the reference is taken off: time_s, x_um, x_sigma_um, y_um, y_sigma_um, z_um, z_sigma_um,
        centre_a_um, centre_a_sigma_um, centre_b_um, centre_b_sigma_um, length_mm, radius_mm, converged, discounted.
    not_cancelled : str
        What of the set-up remains.
    skipped : Rows
        Files that could not be read: file, why.
    ranges : Result
        By axis: first_60_min_UNIT, first_60_min_sigma_UNIT, after_60_min_UNIT, after_60_min_sigma_UNIT, total_UNIT,
        total_sigma_UNIT, first_to_last_UNIT, first_to_last_sigma_UNIT.
    steps : Rows
        Changes of the speed: from_s, to_s, speed_rpm, ranges.
    remarks : list[str]
    """

    method: str
    reference_s: float
    points: Rows
    positions: Rows
    not_cancelled: str
    skipped: Rows
    ranges: Result
    steps: Rows
    remarks: list[str]


class Comparison(Result):
    """How two drifts agree, :func:`ballbar.compare`.

    Attributes
    ----------
    conclusion : str
        What it says in plain words.
    a : str
        Name of the first.
    b : str
        Name of the second.
    reference_s : float
        Time that both are taken to.
    samples : int
        Common times.
    left_out : int
        Times of one alone.
    axes : Result
        By name: rmse, bias, correlation, chi^2 and the series of the difference: agreement, mean_relative_deviation,
        expected_relative_deviation, explained_share, range_normalised_mean_deviation, rmse_UNIT, max_UNIT, max_at_s,
        bias_UNIT, loa_low_UNIT, loa_high_UNIT, within_2_sigma, samples, correlation, lag_s, lag_sigma_s, deviation,
        structure, budget, points.
    remarks : list[str]
    """

    conclusion: str
    a: str
    b: str
    reference_s: float
    samples: int
    left_out: int
    axes: Result
    remarks: list[str]


class History(Result):
    """Machines over their tests, :func:`ballbar.history`.

    Attributes
    ----------
    machines : Rows
        What needs something first: machine, tests, first, last, need, reason, findings, tolerances, series, groups.
    bar_changes : Rows
        From, to, machines, step_um_per_m, sigma_um_per_m.
    judged : int
        Questions.
    found : int
        Of these answered with yes.
    false_discovery_rate : float
        Share of those by chance.
    without_date : list[str]
        Files of tests that are in nothing.
    geometry : Result
        Squareness and scales, of one machine: within_a_day, out_of_square_um_per_m, scales_um_per_m, agreement.
    remarks : list[str]
        Of the readers.
    skipped : Rows
        Files that could not be read: file, sentence, copy_of.
    """

    machines: Rows
    bar_changes: Rows
    judged: int
    found: int
    false_discovery_rate: float
    without_date: list[str]
    geometry: Result
    remarks: list[str]
    skipped: Rows


class Imported(Result):
    """What a log was taken for, :func:`ballbar.import_log`.

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
        How many.
    first_row_line : int
    columns : Rows | int
        Of the log, that of the time left out: source, found_unit, left_out, name, unit, role, why, gaps.
    remarks : list[str]
        What looks broken, what was mended.
    faults : Rows
        Of columns: column, what.
    parts : Rows
        The logs: file, moved_s, by_date_s, lag_s, lag_sigma_s, correlation, compared.
    """

    file: str
    shape: str
    time: str
    started: str
    rows: int
    first_row_line: int
    columns: Rows | int
    remarks: list[str]
    faults: Rows
    parts: Rows


class Simulated(Result):
    """What was simulated, :func:`ballbar.simulate`.

    Attributes
    ----------
    method : str
        Of the session; series: of a series.
    rows : int
        Of a series.
    tests : int
        Of a session.
    seed : int
        Of the noise.
    folder : str
        That was written.
    files : list[str] | int
        In it.
    truth : str
        File of the truth, beside the folder.
    machines : int
        How many.
    months : int
        How many.
    """

    method: str
    rows: int
    tests: int
    seed: int
    folder: str
    files: list[str] | int
    truth: str
    machines: int
    months: int


class Effects(Result):
    """The catalogue, or an effect of it, :func:`ballbar.effects`.

    Attributes
    ----------
    effects : Rows
        Of the whole catalogue: name, level, summary, cause, formula, signature, confused_with, becomes, separated_by,
        remedy, validity, source, time_only, inputs, parameters.
    name : str
    level : str
        Series, recording.
    summary : str
        In a line.
    cause : str
    formula : str
        In the letters of the parameters.
    signature : str
        How it looks in a residual.
    confused_with : list[str]
        Other effects.
    becomes : str
        Another one at the edge of its shapes; empty: none.
    separated_by : str
        The test that tells them apart.
    remedy : str
        In the workshop.
    validity : str
    source : str
    time_only : bool
        Whether it needs nothing but time.
    inputs : Rows
        That it reads: role, units, meaning.
    parameters : Rows
        Name, unit, kind, start, lower, upper, held, meaning.
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
    """What data could show, before any residual, :func:`ballbar.preflight`.

    Attributes
    ----------
    target : str
        Column that is explained.
    n : int
        Readings.
    noise_source : str
        Where the noise is from.
    effects : Rows
        Of the catalogue: effect, testability, columns, bindings, surviving_share, detectable_um, identifiable_um,
        inseparable_from, why.
    targets : Rows
        Of several targets, each as of one: target, n, noise_source, effects.
    """

    target: str
    n: int
    noise_source: str
    effects: Rows
    targets: Rows


class Checked(Result):
    """A model fitted, and where it fails, :func:`ballbar.check`.

    Attributes
    ----------
    target : str
        Column that is explained.
    rmse_um : float
        That the model leaves.
    floor_um : float | None
        That no model could explain; null: not known.
    floor_source : str
        What tells the floor.
    n : int
        Readings.
    n_effective : float
        Independent readings that they are worth.
    adequate : bool
        Whether the model leaves noise alone.
    where : Rows
        Where it fails: what, from, to, n, bias_um, bias_sigma_um, rmse_um, share.
    parameters : Rows
        Effect, name, value, sigma, unit, state.
    correlation : Array
        Of the parameters, row by row.
    noise : Result
        Of the residual: white_um, correlated_um, correlation_time_s.
    whiteness : Result
        Autocorrelation, periodogram_distance, p.
    sentences : list[str]
        How far from the floor, where worst, what is left.
    converged : bool
        Whether the fit came to an end.
    remarks : list[str]
    targets : Rows
        Of several targets, each as of one: target, rmse_um, floor_um, floor_source, n, n_effective, adequate, where,
        parameters, correlation, noise, whiteness, sentences, converged, remarks.
    """

    target: str
    rmse_um: float
    floor_um: float | None
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


class Diagnosis(Checked):
    """Which effect a model lacks, :func:`ballbar.diagnose`.

    Attributes
    ----------
    verdict : str
        Named, probable, driver, equivalent, unexplained, untestable, nothing.
    sentence : str
        What it says in plain words.
    command : str
        To type next; empty: none.
    named : Rows
        That are missing: effect, columns.
    probable : Rows
        That are probably missing: effect, columns.
    equivalent : list[Any]
        Sets, of each of which one may be missing, the likeliest first: effect, columns.
    drivers : Rows
        From p = 0.5 on: column, p.
    own : Rows
        Values that the model holds and that may be others, from p = 0.05 on: effect, parameter, unit, held, fitted,
        low, high, p.
    effects : Rows
        From p = 0.01 on: effect, columns, p.
    p_nothing : float
        Probability that nothing is missing.
    p_discrepancy : float
        Probability of a slow curve without a cause.
    discrepancy_um : float
        Its standard deviation.
    candidates : Rows
        The likeliest set, then others by probability: effect, columns, p, likelihood_ratio, amplitude_um,
        amplitude_sigma_um, rmse_after_um, held_out_before_um, held_out_after_um, p_same_gain, beats_surrogates,
        in_best_set, minor, doubts, inseparable_from, parameters.
    stand_ins : Rows
        Effects added earlier that others explain better: effect, by, command.
    hidden_um : float
        Amplitude up to which an effect could hide in these data.
    untestable : Rows
        Effects that these data cannot show: effect, why.
    not_searched : Rows
        Effects with more choices of columns than were searched: effect, choices_of_columns, searched.
    reasons : list[str]
        Why it is not named, or not all of it.
    gains_by_run : Rows
        Of several runs: gains that differ: effect, parameter, unit, p, runs.
    next_test : Result | None
        That would decide; null: nothing is open: text, separation, command.
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
    not_searched: Rows
    reasons: list[str]
    gains_by_run: Rows
    next_test: Result | None


class Plan(Result):
    """The run of the machine that would decide what is missing, :func:`ballbar.plan`.

    Attributes
    ----------
    sentence : str
        What it says in plain words.
    verdict : str
        Of the data at hand.
    decided : bool
        Whether they decide it.
    tests : Rows
        Runs that were weighed, the best first: test, hours, p_right, p_right_sigma, p_part, p_wrong, truths.
    schedule : Result | None
        Of the best one; null: none is proposed: reading_s, dwells.
    inseparable : list[Any]
        Sets of effects that no run tells apart.
    sensors : Rows
        That are lacking: place, p_right.
    curves : Rows
        What may be missing, the most probable first: effects, p.
    """

    sentence: str
    verdict: str
    decided: bool
    tests: Rows
    schedule: Result | None
    inseparable: list[Any]
    sensors: Rows
    curves: Rows


class Trained(Result):
    """A regression on temperatures over batches, :func:`ballbar.train`.

    Attributes
    ----------
    target : str
        Column that is predicted.
    batches : int
        How many.
    held_out_um : float
        RMSE on what was left out.
    half_width_um : float
        Of the interval of 95 %.
    methods : Rows
        That were compared: method, components, penalty_K2, held_out_um, worst_um, worst_batch, rmse_um, taken.
    effects : Result
        With --model: a model of effects in the same contest: model, held_out_um, worst_um, worst_batch, rmse_um.
    remarks : list[str]
    rows : int
        Trained on.
    runs : int
    dictionary : list[str]
        Kinds of effects.
    terms : int
        How many.
    prior_variance : float
        Of the gains.
    length_s : float
        Memory of what no column drives; 0: none.
    sigma_um : float
        Standard deviation of that.
    interval_scale : float
        By which the interval is widened.
    rmse_um : float
        On the rows that it was trained on.
    forecasts : Result | None
        Null: too few rows: count, error_um, rmse_um, held_um, within_share, predicted.
    drivers : Rows
        Columns, and the um that each moves: column, role, share_um, low_um, high_um, stable, flips.
    range_um : float
        Of what is predicted.
    not_needed : list[str]
        Columns without which nothing changes.
    interchangeable : list[Any]
        Sets of columns, of which any will do.
    cancelling : Rows
        Pairs of columns: columns, range_um, sum_um.
    sentence : str
        What it says in plain words.
    """

    target: str
    batches: int
    held_out_um: float
    half_width_um: float
    methods: Rows
    effects: Result
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
    forecasts: Result | None
    drivers: Rows
    range_um: float
    not_needed: list[str]
    interchangeable: list[Any]
    cancelling: Rows
    sentence: str


class Selected(Result):
    """Batches to train on for a job, :func:`ballbar.select`.

    Attributes
    ----------
    target : str
        Column that is predicted.
    room_degC : float
        As the job begins.
    taken : str
        The choice that is written.
    ranked : Rows
        Batches by the temperature of their rooms: batch, room_apart_K, distance, weight, components,
        modelling_rmse_um, predicted_rmse_um.
    choices : Rows
        With what came of each: choice, batches, method, components, penalty_K2, predicted_rmse_um.
    held_out : Rows
        By number of batches: batches, rmse_um.
    random : Result | None
        Choices to compare with; null: none: batches, share_worse, predicted_rmse_um.
    remarks : list[str]
    """

    target: str
    room_degC: float
    taken: str
    ranked: Rows
    choices: Rows
    held_out: Rows
    random: Result | None
    remarks: list[str]


class Predicted(Result):
    """A model's series, :func:`ballbar.predict`.

    Attributes
    ----------
    time_s : Array
        Of each row.
    COLUMN : Array
        TARGET_model_um, the target, TARGET_residual_um, and what each effect adds.
    goes_on : bool
        By effects: from the end of training, or an earlier prediction.
    holds_training : bool
        By effects: whether it begins with the training rows.
    drivers : Rows
        By effects: the largest share first: column, role, share_um.
    error : Result | None
        Null: the target is not measured: rows, mean_um, rmse_um, within_share.
    broken : list[str]
        By temperatures: sensors that look so.
    warnings : list[str]
    """

    time_s: Array
    goes_on: bool
    holds_training: bool
    drivers: Rows
    error: Result | None
    broken: list[str]
    warnings: list[str]


class Report(Result):
    """The data of a page, :func:`ballbar.report`.

    Attributes
    ----------
    format : str
        Ballbar-report 1.
    title : str
    made_by : str
        Ballbar 0.1.0.
    made_on : str
        Date.
    files : list[str]
        That it is made of.
    summary : list[str]
        The conclusions, whole sentences, first to be read.
    signals : Rows
        Temperatures, speed and the like, each file on its own clock: source, time_s, columns.
    fit : Result
        Of recordings: recordings, results, remarks, pairs, stored_alone, iso230_4, iso230_4_pairs.
    machine_errors : Rows
        One a test: files, plane, nominal_length_mm, recordings, file, conclusion, verdict, named, errors, one_by_one,
        circle_rms_um, circularity_um, circularity_without_all_um, differences, residual_rms_um, repeatability_um,
        noise, left, left_text, undetermined, prior, tolerances, circle_um, curves.
    skipped : Rows
        Files that cannot be read, by their names: file, why.
    drift : Result
        Of a session: method, reference_s, points, positions, not_cancelled.
    five_probe : Result
        What, reference_s, time_s, axes, remarks.
    compare : Result
        Of two drifts: conclusion, a, b, reference_s, samples, left_out, axes, remarks.
    check : Result
        How it fits: targets.
    diagnose : Result
        What it lacks: targets.
    ledger : Result
        Of the model: rows.
    batch : Result
        With a model of train: target, method, batches, time_s, predicted_um, half_width_um, measured_um,
        T2_of_largest, Q_of_largest, broken, warnings.
    """

    format: str
    title: str
    made_by: str
    made_on: str
    files: list[str]
    summary: list[str]
    signals: Rows
    fit: Result
    machine_errors: Rows
    skipped: Rows
    drift: Result
    five_probe: Result
    compare: Result
    check: Result
    diagnose: Result
    ledger: Result
    batch: Result


class Tried(Result):
    """A model before and after effects are added, :func:`ballbar.try_effect`.

    Attributes
    ----------
    target : str
        Column that is explained.
    data : list[str]
        Files, as they were named.
    before : Result
        How well the model does without them: parameters, rmse_um, times_floor, held_out_um.
    after : Result
        How well it does with them: parameters, rmse_um, times_floor, held_out_um.
    likelihood_ratio : float
        2 ln B of the change, of errors of axes chi^2.
    threshold : float
        From which that counts.
    best_surrogate_fall : float
        Share by which the best of 200 surrogates lowers the RMSE.
    verdict : str
        Supported, time only, not supported.
    effects : Rows
        That were added: effect, columns, amplitude_um, amplitude_sigma_um, likelihood_ratio, threshold,
        best_surrogate_fall, p_same_gain, time_only, doubts, parameters.
    earlier : Rows
        Effects of the model, tested anew: effect, likelihood_ratio, parameters, p_drop, needed.
    sentence : str
        What it says in plain words.
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
    """New revisions of a model, :func:`ballbar.add`.

    Attributes
    ----------
    rows : Rows
        Of the ledger: revision, change, parameters, rmse_um, times_floor, held_out_um, verdict, target, data,
        likelihood_ratio, threshold, best_surrogate_fall, forecast_um, surrogate_forecast_um, discrepancy_um,
        still_needed, no_longer_needed, sentence.
    revisions : Rows
        Before and after each: target, data, before, after, likelihood_ratio, threshold, best_surrogate_fall, verdict,
        effects, earlier, sentence.
    growth : Rows
        Of a model that grew by effects that predict: effects, added, kept, rmse_um, surrogate_um, forecast_um,
        forecast_mean_um, surrogate_forecast_um, discrepancy_um, p_none.
    sentence : str
        What that growth says.
    stopped : Result
        With --auto: why nothing more was added: verdict, text.
    written : str | None
        File; null: nothing was added, or no file is named.
    text : str
        Of the new model, where it has no file.
    """

    rows: Rows
    revisions: Rows
    growth: Rows
    sentence: str
    stopped: Result
    written: str | None
    text: str


class Injected(Result):
    """An effect put into data, and whether it is seen, :func:`ballbar.inject`.

    Attributes
    ----------
    target : str
        Column that it is added to.
    effect : str
        As `ballbar effects` lists it.
    columns : Result
        By role.
    shapes : Result
        Of the effect.
    amplitude_um : float
        Largest less smallest of what was added.
    d : float
        Of that, beside the noise of the model's residual.
    detectable_um : float
        Amplitude of d = 5.
    identifiable_um : float
        Amplitude of d = 7.5.
    without : Result
        As measured: verdict, seen.
    with : Result
        With it: verdict, seen.
    answer : str
        What it says in plain words.
    smallest : Result
        Amplitude that is seen: not_seen_um, seen_um, diagnoses.
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
