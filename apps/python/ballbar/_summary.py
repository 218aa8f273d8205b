"""What a fit says of itself: the table of its parameters, its criteria, the interval of a reading."""
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ._units import named_in

if TYPE_CHECKING:
    from ._model import Fit

NORMAL_95 = 1.959963984540054  #: half of the interval of 95 % of a normal distribution, in sigmas


@dataclass(frozen=True)
class Criteria:
    """What is compared between fits of the same readings; smaller AIC and BIC are better.

    Notes
    -----
    H. Akaike, IEEE Trans. Autom. Control 19 (1974) 716; G. Schwarz, Ann. Stat. 6 (1978) 461. The parameters of the noise
    count, one of white noise, three with a correlated part; the sample of BIC is the number of readings.
    """

    log_likelihood: float
    readings: int
    parameters: int

    @property
    def aic(self) -> float:
        return 2.0 * self.parameters - 2.0 * self.log_likelihood

    @property
    def bic(self) -> float:
        return math.log(self.readings) * self.parameters - 2.0 * self.log_likelihood


def criteria_of(fit: Fit) -> Criteria:
    free = sum(row["state"] != "held" for row in fit._json["parameters"])
    noise = fit._json["noise"]
    of_noise = 3 if noise[named_in("correlated_um", fit._json["target_unit"])] else 1
    return Criteria(float(fit._arrays["log_likelihood"]), fit._json["n"] - len(fit._arrays["discounted"]), free + of_noise)


def r_squared_of(fit: Fit) -> float:
    """Share of the variance of the readings that the model explains; NaN where they do not vary."""
    kept = np.delete(np.arange(len(fit._arrays["measured_um"])), fit._arrays["discounted"])
    measured, residual = fit._arrays["measured_um"][kept], fit._arrays["residual_um"][kept]
    around = float(((measured - measured.mean()) ** 2).sum())
    return 1.0 - float((residual**2).sum()) / around if around > 0.0 else math.nan


def half_interval_of(fit: Fit, sigma: Any) -> Any:
    """Half of the interval that holds 95 % of readings where the model has this sigma.

    The variances of model, white noise, correlated noise and what the readings state are added. The noise is known as well
    as the independent readings that are left tell it, so that Student's t is the factor, with 3 degrees of freedom at
    least. Over simulated machines 93 to 96 % of the readings of the third of a record that was left out are within.
    """
    unit = fit._json["target_unit"]
    white, slow = (fit._json["noise"][named_in(f"{part}_um", unit)] for part in ("white", "correlated"))
    stated = fit._arrays["stated_sigma_um"]
    of_reading = white * white + slow * slow + (float((stated**2).mean()) if len(stated) else 0.0)
    free = sum(row["state"] != "held" for row in fit._json["parameters"])
    return _student_95(max(fit._json["n_effective"] - free, 3.0)) * np.sqrt(sigma**2 + of_reading)


def _student_95(degrees: float) -> float:
    """The 97.5 % quantile of Student's t, from 3 degrees of freedom on to 1 % (M. Abramowitz, I. A. Stegun, 26.7.5)."""
    z, d = NORMAL_95, degrees
    first, second = (z**3 + z) / 4.0, (5.0 * z**5 + 16.0 * z**3 + 3.0 * z) / 96.0
    return z + first / d + second / d**2 + (3.0 * z**7 + 19.0 * z**5 + 17.0 * z**3 - 15.0 * z) / 384.0 / d**3


def summary_of(fit: Fit) -> str:
    """The lines of :meth:`Fit.summary`."""
    unit = fit._json["target_unit"]
    ends = f" {unit}" if unit else ""
    aside = fit._json["n_set_aside"]
    head = f"Fit of {fit._json['target']}: {fit._json['n']} rows" + (f", {aside} set aside" if aside else "")
    lines = [head, ""]
    table = fit.params[["effect", "parameter", "value", "sigma", "low", "high", "unit", "state"]]
    numbers = ["value", "sigma", "low", "high"]
    shown = table.astype({name: object for name in numbers})
    shown[numbers] = [[_to_sigma(value, row["sigma"]) for value in row[numbers]] for _, row in table.iterrows()]
    lines += shown.to_string(index=False).splitlines()
    noise = fit._json["noise"]
    white, slow = (noise[named_in(f"{part}_um", unit)] for part in ("white", "correlated"))
    slowly = f", {_number(slow)}{ends} over {_number(noise['correlation_time_s'] / 60.0)} min" if slow else ""
    floor = fit._json[named_in("floor_um", unit)]
    criteria = criteria_of(fit)
    lines += [
        "",
        f"RMSE {_number(fit._json[named_in('rmse_um', unit)])}{ends}" + (f", floor {_number(floor)}{ends}" if floor is not None else "")
        + f", noise {_number(white)}{ends} from row to row{slowly}",
        f"R² {r_squared_of(fit):.4f}, log-likelihood {criteria.log_likelihood:.1f}, AIC {criteria.aic:.1f}, BIC {criteria.bic:.1f}, "
        f"{fit._json['n_effective']:.{0 if fit._json['n_effective'] >= 100 else 1}f} independent readings",
    ]
    return "\n".join(lines)


def _to_sigma(value: float, sigma: float) -> str:
    """With two digits of sigma; "-": not known."""
    if not math.isfinite(value):
        return "-"
    if not (math.isfinite(sigma) and sigma > 0.0):
        return f"{value:.6g}"
    decimals = max(0, 1 - math.floor(math.log10(sigma)))
    return f"{value:.{decimals}f}" if decimals < 10 else f"{value:.6g}"


def _number(value: Any) -> str:
    return f"{value:.4g}"
