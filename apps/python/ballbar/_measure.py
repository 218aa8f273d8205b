"""Circles, errors of the axes, drift: what is measured."""
from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from . import _core
from ._core import Recording
from ._kinds import Comparison, Drift, Errors, Fitted, History, RankedErrors
from ._call import Call, Model, Path, Progress


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

    Returns
    -------
    Fitted
        Centres in um, radii in mm, with sigmas; ISO 230-4 of pairs in um.

    Raises
    ------
    BallbarError
        A file that is none of these, or a reading that cannot be.

    Notes
    -----
    The length equation is solved in all readings at once; the numbers of a pair are those of ISO 230-4.

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
    call = Call("fit").data(data).options(polar=polar, robust=robust, out=out)
    flags = all(isinstance(value, bool) for value in call.set.values())
    if flags and isinstance(recordings, list) and all(type(one) is Recording for one in recordings):
        return Fitted(_core.fit(recordings, bool(polar), bool(robust)), call)  # setting up a command takes longer
    return Fitted(call.run(), call)


def errors(
    files: Any,
    *,
    ranked: bool = False,
    tolerance_um: float | None = None,
    prior: str | None = None,
    model: Model | Path | None = None,
    strict: bool = False,
    out: Path | Sequence[Path] | None = None,
    progress: Progress | None = None,
) -> Errors | RankedErrors:
    """The errors of the axes in ballbar tests: one row a test, or ranked by what mending each gains.

    Parameters
    ----------
    files : path or list of paths
        `.b5r` files, ballbar logs, folders of them; with ``ranked`` recordings too.
    ranked : bool
        All tests of a plane and a bar fitted as one, the errors by what mending each gains.
    tolerance_um : float
        Of ``ranked``: the largest circularity that passes, um.
    prior : str
        Of ``ranked``: what holds errors that the readings hardly tell, usual or none.
    model : Model, path
        Of ``ranked``: a model of recordings, whose effects are marked.
    strict : bool
        A file that cannot be read ends it; otherwise it stands in ``skipped``.
    out : path or list of paths
        Written as well: .csv, one row a test, or .json.
    progress : callable
        Is told how far it is, a line of text; what it raises ends the work.

    Returns
    -------
    Errors or RankedErrors
        Values and sigmas in the unit that stands with each.

    Raises
    ------
    BallbarError
        Where there is no test that can be read.

    Notes
    -----
    The model is worked out from simulated curves that instrument software stores in `.b5r` files. Sandwich covariance:
    H. White, Econometrica 48 (1980).

    Examples
    --------
    >>> import ballbar
    >>> found = ballbar.errors("sample-runs/qc20-style-b5r/00.b5r")
    >>> [(one.name, round(one.value, 1)) for one in found.tests[0].errors if one.name == "scale_mismatch"]
    [('scale_mismatch', 8.0)]
    """
    if not ranked:
        if not (tolerance_um is None and prior is None and model is None):
            raise TypeError("ballbar.errors: expected ranked=True with tolerance_um, prior and model")
        return Errors(Call("errors").files(files).options(show="table", strict=strict, out=out).run(progress))
    call = Call("errors").data(files).options(show="ranked", tolerance=tolerance_um, prior=prior, model=model, strict=strict, out=out)
    return RankedErrors(call.run(progress), call)


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
        A `session.toml`, a folder of it or of `.b5r` files; or the series of five probes, (n,) um each.
    reference_s : float
        Drift is taken to the test at this time, s; default the first.
    sequential : bool
        Method two_arcs: path 1, then path 2 with its y, as the paper.
    equal_radii : bool
        Method two_arcs: one radius for both arcs.
    eq34 : bool
        Method spindle_rotation: the elongation's correction r / cos(dL / r) - r.
    polar, robust : bool
        As of :func:`fit`.
    five_probe : bool
        Of a session its five probes.
    from_plane_1_mm, from_nose_mm : float
        Where the drift is wanted: distance from plane 1 towards plane 2, or from the spindle's nose, mm.
    plane_1_mm, spacing_mm : float
        Distance of plane 1 from the nose, and of both planes, mm, where the file does not state them.
    resolution_um, linearity_percent : float
        Of a probe: step in um, limit of its error in percent of the reading.
    probe : dict
        Columns of the probes: ``{"X1": "ch1_um"}``.
    out : path or list of paths
        Written as well: .csv, .json or .mat.

    Returns
    -------
    Drift
        um and urad with sigmas, a row a test.

    Raises
    ------
    BallbarError
        A test that lacks a recording of its method, or one that cannot be fitted.

    Notes
    -----
    two_arcs: He, Fu, Chen 2015. spindle_rotation: Huang, Li, Zhao 2022, doi 10.19650/j.cnki.cjsi.J2209226. Five probes:
    layout of ISO 230-3.

    Examples
    --------
    >>> import ballbar
    >>> last = ballbar.drift("sample-runs/two-arcs-he2015").points[-1]
    >>> f"{last.y_um:.2f} +- {last.y_sigma_um:.2f} um"
    '8.38 +- 0.02 um'
    """
    call = Call("drift").series(session)
    call.options(
        reference=reference_s, sequential=sequential, equal_radii=equal_radii, eq34=eq34, polar=polar, robust=robust,
        five_probe=five_probe, from_plane_1=from_plane_1_mm, from_nose=from_nose_mm, plane_1=plane_1_mm,
        spacing=spacing_mm, resolution=resolution_um, linearity=linearity_percent, probe=probe, out=out,
    )
    return Drift(call.run())


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
        Sessions, drifts or five probes, (n,) um each; without `b` the session's own five probes.
    reference_s : float
        Time since which changes are taken, s; default the first.
    max_gap_s : float
        No interpolation between rows farther apart, s; default 4 times the usual step.
    match : dict
        Axis of `a` and the axis of `b` that it stands for: ``{"axial": "-z"}``.
    from_plane_1_mm, from_nose_mm, plane_1_mm, spacing_mm, resolution_um, linearity_percent, probe
        As of :func:`drift`.
    out : path or list of paths
        Both and their difference at the common times, .csv.
    plot : path
        A picture of them, .svg.

    Returns
    -------
    Comparison
        The conclusion, and um of each axis.

    Raises
    ------
    BallbarError
        No axis in common, other units, or fewer than 3 common times.

    Notes
    -----
    Mean relative deviation: He 2015. Limits of agreement: Bland, Altman 1986.

    Examples
    --------
    >>> import ballbar
    >>> ballbar.compare("sample-runs/two-arcs-he2015").conclusion
    'x, y, z agree within the stated uncertainty.'
    """
    call = Call("compare").series(a, *([] if b is None else [b]))
    call.options(
        reference=reference_s, max_gap=max_gap_s, match=match, from_plane_1=from_plane_1_mm, from_nose=from_nose_mm,
        plane_1=plane_1_mm, spacing=spacing_mm, resolution=resolution_um, linearity=linearity_percent, probe=probe,
        out=out, plot=plot,
    )
    return Comparison(call.run())


def history(
    folders: Any,
    *,
    tolerance: Mapping[str, float] | None = None,
    false_discovery_rate: float | None = None,
    strict: bool = False,
    out: Path | Sequence[Path] | None = None,
    progress: Progress | None = None,
) -> History:
    """Machines over their tests: what changed, trends, when a tolerance is met; of one its squareness and scales.

    Parameters
    ----------
    folders : path or list of paths
        As of :func:`errors`. Of several folders each is a machine, where its tests name none.
    tolerance : dict
        Limit of a quantity in its unit, to both sides of 0: ``{"backlash_a_pos": 5.0}``.
    false_discovery_rate : float
        The share of what is found that may be by chance; None: 0.05.
    strict : bool
        A file that cannot be read ends it.
    out : path or list of paths
        Written as well: .csv, .json, or .html with pictures.
    progress : callable
        As of :func:`errors`.

    Returns
    -------
    History
        Machine by machine, what needs something first; of one machine every quantity, else those of findings.

    Raises
    ------
    BallbarError
        Where there is no test that can be read, or no quantity of that name.

    Notes
    -----
    Findings: Y. Benjamini and Y. Hochberg, J. R. Stat. Soc. B 57 (1995). Trend: D. A. Harville, J. Am. Stat. Assoc. 72
    (1977); A. Gelman, Bayesian Analysis 1 (2006). Scatter of scales: R. C. Paule and J. Mandel, J. Res. Natl. Bur.
    Stand. 87 (1982).

    Examples
    --------
    >>> import ballbar
    >>> len(ballbar.history("sample-runs/machine-history").machines[0].groups)
    3
    """
    call = Call("history").files(folders).options(
        tolerance=tolerance, false_discovery_rate=false_discovery_rate, strict=strict, out=out
    )
    return History(call.run(progress))
